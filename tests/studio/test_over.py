"""Kinematics over a quantity, and the transmission angle, against Python and closed forms."""

import csv
import re
from collections.abc import Callable
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from python.test_design_kinematics import A, B, C, G, four_bar
from python.test_kinematics import L, R, slider_crank
from studio.test_files import given
from studio.window import Studio

GUESS = {"coupler.angle": "50 deg", "rocker.angle": "-90 deg"}
TEN = [0, 31, 72, 108, 150, 180, 211, 254, 307, 360]


def crank_rocker() -> tuple[kp.Model, dict[str, str], str]:
    return four_bar(), GUESS, "rocker.angle"


def engine() -> tuple[kp.Model, dict[str, str], str]:
    return slider_crank(), {"piston.x": "0.4"}, "piston.x"


Machine = Callable[[], tuple[kp.Model, dict[str, str], str]]


def opened(one: Studio, tmp_path: Path, machine: Machine, *analyses: kp.Kinematics) -> kp.Case:
    """A machine in the window; the same case in Python."""
    model, guess, _ = machine()
    path = tmp_path / "machine.toml"
    kp.Case(model, {"guess": guess}, list(analyses)).save(path)
    assert one.load(path.read_text(encoding="utf-8"))["problems"] == []
    one.mode("read")
    return kp.load(path)


def request(one: Studio, quantity: str, first: str, last: str) -> None:
    """A run over a quantity as a user requests it."""
    one.page.locator("#analysis").select_option(label="over a quantity")
    one.settle()
    one.page.locator("#over").select_option(quantity)
    one.page.locator("#over-first").fill(first)
    one.page.locator("#over-last").fill(last)
    one.page.locator("#run").click()
    one.settle()


def read(one: Studio, *names: str) -> tuple[np.ndarray, np.ndarray, list[str]]:
    found = one.call("names => kempe.values(names)", list(names))
    return np.array(found["t"]), np.array(found["rows"]), found["units"]


@pytest.mark.parametrize("machine", [crank_rocker, engine])
def test_an_analysis_over_the_crank_angle_has_the_numbers_of_python(
    one: Studio, tmp_path: Path, machine: Machine
) -> None:
    turn = kp.Kinematics(over="crank.angle", range=(0, "2*pi"), name="turn")
    output = machine()[2]
    solution = opened(one, tmp_path, machine, turn).run()["turn"]
    rates = {
        "rocker.angle": ("rocker.omega", "rocker.alpha"),
        "piston.x": ("piston.vx", "piston.ax"),
    }
    names = ("crank.angle", output, *rates[output])
    t, rows, units = read(one, *names)
    assert len(t) == 361
    assert units == [kp.results.quantities.named(solution, name).unit for name in names]
    assert units[2:] == {"rocker.angle": ["rad/rad", "rad/rad^2"]}.get(output, ["m/rad", "m/rad^2"])
    np.testing.assert_allclose(t[TEN], np.radians(TEN), rtol=0, atol=1e-12)
    for name, row in zip(names, rows, strict=True):
        np.testing.assert_allclose(row[TEN], solution[name][TEN], rtol=0, atol=1e-9, err_msg=name)


@pytest.mark.parametrize(
    ("first", "last", "ends"),
    [("0", "360", (0.0, 2 * np.pi)), ("90", "-30", (-np.pi / 6, np.pi / 2))],
)
def test_a_requested_run_is_that_of_python(
    one: Studio, tmp_path: Path, first: str, last: str, ends: tuple[float, float]
) -> None:
    case = opened(one, tmp_path, crank_rocker)
    request(one, "crank.angle", first, last)
    t, (angle,), _ = read(one, "rocker.angle")
    low, high = ends
    np.testing.assert_allclose(t, np.linspace(low, high, 361), rtol=0, atol=1e-12)
    solution = kp.kinematics(case.model, case.start(), over="crank.angle", range=(low, high))
    np.testing.assert_allclose(angle, solution["rocker.angle"], rtol=0, atol=1e-9)


