"""Numbers on figures over time agree with closed forms and with an independent evaluation."""

import math
import re
from typing import Any

import kempe as kp
import numpy as np
import pytest
from draw.mechanisms import slider_crank
from kempe import plot
from kempe.plot.panel import Panel
from kempe.plot.peaks import chosen_peaks
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from plot.conftest import pendulum
from sizes import some


def figure(solution: kp.Solution, name: str) -> Figure:
    return plot.select(plot.pages(solution), [name])[0].figure()


def panels(found: Figure) -> dict[str, Axes]:
    return {axes.get_title("left"): axes for axes in found.axes}


def drawn(axes: Axes) -> dict[str, np.ndarray]:
    return {str(line.get_label()): np.asarray(line.get_ydata()) for line in axes.lines}


def times(axes: Axes) -> np.ndarray:
    scale = 1e-3 if any("/ ms" in one.get_xlabel() for one in axes.figure.axes) else 1.0
    return np.asarray(axes.lines[0].get_xdata()) * scale


def note(found: Figure) -> str:
    return " ".join(text.get_text() for text in reversed(found.texts))


def turned(force: np.ndarray, angle: Any) -> np.ndarray:
    """Components of a global vector in axes turned by an angle."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * force[0] + s * force[1], c * force[1] - s * force[0]])


def test_curves_are_the_closed_form_of_the_slider(crank: kp.Solution) -> None:
    """x = r cos φ + √(l² - r² sin² φ), with v_x and a_x by its derivatives."""
    axes = panels(figure(crank, "x"))["3 slider"]
    motion = crank(times(axes))
    phi, omega, alpha = (getattr(motion.body("crank"), n) for n in ("angle", "omega", "alpha"))
    r, length = 0.1, 0.3
    root = np.sqrt(length**2 - (r * np.sin(phi)) ** 2)
    x = r * np.cos(phi) + root
    np.testing.assert_allclose(drawn(axes)["x"], x, atol=1e-7)
    first = -r * np.sin(phi) - r**2 * np.sin(phi) * np.cos(phi) / root
    second = -r * np.cos(phi) - r**2 * np.cos(2 * phi) / root
    second -= (r**2 * np.sin(phi) * np.cos(phi)) ** 2 / root**3
    lines = [axes.lines[0].get_ydata() for axes in figure(crank, "slider").axes]
    np.testing.assert_allclose(lines[0], first * omega, atol=1e-5)
    np.testing.assert_allclose(lines[1], second * omega**2 + first * alpha, atol=1e-3)


def test_a_curve_is_smooth_whatever_the_output_step(crank: kp.Solution) -> None:
    coarse = kp.dynamics(crank.model, crank.initial, t_end=1.0, output_step=0.1)
    axes = plot.positions(coarse, "slider", "x")
    t, x = axes.lines[0].get_data()
    middle = (t[1:] + t[:-1]) / 2
    off = np.abs((x[1:] + x[:-1]) / 2 - coarse(middle).body("slider").x)
    assert off.max() < 1e-3 * np.ptp(x)
    assert len(t) > 20 * len(coarse.t)


def test_angles_are_in_degrees_unless_their_unit_is_chosen(six_bar: kp.Solution) -> None:
    axes = panels(figure(six_bar, "angle"))["3 plate"]
    t, angle = axes.lines[0].get_data()
    assert axes.get_ylabel() == "φ / °"
    np.testing.assert_allclose(angle, np.degrees(six_bar(t)["plate"].angle), rtol=1e-12)
    with kp.units("rad"):
        axes = panels(figure(six_bar, "angle"))["3 plate"]
    assert axes.get_ylabel() == "φ / rad"
    np.testing.assert_allclose(axes.lines[0].get_ydata(), np.radians(angle), rtol=1e-12)


def test_joint_frames_of_a_six_bar_turn_with_their_bodies(six_bar: kp.Solution) -> None:
    found = panels(figure(six_bar, "reactions_C"))
    t = times(found["C on plate, joint frame"])
    motion = six_bar(t)
    forces = {}
    for body in ("coupler", "plate"):
        globally = drawn(found[f"C on {body}, global frame"])
        forces[body] = np.array([globally["$F_{x}$"], globally["$F_{y}$"]])
        locally = drawn(found[f"C on {body}, joint frame"])
        expected = turned(forces[body], motion.body(body).angle)
        assert np.abs(expected - forces[body]).max() > 10.0
        np.testing.assert_allclose(locally["$F_{x″}$"], expected[0], atol=1e-6)
        np.testing.assert_allclose(locally["$F_{y″}$"], expected[1], atol=1e-6)
        np.testing.assert_allclose(locally["|F|"], np.hypot(*expected), rtol=1e-12)
    np.testing.assert_allclose(forces["coupler"], -forces["plate"], atol=1e-9)


def test_reactions_of_a_six_bar_move_its_link(six_bar: kp.Solution) -> None:
    """The forces at E and F on the link, and its weight, are m a (Newton)."""
    E, F = (panels(figure(six_bar, f"reactions_{name}")) for name in "EF")
    at_e, at_f = (drawn(p[f"{n} on link, global frame"]) for p, n in ((E, "E"), (F, "F")))
    link = six_bar(times(E["E on link, global frame"])).body("link")
    np.testing.assert_allclose(at_e["$F_{x}$"] + at_f["$F_{x}$"], 1.0 * link.ax, atol=1e-6)
    np.testing.assert_allclose(at_e["$F_{y}$"] + at_f["$F_{y}$"] - 9.81, 1.0 * link.ay, atol=1e-6)


def test_a_rail_pushes_only_across() -> None:
    """A slide at 0.3 rad without friction: the global force is normal to it, on both bodies."""
    solution = slider_crank()
    found = panels(figure(solution, "reactions_guide"))
    across = drawn(found["guide on slider, joint frame"])
    globally = drawn(found["guide on slider, global frame"])
    normal = -math.sin(0.3) * globally["$F_{x}$"] + math.cos(0.3) * globally["$F_{y}$"]
    assert np.abs(across["$F_{x″}$"]).max() < 1e-6 * np.abs(normal).max()
    np.testing.assert_allclose(across["$F_{y″}$"], normal, atol=1e-6)


def test_the_force_of_a_spring_in_the_frame_of_its_body() -> None:
    from draw.mechanisms import sprung

    solution = sprung()
    rod = solution.body("rod")
    P = rod.point("P").position
    d = P - np.array([-1.2, 0.3])
    length = np.hypot(*d.T)
    u = d / length[:, None]
    rate = np.sum(u * rod.point("P").velocity, axis=1)
    size = -(100.0 * (length - 0.9) + 2.0 * rate)
    expected = turned(size * u.T, rod.angle).T
    found = solution.force("s").force(on="rod", frame="body")
    np.testing.assert_allclose(found, expected, atol=1e-9)
    assert np.abs(found - solution.force("s").force(on="rod")).max() > 1.0


def test_torque_of_the_spring_is_that_of_its_law(flagship: kp.Solution) -> None:
    """-k (φ - 270°) - c φ̇ on the rocker, and its peak at the start."""
    axes = figure(flagship, "torque_spring").axes[0]
    rocker = flagship(times(axes)).body("rocker")
    found = drawn(axes)
    stiffness = -1e6 * (rocker.angle - math.radians(270.0))
    np.testing.assert_allclose(1e3 * found["stiffness"], stiffness, atol=1e-3)
    np.testing.assert_allclose(1e3 * found["damping"], -1e4 * rocker.omega, atol=1e-3)
    np.testing.assert_allclose(found["sum"], found["stiffness"] + found["damping"], atol=1e-9)
    assert [text.get_text() for text in axes.texts] == [f"{stiffness[0] / 1e3:.4g} kN·m at 0 s"]


def test_energies_of_a_pendulum() -> None:
    axes = plot.energy(pendulum())
    found, t = drawn(axes), axes.lines[0].get_xdata()
    assert list(found) == ["kinetic T", "potential V", "T + V + D − W"]
    rod = pendulum()(t).body("rod")
    np.testing.assert_allclose(found["kinetic T"], 0.5 * 2.0 / 3.0 * rod.omega**2, atol=1e-6)
    np.testing.assert_allclose(found["potential V"], 2.0 * 9.81 * rod.y, atol=1e-6)


def test_peaks_have_the_values_of_closed_forms(crank: kp.Solution, six_bar: kp.Solution) -> None:
    axes = panels(figure(crank, "x"))["3 slider"]
    texts = [re.fullmatch(r"(\S+) m at (\S+) s", text.get_text()) for text in axes.texts]
    assert [found and float(found[1]) for found in texts] == [0.4, 0.2]
    for found in texts:
        assert found
        crank_angle = float(crank(float(found[2])).body("crank").angle) / math.pi
        assert crank_angle - round(crank_angle) == pytest.approx(0.0, abs=2e-3)
    marked = np.concatenate([points.get_offsets() for points in axes.collections])
    assert [tuple(row) for row in marked] == [
        pytest.approx((float(found[2]), float(found[1])), abs=1e-4) for found in texts if found
    ]
    # A rocker turns back where crank and coupler are in line: 75.52° and 138.59°.
    plate = panels(figure(six_bar, "angle"))["3 plate"]
    assert sorted(text.get_text().split()[0] for text in plate.texts) == ["138.6°", "75.52°"]


def test_of_several_curves_the_largest_magnitude_is_marked(six_bar: kp.Solution) -> None:
    axes = panels(figure(six_bar, "reactions_B"))["B on coupler, joint frame"]
    most = max(np.abs(values).max() for values in drawn(axes).values())
    value, unit, _, t, _ = axes.texts[0].get_text().split()
    assert unit == "N"
    assert abs(float(value)) == pytest.approx(most, rel=1e-3)
    force = np.hypot(*six_bar(float(t))["B"].force(on="coupler"))
    assert float(force) == pytest.approx(most, rel=1e-3)
    assert len(axes.texts) == 1


def test_constant_curves_have_no_peak() -> None:
    empty = Panel("T", "N·m", [])
    assert chosen_peaks(empty.curves, turning_points=False) == []


def test_panels_without_information_are_left_out(crank: kp.Solution, six_bar: kp.Solution) -> None:
    found = figure(crank, "y")
    assert list(panels(found)) == ["2 rod"]
    assert note(found) == "Not drawn: 1 crank y, 3 slider y (zero)."
    found = figure(crank, "slider")
    assert [axes.get_ylabel() for axes in found.axes] == ["$v_x$ / (m/s)", "$a_x$ / (m/s²)"]
    found = figure(six_bar, "x")
    assert "3 plate" not in panels(found)
    assert note(found) == "Not drawn: 3 plate x = 0.3 m (constant)."
    found = figure(six_bar, "reactions_A")
    assert list(panels(found)) == [
        "A on ground, global frame",
        "A on crank, global frame",
        "A on crank, joint frame",
    ]
    told = "Not drawn: A on ground, joint frame (equal to A on ground, global frame)."
    assert note(found) == told


def test_a_constant_is_drawn_if_the_page_has_nothing_else(squeezer: kp.Solution) -> None:
    found = figure(squeezer, "torque_motor")
    (axes,) = found.axes
    assert axes.get_ylabel() == "T / mN·m"
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 33.0, rtol=1e-12)
    assert not found.texts


def test_an_odd_last_panel_is_as_wide_as_the_page(squeezer: kp.Solution) -> None:
    found = figure(squeezer, "angle")
    boxes = [axes.get_position() for axes in found.axes]
    assert len(boxes) == 7
    assert boxes[-1].x0 == pytest.approx(boxes[0].x0)
    assert boxes[-1].x1 == pytest.approx(boxes[1].x1)


def test_a_page_has_one_unit_for_each_quantity(squeezer: kp.Solution) -> None:
    for page in some(plot.pages(squeezer), 12):
        units: dict[str, set[str]] = {}
        for axes in page.figure().axes:
            symbol, _, unit = axes.get_ylabel().partition(" / ")
            units.setdefault(re.sub("_[xy]", "", symbol), set()).add(unit)
            if symbol == "x":
                assert unit == "mm"
        assert all(len(found) == 1 for found in units.values()), (page.stem, units)


def test_values_are_divided_by_the_unit_of_their_axis(squeezer: kp.Solution) -> None:
    names = ("vx", "ax", "vy", "ay", "omega", "alpha")
    for axes, name in zip(figure(squeezer, "K5").axes, names, strict=True):
        factor = 1e3 if "10³" in axes.get_ylabel() else 1.0
        expected = getattr(squeezer(times(axes)).body("K5"), name)
        np.testing.assert_allclose(factor * axes.lines[0].get_ydata(), expected, rtol=1e-9)


def test_residuals_lie_under_their_envelope(six_bar: kp.Solution) -> None:
    axes = plot.residual(six_bar)
    for line, values in zip(
        axes.lines, (six_bar.drift.position, six_bar.drift.velocity), strict=True
    ):
        edges = np.linspace(0.0, 2.0, 201)
        for t, most in zip(*line.get_data(), strict=True):
            k = int(np.clip(np.searchsorted(edges, t) - 1, 0, 199))
            clearly = (six_bar.t > edges[k] + 1e-9) & (six_bar.t < edges[k + 1] - 1e-9)
            inside = (six_bar.t > edges[k] - 1e-9) & (six_bar.t < edges[k + 1] + 1e-9)
            assert values[clearly].max(initial=0.0) <= most <= values[inside].max()
        assert max(line.get_ydata()) == values.max()


def test_the_motion_page_has_a_line_for_each_body(six_bar: kp.Solution) -> None:
    found = figure(six_bar, "motion")
    for axes, quantity in zip(found.axes, ("x", "y", "angle"), strict=True):
        motion = six_bar(times(axes))
        for label, values in drawn(axes).items():
            body = label.partition(" ")[2]
            exact = getattr(motion.body(body), quantity)
            exact = np.degrees(exact) if quantity == "angle" else exact
            np.testing.assert_allclose(values, exact, rtol=1e-12)
        assert len(axes.lines) == 5


@pytest.mark.parametrize("name", ["six_bar", "crank", "squeezer"])
def test_every_page_of_an_example_can_be_read(name: str, request: pytest.FixtureRequest) -> None:
    from plot.overlaps import faults

    solution = request.getfixturevalue(name)
    for page in some(plot.pages(solution), 12):
        made = page.figure()
        assert faults(made) == ([], []), page.stem
        for axes in made.axes:
            for label in (axes.get_xlabel(), axes.get_ylabel()):
                assert re.fullmatch(r"|.+ / (1|[^/ ,]+|\([^()]+\))", label), label
