"""The machines of the gallery against equations of motion and balances that are derived by hand."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from scipy.integrate import solve_ivp
from truth import chains
from truth.test_example_linkages import (
    DEG,
    G,
    bar,
    dyad,
    even,
    needed,
    quintic,
    same,
    solved,
    still,
    turned,
)


def with_parameters(name: str, **parameters: float) -> kp.Solution:
    case = kp.load(ROOT / f"examples/{name}.toml", parameters=parameters)
    (solution,) = case.run().values()
    return solution


def test_the_lift_multiplies_forces_as_it_multiplies_ways() -> None:
    sol = solved("scissor_lift")
    size = 1.6
    length, rate, change = quintic(sol.t, 0, 1.045, 10, 1.93)
    # length² = L² (0.6² cos² + 1.6² sin²) = L² (0.36 + 2.2 sin²)
    sine = np.sqrt(((length / size) ** 2 - 0.36) / 2.2)
    angle = np.arcsin(sine)
    np.testing.assert_allclose(sol["a1.angle"], angle, rtol=0, atol=1e-11)
    double = 1.1 * size**2 * np.sin(2 * angle)
    omega = length * rate / double
    alpha = (rate**2 + length * change - 2.2 * size**2 * np.cos(2 * angle) * omega**2) / double
    q = turned(0, size, angle, omega, alpha)
    width, height = q.real, q.imag
    links = np.zeros_like(angle)
    for stage in range(3):
        low, high = 1j * stage * height, 1j * (stage + 1) * height
        links += bar(20, low, high + width) + bar(20, low + width, high)
    load = 360 * (3 * height[2] + G) * 3 * height[1]
    same(-sol["cylinder.tension"] * rate, links + load, 1e-8)
    assert -sol["cylinder.tension"][0] > 5 * 360 * G
    assert sol["cylinder.tension"][-1] / sol["cylinder.tension"][0] == pytest.approx(0.45, abs=0.02)


def swing(ramp: float, sol: kp.Solution) -> np.ndarray:
    """The angle of a pendulum below a trolley, l φ″ = -g sin φ - a cos φ, by SciPy."""
    breaks = [0, ramp, ramp + 2, 2 * ramp + 2, 20.0]
    rates = [3 / ramp, 0.0, -3 / ramp, 0.0]
    state, found = np.zeros(2), np.zeros_like(sol.t)
    for begin, end, a in zip(breaks[:-1], breaks[1:], rates, strict=True):
        made = solve_ivp(
            lambda _, y, a=a: [y[1], -(G * np.sin(y[0]) + a * np.cos(y[0])) / 8],
            (begin, end),
            state,
            method="DOP853",
            rtol=1e-12,
            atol=1e-13,
            dense_output=True,
        )
        within = (sol.t >= begin) & (sol.t <= end)
        found[within], state = made.sol(sol.t[within])[0], made.y[:, -1]
    return found


def test_ramps_of_one_period_leave_no_swing() -> None:
    period = 2 * np.pi * np.sqrt(8 / G)
    sol = solved("crane_trolley")
    np.testing.assert_allclose(sol["swing"], swing(period, sol), rtol=0, atol=1e-8)
    after = sol.t > 2 * period + 2
    left = abs(sol["swing"][after]).max()
    assert left < 0.01 * abs(sol["swing"]).max()
    other = with_parameters("crane_trolley", ramp=4.0)
    np.testing.assert_allclose(other["swing"], swing(4.0, other), rtol=0, atol=1e-8)
    assert abs(other["swing"][other.t > 11]).max() > 50 * left


def pumping(t: np.ndarray, counter: float) -> tuple[np.ndarray, np.ndarray]:
    """The power of the gearbox and the motion of the rods of the pump jack."""
    shaft, speed = 2.6 + 0.9j, 8 * 2 * np.pi / 60
    a = turned(shaft, 0.9, *even(t, speed, -90 * DEG))
    o, s = still(shaft, a), still(4.4j, a)
    b = dyad(a, s, 3.3, 2.6, -1)
    n = s - 3.2 / 2.6 * (b - s)
    # the rods are below the end of the beam by w = √(2.6² - x²), x from the well to it
    x = (n - still(-3.1, n)).real
    w = np.sqrt(2.6**2 - x[0] ** 2)
    fall = -x[0] * x[1] / w
    u = n.imag - [w, fall, -(x[0] * x[2] + x[1] ** 2 + fall**2) / w]
    mass = 300 + counter
    power = needed(mass, 200 + 0.2 * counter, o, a, 1.3 * counter / mass / 0.9)
    power += bar(250, a, b) + needed(1500, 5000, s, b, 0) + 2200 * (u[2] + G) * u[1]
    return power + 14e3 * (1 + np.tanh(u[1] / 0.02)) / 2 * u[1], u


def test_the_counterweight_of_the_pump_saves_torque() -> None:
    sol = solved("pump_jack")
    power, u = pumping(sol.t, 2300)
    np.testing.assert_allclose(sol["rods.y"], u[0], rtol=0, atol=1e-9)
    same(sol["rods.ay"], u[2], 1e-8)
    same(sol["gearbox.power"], power, 1e-8)
    bare = with_parameters("pump_jack", counter=0.0)
    same(bare["gearbox.power"], pumping(bare.t, 0)[0], 1e-8)
    assert abs(bare["gearbox.effort"]).max() == pytest.approx(38.6e3, rel=2e-3)
    assert abs(sol["gearbox.effort"]).max() == pytest.approx(13.5e3, rel=2e-3)


def test_the_bicycle_pulls_its_chain_and_lifts_its_front() -> None:
    sol = solved("bicycle_chain")
    radius, sprocket, wheel = 46 * 12.7e-3 / 2 / np.pi, 16 * 12.7e-3 / 2 / np.pi, 0.34
    ratio = sprocket / radius / wheel  # rad of the crank for each metre
    same(sol["crank.omega"], -ratio * sol["frame.vx"], 1e-12)
    same(sol["rear.omega"] / sol["crank.omega"], np.full_like(sol.t, 46 / 16), 1e-12)
    torque = 120 * 0.17
    mass = 82 + 1 + 1.8 + 1.5 + (0.13 + 0.12) / wheel**2 + 0.008 * ratio**2
    drive = torque * ratio
    assert drive == pytest.approx(120 * 0.17 / 0.34 / 2.875)
    top = np.sqrt(drive / 0.25)
    v = top * np.tanh(np.arctanh(2 / top) + np.sqrt(drive * 0.25) / mass * sol.t)
    same(sol["frame.vx"], v, 1e-8)
    a = (drive - 0.25 * v**2) / mass
    same(abs(sol["chain.tangential"]), (torque - 0.008 * ratio * a) / radius, 1e-7)

    # moments about the contact of the rear wheel
    parts = [(82, 0.46, 1.09), (1, 0.43, 0.28), (1.8, 0, 0.34), (1.5, 1.02, 0.34)]
    moment = sum(m * (G * x - y * a) for m, x, y in parts)
    moment -= (0.25 / wheel + 0.008 * ratio) * a + 0.28 * 0.25 * v**2
    front = sol["road_front"].force(on="front")[:, 1]
    same(front, moment / 1.02, 1e-7)


def test_the_first_order_of_a_v_twin_cancels() -> None:
    sol = solved("two_cylinder_engine")
    r, length, speed = 0.045, 0.16, 100 * np.pi
    theta = np.pi / 2 + speed * sol.t
    force = np.zeros_like(theta, dtype=complex)
    for direction in (45 * DEG, 135 * DEG):
        beta = theta - direction
        x = np.sqrt(length**2 - (r * np.sin(beta)) ** 2)  # rod along the cylinder
        slope = -(r**2) * np.sin(beta) * np.cos(beta) / x
        bent = -((r**2) * np.cos(2 * beta) + slope**2) / x
        force += 0.8 * speed**2 * (r * np.cos(beta) - bent) * np.exp(1j * direction)
    force += (2 * 0.5 - (2 * 0.5 + 0.8)) * r * speed**2 * np.exp(1j * theta)
    found = sol["shaking_x"] + 1j * sol["shaking_y"]
    same(found, force)
    turn = found[:200]  # one turn of 0.02 s
    orders = abs(np.fft.fft(turn)) / 200
    single = 0.8 * r * speed**2
    assert max(orders[1], orders[-1]) < 1e-9 * single
    assert abs(turn.imag).max() < 0.03 * abs(turn.real).max()
    assert 2 * orders[2] == pytest.approx(np.sqrt(2) * single * r / length, rel=0.03)


def test_a_push_moves_the_lamp_at_constant_speed() -> None:
    sol = solved("balanced_lamp")
    np.testing.assert_allclose(sol["arm.angle"], -20 * DEG + 0.5 * sol.t, rtol=0, atol=1e-9)
    np.testing.assert_allclose(sol["head.angle"], 0, rtol=0, atol=1e-12)
    stiffness = 9.81 * 1.05 * 0.4 / (0.09 * 0.12)
    long = abs(0.12 * np.exp(1j * sol["arm.angle"]) - 0.09j)
    same(-sol["spring.force"], stiffness * long)


def test_the_balance_shows_the_difference_wherever_the_weights_lie() -> None:
    sol = solved("roberval_balance")
    inertia = 2 * 0.0045 + 0.6 * 0.03**2 + (0.2 + 0.2 + 0.52 + 0.5) * 0.15**2

    def rates(_: float, y: np.ndarray) -> list[float]:
        moment = G * (0.02 * 0.15 * np.cos(y[0]) - 0.6 * 0.03 * np.sin(y[0])) - 0.06 * y[1]
        return [y[1], moment / inertia]

    made = solve_ivp(rates, (0, 6), [0, 0], method="DOP853", t_eval=sol.t, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(sol["upper.angle"], made.y[0], rtol=0, atol=1e-8)
    middle = with_parameters("roberval_balance", place=0.0)
    np.testing.assert_allclose(sol["upper.angle"], middle["upper.angle"], rtol=0, atol=1e-10)
    # the beams carry the couple of the weight that lies outside; the pans do not turn
    more = (sol["C"].force(on="left_pan") - middle["C"].force(on="left_pan"))[:, 0]
    weight = 0.52 * (
        G - 0.15 * (np.cos(made.y[0]) * sol["upper.alpha"] - made.y[1] ** 2 * np.sin(made.y[0]))
    )
    same(more, -0.09 / 0.12 * weight, 1e-7)


def test_the_double_pendulum_follows_lagrange_and_forgets_its_start() -> None:
    sol = solved("double_pendulum")
    early = sol.t <= 4
    masses, length = np.array([0.3, 0.3]), 0.25
    reach = np.array([[length / 2, 0], [length, length / 2]])
    inertias = masses * length**2 / 12
    expected = chains.motion(masses, reach, inertias, np.array([100, 80]) * DEG, sol.t[early])
    np.testing.assert_allclose(sol["first.angle"][early], expected[0], rtol=0, atol=1e-6)
    np.testing.assert_allclose(sol["second.angle"][early], expected[1], rtol=0, atol=1e-6)

    case = kp.load(ROOT / "examples/double_pendulum.toml")
    near = {"first.angle": "100.000001*deg", "second.angle": "80*deg"}
    start = kp.assemble(case.model, set={**near, "first.omega": 0, "second.omega": 0})
    method = kp.DOP853(rtol=1e-11, atol=1e-13)
    other = kp.dynamics(case.model, start, t_end=10, output_step=0.01, method=method)
    apart = abs(other["second.angle"] - sol["second.angle"])
    assert apart[sol.t < 2].max() < 1e-5
    assert apart[sol.t > 8].max() > 0.1


def test_the_trebuchet_gives_most_of_its_energy_to_the_stone() -> None:
    sol = solved("trebuchet")
    start = sol.initial
    hung = start["counterweight.x"] + 1j * start["counterweight.y"]
    axle, arm = 5j, -132 * DEG
    hook = axle - 1.5 * np.exp(1j * arm)
    tip = axle + 6 * np.exp(1j * arm)
    stone = start["stone.x"] + 1j * start["stone.y"]
    angles = np.array([arm, np.angle(hung - hook), np.angle(stone - tip)])
    masses = np.array([220.0, 4000.0, 40.0])
    reach = np.array([[1.6, 0, 0], [-1.5, 1.6, 0], [6, 0, 5.5]])
    inertias = np.array([1030.0, 0, 0])
    expected = chains.motion(masses, reach, inertias, angles, sol.t)
    np.testing.assert_allclose(sol["arm.angle"], expected[0], rtol=0, atol=1e-6)
    thrown = axle + reach[2] @ np.exp(1j * expected[:3])
    place = sol["stone.x"] + 1j * sol["stone.y"]
    np.testing.assert_allclose(place, thrown, rtol=0, atol=1e-5)

    end = sol.final
    vx, vy = end["stone.vx"], end["stone.vy"]
    assert vx == pytest.approx(vy, rel=1e-6)
    lost = 4000 * G * (hung.imag - end["counterweight.y"])
    given = 40 * (vx**2 + vy**2) / 2 + 40 * G * (end["stone.y"] - stone.imag)
    assert given / lost == pytest.approx(0.90, abs=0.005)


def test_the_flywheel_of_the_slider_crank_gives_and_takes_energy() -> None:
    sol = solved("slider_crank")

    def slopes(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Slopes over the crank angle: of the slider, and of the rod's centre and angle."""
        tilt = np.arcsin(0.1 * np.sin(theta) / 0.3)
        turn = 0.1 * np.cos(theta) / (0.3 * np.cos(tilt))
        slider = -0.1 * np.sin(theta) - 0.3 * np.sin(tilt) * turn
        return slider, slider / 2 - 0.05 * np.sin(theta) + 0.05j * np.cos(theta), turn

    def inertia(theta: np.ndarray) -> np.ndarray:
        slider, center, turn = slopes(theta)
        return 0.05 + 0.8 * abs(center) ** 2 + 0.8 * 0.3**2 / 12 * turn**2 + 1.5 * slider**2

    theta, start = sol["crank.angle"], np.radians(60)
    # the energy is that of the start; the centre of the rod is at half the height of the pin
    fall = 0.8 * G * 0.05 * (np.sin(start) - np.sin(theta))
    omega = np.sqrt((inertia(start) * 30**2 + 2 * fall) / inertia(theta))
    same(sol["crank.omega"], omega, 1e-6)
    assert omega.min() == pytest.approx(29.6, abs=0.05)
    assert omega.max() == pytest.approx(35.6, abs=0.05)


