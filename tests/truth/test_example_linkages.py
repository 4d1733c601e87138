"""The linkages of ``examples/`` against geometry and virtual work that are derived by hand.

A motion is an array of three rows: position, velocity and acceleration of a point as complex
numbers. A point of a rigid body is a linear combination of two others, in all three rows.
"""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT

G = 9.81
DEG = np.pi / 180


def solved(name: str) -> kp.Solution:
    (solution,) = kp.load(ROOT / f"examples/{name}.toml").run().values()
    return solution


def turned(
    center: complex, arm: complex, angle: np.ndarray, rate: np.ndarray, acceleration: np.ndarray
) -> np.ndarray:
    """A point that turns about a fixed centre; ``arm`` is its place at angle 0."""
    r = arm * np.exp(1j * angle)
    return np.array([center + r, 1j * rate * r, (1j * acceleration - rate**2) * r])


def still(place: complex, like: np.ndarray) -> np.ndarray:
    motion = np.zeros_like(like)
    motion[0] = place
    return motion


def dyad(p: np.ndarray, q: np.ndarray, from_p: float, from_q: float, side: int) -> np.ndarray:
    """The pin of two bars whose ends p and q move; left of p → q for side 1."""
    d = q[0] - p[0]
    along = (abs(d) ** 2 + from_p**2 - from_q**2) / (2 * abs(d))
    z = p[0] + d / abs(d) * (along + side * 1j * np.sqrt(from_p**2 - along**2))
    e, f = z - p[0], z - q[0]
    area = (np.conj(e) * f).imag

    def solve(first: np.ndarray, second: np.ndarray) -> np.ndarray:
        """The w with e·w = first and f·w = second."""
        return 1j * (second * e - first * f) / area

    def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return (np.conj(a) * b).real

    v = solve(dot(e, p[1]), dot(f, q[1]))
    toward_p, toward_q = abs(v - p[1]) ** 2, abs(v - q[1]) ** 2
    return np.array([z, v, solve(dot(e, p[2]) - toward_p, dot(f, q[2]) - toward_q)])


def needed(
    mass: float, inertia: float, p: np.ndarray, q: np.ndarray, center: complex = 0.5
) -> np.ndarray:
    """The power that a body takes up: of its mass at p + center (q - p), its turning and weight."""
    _, v, a = p + center * (q - p)
    turning = (q - p)[1:] / (q - p)[0]
    return mass * ((a + 1j * G) * np.conj(v)).real + inertia * turning[1].imag * turning[0].imag


def bar(mass: float, p: np.ndarray, q: np.ndarray) -> np.ndarray:
    return needed(mass, mass * abs(q[0] - p[0])[0] ** 2 / 12, p, q)


def same_motion(sol: kp.Solution, point: str, motion: np.ndarray, atol: float = 1e-9) -> None:
    place = sol[f"{point}.x"] + 1j * sol[f"{point}.y"]
    velocity = sol[f"{point}.vx"] + 1j * sol[f"{point}.vy"]
    np.testing.assert_allclose(place, motion[0], rtol=0, atol=atol)
    np.testing.assert_allclose(velocity, motion[1], rtol=0, atol=10 * atol)


def same(found: np.ndarray, expected: np.ndarray, relative: float = 1e-9) -> None:
    np.testing.assert_allclose(found, expected, rtol=0, atol=relative * abs(expected).max())


def even(t: np.ndarray, speed: float, start: float = 0) -> tuple[np.ndarray, ...]:
    return start + speed * t, np.full_like(t, speed), np.zeros_like(t)


def test_the_watt_six_bar() -> None:
    sol = solved("watt_six_bar")
    rocker, coupler, speed = 0.3, 0.2, 2 * np.pi
    e = turned(0.15 - 0.36j, 0.054, *even(sol.t, speed))
    o, a = still(0.15 - 0.36j, e), still(0, e)
    d = still(2 * rocker - 0.015 + 1j * np.sqrt(coupler**2 - 0.015**2), e)
    f = dyad(e, a, 0.36, 0.16, -1)
    b = a + rocker / 0.16 * (f - a)
    c = dyad(b, d, coupler, rocker, 1)
    p = (b + c) / 2
    same_motion(sol, "left.F", f)
    same_motion(sol, "coupler.P", p)
    assert np.ptp(p[0].imag) == pytest.approx(0.202, abs=1e-3)
    assert np.ptp(p[0].real) == pytest.approx(1.7e-4, abs=1e-5)

    power = bar(2, o, e) + bar(0.8, e, f) + needed(1.2, 0.01, a, b)
    power += needed(0.6, 0.002, b, c) + bar(1.2, c, d)
    same(sol["motor.power"], power)
    same(sol["motor.effort"], power / speed)


