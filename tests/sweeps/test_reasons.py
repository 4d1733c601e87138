"""The reasons of rows: one line each, without places in files, with gaps in metres."""

import pickle
import re
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.sweeps.reasons import reason
from sweeps.conftest import flagship


def test_gaps_have_one_unit(case: kp.Case) -> None:
    """At 70° the pins B and D are 18.994 m apart; a coupler of 1 m leaves 6 cm to the rocker."""
    found = kp.sweep(case, {"L2": [1.0, 47.0]}, ["pin.max"])
    between = np.hypot(20 - 10 * np.cos(np.radians(70)), 10 * np.sin(np.radians(70)))
    exact = [between - 19.0, 47.0 - 18.0 - between]
    for k, gap in enumerate(exact):
        told = re.findall(r"by ([\d.]+) (\S+) at joint C", found.reasons[k])
        assert [unit for _, unit in told] == ["m"]
        assert float(told[0][0]) == pytest.approx(gap, abs=1e-3)


@pytest.mark.parametrize(
    ("message", "expected"),
    [
        ("links are short by 57.595 mm at joint C", "links are short by 0.057595 m at joint C"),
        ("open by 7.010 µm in all", "open by 0.000007010 m in all"),
        ("open by 1.500 nm in all", "open by 0.000000001500 m in all"),
        ("too long by 22.942 m at joint C", "too long by 22.942 m at joint C"),
        ("a.toml: 2 problems\na: b (line 2, column 3)\n  2 | x\n    | ^\nc: d", "a: b; c: d"),
        ("a.toml: two drivers contradict", "two drivers contradict"),
    ],
)
def test_messages_become_reasons(message: str, expected: str) -> None:
    assert reason(message, "a.toml") == expected


@pytest.mark.parametrize("count", [2, 17])
def test_the_number_of_problems_is_no_reason(count: int) -> None:
    problems = [f"field {k}: {k} problems with it" for k in range(count)]
    assert reason("\n".join([f"a.toml: {count} problems", *problems]), "a.toml") == (
        "; ".join(problems)
    )


def test_an_impossible_model_has_a_reason_of_one_line(case: kp.Case) -> None:
    found = kp.sweep(case, {"L2": [-1.0], "L3": [18.0, -2.0]}, ["pin.max"])
    first = "bodies.coupler.length: -1 m; must be > 0"
    assert found.reasons == {0: first, 1: f"{first}; bodies.rocker.length: -2 m; must be > 0"}
    worker = pickle.loads(pickle.dumps(found._plan))
    assert worker.rows(found._design, 1).reasons == list(found.reasons.values())


@pytest.mark.parametrize(("statistic", "native"), [("max", True), ("frequency", False)])
def test_a_reason_does_not_name_the_file(statistic: str, native: bool, tmp_path: Path) -> None:
    """On threads of the core, and in single runs, one after the other."""
    path = tmp_path / "linkage.toml"
    flagship().save(path)
    measures = [f"crank.omega.{statistic}"]
    found = kp.sweep(kp.load(path), {"L2": [-1.0, 47.0]}, measures)
    assert found._plan.is_native == native
    assert found.reasons[0] == "bodies.coupler.length: -1 m; must be > 0"
    assert "joint C" in found.reasons[1] and "linkage" not in found.reasons[1]
