"""Results that read a reaction without bound state the times of the singular positions.

Two windows of the N-four-bar have poles on the line but nothing redundant; one window has none. A
driven set of three equal cranks has poles, and its reactions are not unique either.
"""

import io
from collections.abc import Callable
from functools import cache
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe import design
from kempe.cli.findings import show_findings
from kempe.lab_report.write import page
from kempe.model.measure_infos import measure_info
from kempe.plot import pages
from kempe.results import remarks
from matplotlib.axes import Axes
from rich.console import Console
from singular.equal_cranks import cranks, run

from examples.n_four_bar import upright, windows


@cache
def passing(n: int) -> kp.Solution:
    model = windows(n)
    model.measures(pin="B0.force", lift="B0.fy", height="crank0.B.y", spin="crank0.alpha")
    return kp.dynamics(model, upright(model, n), t_end=3, output_step=0.01)


@cache
def redundant() -> kp.Solution:
    of = cranks(2, number=3)
    of.model.measures(pin="B0.force")
    return run(of)


MECHANISMS = {"windows": lambda: passing(2), "cranks": redundant}


def on_the_line(sol: kp.Solution) -> np.ndarray:
    t = np.linspace(0, float(sol.t[-1]), 200_001)
    return t[np.flatnonzero(np.diff(np.sign(np.sin(sol(t)["crank0.angle"]))))]


def below_title(axes: Axes) -> str:
    return " ".join(text.get_text() for text in axes.texts if "bound" in text.get_text())


@pytest.mark.parametrize("name", MECHANISMS)
def test_a_measure_has_the_times_of_its_joint(name: str) -> None:
    sol = MECHANISMS[name]()
    found = sol.measure("pin")
    assert len(found.unbounded_at) > 1
    assert found.unbounded_at == pytest.approx(remarks.unbounded_at(sol, "B0"))
    first, last = (f"{found.unbounded_at[k]:.4g} s" for k in (0, -1))
    assert f", without bound first at {first}, last at {last}>" in repr(found)
    (told,) = (row for row in sol.summary["measures"] if row["name"] == "pin")
    assert told["unbounded_at"] == list(found.unbounded_at)
    figure = kp.plot.measure(sol, "pin")
    assert below_title(figure) == f"without bound first at {first}, last at {last}"
    assert ("minimum norm" in figure.get_title(loc="left")) == (name == "cranks")


def test_the_times_are_those_on_the_line() -> None:
    sol = passing(2)
    assert sol.measure("pin").unbounded_at == pytest.approx(on_the_line(sol), abs=1e-3)


def test_results_with_a_bound_have_no_times() -> None:
    """Positions, accelerations and vertical forces have no pole on the line."""
    sol = passing(2)
    for name in ("height", "spin", "lift"):
        assert sol.measure(name).unbounded_at == ()
        assert "bound" not in repr(sol.measure(name))
        assert not below_title(kp.plot.measure(sol, name))
    one = passing(1)
    assert one.measure("pin").unbounded_at == ()
    assert "bound" not in repr(design.pin_load(one, "B0"))
    assert not below_title(kp.plot.all_reactions(one))
    assert not design.free_body(one, "coupler0", 1.0).unbounded_at


def test_the_printed_measures_state_the_times() -> None:
    sol = passing(2)
    text = io.StringIO()
    show_findings(Console(file=text, width=250), "run", dict(sol.summary))
    rows = text.getvalue().partition("\nMeasures")[2].partition("\nAccuracy")[0]
    first, last = (f"{sol.measure('pin').unbounded_at[k]:.6g} s" for k in (0, -1))
    counted = "counted in integrals and means only"
    passed = f"without bound at singular positions, {counted} (first at {first}, last at {last})"
    assert f"{passed}: pin\n" in rows


@pytest.mark.parametrize("name", MECHANISMS)
def test_the_legend_of_reactions_marks_them(name: str) -> None:
    sol = MECHANISMS[name]()
    axes = kp.plot.all_reactions(sol)
    labels = {str(line.get_label()) for line in axes.get_lines()}
    for joint in sol.compiled.joints:
        (label,) = (text for text in labels if text.startswith(joint))
        passed = remarks.unbounded_at(sol, joint, ["force"])
        assert ("†" in label) == bool(passed), label
    assert below_title(axes).startswith("† without bound first at ")
    single = kp.plot.reactions(sol, "B0")
    assert below_title(single).startswith("without bound first at ")
    assert not below_title(kp.plot.reactions(sol, "B0", quantity="torque"))  # a pin has none
    (sheet,) = (one for one in pages(sol) if one.name == "reactions_B0")
    told = " ".join(text.get_text() for text in reversed(sheet.draw().texts))
    assert "The reactions of B0 are without bound first at " in told
    assert ("The reactions of B0 are not unique" in told) == (name == "cranks")


