"""Contacts against closed forms, scalar equations and conservation laws."""

from __future__ import annotations

from typing import Any

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import gamma

G = 9.81
TIGHT = kp.DOP853(rtol=1e-11, atol=1e-13)


def ball(gravity: float = 0.0, *, radius: float = 0.05, **contact: Any) -> kp.Model:
    """A disc of 2 kg above a floor."""
    m = kp.Model("ball", gravity=(0, -gravity))
    m.ground.curves(floor={"line": ((3, 0), (-3, 0))})  # its right side is above
    m.body("ball", mass=2, inertia=0.5 * 2 * radius**2, points={"C": (0, 0)})
    m.contact("touch", "ball.C", "ground.floor", radius=radius, **contact)
    return m


def test_hertz_depth_and_duration() -> None:
    """m δ'' = -k δ^1.5: depth (5 m v²/(4 k))^(2/5), duration 2 depth/v ∫ dx/√(1 - x^2.5)."""
    k, v, mass = 1e7, 1.3, 2.0
    m = ball(stiffness=k)
    start = kp.assemble(m, set={"ball.x": 0, "ball.y": 0.06, "ball.angle": 0, "ball.vy": -v})
    sol = kp.dynamics(m, start, t_end=0.05, method=TIGHT, events={"deep": "touch.gap_rate"})
    depth = (5 * mass * v**2 / (4 * k)) ** 0.4
    duration = 2 * depth / v * 0.4 * gamma(0.4) * gamma(0.5) / gamma(0.9)
    hit, release = sol.events["touch.hit"], sol.events["touch.release"]
    assert len(hit.t) == len(release.t) == 1
    assert hit.t[0] == pytest.approx(0.01 / v, rel=1e-11)
    assert release.t[0] - hit.t[0] == pytest.approx(duration, rel=1e-6)
    (deepest,) = sol.events["deep"].states
    assert -deepest["touch.gap"] == pytest.approx(depth, rel=1e-6)
    assert deepest["touch.force"] == pytest.approx(k * depth**1.5, rel=1e-6)
    assert sol["ball.vy"][-1] == pytest.approx(v, rel=1e-8)
    assert np.abs(sol["energy.balance"]).max() < 1e-8


@pytest.mark.parametrize(("exponent", "damping"), [(1.5, 0.4), (1.0, 0.9), (2.0, 3.0)])
def test_damped_contact_agrees_with_its_scalar_equation(exponent: float, damping: float) -> None:
    """m δ'' = -k δⁿ (1 + c δ'), until the force is zero."""
    k, v, mass = 2e5, 2.0, 2.0

    def force(depth: float, rate: float) -> float:
        return float(k * depth**exponent * max(0.0, 1 + damping * rate) if depth > 0 else 0.0)

    def released(_: float, y: np.ndarray) -> float:
        return float(y[0])

    released.terminal, released.direction = True, -1  # type: ignore[attr-defined]
    found = solve_ivp(
        lambda _, y: [y[1], -force(y[0], y[1]) / mass],
        (0, 1),
        [1e-300, v],
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
        events=released,
    )
    m = ball(stiffness=k, exponent=exponent, damping=damping)
    start = kp.assemble(m, set={"ball.x": 0, "ball.y": 0.05, "ball.angle": 0, "ball.vy": -v})
    sol = kp.dynamics(m, start, t_end=0.1, method=TIGHT)
    out = float(-found.y[1, -1])
    assert out < 0.95 * v
    assert sol["ball.vy"][-1] == pytest.approx(out, rel=2e-7)
    lost = 0.5 * mass * (v**2 - out**2)
    assert sol["energy.dissipated"][-1] == pytest.approx(lost, rel=1e-6)


def test_friction_brakes_a_sliding_disc_and_turns_it() -> None:
    """Normal force m g from the start; friction μ m g against the motion, with its torque."""
    k, mu, mass, r = 1e5, 0.3, 2.0, 0.05
    m = ball(G, stiffness=k, exponent=1, friction=mu, velocity=1e-3)
    at_rest = r - mass * G / k
    depth = r - at_rest
    start = kp.assemble(m, set={"ball.x": 0, "ball.y": at_rest, "ball.angle": 0, "ball.vx": 1})
    sol = kp.dynamics(m, start, t_end=0.05, method=TIGHT)
    arm = r - depth
    np.testing.assert_allclose(sol["touch.force"], mass * G, rtol=1e-9)
    np.testing.assert_allclose(sol["ball.ax"], -mu * G, rtol=1e-9)
    # backward friction at the bottom turns the disc clockwise
    inertia = 0.5 * mass * r**2
    np.testing.assert_allclose(sol["ball.alpha"], -mu * mass * G * arm / inertia, rtol=1e-9)
    # growing u of the floor is -x: on the floor, friction acts towards +x
    np.testing.assert_allclose(sol["touch.tangential"], -mu * mass * G, rtol=1e-9)
    assert np.abs(sol["energy.balance"]).max() < 1e-9