def test_the_barrier_falls_against_its_spring_and_the_drag_of_its_brake() -> None:
    sol = solved("barrier")
    inertia, drag = 12 * 3**2 / 3, 0.3 * 50 * 0.08
    angle, omega = sol["boom.angle"], sol["boom.omega"]
    held = sol.t < 0.5  # static friction of 3000 N carries what the spring leaves
    left = 12 * G * 1.5 * np.cos(80 * DEG) - 95 * 10 * DEG
    assert 0 < left < 0.4 * 3000 * 0.08
    np.testing.assert_allclose(angle[held], 80 * DEG, rtol=0, atol=1e-12)

    falls = (sol.t >= 0.6 - 1e-9) & (sol.t <= 1.5 + 1e-9)
    made = solve_ivp(
        lambda _, y: [
            y[1],
            (drag - 12 * G * 1.5 * np.cos(y[0]) + 95 * (np.pi / 2 - y[0])) / inertia,
        ],
        (0.6, 1.5),
        [angle[falls][0], omega[falls][0]],
        method="DOP853",
        t_eval=np.clip(sol.t[falls], 0.6, 1.5),
        rtol=1e-11,
        atol=1e-13,
    )
    np.testing.assert_allclose(angle[falls], made.y[0], rtol=0, atol=1e-7)
    stuck = (sol.t > 2) & (sol.t < 3)  # the brake has stopped the boom on its way
    np.testing.assert_allclose(omega[stuck], 0, rtol=0, atol=1e-12)
