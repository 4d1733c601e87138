"""The machines of the tutorials against slider-cranks and moments that are derived by hand.

Complex numbers are vectors of the plane; the rows of a motion are position, velocity, acceleration.
"""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from scipy.interpolate import CubicSpline
from truth.test_example_linkages import DEG, G, needed, same, solved, turned


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (np.conj(a) * b).imag


def vector(pairs: np.ndarray) -> np.ndarray:
    return pairs @ [1, 1j]


def piston(pin: np.ndarray, length: float) -> np.ndarray:
    """The end of a rod from a crank pin to the right, on the x axis."""
    x = pin[0].real + np.sqrt(length**2 - pin[0].imag ** 2)
    e = x - pin[0]
    v = (np.conj(e) * pin[1]).real / e.real
    a = ((np.conj(e) * pin[2]).real - abs(v - pin[1]) ** 2) / e.real
    return np.array([x, v, a])


def pressed(angle: np.ndarray) -> np.ndarray:
    """The gas force from its table, by SciPy, N."""
    table = kp.load(ROOT / "examples/engine.toml").model.tree()["tables"]["gas"]
    spline = CubicSpline(np.array(table["x"]) * DEG, 1e3 * np.array(table["y"]), bc_type="periodic")
    return spline(angle % (4 * np.pi))


def test_the_forces_of_the_engine_are_those_of_a_slider_crank() -> None:
    sol = solved("engine")
    theta, omega, alpha = (sol[f"crank.{name}"] for name in ("angle", "omega", "alpha"))
    a = turned(0, 0.04, theta, omega, alpha)
    b = piston(a, 0.14)
    np.testing.assert_allclose(sol["piston.x"], b[0].real, rtol=0, atol=1e-12)
    same(sol["piston.ax"], b[2].real)
    rod, gas = b - a, pressed(theta)
    s = a + 0.045 / 0.14 * rod
    turning = (rod[2] / rod[0]).imag
    weighed = 0.6 * (s[2] + 1j * G)
    at_x = -gas - 0.5 * b[2].real
    moment = 0.0016 * turning - cross(a[0] - s[0], weighed)
    at_b = at_x + 1j * (moment + rod[0].imag * at_x) / rod[0].real
    at_a = weighed - at_b
    same(vector(sol["B"].force(on="rod")), at_b)
    same(vector(sol["A"].force(on="rod")), at_a)
    same(sol["cylinder"].force(on="piston")[:, 1], at_b.imag + 0.5 * G)
    same(vector(sol["O"].force(on="crank")), at_a + 18j * G)
    shaft = cross(a[0], -at_a) - 0.004 * alpha
    same(sol["shaft"].torque(on="flywheel"), shaft)
    same(0.3 * alpha + 26.3756, shaft)


def test_a_cycle_of_the_engine_does_the_work_of_its_load() -> None:
    sol = solved("engine")
    angle = np.linspace(0, 4 * np.pi, 100_001)
    x = 0.04 * np.cos(angle) + np.sqrt(0.14**2 - (0.04 * np.sin(angle)) ** 2)
    gas = pressed(angle)
    work = -np.sum((gas[1:] + gas[:-1]) / 2 * np.diff(x))
    assert work / (4 * np.pi) == pytest.approx(26.3756, rel=1e-6)
    turns = sol["crank.angle"] / (4 * np.pi)
    again = np.interp([1, 2, 3, 4], turns, sol["crank.omega"])
    np.testing.assert_allclose(again, sol["crank.omega"][0], rtol=2e-5)


def test_the_pins_of_the_boom_carry_its_weights() -> None:
    sol = solved("boom")
    c, (gx, gy) = 3.0, (0.8, -1.2)
    g, direction = np.hypot(gx, gy), np.arctan2(gy, gx)
    s = np.clip(sol.t / 12, 0, 1)
    length = 2.76 + 1.1 * s**3 * (10 - 15 * s + 6 * s**2)
    rate = 1.1 / 12 * 30 * s**2 * (1 - s) ** 2
    change = 1.1 / 144 * 60 * s * (1 - s) * (1 - 2 * s)
    psi = np.arccos((g**2 + c**2 - length**2) / (2 * g * c))
    same(sol["boom.angle"], psi + direction, 1e-10)
    omega = length * rate / (g * c * np.sin(psi))
    alpha = (rate**2 + length * change - g * c * np.cos(psi) * omega**2) / (g * c * np.sin(psi))
    same(sol["boom.alpha"], alpha)

    angle = psi + direction
    along = np.exp(1j * angle)
    inertia = 3200 + 600 * 3.5**2 + 1200 * 8**2
    moment = inertia * alpha + G * (600 * 3.5 + 1200 * 8) * np.cos(angle)
    push = moment / (g * c * np.sin(psi) / length)
    same(-sol["cylinder.tension"], push)
    turning = (1j * alpha - omega**2) * along
    hook = 1200 * (8 * turning + 1j * G)
    same(vector(sol["hook"].force(on="load")), hook)
    line = (c * along - (gx + 1j * gy)) / length
    pin = hook + 600 * (3.5 * turning + 1j * G) - push * line
    same(vector(sol["O"].force(on="boom")), pin)
    still_ends = G * (600 * 3.5 + 1200 * 8) * np.cos(angle) * length / (g * c * np.sin(psi))
    same(push[[0, -1]], still_ends[[0, -1]])


def test_the_motor_of_the_press_obeys_the_balance_of_power() -> None:
    sol = solved("motor_press")
    theta, omega, alpha = (sol[f"wheel.{name}"] for name in ("angle", "omega", "alpha"))
    e = turned(0, 0.1, theta, omega, alpha)
    ram = -1j * piston(1j * e, 0.6)  # the ram is below the shaft
    np.testing.assert_allclose(sol["ram.y"], ram[0].imag, rtol=0, atol=1e-10)
    power = (20 + 25 * 2) * omega * alpha + needed(30, 30 * 0.6**2 / 12, e, ram)
    power += 150 * ((ram[2] + 1j * G) * np.conj(ram[1])).real
    deep, rate = 0.22 - (ram[0].imag - 0.1 + 1.0), -ram[1].imag
    pushed = np.where(deep > 0, np.maximum(4e6 * deep + 5e4 * rate, 0), 0)
    given = 500 * (1 - -5 * omega / (50 * np.pi)) * (-5 * omega)
    same(power, given + pushed * ram[1].imag)
    same(sol["workpiece"].force(on="ram")[:, 1], pushed)
    same(sol["pinion.omega"], -5 * omega)
    # pitch point: the tooth force turns the wheel and the flywheel
    tangential = (500 * (1 + 5 * omega / (50 * np.pi)) + 2 * 5 * alpha) / 0.08
    same(abs(sol["mesh"].tangential), abs(tangential))


def test_the_press_starts_like_a_motor_with_a_flywheel() -> None:
    sol = solved("motor_press")
    first = sol.t < 0.3
    inertia = 2 + 20 / 25
    free = 50 * np.pi * (1 - np.exp(-sol.t * 500 / (50 * np.pi) / inertia))
    np.testing.assert_allclose(sol["pinion.omega"][first], free[first], rtol=0.05)
    energy = sol.energy
    stored = energy.kinetic + energy.potential - (energy.kinetic + energy.potential)[0]
    same(energy.work, stored + energy.dissipated, 1e-7)
