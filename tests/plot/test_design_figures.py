"""Figures of design: nothing covers anything, and they show the numbers of kp.design."""

import kempe as kp
import numpy as np
import pytest
from kempe import plot
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from plot.overlaps import faults
from python.test_design_kinematics import four_bar
from python.test_kinematics import slider_crank, started


@pytest.fixture(scope="module")
def turn() -> kp.Solution:
    m = slider_crank(speed=30.0)
    return kp.inverse_dynamics(m, started(m), t_end="2*pi/30")


@pytest.fixture(scope="module")
def rocker() -> kp.Solution:
    m = four_bar()
    start = kp.assemble(m, guess={"coupler.angle": "50 deg", "rocker.angle": "-90 deg"})
    return kp.inverse_dynamics(m, start, over="crank.angle", range=(0, "2*pi"))


FIGURES = {
    "curve": ("rocker", lambda sol: plot.coupler_curve(sol, "coupler.P")),
    "transmission": ("rocker", lambda sol: plot.transmission_angle(sol, "B")),
    "transmission of a slide": ("turn", lambda sol: plot.transmission_angle(sol, "B")),
    "effort": ("turn", lambda sol: plot.effort(sol, "motor")),
    "effort over time": ("turn", lambda sol: plot.effort(sol, "motor", over="t")),
    "duty": ("turn", lambda sol: plot.torque_speed(sol, "motor")),
    "velocities": ("rocker", lambda sol: plot.velocity_polygon(sol, 1.0)),
    "accelerations": ("rocker", lambda sol: plot.acceleration_polygon(sol, 1.0)),
    "centres": ("rocker", lambda sol: plot.instant_centres(sol, 1.0)),
    "pin": ("turn", lambda sol: plot.pin_load(sol, "A", on="rod")),
    "pin of a coupler": ("rocker", lambda sol: plot.pin_load(sol, "B", on="coupler")),
    "shaking": ("turn", plot.shaking_force),
    "rod": ("turn", lambda sol: plot.free_body(sol, "rod", 0.05)),
    "crank": ("turn", lambda sol: plot.free_body(sol, "crank", 0.05)),
    "piston": ("turn", lambda sol: plot.free_body(sol, "piston", 0.05)),
    "coupler": ("rocker", lambda sol: plot.free_body(sol, "coupler", 1.0)),
}


def figure_of(axes: Axes) -> Figure:
    return axes.figure.canvas.figure


@pytest.mark.parametrize("name", FIGURES)
def test_no_text_covers_another_or_leaves_the_paper(
    name: str, turn: kp.Solution, rocker: kp.Solution
) -> None:
    of, draw = FIGURES[name]
    figure = figure_of(draw(turn if of == "turn" else rocker))
    assert faults(figure) == ([], [])


def test_a_motion_over_time_with_one_driver_is_drawn_over_the_crank_angle(
    turn: kp.Solution,
) -> None:
    axes = plot.effort(turn, "motor")
    assert axes.get_xlabel() == "crank.angle / °"
    x, y = axes.lines[1].get_data()
    assert (x[0], x[-1]) == pytest.approx((np.degrees(0.2), np.degrees(0.2) + 360))
    found = kp.design.duty(turn, "motor")
    assert np.max(np.abs(y)) == pytest.approx(abs(found.peak.value), rel=1e-4)
    assert plot.effort(turn, "motor", over="t").get_xlabel() == "time t / s"
    words = [text.get_text() for text in axes.texts]
    assert any(f"{found.peak.value:.4g}".replace("-", "−") in text for text in words)


def test_the_title_of_a_path_gives_its_length_and_area(rocker: kp.Solution) -> None:
    found = kp.design.coupler_curve(rocker, "coupler.P")
    title = plot.coupler_curve(rocker, "coupler.P").get_title("left")
    assert f"{found.length:.4g} m" in title
    assert f"area {found.area:.4g} m²" in title


def test_a_free_body_names_all_forces_with_values(turn: kp.Solution) -> None:
    axes = plot.free_body(turn, "rod", 0.05)
    figure_of(axes).draw_without_rendering()
    words = {text.get_text() for text in axes.findobj() if hasattr(text, "get_text")}
    for load in kp.design.free_body(turn, "rod", 0.05).loads:
        name = "m g" if load.kind == "gravity" else load.name
        assert f"{name}: {np.hypot(*load.force):.4g} N" in words
    assert any(word.startswith("−m a: ") for word in words)
    assert any(word.startswith("−J α: ") for word in words)


def test_a_polar_diagram_shows_the_tip_of_the_force(turn: kp.Solution) -> None:
    axes = plot.pin_load(turn, "A", on="rod")
    found = kp.design.pin_load(turn, "A", on="rod")
    drawn = next(line for line in axes.lines if len(line.get_xdata()) == len(found.t))
    assert np.column_stack(drawn.get_data()) == pytest.approx(found.force)
    words = " ".join(text.get_text() for text in axes.texts)
    assert f"{found.extremes['max'].value:.4g} N" in words
