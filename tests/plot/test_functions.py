"""Every function returns axes with units, and draws what the solution holds."""

import inspect
from collections.abc import Callable
from functools import cache
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import plot
from kempe.model.compiled import ACCELERATIONS, COORDINATES, RATES
from kempe.plot.equilibrium import rest_pages
from matplotlib.axes import Axes
from plot.conftest import ROOT
from plot.paintings import links

Draw = Callable[..., Axes]


@cache
def measured(sol: kp.Solution) -> kp.Solution:
    """The same solution of the model with a measure."""
    tree = {**sol.model.tree(), "measures": {"pin": "C.force"}}
    return kp.Solution(kp.Model.from_tree(tree).compile(), sol.stored(), "dop853")


FUNCTIONS: dict[str, tuple[Draw, str]] = {
    "positions": (lambda sol, **a: plot.positions(sol, "crank", **a), "x, y / m"),
    "velocities": (lambda sol, **a: plot.velocities(sol, "crank", **a), "$v_x$, $v_y$ / (m/s)"),
    "accelerations": (
        lambda sol, **a: plot.accelerations(sol, "crank", **a),
        "$a_x$, $a_y$ / (m/s²)",
    ),
    "torques": (lambda sol, **a: plot.torques(sol, "spring", **a), "T / kN·m"),
    "reactions": (lambda sol, **a: plot.reactions(sol, "C", **a), "F / kN"),
    "all_reactions": (plot.all_reactions, "|F| / kN"),
    "measure": (lambda sol, **a: plot.measure(measured(sol), "pin", **a), "pin / kN"),
    "residual": (plot.residual, "residual / (m, m/s)"),
    "energy": (plot.energy, "E / kJ"),
    "energy_balance": (plot.energy_balance, "relative error / 1"),
    "mechanism": (plot.mechanism, "y / m"),
    "configuration": (plot.configuration, "y / m"),
    "coupler_curve": (lambda sol, **a: plot.coupler_curve(sol, "coupler.B", **a), "y / m"),
    "transmission_angle": (lambda sol, **a: plot.transmission_angle(sol, "C", **a), "μ / °"),
    "effort": (lambda sol, **a: plot.effort(sol, "spring", **a), "$T$ / kN·m"),
    "torque_speed": (lambda sol, **a: plot.torque_speed(sol, "spring", **a), "$T$ / kN·m"),
    "velocity_polygon": (lambda sol, **a: plot.velocity_polygon(sol, 0.3, **a), "$v_y$ / (m/s)"),
    "acceleration_polygon": (
        lambda sol, **a: plot.acceleration_polygon(sol, 0.3, **a),
        "$a_y$ / (10³ m/s²)",
    ),
    "instant_centres": (lambda sol, **a: plot.instant_centres(sol, 0.3, **a), "y / m"),
    "pin_load": (lambda sol, **a: plot.pin_load(sol, "C", **a), "$F_{y′}$ / kN"),
    "rest_position": (
        lambda sol, **a: plot.rest_position(kp.equilibrium(sol.model, sol.initial), **a),
        "y / m",
    ),
    "path": (
        lambda sol, **a: plot.path(
            kp.equilibrium(sol.model, sol.initial, over="k", range=(1e6, 1.1e6)),
            "crank.angle",
            **a,
        ),
        "crank.angle / °",
    ),
    "mode_shape": (
        lambda sol, **a: plot.mode_shape(kp.modes(sol.model, sol.initial).shape(0), **a),
        "y / m",
    ),
    "shaking_force": (plot.shaking_force, "$F_y$ / kN"),
    "free_body": (lambda sol, **a: plot.free_body(sol, "coupler", 0.3, **a), "y / m"),
    "draw_free_body": (
        lambda sol, **a: plot.draw_free_body(kp.design.free_body(sol, "rocker", 0.3), **a),
        "y / m",
    ),
}
#: Functions that draw results which are not motions; their own tests draw them.
OF_RESULTS = (
    "burmester",
    "mode_shape",
    "path",
    "rest_position",
    "sweep_contributions",
    "sweep_histogram",
    "sweep_lines",
    "sweep_map",
)
#: Labels of the horizontal axes.
ACROSS = (
    "time t / s",
    "x / m",
    "k, SI units",
    "ω / (rad/s)",
    "$v_x$ / (m/s)",
    "$a_x$ / (10³ m/s²)",
)
FORCES = ("$F_{x′}$ / kN", "$F_x$ / kN")


def lines(axes: Axes) -> dict[str, Any]:
    return {str(line.get_label()): line for line in axes.lines}