SHAPES: dict[str, Any] = {
    "circle": {"circle": (0.1, 0, 0.3)},
    "spline": {
        "points": [
            (0.1 + 0.3 * np.cos(u), 0.3 * np.sin(u))
            for u in np.linspace(0, 2 * np.pi, 48, endpoint=False)
        ],
        "periodic": True,
    },
    "formula": {"polar": "0.3 + 0.05*cos(2*u)"},
}


@pytest.mark.parametrize("shape", SHAPES)
def test_free_bodies_keep_momentum_and_angular_momentum(shape: str) -> None:
    """A disc hits a turning cam; nothing else acts."""
    m = kp.Model("free")
    m.body("cam", mass=3, inertia=0.2, curves={"rim": SHAPES[shape]})
    m.body("disc", mass=1, inertia=0.01, points={"C": (0, 0)})
    law: dict[str, Any] = {"stiffness": 1e6, "damping": 0.1, "friction": 0.4, "velocity": 0.01}
    m.contact("touch", "disc.C", "cam.rim", radius=0.1, **law)
    cam = {"cam.x": 0, "cam.y": 0, "cam.angle": 0.4, "cam.omega": 3, "cam.vx": 0.2}
    disc = {"disc.x": 0.7, "disc.y": 0.1, "disc.angle": 0, "disc.vx": -2, "disc.omega": -5}
    start = kp.assemble(m, set=cam | disc)
    sol = kp.dynamics(m, start, t_end=0.3, output_step=1e-3, method=TIGHT)
    assert len(sol.events["touch.release"].t) >= 1
    masses = {"cam": (3, 0.2), "disc": (1, 0.01)}
    momentum = np.zeros((3, len(sol.t)))
    for name, (mass, inertia) in masses.items():
        b = sol[name]
        momentum[0] += mass * b.vx
        momentum[1] += mass * b.vy
        momentum[2] += mass * (b.x * b.vy - b.y * b.vx) + inertia * b.omega
    spread = np.ptp(momentum, axis=1)
    assert spread.max() < 1e-10 * np.abs(momentum).max()
    assert np.abs(sol["energy.balance"]).max() < 1e-7
    assert sol["energy.dissipated"][-1] > 0.1


def test_the_gap_of_a_spline_is_that_of_its_circle() -> None:
    """On both sides, on a body that is turned and moved."""
    gaps = {}
    for shape in ("circle", "spline"):
        m = kp.Model("gap")
        m.body("cam", mass=1, inertia=1, curves={"rim": SHAPES[shape]})
        m.body("probe", mass=1, inertia=1, points={"C": (0.02, 0.01)})
        m.contact("out", "probe.C", "cam.rim", radius=0.05, stiffness=1)
        m.contact("in_", "probe.C", "cam.rim", radius=0.05, side="left", stiffness=1)
        found = []
        for x, y in [(0.9, 0.2), (0.35, -0.3), (-0.4, 1.2), (5, 5), (0.1, 0.25)]:
            cam = {"cam.x": 0.3, "cam.y": -0.2, "cam.angle": 0.7, "cam.omega": 2}
            probe = {"probe.x": x, "probe.y": y, "probe.angle": 0.1, "probe.vx": 0.4}
            state = kp.assemble(m, set=cam | probe)
            names = ("out.gap", "out.gap_rate", "in_.gap", "in_.gap_rate")
            found.append([state[name] for name in names])
        gaps[shape] = np.array(found)
    np.testing.assert_allclose(gaps["spline"], gaps["circle"], atol=3e-8)
    np.testing.assert_allclose(gaps["circle"][:, 0], -gaps["circle"][:, 2] - 0.1, atol=1e-15)


