"""Beams without shear and without stretch against closed forms and conservation laws."""

from __future__ import annotations

import itertools
import math
from typing import Any

import kempe as kp
import numpy as np
import pytest
from scipy.special import ellipe, ellipk

E, SIDE, LENGTH = 2.07e11, 0.1, 2.0
BENDING = E * SIDE**4 / 12
THIN = {"shear": False, "inextensible": True}
#: Tip displacement of a cantilever under a dead load 3 EI/L²: solutions of the boundary value
#: problems.
UNSHEARED = (-0.508537304326, -1.207239854550)
INEXTENSIBLE = (-0.5088403691, -1.2065068823)


def clamped(elements: int, size: float = 1.0, **fields: Any) -> kp.Model:
    m = kp.Model("clamped")
    m.ground.points(O=(0, 0))
    section = kp.Section.rectangle(height=SIDE * size, width=SIDE * size)
    given = {"length": LENGTH * size, "section": section, "young": E, "density": 7850}
    given = {**given, "elements": elements, **fields}
    m.beam("rod", **{key: value for key, value in given.items() if value is not None})
    m.weld("clamp", "ground.O", "rod.A")
    return m


def rest(m: kp.Model) -> kp.State:
    return kp.equilibrium(m, kp.assemble(m)).state


def tip(elements: int, **fields: Any) -> np.ndarray:
    m = clamped(elements, **fields)
    m.force("load", "rod.B", force=(0, -3 * BENDING / LENGTH**2))
    state = rest(m)
    return np.array([state["rod.B.x"] - LENGTH, state["rod.B.y"]])


@pytest.mark.parametrize(("fields", "exact"), [({"shear": False}, UNSHEARED), (THIN, INEXTENSIBLE)])
def test_a_cantilever_bends_by_the_published_displacement(
    fields: dict[str, Any], exact: tuple[float, float]
) -> None:
    errors = [np.hypot(*(tip(n, **fields) - exact)) for n in (2, 4, 8)]
    orders = [math.log2(a / b) for a, b in itertools.pairwise(errors)]
    assert all(5.5 < order < 6.6 for order in orders), orders
    # the published digits of the inextensible rod end at 1e-10
    assert errors[2] < 1e-8


def test_thirty_two_elements_without_shear_are_exact_to_nine_digits() -> None:
    assert tip(32, shear=False) == pytest.approx(UNSHEARED, abs=1e-11)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("angle", [0.5, 2.0])
def test_an_inextensible_strut_is_the_elastica(size: float, angle: float) -> None:
    # clamped at A, load P towards A, angle a of the free end: sqrt(P/EI) L = K(sin a/2)
    k = math.sin(angle / 2)
    whole, second = float(ellipk(k**2)), float(ellipe(k**2))
    length, bending = LENGTH * size, BENDING * size**4
    m = clamped(6, size, **THIN)
    load = bending * (whole / length) ** 2
    m.force("load", "rod.B", force=(-load, 1e-3 * load))
    bent = rest(m)
    m = clamped(6, size, **THIN)
    m.force("load", "rod.B", force=(-load, 0))
    state = kp.equilibrium(m, bent).state
    assert abs(state["rod.B.angle"]) == pytest.approx(angle, rel=3e-6)
    assert state["rod.B.x"] == pytest.approx(length * (2 * second / whole - 1), abs=2e-6 * length)
    assert abs(state["rod.B.y"]) == pytest.approx(2 * k / whole * length, rel=2e-6)
    # the load is the normal force at the clamp, and bends it by its arm
    beam = state.beam("rod")
    assert beam.normal_force[0] == pytest.approx(-load, rel=2e-3)
    moment = load * abs(state["rod.B.y"])
    stress = load / (SIDE * size) ** 2 + 6 * moment / (SIDE * size) ** 3
    assert state["rod.stress"] == pytest.approx(stress, rel=1e-3)
    assert beam.stress.max() == state["rod.stress"]


def test_internal_forces_of_a_small_load() -> None:
    m = clamped(3, **THIN)
    m.force("load", "rod.B", force=(300.0, -100.0))
    state = rest(m)
    beam = state.beam("rod")
    assert beam.normal_force == pytest.approx(np.full(15, 300.0), rel=1e-4)
    assert beam.shear_force == pytest.approx(np.full(15, -100.0), rel=1e-3)
    assert state["rod.strain_energy"] == pytest.approx(
        100.0**2 * LENGTH**3 / (6 * BENDING), rel=1e-3
    )


