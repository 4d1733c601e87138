"""The flagship with measures, over a brief time."""

from pathlib import Path

import kempe as kp
import pytest
from house.places import ROOT

FLAGSHIP = ROOT / "examples" / "four_bar.toml"


def flagship(t_end: float = 0.5) -> kp.Case:
    """The flagship with the default method."""
    case = kp.load(FLAGSHIP)
    case.model.measures(pin="C.force", lean="rocker.angle - coupler.angle", where="crank.B.x")
    run = kp.Dynamics(t_end=t_end, output_step=0.01, name="release")
    start = {"set": case._start.set, "guess": case._start.guess}
    return kp.Case(case.model, start, [run])


@pytest.fixture
def case() -> kp.Case:
    return flagship()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path
