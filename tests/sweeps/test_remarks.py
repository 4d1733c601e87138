"""Measures of a sweep that read redundant joints are marked as not unique."""

import contextlib
import io
import json
import pickle
import sys
from pathlib import Path

import kempe as kp
import numpy as np
import pandas
import pytest
from kempe.cli import app

MEASURES = ["low.force.max", "hook.force.max", "rest.final", "lamp.angle.final"]
OPEN = ("low.force.max", "rest.final")


#: The remarks on them.
REMARKS = dict.fromkeys(OPEN, "minimum norm")
G = 9.81


def door(redundancy: str = "allow", analysis: object = None) -> kp.Case:
    """A door on two slides, of which one is too many if both are there; a lamp hangs on it."""
    m = kp.Model("door", gravity=(0, -9.81), redundancy=redundancy, parameters={"M": 10})
    m.ground.points(A=(0, 0), B=(0, 1))
    points = {"A": (0, 0), "B": (0, 1)}
    m.body("door", mass="M", inertia=1, center=(0.5, 0.5), points=points)
    m.bar("lamp", mass=1, length=0.3, ends=("P", "Q"))
    m.translational("low", "ground.A", "door.A")
    if redundancy == "allow":
        m.translational("high", "ground.B", "door.B")
    m.revolute("hook", "door.B", "lamp.P")
    m.coordinate_driver("motor", "door.x", value="0.3*sin(5*t)")
    m.measures(rest="2*low.torque")
    start = {"set": {"lamp.angle": "-90*deg"}}
    return kp.Case(m, start, [analysis or kp.Dynamics(t_end=0.1)])


def swept(case: kp.Case) -> kp.SweepResult:
    return kp.sweep(case, {"M": {"from": 1, "to": 2, "n": 3}}, MEASURES)


def test_columns_and_figures_are_marked(tmp_path: Path) -> None:
    found = swept(door())
    assert found.choices == dict.fromkeys(OPEN, "minimum norm")
    found.to_csv(tmp_path / "sweep.csv")
    header = (tmp_path / "sweep.csv").read_text("utf-8").partition("\n")[0]
    expected = [f"{name} [minimum norm]" if name in OPEN else name for name in MEASURES]
    assert header == ",".join(["M", *expected, "reason"])
    for name in MEASURES:
        label = kp.plot.sweep_lines(found, name).get_ylabel()
        assert (", minimum norm" in label) == (name in OPEN)


def test_without_redundancy_nothing_is_marked(tmp_path: Path) -> None:
    found = swept(door("refuse"))
    assert found.choices == {}
    assert found.remarks == found.table.attrs["remarks"] == {}
    assert "minimum" not in repr(found)
    found.to_csv(tmp_path / "sweep.csv")
    assert "minimum norm" not in (tmp_path / "sweep.csv").read_text("utf-8")


