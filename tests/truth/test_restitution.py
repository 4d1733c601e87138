"""Stops and contacts with restitution against closed forms."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from scipy.special import ellipk

G = 9.81
TIGHT = kp.DOP853(rtol=1e-12, atol=1e-14)


def test_a_pendulum_that_bounces_on_a_stop() -> None:
    """From the lowest place with ω, it is back after 2 K(k)/ω₀ with k = ω/(2 ω₀)."""
    e, length, count = 0.93, 0.8, 30
    m = kp.Model("pendulum", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=length, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    m.stop("wall", "rod.angle", lower="-90 deg", restitution=e)
    natural = np.sqrt(1.5 * G / length)
    omega, t, times, rates = 1.6 * natural, 0.0, [], []
    for _ in range(count):
        t += 2 * ellipk((omega / (2 * natural)) ** 2) / natural
        times.append(t)
        rates.append(-omega)
        omega *= e
    start = kp.assemble(m, set={"rod.angle": "-90 deg", "rod.omega": 1.6 * natural})
    sol = kp.dynamics(m, start, t_end=t + 0.01, method=TIGHT)
    hit = sol.events["wall.hit"]
    assert len(hit.t) == count
    np.testing.assert_allclose(hit.t, times, rtol=1e-8)
    np.testing.assert_allclose([state["rod.omega"] for state in hit.states], rates, rtol=1e-8)


@pytest.mark.parametrize("reverse", [False, True])
def test_five_equal_balls_in_touch(reverse: bool) -> None:
    """e = 1: the last ball leaves with the speed of the first, the others rest."""
    m = kp.Model("balls")
    r, speed = 0.05, 1.3
    for k in range(5):
        m.body(
            f"b{k}", mass=1, inertia=1, points={"C": (0, 0)}, curves={"rim": {"circle": (0, 0, r)}}
        )
    for k in range(4):
        i, j = (k, k + 1) if reverse else (k + 1, k)
        m.contact(f"c{k}", f"b{i}.C", f"b{j}.rim", radius=r, restitution=1)
    places = {f"b{k}.x": 2 * r * k - (0.03 if k == 0 else 0.0) for k in range(5)}
    others = {f"b{k}.{name}": 0 for k in range(5) for name in ("y", "angle")}
    start = kp.assemble(m, set=places | others | {"b0.vx": speed})
    sol = kp.dynamics(m, start, t_end=0.1, method=TIGHT)
    found = [sol[f"b{k}.vx"][-1] for k in range(5)]
    np.testing.assert_allclose(found, [0, 0, 0, 0, speed], atol=1e-12)


def test_a_ball_bounces_to_rest() -> None:
    """Height h, restitution e: at rest after √(2 h/g) (1 + e)/(1 - e)."""
    h, e, r = 0.5, 0.6, 0.05
    m = kp.Model("ball", gravity=(0, -G))
    m.ground.curves(floor={"line": ((1, 0), (-1, 0))})
    m.point_mass("ball", mass=3)
    m.contact("touch", "ball.P", "ground.floor", radius=r, restitution=e)
    start = kp.assemble(m, set={"ball.x": 0, "ball.y": h + r, "ball.vx": 0.1})
    total = np.sqrt(2 * h / G) * (1 + e) / (1 - e)
    sol = kp.dynamics(m, start, t_end=total + 0.2, output_step=0.01, method=TIGHT)
    hit = sol.events["touch.hit"].t
    bounces = np.sqrt(2 * h / G) * (1 + 2 * e * (1 - e ** np.arange(len(hit))) / (1 - e))
    np.testing.assert_allclose(hit, bounces, rtol=0, atol=1e-9)
    assert hit[-1] == pytest.approx(total, abs=1e-6)
    assert sol["ball.vy"][-1] == pytest.approx(0, abs=1e-12)
    assert sol["touch.gap"][-1] == pytest.approx(0, abs=1e-12)
    assert sol["touch.force"][-1] == pytest.approx(3 * G, rel=1e-10)
    assert sol["ball.x"][-1] == pytest.approx(0.1 * sol.t[-1], rel=1e-9)


def test_bodies_that_turn_keep_momentum_in_an_impact() -> None:
    """Bodies that move: momentum along the line of impact, and Newton's law of restitution."""
    m = kp.Model("two")
    e = 0.4
    m.body(
        "a",
        mass=3,
        inertia=0.2,
        points={"C": (0, 0)},
        curves={"rim": {"polar": "0.3 + 0.02*cos(3*u)"}},
    )
    m.body("b", mass=1, inertia=0.01, points={"C": (0.02, -0.01)})
    m.contact("touch", "b.C", "a.rim", radius=0.1, restitution=e)
    a = {"a.x": 0, "a.y": 0, "a.angle": 0.2, "a.omega": 2, "a.vy": 0.3}
    b = {"b.x": 0.8, "b.y": 0.15, "b.angle": 0.1, "b.vx": -1.5, "b.omega": 4}
    sol = kp.dynamics(m, kp.assemble(m, set=a | b), t_end=0.6, output_step=0.05, method=TIGHT)
    before = sol.events["touch.hit"].states[0]
    t = sol.events["touch.hit"].t[0]
    after = int(np.flatnonzero(sol.t == t)[-1])
    assert sol["touch.gap_rate"][after] == pytest.approx(-e * before["touch.gap_rate"], rel=1e-10)
    momentum = []
    for k in (0, after, -1):
        p = np.zeros(3)
        for name, mass, inertia, (cx, cy) in (("a", 3, 0.2, (0, 0)), ("b", 1, 0.01, (0, 0))):
            x, y = sol[f"{name}.x"][k] + cx, sol[f"{name}.y"][k] + cy
            vx, vy = sol[f"{name}.vx"][k], sol[f"{name}.vy"][k]
            p += mass * np.array([vx, vy, x * vy - y * vx]) + [
                0,
                0,
                inertia * sol[f"{name}.omega"][k],
            ]
        momentum.append(p)
    np.testing.assert_allclose(momentum[1], momentum[0], atol=1e-11)
    np.testing.assert_allclose(momentum[2], momentum[0], atol=1e-11)


def test_random_stops_miss_no_contact() -> None:
    """Oscillators of random frequencies between random stops: no gap below -1e-6 m at any time."""
    rng = np.random.default_rng(7)
    for _ in range(4):
        m = kp.Model("many")
        m.ground.points(O=(0, 0))
        place: dict[str, float] = {}
        for k in range(25):
            m.point_mass(f"p{k}", mass=1)
            stiffness = 10 ** rng.uniform(0, 4)
            m.generalized_force(
                f"f{k}", f"p{k}.x", value=f"-{stiffness}*p{k}.x + 3*sin({rng.uniform(1, 60)}*t)"
            )
            limits = {"lower": -rng.uniform(1e-3, 0.3), "upper": rng.uniform(1e-3, 0.3)}
            m.stop(f"s{k}", f"p{k}.x", restitution=rng.uniform(0, 1), **limits)
            place |= {f"p{k}.x": 0, f"p{k}.y": 0, f"p{k}.vx": rng.uniform(-2, 2)}
        sol = kp.dynamics(m, kp.assemble(m, set=place), t_end=0.5)
        fine = sol(np.linspace(0, 0.5, 4001))
        for k in range(25):
            assert fine[f"s{k}.gap"].min() > -1e-6, k
