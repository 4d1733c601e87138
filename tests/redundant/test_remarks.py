"""Results that read reactions of redundant joints are marked as not unique wherever they appear."""

import io
import json
from collections.abc import Callable
from pathlib import Path

import kempe as kp
import pytest
from kempe import design
from kempe.cli.findings import show_findings
from kempe.lab_report.write import page
from kempe.results import remarks
from kempe.results.table import columns
from matplotlib.axes import Axes
from redundant.pinned import PINNED, Redundant
from redundant.wheels import WHEELS
from rich.console import Console

CLASSICS = PINNED | WHEELS
#: Redundant mechanisms of pins, slides, ropes and gears, and one with redundant drivers.
SOME = ["three cranks on a rod", "guided scissor lift", "swing on three ropes", "belt and gear"]


def measured(one: Redundant) -> tuple[dict[str, str], kp.Solution]:
    """A mechanism with a measure of each joint or driver; the measures, and a motion."""
    joints = list(one.model.compile().constraints)
    names = {joint: f"load {k}" for k, joint in enumerate(joints)}
    told = {name: f"2*abs({joint}.torque*{joint}.fx)" for joint, name in names.items()}
    one.model.measures({**told, "place": f"{next(iter(one.model.compile().bodies))}.x"})
    start = kp.assemble(one.model, set=one.start, guess=one.guess, redundancy="allow")
    return names, kp.dynamics(one.model, start, t_end=0.1, output_step=0.05)


def title(axes: Axes) -> str:
    return axes.get_title(loc="left")


@pytest.mark.parametrize("name", CLASSICS)
def test_measures_say_which_values_are_not_unique(name: str) -> None:
    one = CLASSICS[name]()
    names, sol = measured(one)
    labels = {column.name: column.label for column in columns(sol)}
    told = {row["name"]: row["unique"] for row in sol.summary["measures"]}
    for joint, measure in names.items():
        unique = joint not in one.joints
        assert sol.measure(measure).unique == told[measure] == unique
        assert ("minimum norm" in repr(sol.measure(measure))) == (not unique)
        assert ("minimum norm" in labels[measure]) == (not unique)
    assert told["place"]
    assert "minimum norm" not in labels["place"]


@pytest.mark.parametrize("name", SOME)
def test_the_printed_measures_have_stars(name: str) -> None:
    one = CLASSICS[name]()
    names, sol = measured(one)
    text = io.StringIO()
    show_findings(Console(file=text, width=250), "run", json.loads(json.dumps(dict(sol.summary))))
    rows = text.getvalue().partition("\nMeasures")[2].partition("\nAccuracy")[0]
    for joint, measure in names.items():
        assert (f"* {measure} " in rows) == (joint in one.joints)
        assert f" {measure} " in rows
    assert "* place" not in rows
    assert "(minimum norm): load " in rows


@pytest.mark.parametrize("name", SOME)
def test_pin_loads_and_free_bodies_are_marked(name: str, tmp_path: Path) -> None:
    one = CLASSICS[name]()
    _, sol = measured(one)
    for joint in sol.compiled.joints:
        for found in (design.pin_load(sol, joint), title(kp.plot.pin_load(sol, joint))):
            assert ("minimum norm" in str(found)) == (joint in one.joints)
    design.write_pin_loads(sol, tmp_path / "pins.csv")
    header = (tmp_path / "pins.csv").read_text("utf-8").partition("\n")[0]
    for column in design.pin_table(sol)[1:]:
        open_one = column.name.partition(".")[0] in one.joints
        assert column.unique != open_one
        assert (f"{column.name} [{column.unit}, minimum norm]" in header) == open_one
    for body, info in sol.compiled.bodies.items():
        own = [n for n, c in sol.compiled.constraints.items() if body in c.bodies]
        wanted = [n for n in own if n in one.joints]
        found = design.free_body(sol, body, 0.05)
        assert list(found.not_unique) == wanted, info
        found.to_csv(tmp_path / "body.csv")
        line = f"# not unique, minimum norm: {', '.join(wanted)}\n"
        assert (line in (tmp_path / "body.csv").read_text("utf-8")) == bool(wanted)
        assert ("minimum norm" in repr(found)) == bool(wanted)
        texts = [text.get_text() for text in kp.plot.free_body(sol, body, 0.05).texts]
        assert ("* minimum norm" in texts) == bool(wanted)
        for load in own:
            drawn = [text for text in texts if text.startswith(f"{load} ")]
            plain = [text for text in texts if text.startswith(f"{load}:")]
            assert not (plain if load in wanted else drawn)


