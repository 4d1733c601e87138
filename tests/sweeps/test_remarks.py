"""Measures of a sweep that read redundant joints are marked as not unique."""

import contextlib
import io
from pathlib import Path

import kempe as kp
import pytest
from kempe.cli import app

MEASURES = ["low.force.max", "hook.force.max", "rest.final", "lamp.angle.final"]
OPEN = ("low.force.max", "rest.final")


def door(redundancy: str = "allow") -> kp.Case:
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
    return kp.Case(m, {"set": {"lamp.angle": "-90*deg"}}, [kp.Dynamics(t_end=0.1)])


def swept(case: kp.Case) -> kp.SweepResult:
    return kp.sweep(case, {"M": {"from": 1, "to": 2, "n": 3}}, MEASURES)


def test_columns_and_figures_are_marked(tmp_path: Path) -> None:
    found = swept(door())
    assert found.minimum_norm == OPEN
    found.to_csv(tmp_path / "sweep.csv")
    header = (tmp_path / "sweep.csv").read_text("utf-8").partition("\n")[0]
    expected = [f"{name} [minimum norm]" if name in OPEN else name for name in MEASURES]
    assert header == ",".join(["M", *expected, "reason"])
    for name in MEASURES:
        label = kp.plot.sweep_lines(found, name).get_ylabel()
        assert (", minimum norm" in label) == (name in OPEN)


def test_without_redundancy_nothing_is_marked(tmp_path: Path) -> None:
    found = swept(door("refuse"))
    assert found.minimum_norm == ()
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
