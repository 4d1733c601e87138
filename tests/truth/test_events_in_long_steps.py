"""Contacts, conditions and laws that begin and end within a long step, against closed forms."""

from __future__ import annotations

from math import cos, floor, pi, sqrt

import kempe as kp
import numpy as np
import pytest


def wheel(inertia: float = 0.1) -> kp.Model:
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0), A=(0.2, 0))
    m.body("wheel", mass=5, inertia=inertia, points={"O": (0, 0), "Pin": (0.1, 0)})
    m.revolute("J", "ground.O", "wheel.O")
    return m


def turn(m: kp.Model, t_end: float, **options: object) -> kp.Solution:
    start = kp.assemble(m, set={"wheel.angle": 2.0, "wheel.omega": 3.0})
    return kp.dynamics(m, start, t_end=t_end, **options)


METHODS = (kp.Auto(), kp.RK45(rtol=1e-8), kp.DOP853(), kp.Radau(), kp.RK4(step=0.01))


@pytest.mark.parametrize("method", METHODS, ids=str)
def test_a_ball_does_not_fall_through_a_peg(method: object) -> None:
    m = kp.Model("drop", gravity=(0, -9.81))
    m.ground.curves(peg={"circle": (0, 0, 0.05)})
    m.point_mass("ball", mass=0.02)
    m.contact("c", "ball.P", "ground.peg", restitution=0.5)
    start = kp.assemble(m, set={"ball.x": 0, "ball.y": 1})
    found = kp.dynamics(m, start, t_end=0.8, method=method)
    t = sqrt(2 * 0.95 / 9.81)
    assert found.events["c.hit"].t == pytest.approx([t], rel=1e-6)
    after, up = 0.8 - t, 0.5 * 9.81 * t
    assert found["ball.y"][-1] == pytest.approx(0.05 + up * after - 4.905 * after**2, rel=1e-5)


@pytest.mark.parametrize("t_end", [2.1, 3, 10, 50])
def test_the_result_does_not_depend_on_the_end(t_end: float) -> None:
    """A pusher hits a disc of 20 mm after 2 m, off its middle."""
    m = kp.Model("cart")
    m.ground.points(O=(0, 0))
    m.body("cart", mass=1, inertia=0.1, points={"P": (0, 0)})
    m.translational("S", "ground.O", "cart.P")
    rim = {"rim": {"circle": (0, 0, 0.01)}}
    m.body("ball", mass=0.1, inertia=1e-4, points={"C": (0, 0)}, curves=rim)
    m.contact("c", "cart.P", "ball.rim", radius=0.01, stiffness=1e6)
    given = {"S.displacement": 0, "cart.vx": 1, "ball.x": 2, "ball.y": 0.005}
    found = kp.dynamics(m, kp.assemble(m, set=given), t_end=t_end)
    # a rigid contact along the line of centres gives 1.714, a soft one turns a little
    assert len(found.events["c.hit"].t) == 1
    assert found["ball.vx"][-1] == pytest.approx(1.686, abs=5e-4)
    v = [found[f"{name}"][-1] for name in ("cart.vx", "ball.vx", "ball.vy")]
    assert v[0] + 0.1 * v[1] == pytest.approx(1, rel=1e-6)
    assert v[0] ** 2 + 0.1 * (v[1] ** 2 + v[2] ** 2) == pytest.approx(1, rel=1e-5)


@pytest.mark.parametrize("method", METHODS, ids=str)
@pytest.mark.parametrize("half", [0.1, 1e-3])
@pytest.mark.parametrize(
    "law",
    [
        "if(cos(wheel.angle) > cos({half}), 0.2, 0)",
        "if(abs(wheel.angle - 2*pi*floor(wheel.angle/(2*pi) + 0.5)) < {half}, 0.2, 0)",
        "0.2*step(wheel.Pin.x - 0.1*cos({half}))",
    ],
)
def test_a_window_acts_as_long_as_it_is_open(law: str, half: float, method: object) -> None:
    m = wheel()
    m.torque("c", "wheel", torque=law.format(half=half))
    found = turn(m, 10, method=method)
    passed = floor((found["wheel.angle"][-1] - half) / (2 * pi))
    assert found["wheel.omega"][-1] == pytest.approx(sqrt(9 + 8 * half * passed), rel=1e-6)


