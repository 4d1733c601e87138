"""Random free motions whose contacts, windows and events have closed forms.

Sizes, masses and rates are spread over six orders of magnitude. The motions between the contacts
are so simple that steps are as long as they can be.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import acos, ceil, cos, floor, pi, sqrt

import kempe as kp
import numpy as np
import pytest

#: Methods, each with the accuracy of its times and rates.
METHODS = (
    (kp.Auto(), 1e-6),
    (kp.RK45(), 1e-4),
    (kp.DOP853(), 1e-6),
    (kp.Radau(), 1e-4),
    (kp.GeneralizedAlpha(), 2e-3),
)


@dataclass
class Trial:
    """A run, and what is right in it."""

    model: kp.Model
    set: Mapping[str, float]
    t_end: float
    #: Asserts what is right, with the accuracy of the method.
    check: Callable[[kp.Solution, float], None]
    events: Mapping[str, str] = field(default_factory=dict)

    def run(self, method: object, accuracy: float) -> None:
        """Run by a method and check."""
        start = kp.assemble(self.model, set=self.set)
        found = kp.dynamics(self.model, start, t_end=self.t_end, method=method, events=self.events)
        self.check(found, accuracy)


def spread(rng: np.random.Generator, low: float = -3, high: float = 3) -> float:
    """A number spread over orders of magnitude."""
    return float(10 ** rng.uniform(low, high))


def hit(found: kp.Solution, t: float, within: float) -> None:
    """Assert the time of the first hit."""
    times = found.events["c.hit"].t
    assert len(times) > 0, "it was missed"
    assert abs(times[0] - t) < within


def drop(rng: np.random.Generator) -> Trial:
    """A ball falls beside the middle of a peg."""
    size, mass, g = spread(rng), spread(rng), 9.81
    radius = size * rng.uniform(0.01, 0.5)
    aside, height = radius * rng.uniform(-0.9, 0.9), size * rng.uniform(1, 5) + radius
    model = kp.Model("drop", gravity=(0, -g))
    model.ground.curves(peg={"circle": (0, 0, radius)})
    model.point_mass("ball", mass=mass)
    fall = height - sqrt(radius**2 - aside**2)
    if rng.random() < 0.5:
        model.contact("c", "ball.P", "ground.peg", restitution=rng.uniform(0, 1))
    else:
        depth = 0.01 * radius
        stiffness = 2.5 * mass * g * fall / depth**2.5
        model.contact("c", "ball.P", "ground.peg", stiffness=stiffness)
    t = sqrt(2 * fall / g)

    def check(found: kp.Solution, accuracy: float) -> None:
        hit(found, t, accuracy * t)
        assert np.hypot(found["ball.x"], found["ball.y"]).min() > 0.95 * radius

    return Trial(model, {"ball.x": aside, "ball.y": height}, 1.3 * t, check)


def two_bodies(rng: np.random.Generator) -> Trial:
    """A spinning disc passes a spinning body with a rim, or hits it."""
    size, mass = spread(rng), spread(rng)
    radius, own = size * rng.uniform(0.01, 0.3), size * rng.uniform(0, 0.1)
    speed, far = size * spread(rng, -2, 2), size * rng.uniform(2, 20)
    beside = (radius + own) * rng.uniform(-1.5, 1.5)
    model = kp.Model("two bodies")
    model.body("i", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    rim = {"rim": {"circle": (0, 0, radius)}}
    model.body("j", mass=mass * rng.uniform(0.1, 10), inertia=mass * size**2, curves=rim)
    model.contact("c", "i.P", "j.rim", radius=own, restitution=0.5)
    spins = {
        "i.omega": speed / size * rng.uniform(-9, 9),
        "j.omega": speed / size * rng.uniform(-9, 9),
    }
    left = (radius + own) ** 2 - beside**2

    def check(found: kp.Solution, accuracy: float) -> None:
        if left > 0:
            t = (far - sqrt(left)) / speed
            hit(found, t, accuracy * t)
        else:
            assert len(found.events["c.hit"].t) == 0

    set_ = {"i.x": -far, "i.y": beside, "i.vx": speed, "j.x": 0.0, "j.y": 0.0, **spins}
    return Trial(model, set_, 2 * far / speed, check)


def formula_curve(rng: np.random.Generator) -> Trial:
    """A point flies at an ellipse that is a formula."""
    size = spread(rng)
    a = size * rng.uniform(0.1, 1)
    b = a * rng.uniform(0.2, 1)
    level, speed, far = b * rng.uniform(-0.95, 0.95), size * spread(rng), size * rng.uniform(2, 30)
    model = kp.Model("ellipse")
    ellipse = {"x": f"{a!r}*cos(u)", "y": f"{b!r}*sin(u)", "range": [0, "2*pi"]}
    model.ground.curves(e={**ellipse, "periodic": True})
    model.point_mass("ball", mass=spread(rng))
    model.contact("c", "ball.P", "ground.e", restitution=0.7)
    t = (far - a * sqrt(1 - (level / b) ** 2)) / speed
    set_ = {"ball.x": -far, "ball.y": level, "ball.vx": speed}
    return Trial(model, set_, 1.5 * t, lambda found, accuracy: hit(found, t, accuracy * t))


def wheel(inertia: float, arm: float) -> kp.Model:
    """A wheel on a pin, with a point P."""
    model = kp.Model("wheel")
    model.ground.points(O=(0, 0))
    model.body("w", mass=1, inertia=inertia, points={"O": (0, 0), "P": (arm, 0)})
    model.revolute("J", "ground.O", "w.O")
    return model


def window(rng: np.random.Generator) -> Trial:
    """A wheel is driven in a short window of each turn."""
    half, inertia, speed = spread(rng, -5, -1), spread(rng), spread(rng, -1, 2)
    arm, torque = spread(rng), 0.1 * inertia * speed**2 / half * rng.uniform(0.02, 2)
    wrapped = "(w.angle - 2*pi*floor(w.angle/(2*pi) + 0.5))"
    law = (
        f"if(cos(w.angle) > cos({half!r}), {torque!r}, 0)",
        f"{torque!r}*step(w.P.x - {arm * cos(half)!r})",
        f"if({wrapped} > -{half!r}, if({wrapped} < {half!r}, {torque!r}, 0), 0)",
    )[rng.integers(3)]
    model = wheel(inertia, arm)
    model.torque("drive", "w", torque=law)
    turns = int(rng.integers(1, 8))

    def check(found: kp.Solution, accuracy: float) -> None:
        angle = float(found["w.angle"][-1])
        passed = floor((angle - half) / (2 * pi))
        if abs((angle + pi) % (2 * pi) - pi) > half:
            right = sqrt(speed**2 + 4 * torque * half * passed / inertia)
            # the edges cos(half) and arm cos(half) are rounded
            rounded = 1e-15 / half**2
            assert passed > 0
            assert found["w.omega"][-1] == pytest.approx(right, rel=3 * accuracy + rounded)

    set_ = {"w.angle": 1.0, "w.omega": speed}
    return Trial(model, set_, (2 * pi * turns + 1) / speed, check)


def events(rng: np.random.Generator) -> Trial:
    """Events of a wheel that turns uniformly, slow and fast."""
    speed, arm, often = spread(rng, -1, 2), spread(rng), spread(rng, 0, 4)
    level, begin = rng.uniform(-0.99, 0.99), 0.1
    turned = rng.uniform(2, 20)
    end, tick = begin + turned, 50 * speed / turned
    conditions = {
        "fast": f"sin({often!r}*w.angle)",
        "x": f"w.P.x - {arm * level!r}",
        "vy": f"w.P.vy - {arm * speed * level!r}",
        "tick": f"t - floor({tick!r}*t)/{tick!r} < {0.1 / tick!r}",
        "short": f"abs(t - {turned / speed / 3!r}) < {1e-6 * turned / speed!r}",
    }

    def levels(up_to: float) -> int:
        """Number of angles ±acos(level) + 2πk from 0 to an angle."""
        one = acos(level)
        both = (one, 2 * pi - one)
        return sum(max(0, ceil((up_to - each) / (2 * pi))) for each in both)

    right = {
        "fast": floor(often * end / pi) - floor(often * begin / pi),
        "x": levels(end) - levels(begin),
        "vy": levels(end) - levels(begin),
        "tick": 49,
        "short": 1,
    }

    def check(found: kp.Solution, _: float) -> None:
        for name, count in right.items():
            # an event at an end of the run may belong to it or not
            slack = 1 if name in ("fast", "tick") else 0
            assert abs(len(found.events[name].t) - count) <= slack, name

    set_ = {"w.angle": begin, "w.omega": speed}
    return Trial(wheel(spread(rng), arm), set_, turned / speed, check, conditions)


def stop(rng: np.random.Generator) -> Trial:
    """A point of a free wheel meets a stop near the top of its circle."""
    speed, arm, inertia = spread(rng, -1, 2), spread(rng), spread(rng)
    depth = spread(rng, -7, -1)
    model = wheel(inertia, arm)
    model.stop("c", "w.P.x", upper=arm * (1 - depth), restitution=rng.uniform(0.1, 1))
    at = 2 * pi - acos(1 - depth)
    t = (at - 1) / speed
    return Trial(
        model,
        {"w.angle": 1.0, "w.omega": speed},
        (at + 2) / speed,
        lambda found, accuracy: hit(found, t, accuracy * t + 1e-9 * t),
    )


def cord(rng: np.random.Generator) -> Trial:
    """A cord is taut for a short part of each turn of a wheel, and takes no energy."""
    speed, inertia = spread(rng, -1, 2), spread(rng)
    slack = spread(rng, -5, -2)
    model = wheel(inertia, 1.0)
    model.ground.points(A=(2, 0))
    free = 3 - slack
    stiffness = inertia * speed**2 / slack
    ends = ("ground.A", "w.P")
    model.spring_damper("cord", *ends, stiffness=stiffness, free_length=free, only="tension")

    def check(found: kp.Solution, accuracy: float) -> None:
        # steps end where the cord becomes taut and slack
        assert np.sum(found["cord.length"] >= free - 1e-9) >= 2, "the cord was never taut"
        assert found["w.omega"][-1] == pytest.approx(speed, rel=30 * accuracy)

    set_ = {"w.angle": 1.0, "w.omega": speed}
    return Trial(model, set_, 2 * pi / speed, check)


KINDS = (drop, two_bodies, formula_curve, window, events, stop, cord)
