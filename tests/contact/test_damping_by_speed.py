"""Damping from a restitution and the speed of each impact."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

LAWS = ["lankarani_nikravesh", "flores"]
#: Masses in kg, sizes in m and speeds in m/s.
SCALES = [(2.0, 1.0, 1.0), (1e-3, 1e-3, 0.02), (1e3, 1e3, 30.0)]


def beta(law: str, e: float) -> float:
    """The damping times the speed of the impact."""
    return 0.75 * (1 - e**2) if law == "lankarani_nikravesh" else 8 * (1 - e) / (5 * e)


def rebound(law: str, e: float) -> float:
    """The speed after an impact over that before it: both have the same elastic work."""
    b = beta(law, e)

    def work(u: float) -> float:
        return float(u / b - np.log1p(b * u) / b**2)

    return float(-brentq(lambda u: work(u) - work(1), -min(1, 1 / b) * (1 - 1e-15), -1e-12))


def channel(
    scale: tuple[float, float, float], exponent: float, gravity: float = 0, **law: Any
) -> kp.Model:
    """A ball between two walls."""
    mass, size, speed = scale
    m = kp.Model("channel", gravity=(0, -gravity))
    m.ground.curves(
        floor={"line": ((size, 0), (-size, 0))}, roof={"line": ((-size, size), (size, size))}
    )
    m.body("ball", mass=mass, inertia=mass * size**2, points={"C": (0, 0)})
    k = mass * (speed / (0.01 * size)) ** 2 / (0.01 * size) ** (exponent - 1)
    for name in ("floor", "roof"):
        m.contact(name, "ball.C", f"ground.{name}", stiffness=k, exponent=exponent, **law)
    return m


def at(size: float, speed: float, y: float) -> dict[str, float]:
    still = {"ball.x": 0.0, "ball.angle": 0.0, "ball.vx": 0.0, "ball.omega": 0.0}
    return {**still, "ball.y": y * size, "ball.vy": speed}


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("e", [0.2, 0.9])
def test_each_impact_has_its_own_speed(
    scale: tuple[float, float, float], law: str, e: float
) -> None:
    _, size, speed = scale
    m = channel(scale, 1.0, law=law, restitution=e)
    start = kp.assemble(m, at(size, -speed, 0.5))
    r = rebound(law, e)
    until = size / speed * (0.5 + 1.3 / r + 0.3)
    for method, tight in [(kp.Auto(), 1e-8), (kp.Radau(rtol=1e-9, atol=1e-13), 1e-6)]:
        sol = kp.dynamics(m, start, t_end=until, method=method)
        assert_allclose(sol["ball.vy"][-1], -(r**2) * speed, rtol=tight)
        assert_allclose(sol["floor.impact_speed"][-1], speed, rtol=tight)
        assert_allclose(sol["roof.impact_speed"][-1], r * speed, rtol=tight)
        hits = [len(sol.events[f"{name}.hit"].t) for name in ("floor", "roof")]
        assert hits == [1, 1]


def test_balls_that_touch_two_walls_at_once() -> None:
    """A contact that begins ends the phase, and one that is closed keeps its speed."""
    m = kp.Model("corner", gravity=(0, 0))
    m.ground.curves(floor={"line": ((1, 0), (-1, 0))}, wall={"line": ((0, -1), (0, 1))})
    m.body("ball", mass=2, inertia=1, points={"C": (0, 0)})
    for name in ("floor", "wall"):
        field = {"stiffness": 2e4, "exponent": 1, "law": "flores", "restitution": 0.5}
        m.contact(name, "ball.C", f"ground.{name}", **field)
    set_ = {"ball.x": 0.51, "ball.y": 0.5, "ball.angle": 0, "ball.omega": 0}
    start = kp.assemble(m, {**set_, "ball.vx": -1, "ball.vy": -1})
    sol = kp.dynamics(m, start, t_end=0.7)
    first, second = (sol.events[f"{name}.hit"].t for name in ("floor", "wall"))
    assert_allclose([*first, *second], [0.5, 0.51], rtol=1e-9)
    assert sol.events["floor.release"].t[0] > 0.51
    r = rebound("flores", 0.5)
    assert_allclose([sol["ball.vx"][-1], sol["ball.vy"][-1]], [r, r], rtol=1e-7)


@pytest.mark.parametrize("law", LAWS)
def test_pin_in_a_bush(law: str) -> None:
    """The motion of a pin that bounces in its bush, against an integration in polar coordinates."""
    mass, radius, clearance, k, e = 0.5, 0.02, 0.002, 4e7, 0.6
    m = kp.Model("shaft", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("pin", mass=mass, inertia=1e-4, points={"C": (0, 0)})
    fields = {"stiffness": k, "exponent": 1.5, "law": law, "restitution": e}
    m.clearance("B", "ground.O", "pin.C", radius=radius, clearance=clearance, **fields)
    set_ = {"pin.x": 0, "pin.y": 0, "pin.angle": 0, "pin.vx": 0.05, "pin.vy": 0, "pin.omega": 0}
    method = kp.DOP853(rtol=1e-11, atol=1e-15)
    sol = kp.dynamics(m, kp.assemble(m, set_), t_end=0.1, method=method)

    speed = 0.0

    def rates(_: float, y: np.ndarray) -> list[float]:
        r = np.hypot(y[0], y[1])
        out = y[:2] / max(r, 1e-12)
        depth, rate = r - clearance, out @ y[2:]
        damping = beta(law, e) / speed if speed else 0
        force = max(0.0, k * max(depth, 0) ** 1.5 * (1 + damping * rate))
        a = -force * out / mass
        return [y[2], y[3], a[0], a[1] - 9.81]

    def touches(_: float, y: np.ndarray) -> float:
        return float(np.hypot(y[0], y[1]) - clearance)

    touches.terminal = True  # type: ignore[attr-defined]
    t, y, hits = 0.0, np.array([0, 0, 0.05, 0]), []
    for direction in [1, -1] * 50:
        touches.direction = direction  # type: ignore[attr-defined]
        part = solve_ivp(
            rates, (t, 0.1), y, events=touches, rtol=1e-11, atol=1e-15, method="DOP853"
        )
        t, y = part.t[-1], part.y[:, -1]
        if part.status == 0:
            break
        if direction == 1:
            speed = float(y[:2] @ y[2:] / np.hypot(y[0], y[1]))
            hits.append(t)
    assert len(hits) >= 3
    assert_allclose(sol.events["B.hit"].t, hits, rtol=1e-6)
    assert_allclose(sol["B.impact_speed"][-1], speed, rtol=1e-4)
    assert_allclose([sol["pin.x"][-1], sol["pin.y"][-1]], y[:2], atol=1e-6 * clearance)


def test_contact_that_is_closed_at_the_start() -> None:
    m = channel(SCALES[0], 1.0, law="flores", restitution=0.5)
    depth, speed = 0.005, -0.6
    k = 2 * 1e4
    start = kp.assemble(m, at(1, speed, -depth))
    sol = kp.dynamics(m, start, t_end=1e-9)
    assert_allclose(sol["floor.impact_speed"][0], 0.6)
    assert_allclose(sol["floor.force"][0], k * depth * (1 + beta("flores", 0.5)))
    # one that opens has no damping, and one whose speed is set keeps it
    sol = kp.dynamics(m, kp.assemble(m, at(1, 0.6, -depth)), t_end=1e-9)
    assert_allclose(sol["floor.force"][0], k * depth)
    start = kp.assemble(m, {**at(1, speed, -depth), "floor.impact_speed": 2})
    sol = kp.dynamics(m, start, t_end=1e-9)
    assert_allclose(sol["floor.force"][0], k * depth * (1 + 0.3 * beta("flores", 0.5)))


def test_a_negative_speed_of_an_impact_is_refused() -> None:
    m = channel(SCALES[0], 1.0, law="flores", restitution=0.5)
    start = kp.assemble(m, {**at(1, -0.6, 0.5), "floor.impact_speed": -2})
    with pytest.raises(kp.KempeError, match=r"impact_speed of floor is -2 m/s.*not negative"):
        kp.dynamics(m, start, t_end=1)


def test_rest_and_what_is_refused() -> None:
    m = channel(SCALES[0], 1.0, 9.81, law="flores", restitution=0.5)
    rest = kp.equilibrium(m, kp.assemble(m, at(1, 0, 0.01)))
    assert_allclose(rest.state["ball.y"], -9.81 / 1e4, rtol=1e-9)
    case = kp.Case(
        m, kp.Start(set=at(1, -1, 0.5)), analyses={"run": {"type": "dynamics", "t_end": 1}}
    )
    found = kp.gradient(case, ["ball.y.final"], ["ball.vy"])
    assert np.isnan(found.jacobian).all()
    assert "speed with which each contact begins" in str(found.remarks)
    for given, words in [
        ({"law": "flores"}, "restitution: missing"),
        ({"law": "flores", "restitution": 0}, "restitution: must be above 0"),
        ({"law": "lankarani_nikravesh", "restitution": 1.5}, "restitution: must be from 0 to 1"),
        ({"law": "flores", "restitution": 0.5, "damping": 1}, "damping: follows from restitution"),
        ({"law": "flores", "restitution": 0.5, "young": 1e9}, "young: belongs to law"),
        ({"law": "flores", "restitution": 0.5, "friction": 0.1}, "friction: friction that sticks"),
    ]:
        with pytest.raises(kp.ModelError, match=words):
            kp.assemble(channel(SCALES[0], 1.0, **given))