def jansen(t: np.ndarray, speed: float) -> dict[str, np.ndarray]:
    """The pins of the leg, from its lengths in metres."""
    b, c, d, e, f, g = 0.415, 0.393, 0.401, 0.558, 0.394, 0.367
    h, i, j, k = 0.657, 0.49, 0.5, 0.619
    m = turned(0, 0.15, *even(t, speed))
    pivot = still(-0.38 - 0.078j, m)
    top, knee = dyad(m, pivot, j, b, -1), dyad(m, pivot, k, c, 1)
    left = dyad(pivot, top, d, e, 1)
    heel = dyad(left, knee, f, g, -1)
    foot = dyad(knee, heel, i, h, 1)
    return dict(zip("OMBTKLNF", (still(0, m), m, pivot, top, knee, left, heel, foot), strict=True))


def test_the_jansen_leg() -> None:
    sol = solved("jansen_leg")
    speed = 20 * 2 * np.pi / 60
    pin = jansen(sol.t, speed)
    for point in ("crank.M", "shoulder.T", "shoulder.L", "thigh.K", "foot.N", "foot.F"):
        same_motion(sol, point, pin[point[-1]])

    def plate(mass: float, inertia: float, corners: str) -> np.ndarray:
        a, b, c = (pin[corner] for corner in corners)
        center = ((a + b + c) / 3 - a)[0] / (b - a)[0]
        return needed(mass, inertia, a, b, center[0])

    power = bar(0.3, pin["O"], pin["M"]) + bar(0.5, pin["M"], pin["T"])
    power += bar(0.6, pin["M"], pin["K"]) + bar(0.4, pin["B"], pin["K"])
    power += bar(0.4, pin["L"], pin["N"]) + plate(1.2, 0.03, "BTL") + plate(1.4, 0.04, "KNF")
    same(sol["motor.effort"], power / speed)

    x, y = (sol[f"foot.F.{axis}"][:-1] for axis in "xy")
    low = y < y.min() + 0.01  # the foot is on the ground
    assert np.mean(low) == pytest.approx(0.43, abs=0.01)
    assert np.ptp(x[low]) > 0.8 * np.ptp(x)


def test_the_peaucellier_linkage_draws_a_straight_line() -> None:
    sol = solved("peaucellier")
    arm, side, crank = 0.28, 0.14, 0.09
    angle = 60 * DEG * np.sin(np.pi * sol.t)
    rate = 60 * DEG * np.pi * np.cos(np.pi * sol.t)
    line = (arm**2 - side**2) / (2 * crank)
    same(sol["side_aq.Q.x"], np.full_like(angle, line), 1e-11)
    np.testing.assert_allclose(sol["side_aq.Q.y"], line * np.tan(angle / 2), rtol=0, atol=1e-10)
    speed = line / 2 * rate / np.cos(angle / 2) ** 2
    np.testing.assert_allclose(sol["side_aq.Q.vy"], speed, rtol=0, atol=1e-9)

    p = turned(crank, crank, angle, rate, -(np.pi**2) * angle)
    o, c = still(0, p), still(crank, p)
    a, b = dyad(o, p, arm, side, 1), dyad(o, p, arm, side, -1)
    q = a + b - p  # the fourth corner of the rhombus
    power = bar(0.4, c, p) + bar(0.8, o, a) + bar(0.8, o, b)
    power += bar(0.3, p, a) + bar(0.3, p, b) + bar(0.3, a, q) + bar(0.3, b, q)
    same(sol["motor.power"], power)


def test_the_toggle_press_amplifies_its_force() -> None:
    sol = solved("toggle_press")
    link, speed = 0.35, np.pi
    e = turned(-0.6 + 0.45j, 0.07, *even(sol.t, speed, np.pi))
    o, t = still(-0.6 + 0.45j, e), still(0.8j, e)
    k = dyad(e, t, 0.525, link, -1)
    # the ram is below the knee by w = √(link² - x²), w w' = -x x', w w'' + w'² = -(x x'' + x'²)
    x = k.real
    w = np.sqrt(link**2 - x[0] ** 2)
    fall = -x[0] * x[1] / w
    s = 1j * (k.imag - [w, fall, -(x[0] * x[2] + x[1] ** 2 + fall**2) / w])
    same_motion(sol, "upper.K", k)
    same_motion(sol, "ram.S", s)

    push = 1.2e6 * (0.223 - (s[0].imag - 0.06 + 0.12))
    same(sol["workpiece.force"], push)
    power = bar(20, o, e) + bar(12, e, k) + bar(15, t, k) + bar(15, k, s)
    power += 80 * (s[2].imag + G) * s[1].imag - push * s[1].imag
    same(sol["motor.effort"], power / speed, 1e-8)
    # without friction the forces are inverse to the speeds
    tangent = -x[0] / w
    same(sol["ram.vy"], -2 * tangent * sol["upper.K.vx"])
    assert 1 / (2 * tangent.min()) == pytest.approx(35, rel=1e-3)


