"""Beams against closed forms, transcendental equations and conservation laws."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import ellipk

E, SIDE, LENGTH = 2.07e11, 0.1, 2.0
SQUARE = kp.Section.rectangle(height=SIDE, width=SIDE)
BENDING = E * SIDE**4 / 12
STEEL = {"section": SQUARE, "young": E, "density": 7850}
#: Tip displacement under a dead load 3 EI/L²: solutions of the boundary value problem.
SHEARED = (-0.5094829, -1.2088539)
UNSHEARED = (-0.508537304326, -1.207239854550)


def cantilever(
    elements: int = 8, parameters: dict[str, float] | None = None, **fields: Any
) -> kp.Model:
    m = kp.Model("cantilever", parameters=parameters or {})
    m.ground.points(O=(0, 0))
    given = {"length": LENGTH, "elements": elements, **(STEEL if "EA" not in fields else {})}
    m.beam("rod", **{**given, **fields})
    m.weld("clamp", "ground.O", "rod.A")
    return m


def rest(m: kp.Model) -> kp.State:
    return kp.equilibrium(m, kp.assemble(m)).state


def tip_loaded(elements: int, **fields: Any) -> np.ndarray:
    m = cantilever(elements, **fields)
    m.force("load", "rod.B", force=(0, -3 * BENDING / LENGTH**2))
    state = rest(m)
    return np.array([state["rod.B.x"] - LENGTH, state["rod.B.y"]])


def test_a_cantilever_bends_by_the_published_displacement_with_order_six() -> None:
    found = [tip_loaded(n) for n in (2, 4, 8)]
    assert found[2] == pytest.approx(SHEARED, abs=2e-7)
    fine = tip_loaded(16)
    errors = [np.hypot(*(tip - fine)) for tip in found]
    order = math.log2(errors[1] / errors[2])
    assert 5.5 < order < 7
    assert errors[2] < 1e-9 * LENGTH * 10


def test_a_cantilever_without_shear_is_the_limit_of_large_shear_stiffness() -> None:
    given = {"EA": E * SIDE**2, "EI": BENDING, "mass_per_length": 78.5}
    tips = [tip_loaded(8, GA=E * SIDE**2 * k, **given) for k in (1e2, 1e4)]
    # the remaining shear is inversely proportional to GA
    limit = tips[1] + (tips[1] - tips[0]) / (1e2 - 1)
    assert limit == pytest.approx(UNSHEARED, abs=1e-8)


def bent(m: kp.Model, angle: Callable[[float], float]) -> kp.State:
    """The assembled state with the nodes of a straight beam at given angles, without stretch."""
    q = np.array(kp.assemble(m).q).reshape(-1, 3)
    for row in q:
        s = row[0]
        row[0] = quad(lambda u: math.cos(angle(u)), 0, s, epsabs=1e-9 * max(1.0, s))[0]
        row[1] = quad(lambda u: math.sin(angle(u)), 0, s, epsabs=1e-9 * max(1.0, s))[0]
        row[2] = angle(s)
    return kp.State(m, 0.0, q.ravel(), np.zeros(q.size))


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_moment_rolls_a_cantilever_up_to_a_circle(size: float) -> None:
    side, length = SIDE * size, 10 * size
    section = kp.Section.rectangle(height=side, width=side)
    m = cantilever(8, length=length, section=section)
    moment = 2 * math.pi * E * side**4 / 12 / length
    m.torque("M", "rod.B", torque=moment)
    state = kp.equilibrium(m, bent(m, lambda s: 1.98 * math.pi * s / length)).state
    assert state["rod.B.angle"] == pytest.approx(2 * math.pi, rel=1e-9)
    assert np.hypot(state["rod.B.x"], state["rod.B.y"]) < 1e-9 * length
    beam = state.beam("rod")
    assert beam.bending_moment == pytest.approx(np.full(len(beam.s), moment), rel=1e-8)
    radius = length / (2 * math.pi)
    nodes = state.q.reshape(-1, 3)
    from_centre = np.hypot(nodes[:, 0], nodes[:, 1] - radius)
    assert from_centre == pytest.approx(np.full(len(nodes), radius), rel=1e-6)


@pytest.mark.parametrize("angle", [0.5, 1.5, 2.5])
def test_a_strut_buckles_along_the_elastica(angle: float) -> None:
    # clamped at A, load P towards A, angle a of the free end: sqrt(P/EI) L = K(sin a/2)
    stiff = {"EA": 1e7, "GA": 1e7, "EI": 1.0, "mass_per_length": 1.0}
    load = float(ellipk(math.sin(angle / 2) ** 2) ** 2)
    m = cantilever(6, length=1.0, **stiff)
    m.force("load", "rod.B", force=(-load, 0))
    start = bent(m, lambda s: 0.9 * angle * math.sin(math.pi * s / 2))
    state = kp.equilibrium(m, start).state
    assert state["rod.B.angle"] == pytest.approx(angle, rel=2e-6)


def timoshenko(count: int) -> list[float]:
    """Frequencies of a clamped Timoshenko beam, rad/s, as zeros of a determinant."""
    rho, area, second = 7850.0, SIDE**2, SIDE**4 / 12
    shear = 5 / 6 * E / 2.6 * area

    def determinant(omega: float) -> float:
        mass, turn = rho * area * omega**2, rho * second * omega**2
        # EI GA k⁴ + (GA·ρIω² + EI·ρAω²) k² - ρAω² (GA - ρIω²) = 0 for k = λ² of exp(λ s)
        a, b = BENDING * shear, shear * turn + BENDING * mass
        c = -mass * (shear - turn)
        squares = np.roots([a, b, c]).astype(complex)
        roots = [sign * np.sqrt(square) for square in squares for sign in (1, -1)]
        rows = np.zeros((4, 4), dtype=complex)
        for j, lam in enumerate(roots):
            slope = (shear * lam**2 + mass) / (shear * lam)  # φ for w = 1
            grow = np.exp(lam * LENGTH)
            rows[:, j] = [1, slope, slope * lam * grow, (lam - slope) * grow]
        value = np.linalg.det(rows)
        # pairs of roots of opposite sign: the determinant is real or imaginary
        scale = np.prod([np.abs(rows[:, j]).max() for j in range(4)])
        return float((value.real if abs(value.real) > abs(value.imag) else value.imag) / scale)

    found: list[float] = []
    grid = np.linspace(20, 4500, 3000)
    values = [determinant(w) for w in grid]
    for a, b, fa, fb in zip(grid, grid[1:], values, values[1:], strict=False):
        if fa * fb < 0 and len(found) < count:
            root = brentq(determinant, a, b, xtol=1e-9)
            if abs(determinant(root)) < 1e-6:
                found.append(root)
    return found


def test_the_frequencies_of_a_cantilever_are_those_of_timoshenko() -> None:
    m = cantilever(8)
    omega = np.unique(np.abs(kp.modes(m, kp.assemble(m)).omega).round(6))
    expected = timoshenko(3)
    for one in expected:
        assert np.abs(omega / one - 1).min() < 1e-5, (one, omega[:6])
    # the first mode of stretch, sqrt(E/rho) pi/2L
    stretch = math.pi / (2 * LENGTH) * math.sqrt(E / 7850)
    assert np.abs(omega / stretch - 1).min() < 1e-8


def free_beam(mass: float = 1.0) -> kp.Model:
    m = kp.Model("free")
    given = {"EA": 400 * mass, "GA": 300 * mass, "EI": 2 * mass, "mass_per_length": 3 * mass}
    m.beam("rod", length=1.5, elements=3, **given)
    return m


def thrown(m: kp.Model) -> kp.State:
    start = kp.assemble(m)
    rng = np.random.default_rng(3)
    return kp.State(m, 0.0, start.q, rng.normal(size=len(start.q)) * 0.3)


@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_a_free_beam_keeps_its_momentum_and_energy(mass: float) -> None:
    m = free_beam(mass)
    solution = kp.dynamics(m, thrown(m), t_end=0.5, method=kp.DOP853(rtol=1e-11, atol=1e-11))
    totals = np.zeros((len(solution.t), 3))
    for name, info in solution.compiled.bodies.items():
        body = solution.body(name)
        momentum = info.mass * np.column_stack([body.vx, body.vy])
        spin = body.x * momentum[:, 1] - body.y * momentum[:, 0] + info.inertia * body.omega
        totals += np.column_stack([momentum, spin])
    assert np.abs(totals - totals[0]).max() < 1e-12 * mass * 3 * 1.5
    assert np.abs(solution["energy.balance"]).max() < 1e-8
    assert solution["rod.strain_energy"].max() > 1e-4 * mass


def test_a_rigid_rotation_changes_no_internal_force() -> None:
    m = free_beam()
    rng = np.random.default_rng(5)
    start = kp.assemble(m)
    q = np.array(start.q) + rng.normal(size=len(start.q)) * 0.02
    before = kp.State(m, 0.0, q, np.zeros_like(q)).beam("rod")
    for angle in (0.3, 2.0, 400.0):
        c, s = math.cos(angle), math.sin(angle)
        turned = q.reshape(-1, 3) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        turned[:, 2] += angle
        after = kp.State(m, 0.0, turned.ravel(), np.zeros_like(q)).beam("rod")
        for quantity in ("normal_force", "shear_force", "bending_moment"):
            one, other = getattr(before, quantity), getattr(after, quantity)
            # an angle of 400 rad has a rounding error of 3e-14
            assert np.abs(one - other).max() < 1e-13 * 400 * max(1, angle)


def test_damping_dissipates_what_the_energy_loses() -> None:
    damped = kp.Model("damped")
    damped.beam(
        "rod", length=1.5, elements=3, EA=400, GA=300, EI=2, mass_per_length=3, damping=1e-3
    )
    solution = kp.dynamics(damped, thrown(damped), t_end=0.5)
    energy = solution.energy
    assert energy.dissipated[-1] > 0.1
    assert np.abs(energy.balance).max() < 1e-7
    total = energy.kinetic + energy.potential
    assert total[0] - total[-1] == pytest.approx(energy.dissipated[-1], rel=1e-6)


def test_stress_and_energy_of_a_bent_cantilever() -> None:
    m = cantilever(4)
    force = 100.0  # small: linear theory
    m.force("load", "rod.B", force=(0, -force))
    state = rest(m)
    beam = state.beam("rod")
    arm = LENGTH - beam.s
    assert beam.bending_moment == pytest.approx(-force * arm, abs=1e-4 * force)
    assert beam.shear_force == pytest.approx(np.full(len(beam.s), -force), rel=1e-4)
    stress = force * LENGTH * 6 / SIDE**3
    assert state["rod.stress"] == pytest.approx(stress, rel=1e-5)
    assert state["rod.bending_moment"] == pytest.approx(force * LENGTH, rel=1e-5)
    shear = 5 / 6 * E / 2.6 * SIDE**2
    compliance = LENGTH**3 / (3 * BENDING) + LENGTH / shear
    assert state["rod.strain_energy"] == pytest.approx(force**2 * compliance / 2, rel=1e-6)


def test_an_arc_starts_without_stress_and_bends_by_castigliano() -> None:
    radius = 0.5
    m = kp.Model("hook")
    m.ground.points(O=(0, 0))
    given = {"EA": 1e7, "GA": 1e7, "EI": 100.0, "mass_per_length": 1.0}
    m.beam("hook", arc=(0, radius, radius, -math.pi / 2, 0), elements=4, **given)
    m.weld("clamp", "ground.O", "hook.A")
    start = kp.assemble(m)
    assert start["hook.B.x"] == pytest.approx(radius, abs=1e-14)
    assert start["hook.B.y"] == pytest.approx(radius, abs=1e-14)
    assert start["hook.B.angle"] == pytest.approx(math.pi / 2, abs=1e-14)
    assert np.abs(start.beam("hook").bending_moment).max() < 1e-9
    m.force("load", "hook.B", force=(0, -1e-3))
    state = kp.equilibrium(m, kp.assemble(m)).state
    moment = quad(lambda a: (radius - radius * math.sin(a)) ** 2 * radius, 0, math.pi / 2)[0] / 100
    normal = quad(lambda a: math.sin(a) ** 2 * radius, 0, math.pi / 2)[0] / 1e7
    shear = quad(lambda a: math.cos(a) ** 2 * radius, 0, math.pi / 2)[0] / 1e7
    down = radius - state["hook.B.y"]
    assert down == pytest.approx(1e-3 * (moment + normal + shear), rel=1e-5)