def test_options_of_the_functions_are_named() -> None:
    """Where to draw, and how, is given by name; so options can be added."""
    functions = [getattr(plot, name) for name in plot.__all__]
    drawing = [
        f for f in functions if inspect.isfunction(f) and "ax" in inspect.signature(f).parameters
    ]
    assert {f.__name__ for f in drawing} == {*FUNCTIONS, *OF_RESULTS}
    for function in drawing:
        for name, parameter in inspect.signature(function).parameters.items():
            is_option = name in {
                "ax",
                "bins",
                "cut",
                "on",
                "over",
                "lines",
                "frame",
                "index_base",
                "legend",
            }
            assert (parameter.kind is inspect.Parameter.KEYWORD_ONLY) == is_option or (
                name in {"quantity", "most"}
            ), (function, name)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_axes_have_labels_with_units(flagship: kp.Solution, name: str) -> None:
    draw, label = FUNCTIONS[name]
    axes = draw(flagship)
    assert isinstance(axes, Axes)
    assert axes.get_ylabel() == label
    assert axes.get_xlabel() in (*ACROSS, *FORCES)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_axes_given_are_drawn_in_and_the_style_is_not_left_behind(
    flagship: kp.Solution, name: str
) -> None:
    import matplotlib
    from matplotlib import pyplot

    before = dict(matplotlib.rcParams)
    axes = pyplot.figure().add_subplot()
    assert FUNCTIONS[name][0](flagship, ax=axes) is axes
    assert dict(matplotlib.rcParams) == before
    assert len(pyplot.get_fignums()) == 1


@pytest.mark.parametrize(
    ("draw", "quantities"),
    [
        (plot.positions, COORDINATES),
        (plot.velocities, RATES),
        (plot.accelerations, ACCELERATIONS),
    ],
)
def test_a_line_is_the_array_of_the_solution(
    flagship: kp.Solution, draw: Draw, quantities: tuple[str, ...]
) -> None:
    for body in ("crank", "coupler"):
        for quantity in quantities:
            axes = draw(flagship, body, quantity)
            line = axes.lines[0]
            divisor = 1e3 if "10³" in axes.get_ylabel() else 1.0
            divisor = np.pi / 180.0 if quantity == "angle" else divisor
            t = line.get_xdata()
            assert (t[0], t[-1]) == (0.0, 15.0)
            expected = getattr(flagship(t).body(body), quantity) / divisor
            np.testing.assert_allclose(line.get_ydata(), expected, rtol=1e-12, atol=1e-12)


def test_all_three_quantities_share_a_panel(flagship: kp.Solution) -> None:
    axes = plot.positions(flagship, "rocker")
    twin = next(other for other in axes.figure.axes if other is not axes)
    motion = flagship(lines(axes)["y"].get_xdata())
    np.testing.assert_array_equal(lines(axes)["y"].get_ydata(), motion["rocker"].y)
    np.testing.assert_allclose(twin.lines[0].get_ydata(), np.degrees(motion["rocker"].angle))
    assert twin.get_ylabel() == "φ / °"
    legend = axes.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["x", "y", "φ"]


@pytest.mark.parametrize("on", ["rocker", "ground"])
def test_torques_are_the_parts_and_their_sum(flagship: kp.Solution, on: str) -> None:
    drawn = lines(plot.torques(flagship, "spring", on=on))
    spring = flagship(drawn["sum"].get_xdata())["spring"]
    for label, torque in (
        ("stiffness", spring.stiffness_torque(on=on)),
        ("damping", spring.damping_torque(on=on)),
        ("sum", spring.torque(on=on)),
    ):
        np.testing.assert_array_equal(drawn[label].get_ydata(), torque / 1e3)


@pytest.mark.parametrize("frame", ["global", "body", "joint"])
@pytest.mark.parametrize("on", ["coupler", "rocker"])
def test_reactions_are_those_of_the_body_and_frame(
    flagship: kp.Solution, on: str, frame: str
) -> None:
    axes = plot.reactions(flagship, "C", on=on, frame=frame)
    motion = flagship(axes.lines[0].get_xdata())
    force = motion["C"].force(on=on, frame=frame) / 1e3
    x, y, magnitude = (line.get_ydata() for line in axes.lines)
    np.testing.assert_array_equal(x, force[:, 0])
    np.testing.assert_array_equal(y, force[:, 1])
    np.testing.assert_allclose(magnitude, np.linalg.norm(force, axis=1), rtol=1e-14)
    assert frame in axes.get_title("left")


def test_all_reactions_are_magnitudes(flagship: kp.Solution) -> None:
    drawn = lines(plot.all_reactions(flagship))
    assert [label.partition(":")[0] for label in drawn] == ["A", "B", "C", "D"]
    for label, line in drawn.items():
        joint = flagship(line.get_xdata())[label.partition(":")[0]]
        force = np.linalg.norm(joint.force(on=joint.info.j), axis=1) / 1e3
        np.testing.assert_allclose(line.get_ydata(), force)
        value, unit, at, t, second = label.partition(": ")[2].split()
        assert (unit, at, second) == ("kN", "at", "s")
        assert float(value) == pytest.approx(force.max(), rel=1e-3)
        assert float(t) == pytest.approx(line.get_xdata()[force.argmax()], abs=2e-3)


