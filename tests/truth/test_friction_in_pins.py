"""A four-bar linkage with friction in three pins against equations of one freedom by hand.

All pins stand still where the crank does: they stick and slip together. While they stick, each
takes the same part of its limit; they slip where that part is one.
"""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from kempe.base.arrays import Floats
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

G, STATIC, KINETIC, RADIUS, D = 9.81, 0.4, 0.3, 0.02, 0.4
LENGTHS = np.array([0.1, 0.4, 0.3])
MASSES = np.array([0.5, 1.0, 1.0])
#: Pins with friction: row of Φ, body i (-1: ground) and body j.
RUBBING = {"A": (0, -1, 0), "B": (2, 0, 1), "D": (6, -1, 2)}
T_END = 1.0


def motor(t: float) -> float:
    return 0.25 * np.sin(4 * t)


def angles(crank: float) -> Floats:
    """The angles of crank, coupler and rocker; the rocker's frame begins at C."""
    b = LENGTHS[0] * np.array([np.cos(crank), np.sin(crank)])
    to = np.array([D, 0]) - b
    far = np.hypot(*to)
    inner = np.arccos((LENGTHS[1] ** 2 + far**2 - LENGTHS[2] ** 2) / (2 * LENGTHS[1] * far))
    coupler = np.arctan2(to[1], to[0]) + inner
    c = b + LENGTHS[1] * np.array([np.cos(coupler), np.sin(coupler)])
    return np.array([crank, coupler, np.arctan2(-c[1], D - c[0])])


def jacobian(turned: Floats) -> Floats:
    """Φ_q of A, B, C and D for bars with frames at their centres."""
    rows = np.zeros((8, 9))
    ends = [(0, -1, 0, 1), (0, 1, 1, -1), (1, -1, 1, 1), (1, 1, 2, -1), (2, -1, 2, 1), (2, 1, 3, 1)]
    for k, end, pin, sign in ends:
        half = 0.5 * end * LENGTHS[k]
        normal = half * np.array([-np.sin(turned[k]), np.cos(turned[k])])
        rows[2 * pin : 2 * pin + 2, 3 * k : 3 * k + 2] = sign * np.eye(2)
        rows[2 * pin : 2 * pin + 2, 3 * k + 2] = sign * normal
    return rows


def bias(turned: Floats, rates: Floats) -> Floats:
    """γ in Φ_q a = γ."""
    gamma = np.zeros(8)
    ends = [(0, -1, 0, 1), (0, 1, 1, -1), (1, -1, 1, 1), (1, 1, 2, -1), (2, -1, 2, 1), (2, 1, 3, 1)]
    for k, end, pin, sign in ends:
        arm = 0.5 * end * LENGTHS[k] * np.array([np.cos(turned[k]), np.sin(turned[k])])
        gamma[2 * pin : 2 * pin + 2] += sign * rates[k] ** 2 * arm
    return gamma


def ratios(turned: Floats) -> Floats:
    """The rates of the angles for one of the crank."""
    rows = jacobian(turned)
    columns = np.delete(rows, 2, axis=1)
    solved = np.linalg.lstsq(columns, -rows[:, 2], rcond=None)[0]
    return np.array([1.0, solved[4], solved[7]])


def solved(t: float, turned: Floats, rate: float, factor: float, sense: float) -> Floats:
    """Accelerations and multipliers for friction of factor × load × radius against the sense."""
    rates = rate * ratios(turned)
    inertia = MASSES * LENGTHS**2 / 12
    mass = np.diag(np.column_stack([MASSES, MASSES, inertia]).ravel())
    rows = jacobian(turned)
    matrix = np.block([[mass, rows.T], [rows, np.zeros((8, 8))]])
    given = np.zeros(17)
    given[1:9:3] = -MASSES * G
    given[2] = motor(t)
    given[9:] = bias(turned, rates)
    inverse, x = np.linalg.inv(matrix), np.zeros(17)
    relative = np.append(ratios(turned), 0.0)  # ground at -1
    for _ in range(200):
        right = given.copy()
        for row, i, j in RUBBING.values():
            load = np.hypot(*x[9 + row : 11 + row])
            torque = -factor * RADIUS * load * np.sign(sense * (relative[j] - relative[i]))
            right[3 * j + 2] += torque
            if i >= 0:
                right[3 * i + 2] -= torque
        new = inverse @ right
        if np.abs(new - x).max() < 1e-14 * np.abs(new).max():
            break
        x = new
    return new