@pytest.mark.parametrize("depth", [1e-2, 1e-3, 1e-5])
def test_what_is_listed_has_acted(depth: float) -> None:
    m = wheel()
    m.stop("c", "wheel.Pin.x", upper=0.1 * (1 - depth), stiffness=1e3, damping=50)
    found = turn(m, 10)
    assert [len(found.events[name].t) for name in ("c.hit", "c.release")] == [5, 5]
    assert found["wheel.omega"][-1] < 3


def test_fast_events_are_all_listed() -> None:
    m = wheel()
    still = {"slow": "sin(100*t)", "fast": "sin(1e4*t)", "short": "abs(t - 0.5) < 1e-6"}
    found = kp.dynamics(m, kp.assemble(m), t_end=1, events=still)
    assert {name: len(event.t) for name, event in found.events.items()} == {
        "slow": 31,
        "fast": 3183,
        "short": 1,
    }
    moving = {
        "turn": "sin(100*wheel.angle)",
        "fast": "sin(1e4*wheel.angle)",
        "tick": "t - floor(t*50)/50 < 0.005",
    }
    start = kp.assemble(m, set={"wheel.angle": 0, "wheel.omega": 1})
    found = kp.dynamics(m, start, t_end=1, events=moving)
    assert len(found.events["turn"].t) == 31
    assert len(found.events["fast"].t) == 3183
    assert len(found.events["tick"].t) in (49, 50)
    exact = np.arange(1, 3184) * pi / 1e4
    assert found.events["fast"].t == pytest.approx(exact, rel=1e-12)


def test_an_event_that_is_too_fast_is_refused_by_name() -> None:
    start = kp.assemble(wheel(), set={"wheel.angle": 0, "wheel.omega": 1})
    with pytest.raises(kp.KempeError, match="hum may change more than a million times"):
        kp.dynamics(wheel(), start, t_end=1, events={"hum": "sin(1e9*wheel.angle)"})


def test_pulse_width_modulation_has_its_mean_voltage() -> None:
    m = kp.Model("pwm")
    m.ground.points(O=(0, 0))
    m.body("rotor", mass=1, inertia=1e-3, points={"P": (0, 0)})
    m.revolute("pin", "ground.O", "rotor.P")
    duty = 0.3
    voltage = f"if(sin(2*pi*20000*t) > {cos(pi * duty)!r}, 12, 0)"
    m.motor("motor", "rotor", voltage=voltage, resistance=1, torque_constant=0.05)
    found = kp.dynamics(m, kp.assemble(m), t_end=1, output_step=0.1)
    mean = 12 * duty / 0.05 * (1 - np.exp(-(0.05**2) / 1e-3))
    assert found["rotor.omega"][-1] == pytest.approx(mean, rel=1e-4)
    assert found.statistics["steps"] > 40_000


def test_more_than_a_million_switches_are_refused() -> None:
    m = wheel()
    m.torque("c", "wheel", torque="if(sin(1e8*t) > 0, 1, 0)")
    with pytest.raises(kp.KempeError, match="more than a million switches"):
        kp.dynamics(m, kp.assemble(m), t_end=1)


@pytest.mark.parametrize("size", [1e-3, 1, 1e3])
@pytest.mark.parametrize("beside", [-1e-12, 0.0, 1e-12])
def test_a_tangent_passage_is_listed_as_graze(size: float, beside: float) -> None:
    """A point passes a peg of half the size at a distance within the error of a step."""
    m = kp.Model("passage")
    m.ground.curves(peg={"circle": (0, 0, 0.5 * size)})
    m.point_mass("ball", mass=1)
    m.contact("c", "ball.P", "ground.peg", restitution=0.5)
    given = {"ball.x": -3 * size, "ball.y": size * (0.5 + beside), "ball.vx": size}
    found = kp.dynamics(m, kp.assemble(m, set=given), t_end=5)
    assert len(found.events["c.hit"].t) == 0
    assert found.events["c.graze"].t == pytest.approx([3], abs=1e-4)
    assert found["ball.vy"][-1] == 0