def test_the_printed_table_has_stars(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    door().save(tmp_path / "door.json")
    asked = [part for name in MEASURES for part in ("--measure", name)]
    line = ["sweep", str(tmp_path / "door.json"), "--over", "M=1:2:2", *asked]
    with contextlib.redirect_stderr(io.StringIO()):
        assert app.run([*line, "-o", str(tmp_path / "out")]) == 0
    told = capsys.readouterr().out
    for name in MEASURES:
        assert (f"* {name} " in told) == (name in OPEN)
    assert f"* not unique, of the smallest multipliers (minimum norm): {', '.join(OPEN)}" in told


def test_the_table_and_copies_of_the_result_have_the_remarks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = swept(door())
    assert found.remarks == found.table.attrs["remarks"] == REMARKS
    assert list(found.table) == ["M", *MEASURES, "reason"]
    assert "low.force.max (minimum norm), hook.force.max," in repr(found)
    assert pickle.loads(pickle.dumps(found)).remarks == REMARKS
    found.to_parquet(tmp_path / "sweep.parquet")
    assert pandas.read_parquet(tmp_path / "sweep.parquet").attrs["remarks"] == REMARKS
    monkeypatch.setitem(sys.modules, "pandas", None)
    bare = swept(door())
    assert bare.table.dtype.names == ("M", *MEASURES, "reason")
    assert bare.remarks == bare.table.dtype.metadata["remarks"] == REMARKS


def test_a_sweep_that_resumes_keeps_its_remarks(tmp_path: Path) -> None:
    for _ in range(2):
        found = kp.sweep(door(), {"M": [1, 2]}, MEASURES, out=tmp_path / "sweep.db")
        assert found.remarks == REMARKS


def test_labels_of_the_scatter_matrix() -> None:
    figure = kp.plot.sweep_scatter(swept(door()))
    across = [axes.get_xlabel() for axes in figure.axes if axes.get_xlabel()]
    up = [axes.get_ylabel() for axes in figure.axes if axes.get_ylabel()]
    expected = [f"{name},\nminimum norm" if name in OPEN else name for name in ["M", *MEASURES]]
    assert across == up == expected


@pytest.mark.parametrize("name", MEASURES[:2])
def test_tolerances(name: str) -> None:
    found = kp.tolerances(door(), {"M": 0.1}, name, n=10)
    assert found.remark == REMARKS.get(name, "")
    label = f"{name}, minimum norm" if name in OPEN else name
    assert repr(found).startswith(f"<Tolerances of {label}: ")
    shown = kp.plot.sweep_contributions(found).get_xlabel()
    assert shown == f"contribution to {label} (first order) / %"
    shown = kp.plot.sweep_contributions(found.sample, name).get_xlabel()
    assert shown == f"contribution to {label} (share of the variance) / %"


def test_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    door().save(tmp_path / "door.json")
    asked = [part for name in MEASURES for part in ("--measure", name)]
    line = ["sweep", str(tmp_path / "door.json"), "--over", "M=1:2:2", *asked, "--json"]
    with contextlib.redirect_stderr(io.StringIO()):
        assert app.run([*line, "-o", str(tmp_path / "out")]) == 0
    assert json.loads(capsys.readouterr().out)["remarks"] == REMARKS


def test_an_equilibrium() -> None:
    """Two equal slides share the moment of the weights about the line of their guide."""
    asked = ["low.torque", "rest", "hook.force", "door.x"]
    found = kp.sweep(door(analysis=kp.Equilibrium()), {"M": [1, 2]}, asked)
    np.testing.assert_allclose(found["hook.force"], G, rtol=1e-9)
    np.testing.assert_allclose(np.abs(found["low.torque"]), 0.5 * found["M"] * G / 2, rtol=1e-9)
    assert found.remarks == dict.fromkeys(asked[:2], "minimum norm")


@pytest.mark.parametrize("kind", [kp.Kinematics, kp.InverseDynamics])
def test_a_motion_over_a_quantity(kind: type) -> None:
    """The driver of the quantity exists during the analysis only; it is not redundant."""
    m = kp.Model("slides", gravity=(0, -G), redundancy="allow", parameters={"M": 10})
    m.ground.points(A=(0, 0), B=(0, 1))
    points = {"A": (0, 0), "B": (0, 1)}
    m.body("door", mass="M", inertia=1, center=(0.5, 0.5), points=points)
    m.translational("low", "ground.A", "door.A")
    m.translational("high", "ground.B", "door.B")
    asked = ["low.torque.max", "over.effort.max", "over.effort.peak"]
    case = kp.Case(m, analyses=[kind(over="door.x", range=[0, 0.2], n=3)])
    found = kp.sweep(case, {"M": [1, 2]}, asked)
    np.testing.assert_allclose(np.abs(found["low.torque.max"]), 0.5 * found["M"] * G / 2)
    np.testing.assert_allclose(found["over.effort.peak"], 0, atol=1e-9)
    assert found.remarks == {"low.torque.max": "minimum norm"}
