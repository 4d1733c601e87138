"""Results that are not motions: their files, their place in a case and on the command line."""

import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe import case as cases
from kempe.cli import app
from kempe.cli.figures import Drawing
from kempe.cli.results import write_result
from kempe.plot import Page, pages
from kempe.plot import result_pages as listed
from kempe.results.result import Result
from kempe.results.state import State
from kempe.results.table import Column
from matplotlib.figure import Figure


class Weighed(Result):
    """A result for tests."""

    kind = "kinematics"

    def __init__(self, state: State) -> None:
        self._state = state

    @property
    def final(self) -> State:
        return self._state

    def summary(self) -> dict[str, object]:
        return {"mass": 2.5}

    def report(self) -> list[str]:
        return ["mass: 2.5 kg"]

    def tables(self) -> dict[str, list[Column]]:
        number = Column("number", "", np.array([1.0, 2.0]))
        return {"masses": [number, Column("mass", "kg", np.array([0.1, 1 / 3]))]}


def pendulum() -> kp.Model:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    return m


def test_the_files_of_a_result(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(
        listed._PAGES, "kinematics", lambda *_: [Page(7, "masses", "masses", Figure)]
    )
    weighed = Weighed(kp.assemble(pendulum()))
    assert str(weighed) == "mass: 2.5 kg"
    assert [page.stem for page in pages(weighed)] == ["01_masses"]
    written = write_result(weighed, tmp_path, Drawing())
    assert (tmp_path / "masses.csv").read_text(encoding="utf-8").splitlines() == [
        "number,mass [kg]",
        "1,0.10000000000000001",
        "2,0.33333333333333331",
    ]
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["mass"] == 2.5
    assert summary["files"] == [path.relative_to(tmp_path).as_posix() for path in written]


def test_the_next_analysis_starts_from_its_state(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    turned = kp.assemble(pendulum(), set={"rod.angle": 1.25})
    monkeypatch.setitem(cases._RESULTS, "mobility", lambda _: Weighed(turned))
    rest, fall = kp.Mobility(name="rest"), kp.Dynamics(t_end=0.1, name="fall")
    case = kp.Case(pendulum(), {"set": {"rod.angle": 0}}, [rest, fall])
    results = case.run()
    assert isinstance(results["rest"], Weighed)
    assert results["fall"]["rod.angle"][0] == 1.25
    monkeypatch.chdir(tmp_path)
    case.save("pendulum.toml")
    assert app.run(["run", "pendulum.toml", "--figures", "none"]) == 0
    assert "  mass: 2.5 kg" in capsys.readouterr().out.splitlines()
    assert Path("out/pendulum/rest/masses.csv").exists()
    assert app.run(["show", "pendulum.toml", "--t", "0.05"]) == 0
    assert app.run(["animate", "pendulum.toml", "--at", "0.05", "-o", "still.png"]) == 0