@pytest.mark.parametrize("fields", [{"shear": False}, {"inextensible": True}, THIN])
def test_locks_are_independent(fields: dict[str, Any]) -> None:
    m = clamped(4, **fields)
    found = kp.mobility(m, kp.assemble(m))
    assert found.degrees_of_freedom == 4 * (9 - 3 * len(fields))
    assert not found.redundant


def test_the_frequencies_are_those_of_euler_and_bernoulli() -> None:
    given = {"section": None, "young": None, "density": None, "mass_per_length": 78.5}
    m = clamped(8, EI=BENDING, inertia_per_length=0, **given, **THIN)
    omega = kp.modes(m, kp.assemble(m)).omega
    for k, root in enumerate((1.8751040687119611, 4.694091132974174, 7.854757438237613)):
        exact = root**2 * math.sqrt(BENDING / 78.5) / LENGTH**2
        assert omega[k] == pytest.approx(exact, rel=1e-5)


@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_a_free_thin_beam_keeps_its_momentum_and_energy(mass: float) -> None:
    m = kp.Model("free")
    given = {"EI": 2 * mass, "mass_per_length": 3 * mass, "inertia_per_length": 0.01 * mass}
    m.beam("rod", arc=(0, 0, 1, 0, 1.5), elements=3, **given, **THIN)
    start = kp.assemble(m, set={"rod.omega": 1.0})
    m.force("load", "rod.B", force=(0, f"{mass}*if(t < 0.1, 1, 0)"))
    solution = kp.dynamics(m, start, t_end=0.6, method=kp.DOP853(rtol=1e-10, atol=1e-10))
    after = solution.t > 0.11
    totals = np.zeros((len(solution.t), 3))
    for name, info in solution.compiled.bodies.items():
        body = solution.body(name)
        momentum = info.mass * np.column_stack([body.vx, body.vy])
        spin = body.x * momentum[:, 1] - body.y * momentum[:, 0] + info.inertia * body.omega
        totals += np.column_stack([momentum, spin])
    kept = totals[after]
    assert np.abs(kept - kept[0]).max() < 1e-11 * 5 * mass
    assert np.abs(solution["energy.balance"]).max() < 1e-8
    assert solution["rod.strain_energy"].max() > 1e-5 * mass
    # the centre line keeps its length between neighbouring nodes
    assert solution["drift.position"].max() < 1e-9


@pytest.mark.parametrize("size", [0.1, 10.0])
def test_sections_without_much_inertia_are_no_singular_position(size: float) -> None:
    # trial states of explicit steps open the locks widely; the motion itself is regular
    line, pace = 1 / size, math.sqrt(size / 9.81)
    tips = []
    for part in (0.0, 1e-8, 1e-7):
        m = kp.Model("clamped", gravity=(0, -9.81))
        m.ground.points(O=(0, 0))
        given = {"EI": 13 * line * 9.81 * size**3, "damping": 0.003 * pace, "elements": 8}
        mass = {"mass_per_length": line, "inertia_per_length": line * size**2 * part}
        m.beam("rod", length=size, **mass, **given, **THIN)
        m.weld("W", "ground.O", "rod.A", angle=-0.49)
        m.body("tip", mass=1, inertia=0.03 * size**2, points={"P": (0, 0)})
        m.weld("X", "rod.B", "tip.P")
        start = kp.assemble(m, guess={"rod.angle": -0.49})
        solution = kp.dynamics(m, start, t_end=0.2 * pace)
        assert np.abs(solution["energy.balance"]).max() < 1e-6
        tips.append(solution["tip.y"][-1] / size)
    assert tips == pytest.approx([tips[0]] * 3, abs=1e-6)


def test_a_straight_thin_beam_between_two_pins_cannot_bend() -> None:
    """Its pins would have to approach each other; the forces that hold it have no bound."""
    m = kp.Model("pinned", gravity=(0, -9.81))
    m.ground.points(O=(0, 0), D=(1, 0))
    given = {"EI": 1.0, "mass_per_length": 1.0, "inertia_per_length": 1e-3}
    m.beam("rod", length=1, elements=2, **given, **THIN)
    m.revolute("A", "ground.O", "rod.A")
    m.revolute("B", "ground.D", "rod.B")
    with pytest.warns(kp.AccuracyWarning, match=r"leave out the load along .*rod\.#1\.y"):
        sol = kp.dynamics(m, kp.assemble(m), t_end=0.1)
    assert np.abs(sol.q - sol.q[0]).max() < 1e-12