def quintic(
    t: np.ndarray, t0: float, y0: float, t1: float, y1: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """``step5`` and its derivatives."""
    s, h, rise = np.clip((t - t0) / (t1 - t0), 0, 1), t1 - t0, y1 - y0
    return (
        y0 + rise * (10 * s**3 - 15 * s**4 + 6 * s**5),
        rise / h * 30 * s**2 * (1 - s) ** 2,
        rise / h**2 * 60 * s * (1 - s) * (1 - 2 * s),
    )


def turns_by_cylinder(
    foot: complex, head: complex, side: int, length: np.ndarray, rate: np.ndarray, acc: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Angle of the body with the head, about 0: L² = a² + b² - 2ab cos γ; last, its lever dL/dγ."""
    a, b = abs(foot), abs(head)
    gamma = side * np.arccos((a**2 + b**2 - length**2) / (2 * a * b))
    lever = a * b * np.sin(gamma) / length
    omega = rate / lever
    alpha = (acc - omega**2 * (a * b * np.cos(gamma) - lever**2) / length) / lever
    return gamma + np.angle(foot) - np.angle(head), omega, alpha, lever


def test_the_excavator_is_carried_by_its_cylinders() -> None:
    sol = solved("excavator")
    first = quintic(sol.t, 0, 1.95, 4, 2.45)
    *boom, lever = turns_by_cylinder(0.6 - 0.5j, 2.3 + 0.5j, 1, *first)
    second = quintic(sol.t, 2, 2.9, 6, 2.45)
    *bend, second_lever = turns_by_cylinder(2.7 + 1.1j - 5.6, -0.8 + 0.2j, -1, *second)
    total = [bend[0] + boom[0] - 2 * np.pi, bend[1] + boom[1], bend[2] + boom[2]]
    joint = turned(0, 5.6, *boom)
    tip = joint + turned(0, 2.9, *total)
    np.testing.assert_allclose(np.cos(sol["arm.angle"] - total[0]), 1, rtol=0, atol=1e-12)
    same_motion(sol, "boom.A", joint)
    same_motion(sol, "arm.T", tip)

    def moment(mass: float, inertia: float, center: np.ndarray, about: np.ndarray) -> np.ndarray:
        arm = np.conj(center[0] - about[0])
        return mass * (arm * (center[2] + 1j * G)).imag + inertia

    boom_center = turned(0, 2.6 + 0.5j, *boom)
    arm_center = joint + turned(0, 2.2, *total)
    on_arm = moment(1900, 2400 * total[2], arm_center, joint)
    same(-sol["arm_cylinder.tension"], on_arm / second_lever)
    about_pivot = moment(1500, 4500 * boom[2], boom_center, still(0, tip))
    about_pivot += moment(1900, 2400 * total[2], arm_center, still(0, tip))
    same(-sol["boom_cylinder.tension"], about_pivot / lever)
    assert (sol["boom_cylinder.tension"] < 0).all() and (sol["arm_cylinder.tension"] > 0).all()


def test_the_garage_door_passes_its_change_point_smoothly() -> None:
    sol = solved("garage_door")
    angle, omega = sol["arm.angle"], sol["arm.omega"]
    assert angle.min() < -140 * DEG and angle.max() == pytest.approx(20 * DEG)
    # x = 2 cos φ ± √(9 - (1 - 2 sin φ)²) = 2 cos φ + 2 √((1 + sin φ) (2 - sin φ)), and
    # √(1 + sin φ) = √2 sin(φ/2 + 45°) changes its sign as the arm passes -90°
    root = np.sqrt(2) * np.sin(angle / 2 + np.pi / 4)
    reach = 2 * root * np.sqrt(2 - np.sin(angle))
    x = 2 * np.cos(angle) + reach
    np.testing.assert_allclose(sol["roller.x"], x, rtol=0, atol=1e-9)

    away = abs(angle + np.pi / 2) > 1 * DEG
    a = turned(0, 2, angle, omega, sol["arm.alpha"])[:, away]
    b = np.zeros_like(a)
    b[0] = x[away] + 1j
    d = b[0] - a[0]  # d·(vb - va) = 0 and d·(ab - aa) = -|vb - va|², with b level
    b[1] = (np.conj(d) * a[1]).real / d.real
    b[2] = ((np.conj(d) * a[2]).real - abs(b[1] - a[1]) ** 2) / d.real
    same(sol["roller.vx"][away], b[1].real)
    power = bar(12, still(0, a), a) + bar(60, a, b) + (b[2] * np.conj(b[1])).real
    brake = -150 * omega[away] ** 2
    np.testing.assert_allclose(power, brake, rtol=0, atol=1e-7 * abs(brake).max())
