"""Beams as entries of a model: bad input, references, lists, cases, starts."""

from __future__ import annotations

import json
import pickle
import warnings
from typing import Any

import kempe as kp
import numpy as np
import pytest

SECTION = kp.Section.rectangle(height=0.01, width=0.01)
GIVEN: dict[str, Any] = {"length": 1, "section": SECTION, "young": 1e9, "density": 1e3}
WITHOUT: dict[str, Any] = {"section": None, "young": None, "density": None}
LOOP = [(0, 0), (1, 1), (1, 0), (0, 1)]


def clamped(parameters: dict[str, float] | None = None, **fields: Any) -> kp.Model:
    m = kp.Model("clamped", parameters=parameters or {})
    m.ground.points(O=(0, 0))
    m.beam("rod", **{key: x for key, x in {**GIVEN, **fields}.items() if x is not None})
    m.weld("clamp", "ground.O", "rod.A")
    return m


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"young": 0}, "the stiffness EA of the beam is 0 N; must be > 0"),
        ({"young": -1e9}, "must be > 0"),
        ({"young": None}, "'young' is missing"),
        ({"section": None, "young": None, "density": None, "EA": 1, "EI": 1}, "'GA' is missing"),
        ({"section": None}, "has no meaning without a section"),
        ({"length": -1}, "-1 m; must be > 0"),
        ({"length": None}, "needs one of 'length', 'through' and 'arc'"),
        ({"density": -1}, "must not be negative"),
        ({"density": None}, "'density' or 'mass_per_length' is missing"),
        ({"points": {"P": 1.2}}, "P is at 1.2 m, outside the beam of 1 m"),
        ({"points": {"P": "120 %"}}, "outside the beam"),
        ({"points": {"P": 0.5, "Q": 0.5}}, "at the same place as P"),
        ({"points": {"P": 0.5}, "elements": 1}, "at least 2 elements are needed"),
        ({"length": None, "through": LOOP}, "crosses itself"),
        ({"length": None, "arc": (0, 0, 1, 0, 7)}, "does not cross itself"),
        ({"section": kp.Section.tube(0.01, 0.02)}, "larger than the inner one"),
        ({"poisson": 0.7}, "between -1 and 0.5"),
        ({"damping": -1}, "must be ≥ 0"),
        ({**WITHOUT, "EA": 1, "EI": 1, "mass_per_length": 1}, "shear = false needs no GA"),
        ({**WITHOUT, "GA": 1, "EI": 1, "mass_per_length": 1}, "inextensible = true needs no EA"),
        (
            {**WITHOUT, "EI": 1, "mass_per_length": 1, "shear": False, "inextensible": True},
            "'inertia_per_length' is missing",
        ),
    ],
)
def test_bad_input_is_refused(fields: dict[str, Any], words: str) -> None:
    with pytest.raises(kp.KempeError) as refused:
        clamped(**fields).compile()
    assert words in str(refused.value)


def test_a_beam_without_mass_has_equilibria_only() -> None:
    m = clamped(density=0)
    start = kp.assemble(m)
    with pytest.raises(kp.KempeError, match=r"beam rod is not determined.*density"):
        kp.dynamics(m, start, t_end=0.1)
    assert kp.equilibrium(m, start).state["rod.B.x"] == pytest.approx(1)


def test_modes_of_beams_without_mass_or_inertia_name_the_beam() -> None:
    m = clamped(density=0)
    with pytest.raises(kp.KempeError, match=r"beam rod is not determined.*density"):
        kp.modes(m, kp.assemble(m))
    # a free beam has one motion more than its nodes, in which its sections turn alternately
    for inertia in (0, 1e-6):
        m = kp.Model("free")
        given = {"EA": 1e6, "EI": 1.0, "mass_per_length": 1.0, "shear": False}
        m.beam("rod", length=1, elements=4, inertia_per_length=inertia, **given)
        if inertia:
            assert kp.modes(m, kp.assemble(m)).omega.size
            continue
        with pytest.raises(kp.KempeError, match=r"beam rod.*give inertia_per_length > 0"):
            kp.modes(m, kp.assemble(m))


def test_the_equilibrium_over_a_driver_takes_the_place_of_kinematics() -> None:
    m = clamped(elements=2)
    with pytest.raises(kp.KempeError, match=r"shape of beam rod.*drive a coordinate"):
        kp.kinematics(m, kp.assemble(m), t_end=0.1)
    m.coordinate_driver("tip", "rod.B.y", value="-0.1*t^2")
    start = kp.assemble(m)
    remedy = r"make the value of tip a parameter p .* kp.equilibrium\(model, state, over=\"p\""
    with pytest.raises(kp.KempeError, match=remedy):
        kp.kinematics(m, start, t_end=0.1)
    # the remedy: EI = 1e9 × 1e-8/12, and the tip force is 3 EI y/L³
    m = clamped(elements=2, parameters={"p": 0.0})
    m.coordinate_driver("tip", "rod.B.y", value="p")
    path = kp.equilibrium(m, kp.assemble(m), over="p", range=(0, -0.01))
    assert path.states[-1]["rod.B.y"] == pytest.approx(-0.01)
    assert path.states[-1]["tip.effort"] == pytest.approx(-3 * 10 / 12 * 0.01, rel=3e-3)


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({}, 4),
        ({"points": {"P": 0.2, "Q": 0.4}}, 6),
        ({"length": None, "arc": (0, 0, 1, 0, 1)}, 8),
        ({"length": None, "through": [(k / 10, k * k / 100) for k in range(12)]}, 11),
        ({"length": None, "through": [(0, 0), (1, 1)]}, 4),
        ({"elements": 3}, 3),
    ],
)
def test_the_number_of_elements_follows_from_the_shape(
    fields: dict[str, Any], expected: int
) -> None:
    beam = kp.assemble(clamped(**fields)).beam("rod")
    assert len(beam.s) == 5 * expected
    assert beam.enough == expected  # without loads