def driven(*cranks: str) -> kp.Solution:
    """A parallelogram with motors on some of its cranks."""
    m = kp.Model("two motors", gravity=(0, -9.81), redundancy="allow")
    m.ground.points(A=(0, 0), D=(1, 0))
    for name, length in (("c", 0.5), ("k", 1), ("r", 0.5)):
        m.bar(name, mass=1, length=length, ends=("P", "Q"))
    for name, i, j in (("A", "ground.A", "c.P"), ("B", "c.Q", "k.P"), ("C", "k.Q", "r.Q")):
        m.revolute(name, i, j)
    m.revolute("D", "ground.D", "r.P")
    for crank in cranks:
        m.coordinate_driver(f"on_{crank}", f"{crank}.angle", value="1 + 2*t")
    m.measures(effort="on_c.effort", power=f"on_{cranks[-1]}.power", turned="c.angle")
    start = kp.assemble(m, guess={"k.angle": 0})
    return kp.inverse_dynamics(m, start, t_end=1, output_step=0.1)


@pytest.mark.parametrize("draw", [kp.plot.effort, kp.plot.torque_speed])
def test_efforts_of_redundant_drivers_are_marked(draw: Callable[..., Axes]) -> None:
    sol = driven("c", "r")
    assert not sol["on_c"].unique
    assert "minimum norm" in title(draw(sol, "on_c"))
    assert not design.duty(sol, "on_c").unique
    assert "minimum norm" in repr(design.duty(sol, "on_c"))
    assert "minimum norm" in repr(design.flywheel(sol, "on_c", fluctuation=0.1))
    assert [sol.measure(name).unique for name in sol.compiled.measures] == [False, False, True]
    single = driven("c")
    assert "minimum norm" not in title(draw(single, "on_c"))
    assert "minimum norm" not in repr(design.duty(single, "on_c"))
    assert "minimum norm" not in repr(design.flywheel(single, "on_c", fluctuation=0.1))


def test_figures_of_measures_are_marked() -> None:
    sol = driven("c", "r")
    marked = {
        name: "minimum norm" in title(kp.plot.measure(sol, name)) for name in sol.compiled.measures
    }
    assert marked == {"effort": True, "power": True, "turned": False}


def test_the_lab_report_marks_joints_and_measures() -> None:
    text = page(driven("c", "r"), None, None)
    assert {name for name in ("A", "on_c", "effort", "turned") if f">* {name}<" in text} == {
        "A",
        "on_c",
        "effort",
    }
    assert "* The reactions in the measures effort, power are not unique" in text


def test_positions_of_redundant_joints_read_no_reaction() -> None:
    for name in CLASSICS:
        model = CLASSICS[name]().model.compile()
        for joint, info in model.constraints.items():
            places = [f"{joint}.{of}" for each in info.measured for of in each.names if of]
            places += [f"{joint}.{of}" for of, _ in info.coordinates]
            assert not remarks.read_by(model, places)
            assert remarks.read_by(model, [f"{joint}.fx", "t", "energy.total"]) == {joint}


def test_a_force_from_a_reaction_reads_its_joint() -> None:
    model = kp.load("examples/four_bar.toml").model
    assert not remarks.read_by(model.compile(), ["k.torque", "crank.alpha"])
    m = kp.Model("slide")
    m.ground.points(O=(0, 0))
    m.body("block", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "block.P")
    m.friction("rub", "guide", kinetic=0.2)
    assert remarks.read_by(m.compile(), ["rub.power"]) == {"guide", "rub"}
