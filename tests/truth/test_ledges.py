"""A point that slides past the end of a line falls freely from there."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

EXACT = kp.DOP853(rtol=1e-11, atol=1e-13)
#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e3, 0.01)]


def ledge(scale: tuple[float, float, float], tilt: float, **fields: Any) -> kp.Model:
    """A point on a line from (-2, 0) to (0.5, 0) sizes, turned about the origin."""
    mass, size, rate = scale
    m = kp.Model("ledge", gravity=(0, -size * rate**2))
    u = size * np.array([np.cos(tilt), np.sin(tilt)])
    m.ground.curves(floor={"line": [(-2 * u).tolist(), (0.5 * u).tolist()]})
    m.body("b", mass=mass, inertia=0.1 * mass * size**2, points={"C": (0, 0)})
    m.contact("c", "b.C", "ground.floor", side="left", **fields)
    return m


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("friction", [None, 0.1])
@pytest.mark.parametrize("restitution", [0.0, 0.7])
@pytest.mark.parametrize(("tilt", "speed"), [(0.0, 1.0), (0.0, -2.5), (-0.2, 0.8), (0.15, 0.9)])
def test_a_point_leaves_a_ledge_with_its_speed(
    scale: tuple[float, float, float],
    friction: float | None,
    restitution: float,
    tilt: float,
    speed: float,
) -> None:
    _, size, rate = scale
    fields = {} if friction is None else {"friction": friction}
    m = ledge(scale, tilt, restitution=restitution, **fields)
    u = np.array([np.cos(tilt), np.sin(tilt)])
    v = speed * size * rate * u
    start = {"b.x": 0, "b.y": 0, "b.angle": 0, "b.vx": v[0], "b.vy": v[1], "b.omega": 0.3 * rate}
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=3 / rate, method=EXACT)
    # along the line, in units of the size and the rate
    sense, way = np.sign(speed), 0.5 if speed > 0 else 2.0
    pull = -sense * np.sin(tilt) - (friction or 0) * np.cos(tilt)
    left = np.sqrt(speed**2 + 2 * pull * way)
    time = (left - abs(speed)) / pull if pull else way / abs(speed)
    assert_allclose(sol.events["c.release"].t[:1] * rate, [time], rtol=1e-9)
    rest = 3 - time
    end = sense * (way + left * rest) * u - [0, 0.5 * rest**2]
    assert_allclose(np.array([sol["b.x"][-1], sol["b.y"][-1]]) / size, end, rtol=1e-8, atol=1e-9)
    assert_allclose(sol["b.omega"][-1], 0.3 * rate, rtol=1e-12)
    assert not sol.events["c.hit"].t.size


@pytest.mark.parametrize("scale", SCALES)
def test_a_board_turns_about_the_foot_that_is_still_on_the_ledge(
    scale: tuple[float, float, float],
) -> None:
    mass, size, rate = scale
    m = kp.Model("board", gravity=(0, -size * rate**2))
    m.ground.curves(floor={"line": [[-3 * size, 0], [0.5 * size, 0]]})
    inertia, back = 0.2, 0.8
    feet = {"R": (-back * size, 0), "F": (0.4 * size, 0)}
    m.body("d", mass=mass, inertia=inertia * mass * size**2, points=feet)
    for name in feet:
        m.contact(name, f"d.{name}", "ground.floor", side="left", restitution=0)
    speed = 1.2
    start = {"d.x": -0.5 * size, "d.y": 0, "d.angle": 0}
    start |= {"d.vx": speed * size * rate, "d.vy": 0, "d.omega": 0}
    time, end = 0.6 / speed, 1.2
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=end / rate, method=EXACT)
    assert_allclose(sol.events["F.release"].t * rate, [time], rtol=1e-9)
    assert not sol.events["R.release"].t.size

    def rates(_: float, y: np.ndarray) -> list[float]:
        angle, omega = y
        c, s = np.cos(angle), np.sin(angle)
        turning = -back * c * (1 - back * omega**2 * s) / (inertia + back**2 * c**2)
        return [omega, turning]

    own = solve_ivp(rates, (time, end), [0, 0], rtol=1e-11, atol=1e-13).y[:, -1]
    assert_allclose(sol["d.angle"][-1], own[0], rtol=1e-8)
    assert_allclose(sol["d.omega"][-1] / rate, own[1], rtol=1e-8)
    assert_allclose(sol["d.y"][-1] / size, back * np.sin(own[0]), rtol=1e-8)
    assert_allclose(sol["d.vx"] / (size * rate), speed, rtol=1e-9)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("radius", [1e-8, 1e-4, 0.05])
@pytest.mark.parametrize("friction", [None, 0.1])
def test_a_fast_small_circle_does_not_turn_about_the_ledge(
    scale: tuple[float, float, float], radius: float, friction: float | None
) -> None:
    mass, size, rate = scale
    m = kp.Model("ledge", gravity=(0, -size * rate**2))
    m.ground.curves(floor={"line": [[-2 * size, 0], [0.5 * size, 0]]})
    m.body("b", mass=mass, inertia=0.1 * mass * size**2, points={"C": (0, 0)})
    fields = {} if friction is None else {"friction": friction}
    m.contact(
        "c", "b.C", "ground.floor", side="left", restitution=0, radius=radius * size, **fields
    )
    start = {"b.x": 0, "b.y": radius * size, "b.angle": 0}
    start |= {"b.vx": 2 * size * rate, "b.vy": 0, "b.omega": 0}
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=1 / rate, method=EXACT)
    left = np.sqrt(4 - (friction or 0))
    time = 0.25 if friction is None else (2 - left) / friction
    assert_allclose(sol.events["c.release"].t * rate, [time], rtol=1e-9)
    end = [0.5 + left * (1 - time), radius - 0.5 * (1 - time) ** 2]
    assert_allclose([sol["b.x"][-1] / size, sol["b.y"][-1] / size], end, rtol=1e-8)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_rolling_wheel_begins_to_slip_where_it_presses_into_the_ledge(
    scale: tuple[float, float, float], sense: float
) -> None:
    """It rolls on its surface, but about the end of the line on its pressed radius."""
    mass, size, rate = scale
    radius, stiffness, damping, friction, inertia = 0.05, 4e3, 0.1, 0.2, 0.02
    m = kp.Model("ledge", gravity=(0, -size * rate**2))
    m.ground.curves(floor={"line": [[0.5 * size, 0], [-0.5 * size, 0]]})
    m.body("b", mass=mass, inertia=inertia * mass * size**2, points={"C": (0, 0)})
    law = {"stiffness": stiffness * mass * rate**2, "exponent": 1, "friction": friction}
    law["damping"] = damping / (size * rate)
    m.contact("c", "b.C", "ground.floor", radius=radius * size, **law)
    height = radius - 1 / stiffness
    start = {"b.x": 0.3 * sense * size, "b.y": height * size, "b.angle": 0}
    start |= {"b.vx": sense * size * rate, "b.vy": 0, "b.omega": -sense / radius * rate}
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=0.5 / rate, method=EXACT)

    def forces(y: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
        arm = np.array([y[0] - 0.5, y[1]])
        d = np.hypot(*arm)
        normal = arm / d
        along = np.array([normal[1], -normal[0]])
        press = max(0.0, stiffness * (radius - d) * (1 - damping * normal @ y[3:5]))
        slides = along @ y[3:5] + y[5] * d
        return (
            -friction * press * np.sign(slides) * d,
            press * normal,
            along * -friction * press * (np.sign(slides)),
        )

    def rates(_: float, y: np.ndarray) -> list[float]:
        torque, push, rub = forces(y)
        a = push + rub - [0, 1]
        return [*y[3:], *a, torque / inertia]

    begin = [0.5, height, 0.0, 1.0, 0.0, -1 / radius]
    own = solve_ivp(rates, (0.2, 0.5), begin, rtol=1e-10, atol=1e-12, max_step=1e-3).y[:, -1]
    assert_allclose(sol.events["c.slip"].t * rate, [0.2], rtol=1e-9)
    assert_allclose(sense * sol["b.x"][-1] / size, own[0], rtol=1e-6)
    assert_allclose(sol["b.y"][-1] / size, own[1], rtol=1e-6)
    assert_allclose(sense * sol["b.vx"][-1] / (size * rate), own[3], rtol=1e-6)
    assert_allclose(sense * sol["b.omega"][-1] / rate, own[5], rtol=1e-6)