def test_enough_elements_have_a_small_error() -> None:
    def bent(elements: int) -> Any:
        m = clamped(elements=elements)
        m.force("load", "rod.B", force=(0, -10.0))
        return kp.equilibrium(m, kp.assemble(m)).state.beam("rod")

    few = bent(2)
    assert few.error > 1e-3
    assert 2 < few.enough < 20
    assert bent(few.enough).error < 1.5e-3
    assert bent(few.enough // 2).error > 2e-3


@pytest.mark.parametrize("torque", [1e-3, -0.5])
def test_a_torque_at_a_named_place_is_no_error(torque: float) -> None:
    """The moment is the torque up to the place and zero beyond, with a jump that belongs there."""
    m = clamped(points={"P": "50 %"})
    m.torque("turn", "rod.P", torque=torque)
    beam = kp.equilibrium(m, kp.assemble(m)).state.beam("rod")
    before = np.arange(len(beam.s)) < len(beam.s) // 2
    np.testing.assert_allclose(beam.bending_moment, np.where(before, torque, 0.0), atol=1e-9)
    assert beam.error < 1e-8
    assert beam.enough == 4


@pytest.mark.parametrize("locked", [{}, {"shear": False}, {"shear": False, "inextensible": True}])
def test_a_beam_of_a_run_is_that_of_its_states(locked: dict[str, bool]) -> None:
    """Rows are instants; the error is the largest jump of all of them over the largest moment."""
    m = clamped(elements=2, damping=1e-3, points={"P": "50 %"}, **locked)
    m.force("load", "rod.B", force=(3.0, -10.0))
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.02, output_step=0.005)
    beam, states = sol.beam("rod"), [sol(float(t)).beam("rod") for t in sol.t]
    for name in ("x", "y", "angle", "normal_force", "shear_force", "bending_moment", "stress"):
        rows = np.array([getattr(one, name) for one in states])
        assert rows.shape == (5, 10)
        near = 1e-6 * np.abs(rows).max()
        np.testing.assert_allclose(getattr(beam, name), rows, atol=near, err_msg=name)
    np.testing.assert_allclose(beam.strain_energy, [one.strain_energy for one in states], rtol=1e-6)
    assert states[0].strain_energy < 1e-12 < beam.strain_energy[-1]
    m = clamped(elements=3, damping=1e-3, **locked)
    m.force("load", "rod.B", force=(0.0, -10.0))
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.05, output_step=0.01)
    beam, states = sol.beam("rod"), [sol(float(t)).beam("rod") for t in sol.t]
    largest = [np.abs(one.bending_moment).max() for one in states]
    jumps = [one.error * own for one, own in zip(states, largest, strict=True)]
    assert beam.error == pytest.approx(max(jumps) / max(largest), rel=1e-4)
    assert beam.error > 1e-4


def test_lists_show_a_beam_as_one() -> None:
    m = clamped(points={"P": "25 %"})
    state = kp.assemble(m)
    assert "#" not in str(state)
    assert {"rod.B", "rod.P"} <= {line.split()[0] for line in str(state).splitlines() if line}
    solution = kp.dynamics(m, state, t_end=1e-4)
    about = solution.summary["mechanism"]
    assert about["bodies"] == ["rod"]
    assert about["forces"] == []
    assert not [name for name in solution.to_dataframe().columns if "#" in str(name)]


@pytest.mark.parametrize("mass", [0.03, 300.0])
def test_reactions_at_a_place_of_a_beam_are_columns(mass: float) -> None:
    m = clamped(shear=False, points={"P": "50 %"}, damping=1e-3)
    m.body("load", mass=mass, inertia=1, points={"O": (0, 0)})
    m.revolute("J", "rod.P", "load.O")
    m.force("pull", "load.O", force=(mass, -2 * mass))
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.01)
    table = sol.to_dataframe()
    for axis, pull, rate in (("fx", mass, "ax"), ("fy", -2 * mass, "ay")):
        # Newton for the load, and the opposite force on the beam
        load = mass * sol[f"load.{rate}"] - pull
        np.testing.assert_allclose(table[f"J.{axis}_on_load"], load, atol=1e-9 * mass)
        np.testing.assert_allclose(table[f"J.{axis}_on_rod.P"], -load, atol=1e-9 * mass)
        np.testing.assert_allclose(sol[f"J.{axis}_on_rod.P"], -load, atol=1e-9 * mass)