def test_a_turn_of_the_driven_crank_is_offered_first(one: Studio, tmp_path: Path) -> None:
    opened(one, tmp_path, crank_rocker)
    one.page.locator("#analysis").select_option(label="over a quantity")
    one.wait("document.querySelector('#over').value === 'crank.angle'")
    assert one.page.locator("#over-first").input_value() == "0"
    assert one.page.locator("#over-last").input_value() == "360"
    one.page.locator("#run").click()
    one.settle()
    assert "361 states up to crank.angle = 360°" in one.message()
    one.page.locator("#over").select_option("rocker.x")  # a length has no range by itself
    one.page.locator("#run").click()
    one.settle()
    assert "range is not complete" in one.message()


def test_a_range_that_the_mechanism_cannot_pass_keeps_its_part(one: Studio, tmp_path: Path) -> None:
    case = opened(one, tmp_path, engine)
    # without the law of the driver, so that the piston may drive
    request(one, "piston.x", "0.35", "0.45")
    start = case.start()
    with pytest.raises(kp.SingularityError) as error:
        kp.kinematics(case.model, start, over="piston.x", range=(0.35, 0.45))
    assert error.value.value == pytest.approx(R + L, abs=1e-9)
    t, _, _ = read(one, "crank.angle")
    known = error.value.solution
    assert known is not None
    np.testing.assert_allclose(t, known.t, rtol=0, atol=1e-9)
    assert f"{R + L:g}" in one.message()


def labels(one: Studio) -> None:
    """Notes what is drawn as text from now on: `drawn` on the plots, `sheet` on the sheet."""
    one.call(
        """() => {
          window.drawn = [];
          window.sheet = [];
          const write = CanvasRenderingContext2D.prototype.fillText;
          CanvasRenderingContext2D.prototype.fillText = function (text, ...where) {
            (this.canvas.id === "sheet" ? window.sheet : window.drawn).push(text);
            return write.call(this, text, ...where);
          };
        }"""
    )


def test_axis_and_playback_show_the_quantity(one: Studio, tmp_path: Path) -> None:
    turn = kp.Kinematics(over="crank.angle", range=(0, "2*pi"), name="turn")
    opened(one, tmp_path, crank_rocker, turn)
    labels(one)
    one.page.get_by_label("Add plot").select_option("rocker.omega")
    one.wait("window.drawn.includes('crank.angle / °') && window.drawn.includes('360')")
    one.wait("window.drawn.includes('rocker.omega / (°/°)')")
    condition = "with inertia and damping at 1 rad/s"
    assert condition not in one.call("() => window.drawn")
    one.page.get_by_label("Add plot").select_option("motor.effort")
    one.wait(f"window.drawn.includes('{condition}')")
    clock = one.page.locator(".clock")
    assert re.sub(r"\s+", " ", clock.inner_text()) == "crank.angle 0.0°"
    one.page.locator("#scrub").fill(str(np.pi / 2))
    one.settle()
    assert "90.0°" in clock.inner_text()
    one.page.get_by_text("° and rpm").click()
    one.wait("window.drawn.includes('crank.angle / rad')")
    one.wait("window.drawn.includes('rocker.omega / (rad/rad)')")
    assert "1.571 rad" in clock.inner_text()
    one.page.get_by_text("° and rpm").click()
    one.settle()


def test_arrows_over_the_quantity_have_its_units_and_a_note(one: Studio, tmp_path: Path) -> None:
    turn = kp.InverseDynamics(over="crank.angle", range=(0, "2*pi"), name="turn")
    opened(one, tmp_path, crank_rocker, turn)
    labels(one)
    note = "forces with inertia and damping at 1 rad/s"
    for kind in ("Velocities", "Reactions"):
        one.page.get_by_label(kind).uncheck()
    one.page.get_by_label("Velocities").check()
    one.wait("window.sheet.some(text => /m\\/° coupler/.test(text))")
    assert note not in one.call("() => window.sheet")
    one.page.get_by_label("Reactions").check()
    one.wait(f"window.sheet.includes('{note}')")