def test_a_disc_in_a_ring_is_a_pendulum() -> None:
    """Contact with the inside of a circle: at rest on it, a point mass swings on an arm R - r."""
    radius, ring, angle = 0.1, 0.5, 1.0
    arm = ring - radius
    m = kp.Model("ring", gravity=(0, -G))
    m.ground.curves(ring={"circle": (0, 0, ring)})
    m.point_mass("ball", mass=1)
    m.contact("touch", "ball.P", "ground.ring", radius=radius, side="left", restitution=0)
    place = {"ball.x": arm * np.sin(angle), "ball.y": -arm * np.cos(angle)}
    start = kp.assemble(m, set=place)
    sol = kp.dynamics(m, start, t_end=2, output_step=0.01, method=TIGHT)
    swing = solve_ivp(
        lambda _, y: [y[1], -G / arm * np.sin(y[0])],
        (0, 2),
        [angle, 0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
        t_eval=sol.t,
    )
    np.testing.assert_allclose(np.arctan2(sol["ball.x"], -sol["ball.y"]), swing.y[0], atol=1e-8)
    force = G * np.cos(swing.y[0]) + arm * swing.y[1] ** 2
    np.testing.assert_allclose(sol["touch.force"], force, rtol=1e-7)


def test_a_disc_rolls_off_the_end_of_a_table() -> None:
    """Beyond the end of a line the disc meets the corner: it turns about it, then falls."""
    m = kp.Model("table", gravity=(0, -G))
    m.ground.curves(table={"line": ((0, 0), (-1, 0))})
    m.point_mass("ball", mass=1)
    m.contact("touch", "ball.P", "ground.table", radius=0.1, restitution=0)
    # a slow ball follows the circle around the corner; it leaves where m v²/r = m g cos a
    v = 0.2
    start = kp.assemble(m, set={"ball.x": -0.1, "ball.y": 0.1, "ball.vx": v})
    sol = kp.dynamics(m, start, t_end=1, method=TIGHT)
    release = sol.events["touch.release"]
    assert len(release.t) == 1
    leaves = release.states[0]
    angle = np.arctan2(leaves["ball.x"], leaves["ball.y"])
    # v² + 2 g r (1 - cos a) = g r cos a
    assert np.cos(angle) == pytest.approx((v**2 / (G * 0.1) + 2) / 3, rel=1e-7)


def eccentric(spin_up: float) -> kp.Model:
    """A follower that rests on an eccentric disc whose speed grows evenly."""
    m = kp.Model("cam", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body(
        "cam",
        mass=1,
        inertia=0.01,
        points={"O": (0, 0)},
        curves={"rim": {"circle": (0.02, 0, 0.05)}},
    )
    m.revolute("O", "ground.O", "cam.O")
    m.body("follower", mass=0.5, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "follower.P", axes=("90*deg", "90*deg"))
    m.contact("touch", "follower.P", "cam.rim", radius=0.01, restitution=0)
    m.coordinate_driver("motor", "cam.angle", value=f"0.5*{spin_up}*t^2")
    return m


def test_a_follower_leaves_an_eccentric_cam_where_its_acceleration_is_that_of_gravity() -> None:
    """y = e sin θ + √(L² - e² cos² θ): it leaves where y'' = -g."""
    spin_up, e, length = 4.0, 0.02, 0.06

    def acceleration(t: float) -> float:
        theta, omega = 0.5 * spin_up * t**2, spin_up * t
        s, c = np.sin(theta), np.cos(theta)
        root = np.sqrt(length**2 - (e * c) ** 2)
        first = e * c + e**2 * s * c / root
        second = -e * s + e**2 * (c**2 - s**2) / root - (e**2 * s * c) ** 2 / root**3
        return float(second * omega**2 + first * spin_up)

    times = np.linspace(0, 8, 80001)
    below = np.array([acceleration(t) for t in times]) < -G
    first = int(below.argmax())
    leaves = brentq(lambda t: acceleration(t) + G, times[first - 1], times[first], xtol=1e-14)
    m = eccentric(spin_up)
    start = kp.assemble(m, set={"follower.y": np.sqrt(length**2 - e**2)})
    sol = kp.dynamics(m, start, t_end=leaves + 0.02, method=kp.DOP853(rtol=1e-11, atol=1e-14))
    release = sol.events["touch.release"]
    assert release.t[0] == pytest.approx(leaves, rel=1e-6)
    assert release.states[0]["cam.omega"] == pytest.approx(spin_up * leaves, rel=1e-6)
    assert sol["touch.gap"][-1] > 1e-7