def test_a_beam_is_saved_and_pickled() -> None:
    m = clamped(points={"P": 0.25}, elements=3, damping=1e-3)
    again = pickle.loads(pickle.dumps(m))
    assert again.json() == m.json()
    rod = json.loads(m.json())["bodies"]["rod"]
    assert rod["section"] == {"rectangle": [0.01, 0.01]}


def test_a_loop_closes_with_rigid_beams() -> None:
    m = kp.Model("four-bar")
    m.ground.points(O=(0, 0), D=(0.4, 0))
    m.bar("crank", mass=0.5, length=0.1, ends=("O", "A"))
    m.bar("coupler", mass=0.8, length=0.35, ends=("A", "B"))
    m.beam("rocker", ends=("D", "B"), **{**GIVEN, "length": 0.3, "points": {"P": "50 %"}})
    for name, i, j in (
        ("O", "ground.O", "crank.O"),
        ("A", "crank.A", "coupler.A"),
        ("B", "coupler.B", "rocker.B"),
        ("D", "ground.D", "rocker.D"),
    ):
        m.revolute(name, i, j)
    state = kp.assemble(m, set={"crank.angle": 1.0, "crank.omega": 2.0})
    assert state.beam("rocker").strain_energy < 1e-20
    assert state["rocker.P.angle"] == pytest.approx(state["rocker.angle"], abs=1e-12)
    assert state["rocker.B.omega"] == pytest.approx(state["rocker.omega"], abs=1e-12)
    turned = np.array([state["rocker.B.x"] - 0.4, state["rocker.B.y"]])
    assert np.hypot(*turned) == pytest.approx(0.3, abs=1e-12)


def test_a_beam_without_section_has_no_stress() -> None:
    given = {"EA": 1e5, "EI": 1.0, "GA": 1e5, "mass_per_length": 1.0}
    state = kp.assemble(clamped(section=None, young=None, density=None, **given))
    with pytest.raises(kp.KempeError, match="give section and young"):
        _ = state.beam("rod").stress
    with pytest.raises(kp.KempeError, match="unknown quantity"):
        _ = state["rod.stress"]


def test_lists_and_figures_number_a_beam_as_one_body() -> None:
    m = clamped(elements=3, points={"P": "50 %"})
    m.body("load", mass=1, inertia=1, points={"O": (0, 0)})
    m.weld("hook", "rod.B", "load.O")
    compiled = m.compile()
    assert [body.shown_number for body in compiled.shown_bodies.values()] == [1, 2]
    assert compiled.bodies["rod.P"].shown_number == 0
    sol = kp.dynamics(m, kp.assemble(m), t_end=1e-3)
    for name, title in (("load", "2 load"), ("rod.P", "rod.P")):
        figure = np.ravel(kp.plot.velocities(sol, name))[0].figure
        told = [axes.get_title(loc="left") for axes in figure.axes]
        assert any(one.startswith(title) for one in [figure.get_suptitle(), *told])
    words = " ".join(text.get_text() for text in kp.plot.configuration(sol.initial).texts)
    assert {"1", "2"} <= set(words.split())
    assert "3" not in words.split()


@pytest.mark.parametrize(("size", "stiffness"), [(1.0, 1.0), (1e-3, 1e-4), (1e3, 1e5)])
def test_beams_with_too_few_elements_are_named(size: float, stiffness: float) -> None:
    """The advised number of elements removes the warning, and the tip is where it belongs."""

    def tip(load: float, elements: int | None) -> tuple[Any, list[str]]:
        given = {"EA": 1e4 * stiffness / size**2, "GA": 1e4 * stiffness / size**2}
        m = kp.Model("clamped")
        m.ground.points(O=(0, 0))
        m.beam("rod", length=size, EI=stiffness, mass_per_length=1, elements=elements, **given)
        m.weld("clamp", "ground.O", "rod.A")
        m.force("load", "rod.B", force=(0, -load * stiffness / size**2))
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            found = kp.equilibrium(m, kp.assemble(m)).state
        place = np.array([found["rod.B.x"], found["rod.B.y"]]) / size
        return place, [str(one.message) for one in told]

    for load in (3.0, 30.0, 300.0):
        place, told = tip(load, None)
        assert ["rod has too few elements" in text for text in told] == [True] * (load == 300)
        if size == 1.0 and told:
            advised = int(told[0].partition("elements = ")[2].split()[0])
            exact, told = tip(load, advised)
            assert not told
            assert 1e-4 < np.abs(place - exact).max() < 1e-2


def test_a_run_that_ends_early_says_what_a_stiff_beam_needs() -> None:
    m = clamped()
    m.force("load", "rod.B", force=(0, -1))
    with pytest.raises(kp.IntegrationError, match="give the beams damping, shear = false"):
        kp.dynamics(m, kp.assemble(m), t_end=1, max_steps=5)
