"""The flagship, simulated with the public interface, and the independent reference."""

import json
from pathlib import Path
from typing import Any

import kempe as kp
import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def reference() -> dict[str, Any]:
    text = (ROOT / "tests/reference/four_bar.json").read_text("utf-8")
    return dict(json.loads(text))


@pytest.fixture(scope="session")
def case() -> kp.Case:
    return kp.load(ROOT / "examples/four_bar.toml")


@pytest.fixture(scope="session")
def start(case: kp.Case) -> kp.State:
    return case.start()


@pytest.fixture(scope="session")
def tight(case: kp.Case, start: kp.State) -> kp.Solution:
    """15 s at rtol 1e-9, atol 1e-12, every 0.01 s."""
    return kp.dynamics(
        case.model,
        start,
        t_end=15,
        output_step=0.01,
        method=kp.RK45(rtol=1e-9, atol=1e-12),
        stabilization=kp.Baumgarte(alpha=10, beta=200),
    )