def test_residual_and_balance_are_logarithmic(flagship: kp.Solution) -> None:
    axes = plot.residual(flagship)
    position, velocity = (line.get_ydata() for line in axes.lines)
    assert position.max() == flagship.drift.position.max()
    assert velocity.max() == flagship.drift.velocity.max()
    balance = plot.energy_balance(flagship)
    assert balance.lines[0].get_ydata().max() == np.abs(flagship.energy.balance).max()
    assert axes.get_yscale() == balance.get_yscale() == "log"


def test_the_energy_adds_up(flagship: kp.Solution) -> None:
    found = plot.energy(flagship).lines
    assert [line.get_label() for line in found] == [
        "kinetic T",
        "potential V",
        "dissipated D",
        "T + V + D − W",  # no work is done on the flagship
    ]
    kinetic, potential, dissipated, total = (line.get_ydata() for line in found)
    np.testing.assert_allclose(kinetic + potential + dissipated, total, rtol=1e-12)
    outputs = np.interp(flagship.t, found[0].get_xdata(), kinetic)
    np.testing.assert_allclose(outputs, flagship.energy.kinetic / 1e3, atol=0.05)
    assert not flagship.energy.work.any()


@pytest.mark.parametrize("t", [None, 0.123, 15.0])
def test_links_stand_where_the_bodies_are(flagship: kp.Solution, t: float | None) -> None:
    axes = plot.configuration(flagship, t)
    state = flagship(0.0 if t is None else t)
    drawn = [axes.transData.inverted().transform(corners) for _, corners in links(axes)]
    for body in ("crank", "coupler", "rocker"):
        ends = [
            flagship.model.bodies[body].points[name]
            for name in "ABCD"
            if name in flagship.model.bodies[body].points
        ]
        places = np.array([state.body(body).at(end).position for end in ends])
        assert any(
            line.shape == places.shape
            and (np.allclose(line, places, atol=1e-7) or np.allclose(line[::-1], places, atol=1e-7))
            for line in drawn
        )


@pytest.mark.parametrize("base", [0, 1])
def test_bodies_are_numbered_and_joints_named(flagship: kp.Solution, base: int) -> None:
    texts = {text.get_text() for text in plot.configuration(flagship, index_base=base).texts}
    numbers = {str(k + base) for k in range(3)}
    assert texts == numbers | {"crank", "coupler", "rocker", "A", "B", "C", "D"}
    title = plot.positions(flagship, "coupler", "x", index_base=base).get_title("left")
    assert title == f"{1 + base} coupler"


def test_the_drawing_gives_lengths_spring_and_gravity(flagship: kp.Solution) -> None:
    texts = {text.get_text() for text in plot.mechanism(flagship).texts}
    assert {"10 m", "26 m", "18 m", "20 m", "spring", "g = 9.81 m/s²"} <= texts
    assert {"A", "B", "C", "D"} <= texts
    axes = plot.mechanism(flagship.final)
    assert axes.get_aspect() == 1.0


@pytest.mark.parametrize(
    ("draw", "words"),
    [
        (lambda sol: plot.positions(sol, "cranc"), "did you mean 'crank'"),
        (lambda sol: plot.positions(sol, "crank", "angel"), "did you mean 'angle'"),
        (lambda sol: plot.torques(sol, "sprin"), "did you mean 'spring'"),
        (lambda sol: plot.torques(sol, "spring", on="crank"), "there is ground, rocker"),
        (lambda sol: plot.reactions(sol, "E"), "there is A, B, C, D"),
        (lambda sol: plot.reactions(sol, "C", frame="join"), "did you mean 'joint'"),
        (lambda sol: plot.configuration(sol, 16.0), "outside"),
    ],
)
def test_what_does_not_exist_is_refused(flagship: kp.Solution, draw: Draw, words: str) -> None:
    with pytest.raises(kp.ModelError, match=words):
        draw(flagship)


def test_the_parameter_of_a_path_has_its_unit() -> None:
    m = kp.Model("rod on a spring", gravity=(0, -9.81), parameters={"mass": "2 kg"})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass="mass", length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("spring", "ground", "rod", stiffness=50)
    found = kp.equilibrium(m, kp.assemble(m), over="mass", range=(1, 3))
    assert plot.path(found, "rod.angle").get_xlabel() == "mass / kg"
    with kp.units("g"):
        axes = plot.path(found, "rod.angle")
    assert axes.get_xlabel() == "mass / g"
    assert axes.lines[0].get_xdata()[-1] == pytest.approx(3000)


def test_a_path_of_a_beam_shows_bodies_of_the_file() -> None:
    case = kp.load(ROOT / "examples" / "leaf_spring_guide.toml")
    start = case.start()
    found = kp.equilibrium(start.model, start, over="width", range=(0.02, 0.021))
    assert any(".#" in name for name in found.coordinates)
    (figure,) = (page.draw() for page in rest_pages(found, 1) if page.name == "path")
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert labels
    assert not any("#" in label for label in labels)