@pytest.mark.parametrize("name", MECHANISMS)
def test_pin_loads_have_the_peaks_of_the_reactions(name: str) -> None:
    sol = MECHANISMS[name]()
    found = design.pin_load(sol, "B0")
    (peak,) = (one for one in sol.summary["peaks"]["reactions"] if one["joint"] == "B0")
    assert found.extremes["max"].value == pytest.approx(peak["force"], rel=1e-9)
    assert list(found.unbounded_at) == peak["unbounded_at"]
    assert found.magnitude.max() > 1.1 * peak["force"]  # beside the poles
    assert ", without bound first at " in repr(found)
    axes = kp.plot.pin_load(sol, "B0")
    assert below_title(axes).startswith("without bound first at ")
    drawn = [line.get_xydata() for line in axes.get_lines()]
    longest = max(float(np.nanmax(np.hypot(*np.asarray(points).T))) for points in drawn[2:])
    assert longest <= peak["force"] * (1 + 1e-6)


def test_free_bodies_state_the_times(tmp_path: Path) -> None:
    sol = passing(2)
    found = design.free_body(sol, "coupler0", 1.0)
    assert set(found.unbounded_at) == {"B0", "C0"}
    assert "without bound first at " in repr(found)
    found.to_csv(tmp_path / "body.csv")
    first, last = (f"{found.unbounded_at['B0'][k]:.4g} s" for k in (0, -1))
    line = f"# without bound first at {first}, last at {last}: B0, C0\n"
    assert line in (tmp_path / "body.csv").read_text("utf-8")
    axes = kp.plot.free_body(sol, "coupler0", 1.0)
    texts = [text.get_text() for text in axes.texts]
    assert f"† without bound first at {first}, last at {last}" in texts
    assert any(text.startswith("B0 †: ") for text in texts)
    assert any(text.startswith("m g: ") for text in texts)


def test_the_lab_report_states_the_times() -> None:
    text = page(passing(2), None, None)
    assert (
        "The reactions in the measures pin have no bound at singular positions (first at " in text
    )
    assert "have no bound at singular positions (first at " in text.partition("Measures")[0]


@cache
def jacked(tube: float = 3.0) -> kp.Solution:
    """Two windows whose first coupler is a jack that is held at its length, with a heavy tube."""
    m = kp.Model("a jack in a window", gravity=(0, -9.81))
    m.ground.points(**{f"P{k}": (k, 0) for k in range(3)})
    for k in range(3):
        m.bar(f"crank{k}", mass=1, length=1, ends=("A", "B"))
        m.revolute(f"A{k}", f"ground.P{k}", f"crank{k}.A")
    for name, mass, length in (("tube", tube, 0.6), ("piston", 1, 0.6), ("coupler", 1, 1)):
        m.bar(name, mass=mass, length=length, ends=("P", "Q"))
    m.revolute("B0", "crank0.B", "tube.P")
    m.translational("slide", "tube.P", "piston.P")
    m.revolute("B1", "piston.Q", "crank1.B")
    m.revolute("C1", "coupler.P", "crank1.B")
    m.revolute("C2", "coupler.Q", "crank2.B")
    m.coordinate_driver("jack", "slide.displacement", value=0.4)
    level = {"tube.angle": 0, "piston.angle": 0, "coupler.angle": 0, "crank2.angle": "90*deg"}
    start = kp.assemble(m, set={"crank0.angle": "90*deg", "crank0.omega": -1}, guess=level)
    return kp.dynamics(m, start, t_end=3, output_step=0.01)


@pytest.mark.parametrize("draw", [kp.plot.effort, kp.plot.torque_speed])
def test_an_effort_without_bound(draw: Callable[..., Axes]) -> None:
    sol = jacked()
    found = design.duty(sol, "jack")
    assert found.unbounded_at == pytest.approx(on_the_line(sol), abs=1e-3)
    (peak,) = (one for one in sol.summary["peaks"]["reactions"] if one["joint"] == "jack")
    assert abs(found.peak.value) == pytest.approx(peak["force"], rel=1e-6)
    assert ", without bound first at " in repr(found)
    axes = draw(sol, "jack")
    assert below_title(axes).startswith("without bound first at ")
    unit = 1e3 if "kN" in axes.get_ylabel() else 1.0
    assert max(map(abs, axes.get_ylim())) * unit < 4 * peak["force"]  # not beside the poles


def test_forces_that_vanish_have_bounds() -> None:
    """With equal weights the axial force is zero: beside the line only errors grow."""
    sol = jacked(tube=1.0)
    assert np.median(np.abs(sol["jack.effort"])) < 1e-12
    for joint in ("jack", "slide"):
        assert not remarks.unbounded_at(sol, joint, ["force"])
    assert not design.duty(sol, "jack").unbounded_at
    info = measure_info(sol.compiled, "jack.effort")
    assert not remarks.measure_unbounded_at(sol, info)
    assert len(remarks.unbounded_at(sol, "A1")) == 3


def test_the_words_of_remarks() -> None:
    time, over = kp.results.variable.TIME, kp.results.variable.Variable("crank.angle", "rad")
    told = remarks.remark(remarks.MINIMUM_NORM, times=[0.5, 0.7], variable=time)
    assert told == ", minimum norm, without bound first at 0.5 s, last at 0.7 s"
    assert remarks.when([0.5, 0.5], time) == "at 0.5 s"
    assert remarks.when([-np.pi / 2, np.pi], over) == "first at −90°, last at 180°"
    with kp.units("ms"):
        assert remarks.when([0.5], time) == "at 500 ms"