def test_the_transmission_angle_of_the_crank_rocker(one: Studio, tmp_path: Path) -> None:
    turn = kp.Kinematics(over="crank.angle", range=(0, "2*pi"), name="turn")
    solution = opened(one, tmp_path, crank_rocker, turn).run()["turn"]
    name = "transmission angle at B"
    one.page.get_by_label("Add plot").select_option(name)
    one.settle()
    t, (found,), units = read(one, name)
    assert units == ["rad"]
    diagonal = A**2 + G**2 - 2 * A * G * np.cos(t)
    expected = np.arccos((B**2 + C**2 - diagonal) / (2 * B * C))
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)
    python = kp.design.transmission_angle(solution, "B")
    ends = [python.limits.least.value, python.limits.largest.value]  # at 0 and 180 degrees
    np.testing.assert_allclose(found[[0, 180]], ends, rtol=0, atol=1e-9)
    legend = one.page.locator(".legend li").filter(has_text=name).inner_text()
    assert f"peak {np.degrees(expected.max()):.4g}" in legend


def test_the_transmission_angle_of_the_slider_crank_is_at_its_slide(
    one: Studio, tmp_path: Path
) -> None:
    turn = kp.Kinematics(over="crank.angle", range=(0, "2*pi"), name="turn")
    opened(one, tmp_path, engine, turn)
    offered = one.page.get_by_label("Add plot").locator("option").all_inner_texts()
    assert [text for text in offered if "transmission" in text] == ["transmission angle at B"]
    t, (found,), _ = read(one, "transmission angle at B")
    np.testing.assert_allclose(found, np.arccos(R / L * np.sin(t)), rtol=0, atol=1e-9)


def test_csv_has_the_quantity_in_its_first_column(one: Studio, tmp_path: Path) -> None:
    turn = kp.Kinematics(over="crank.angle", range=(0, "2*pi"), n=37, name="turn")
    solution = opened(one, tmp_path, crank_rocker, turn).run()["turn"]
    assert "at 1 rad/s" in one.page.locator("#condition").inner_text()
    for name in ("transmission angle at B", "rocker.omega", "motor.effort"):
        one.page.get_by_label("Add plot").select_option(name)
        one.settle()
    hint = "Save the plotted curves as CSV, in SI units and rad"
    path = given(one, hint, tmp_path / "curves.csv")
    with path.open(encoding="utf-8") as file:
        head = next(csv.reader(file))
    names = ["crank.angle", "coupler.angle", "rocker.angle", "transmission angle at B"]
    effort = f"motor.effort [N*m, {solution.variable.condition}]"
    assert head == [*(f"{name} [rad]" for name in names), "rocker.omega [rad/rad]", effort]
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    np.testing.assert_allclose(table[:, 0], solution.t, rtol=0, atol=1e-12)
    np.testing.assert_allclose(table[:, 2], solution["rocker.angle"], rtol=0, atol=1e-9)


def test_measures_may_be_formulas(one: Studio, tmp_path: Path) -> None:
    model, guess, _ = crank_rocker()
    path = tmp_path / "machine.toml"
    turn = kp.Kinematics(over="crank.angle", range=(0, "2*pi"), name="turn")
    kp.Case(model, {"guess": guess}, [turn]).save(path)
    text = (
        path.read_text(encoding="utf-8")
        + '\n[measures]\nlift = "2*rocker.B.y + hypot(rocker.B.x, 0.1)"\n'
    )
    path.write_text(text, encoding="utf-8")
    solution = kp.load(path).run()["turn"]
    assert one.load(text)["problems"] == []
    one.mode("read")
    for name in ("lift", "2*rocker.B.y + hypot(rocker.B.x, 0.1)"):
        _, (found,), _ = read(one, name)
        np.testing.assert_allclose(found, solution["lift"], rtol=0, atol=1e-9)
    shown = one.page.locator(".measure").first.inner_text()
    numbers = [float(x.replace("−", "-")) for x in re.findall(r"(−?[\d.]+)", shown)]
    assert numbers[-1] == pytest.approx(solution["lift"][-1], rel=1e-3), shown
