"""The linkages of the gallery against geometry and balances of power that are derived by hand."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from truth.test_example_linkages import (
    DEG,
    bar,
    dyad,
    even,
    needed,
    quintic,
    same,
    same_motion,
    solved,
    still,
    turned,
    turns_by_cylinder,
)


def level(
    mass: float, inertia: float, p: np.ndarray, q: np.ndarray, center: complex = 0.5
) -> np.ndarray:
    """The power that a body takes up where there is no weight."""
    _, v, a = p + center * (q - p)
    turning = (q - p)[1:] / (q - p)[0]
    return mass * (a * np.conj(v)).real + inertia * turning[1].imag * turning[0].imag


def rod(mass: float, p: np.ndarray, q: np.ndarray) -> np.ndarray:
    return level(mass, mass * abs(q[0] - p[0])[0] ** 2 / 12, p, q)


def heart(t: np.ndarray) -> np.ndarray:
    """The path of the tracer from its harmonics, sin³ = (3 sin - sin 3·)/4."""
    sines, cosines = {1: 12.0, 3: -4.0}, {1: 13.0, 2: -5.0, 3: -2.0, 4: -1.0}
    rows = []
    for order in range(3):
        row = np.zeros_like(t, dtype=complex)
        for terms, phase, along in ((sines, -np.pi / 2, 1), (cosines, 0.0, 1j)):
            for k, factor in terms.items():
                w = k * np.pi / 2
                row += along * factor * w**order * np.cos(w * t + phase + order * np.pi / 2)
        rows.append(3.2e-3 * row)
    motion = np.array(rows)
    motion[0] += 0.16 + 0.01j
    return motion


def test_the_pantograph_enlarges_three_times() -> None:
    sol = solved("pantograph")
    t = heart(sol.t)
    same_motion(sol, "link.T", t, 1e-11)
    same_motion(sol, "pen_arm.P", 3 * t, 1e-11)
    o = still(0, t)
    a = dyad(o, t, 0.15, 0.15, 1)
    c, d = 3 * a, 2 * a + t
    power = level(0.2, 0.0034, o, c) + level(0.2, 0.0034, c, 3 * t) + rod(0.07, a, t)
    power += rod(0.13, t, d) + 8 * abs(3 * t[1]) ** 2
    same(sol["hand_x.power"] + sol["hand_y.power"], power)


def test_the_klann_leg_steps() -> None:
    sol = solved("klann_leg")
    s, speed = 0.4, np.pi
    table = {9: 1.366 + 1.366j, 11: 1.009 + 0.574j, 27: 0.741 + 0.75j, 29: 1.331 + 0.75j}
    table |= {33: 0j, 35: 0.232 + 0.866j, 37: 0.866 + 1.5j}
    at = {number: s * (place - 1.599 - 0.75j) for number, place in table.items()}
    m = turned(0, at[29], *even(sol.t, speed))
    o, a, b = still(0, m), still(at[9], m), still(at[11], m)
    e = dyad(m, b, abs(at[27] - at[29]), abs(at[27] - at[11]), -1)
    k = m + (at[35] - at[29]) / (at[27] - at[29]) * (e - m)
    h = dyad(k, a, abs(at[37] - at[35]), abs(at[37] - at[9]), 1)
    f = k + (at[33] - at[35]) / (at[37] - at[35]) * (h - k)
    for point, motion in {"rod.E": e, "rod.K": k, "upper_rocker.H": h, "leg.F": f}.items():
        same_motion(sol, point, motion)

    power = needed(0.3, 0.0005, o, m) + needed(0.8, 0.015, m, e, (-0.563 + 0.039j) / -0.59)
    power += needed(0.3, 0.0005, b, e) + needed(0.4, 0.0015, a, h)
    power += needed(1.2, 0.05, k, h, (0.134 - 0.077j) / (0.634 + 0.634j))
    same(sol["motor.effort"], power / speed)

    down = f[0, (sol.t > 0.99) & (sol.t < 1.99)]  # half a turn
    assert np.ptp(down.imag) == pytest.approx(0.022, abs=1e-4)
    assert np.ptp(down.real) == pytest.approx(np.ptp(f[0].real), abs=1e-4)
    assert np.ptp(f[0].imag) == pytest.approx(0.211, abs=1e-3)


def test_the_hoecken_linkage_is_straight_and_even_for_half_a_turn() -> None:
    sol = solved("hoecken")
    r, speed = 0.06, 2 * np.pi
    angle = 130 * DEG + speed * sol.t
    a = turned(0, r, *even(sol.t, speed, 130 * DEG))
    o, d = still(0, a), still(2 * r, a)
    c = dyad(a, d, 2.5 * r, 2.5 * r, 1)
    p = 2 * c - a
    same_motion(sol, "coupler.P", p)
    power = rod(0.2, o, a) + rod(0.8, a, p) + rod(0.4, d, c)
    same(sol["motor.power"], power)

    half = np.cos(angle) <= 0  # the crank points away from D
    place, velocity = p[0][half], p[1][half].real
    assert np.ptp(place.imag) < 0.0025 * np.ptp(place.real)
    assert np.ptp(place.real) == pytest.approx(4 * r, rel=0.1)
    middle = np.cos(angle) < -0.5
    assert np.ptp(p[1][middle].real) < 0.05 * abs(velocity).max()


def test_the_trammel_draws_an_ellipse() -> None:
    sol = solved("elliptical_trammel")
    a, b, speed = 0.3, 0.18, np.pi
    angle = 40 * DEG + speed * sol.t
    np.testing.assert_allclose(sol["rod.P.x"], a * np.cos(angle), rtol=0, atol=1e-12)
    np.testing.assert_allclose(sol["rod.P.y"], b * np.sin(angle), rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.hypot(sol["rod.M.x"], sol["rod.M.y"]), 0.06, rtol=0, atol=1e-12)
    # mass centre: half axes a/2 and a/2 - (a - b); the kinetic energy changes with the angle
    long, short = a / 2, a / 2 - (a - b)
    effort = 0.4 * speed**2 * (long**2 - short**2) * np.sin(angle) * np.cos(angle)
    same(sol["hand.effort"], effort)


def test_the_cardan_gear_draws_a_line_and_presses_its_piston_to_no_side() -> None:
    sol = solved("cardan_gear")
    arm, speed = 0.04, 8 * np.pi
    angle = 30 * DEG + speed * sol.t
    np.testing.assert_allclose(sol["piston.y"], 0, rtol=0, atol=1e-12)
    np.testing.assert_allclose(sol["piston.x"], 2 * arm * np.cos(angle), rtol=0, atol=1e-12)
    same(sol["wheel.omega"], np.full_like(angle, -speed), 1e-12)
    force = sol["P"].force(on="piston")
    along = -2 * 2 * arm * speed**2 * np.cos(angle)
    same(force[:, 0], along)
    np.testing.assert_allclose(force[:, 1], 2 * 9.81, rtol=0, atol=1e-9)
    effort = along * -2 * arm * np.sin(angle) + 0.8 * 9.81 * arm * np.cos(angle)
    same(sol["shaft.effort"], effort)


def test_the_oldham_coupling_has_no_error_of_speed() -> None:
    sol = solved("oldham_coupling")
    e, speed = 0.012, 20 * np.pi
    np.testing.assert_allclose(sol["second.omega"], speed, rtol=1e-12)
    # Thales: the centre of the disc sees the shafts at a right angle
    center = e / 2 * (1 + np.exp(2j * speed * sol.t))
    np.testing.assert_allclose(sol["disc.x"] + 1j * sol["disc.y"], center, rtol=0, atol=1e-13)
    felt = sol["O"].force(on="ground") + sol["Q"].force(on="ground")
    outwards = 0.4 * e / 2 * (2 * speed) ** 2 * np.exp(2j * speed * sol.t)
    np.testing.assert_allclose(felt @ [1, 1j], outwards, rtol=0, atol=1e-9 * abs(outwards[0]))
    same(sol["motor.effort"], np.full_like(sol.t, 3.0), 1e-10)


def test_the_wipe_follows_from_two_triangles() -> None:
    sol = solved("wiper")
    crank, lever, length, arm, speed = 0.048, 0.07, 0.33, 0.48, 1.5 * np.pi
    motor = -0.3 - 0.09j
    e = turned(motor, crank, *even(sol.t, speed))
    m, a, b = still(motor, e), still(0, e), still(0.56, e)
    f = dyad(e, a, length, lever, -1)
    tip = arm / lever * np.exp(105j * DEG) * f
    same_motion(sol, "first.T", tip)
    np.testing.assert_allclose(sol["second.angle"], sol["first.angle"], rtol=0, atol=1e-12)
    h = f + b
    power = rod(0.15, m, e) + rod(0.3, e, f) + rod(0.4, f, h)
    power += level(0.8, 0.02, a, tip, 0.4) + level(0.8, 0.02, b, tip + b, 0.4)
    same(sol["motor.power"], power)

    far = abs(motor)
    ends = [
        np.arccos((far**2 + lever**2 - (length + side * crank) ** 2) / (2 * far * lever))
        for side in (-1, 1)
    ]
    wipe = np.ptp(sol["first.angle"])
    assert wipe == pytest.approx(ends[1] - ends[0], abs=2e-5)
    assert wipe == pytest.approx(97.8 * DEG, abs=0.1 * DEG)


def test_a_brace_in_line_keeps_the_load_from_the_cylinder() -> None:
    sol = solved("landing_gear")
    hinge, joined = -0.9 + 0j, -0.7j
    lower = abs(joined - hinge) - 0.6
    along = np.angle(joined - hinge)
    down = abs((0.12 + 0.2j) * np.exp(1j * along) + 0.45 - 0.05j)
    stroke = quintic(sol.t, 1, 0, 7, -0.3)
    *turning, _ = turns_by_cylinder(
        -0.45 + 0.05j, 0.12 + 0.2j, -1, down + stroke[0], stroke[1], stroke[2]
    )
    turning[0] = turning[0] - 2 * np.pi * np.round((turning[0][0] - along) / (2 * np.pi))
    b = still(hinge, np.zeros((3, len(sol.t)), complex))
    a = np.zeros_like(b)
    k = turned(hinge, 0.6, *turning)
    c = dyad(k, a, lower, 0.7, -1)
    same_motion(sol, "upper.K", k)
    same_motion(sol, "leg.C", c)
    moved = (sol.t > 1.01) & (sol.t < 6.99)
    power = needed(140, 22, a, c, 1.2 / 0.7) + needed(9, 0.4, b, k, 0.25 / 0.6) + bar(6, k, c)
    same(-(sol["cylinder.tension"] * sol["cylinder.rate"])[moved], power[moved])
    assert sol["leg.angle"][-1] < -170 * DEG

    case = kp.load(ROOT / "examples/landing_gear.toml")
    still_down = kp.assemble(case.model.with_parameters({"side": 0}), guess=GUESS)
    pushed = kp.assemble(case.model.with_parameters({"side": 5e4}), guess=GUESS)
    np.testing.assert_allclose(pushed["cylinder.tension"], still_down["cylinder.tension"])
    # moments about A: the brace carries the side force times its lever arms
    brace = 5e4 * 1.55 / (0.7 * np.cos(along))
    more = pushed["C"].force(on="leg") - still_down["C"].force(on="leg")
    np.testing.assert_allclose(np.hypot(*more), brace, rtol=1e-9)


GUESS = {"leg.angle": "-90 deg", "upper.angle": "-38 deg", "lower.angle": "-38 deg"}


def test_the_steering_meets_ackermann_within_a_degree() -> None:
    sol = solved("rack_steering")
    track, base, arm, behind, half = 1.3, 2.5, 0.16, 0.19, 0.36
    toe = np.arctan2(track / 2, base)
    length = np.hypot(track / 2 - arm * np.sin(toe) - half, behind - arm * np.cos(toe))
    y = 8e-3 * sol["pinion.angle"]
    np.testing.assert_allclose(sol["rack.y"], y, rtol=0, atol=1e-13)
    assert abs(y).max() == pytest.approx(8e-3 * 400 * DEG, rel=1e-3)

    def wheel(side: int) -> np.ndarray:
        """The angle of a wheel: its arm ends on two circles."""
        end = -behind + 1j * (y + side * (half - track / 2))
        far = abs(end)
        inside = np.arccos((far**2 + arm**2 - length**2) / (2 * far * arm))
        straight = -np.exp(side * 1j * toe)
        return np.angle(np.exp(1j * (np.angle(end) - side * inside)) / straight)

    np.testing.assert_allclose(sol["left.angle"], wheel(1), rtol=0, atol=1e-10)
    np.testing.assert_allclose(sol["right.angle"], wheel(-1), rtol=0, atol=1e-10)
    left, right = sol["left.angle"], sol["right.angle"]
    turns = abs(left) > 1 * DEG
    radius = base / np.tan(left[turns]) + track  # of the right wheel about the ideal centre
    ideal = np.arctan(base / radius)
    assert abs(ideal - right[turns]).max() < 1 * DEG
    assert abs(left).max() > 20 * DEG


def test_the_second_loop_of_the_six_bar_follows_the_first() -> None:
    sol = solved("six_bar")
    speed = 2 * np.pi
    b = turned(0, 0.1, *even(sol.t, speed, sol["crank.angle"][0]))
    a, d, g = still(0, b), still(0.3, b), still(0.65, b)
    c = dyad(b, d, 0.3, 0.2, 1)
    e = d + (0.12 - 0.15j) / 0.2 * (c - d)
    f = dyad(e, g, 0.28, 0.2, 1)
    same_motion(sol, "coupler.C", c, 1e-8)
    same_motion(sol, "link.F", f, 1e-8)
    turning = ((f - g)[1] / (f - g)[0]).imag
    power = bar(0.5, a, b) + bar(1.2, b, c) + needed(2, 0.012, d, c, (0.1 - 0.05j) / 0.2)
    power += bar(1, e, f) + bar(0.8, f, g) + 5 * turning**2
    same(sol["motor.power"], power, 1e-7)