def excess(t: float, turned: Floats, sense: float, factor: float) -> float:
    """Acceleration of the crank from rest in a sense, for friction of this factor."""
    return float(sense * solved(t, turned, 0.0, factor, sense)[2])


def begins(t: float, turned: Floats) -> tuple[float, float] | None:
    """When the crank next leaves its place, and in which sense."""
    grid = np.linspace(t, T_END, 300)
    for k, late in enumerate(grid):
        for sense in (1.0, -1.0):
            if excess(late, turned, sense, STATIC) > 0:
                if k == 0:
                    return t, sense
                of = (turned, sense, STATIC)
                return float(brentq(excess, grid[k - 1], late, of, xtol=1e-14)), sense
    return None


def course() -> tuple[list[float], list[float], Floats]:
    """The times of slipping and sticking, and angle and rate of the crank at the end."""
    t, state = 0.0, np.array([np.radians(70), 0.0])
    slips: list[float] = []
    sticks: list[float] = []
    while t < T_END and (begun := begins(t, angles(state[0]))):
        t, sense = begun
        slips.append(t)

        def rate(t: float, y: Floats, sense: float = sense) -> list[float]:
            return [y[1], solved(t, angles(y[0]), y[1], KINETIC, sense)[2]]

        def still(t: float, y: Floats, sense: float = sense, since: float = t) -> float:
            return sense * y[1] if t > since + 1e-6 else 1.0

        still.terminal, still.direction = True, -1  # type: ignore[attr-defined]
        moved = solve_ivp(rate, (t, T_END), state, "DOP853", rtol=1e-11, atol=1e-12, events=still)
        t, state = float(moved.t[-1]), moved.y[:, -1]
        if moved.status == 1:
            sticks.append(t)
            state[1] = 0.0
    return slips, sticks, state


@pytest.fixture(scope="module")
def solution() -> kp.Solution:
    m = kp.Model("four-bar", gravity=(0, -G))
    m.ground.points(A=(0, 0), D=(D, 0))
    ends = (("A", "B"), ("B", "C"), ("C", "D"))
    for name, mass, length, both in zip(
        ("crank", "coupler", "rocker"), MASSES, LENGTHS, ends, strict=True
    ):
        m.bar(name, mass=float(mass), length=float(length), ends=both)
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.torque("motor", "crank", torque="0.25*sin(4*t)")
    for pin in RUBBING:
        m.friction(f"rub_{pin}", pin, static=STATIC, kinetic=KINETIC, radius=RADIUS)
    turned = angles(np.radians(70))
    start = kp.assemble(
        m,
        set={"crank.angle": "70 deg", "crank.omega": 0},
        guess={"coupler.angle": float(turned[1]), "rocker.angle": float(turned[2])},
    )
    return kp.dynamics(m, start, t_end=T_END, method=kp.DOP853(rtol=1e-11, atol=1e-13))


def test_times_and_place(solution: kp.Solution) -> None:
    slips, sticks, (angle, rate) = course()
    assert len(sticks) == 1
    for name in RUBBING:
        stick, slip = (solution.events[f"rub_{name}.{what}"].t for what in ("stick", "slip"))
        np.testing.assert_allclose(stick, sticks, rtol=0, atol=1e-8)
        # at the start the crank moves at once
        np.testing.assert_allclose(slip, slips[1:], rtol=0, atol=1e-8)
    assert solution["crank.angle"][-1] == pytest.approx(angle, abs=1e-8)
    assert solution["crank.omega"][-1] == pytest.approx(rate, abs=1e-7)
