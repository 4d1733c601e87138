"""Blocks with several feet in a line, of which two suffice: they fall, slide and come to rest.

The number of feet does not matter for a block that slides flat on an inclined floor: its motion is
that of a point. A foot that other feet keep closed must push where the thing below it rises.
"""

import kempe as kp
import numpy as np
import pytest
from sizes import count

G = 9.81


class Comb:
    """A block with one to three feet, each with two corners, above an inclined floor."""

    def __init__(self, seed: int) -> None:
        rng = self.rng = np.random.default_rng([33, seed])
        self.size, self.mass = (10 ** rng.uniform(-3, 3, 2)).tolist()
        self.friction = float(rng.choice([0, 0.1, 0.4, 0.9]))
        self.slope = float(rng.choice([0, rng.uniform(-0.5, 0.5)]))
        n = int(rng.integers(1, 4))
        x = np.sort(rng.uniform(-0.6, 0.6, 2 * n)) + 0.03 * np.arange(2 * n)
        self.rim = [(x[0], 0.2)]
        for left, right in x.reshape(-1, 2):
            self.rim += [(left, -0.2), (left, -0.3), (right, -0.3), (right, -0.2)]
        self.rim += [(x[-1], 0.2)]

    def model(self, restitution: float) -> kp.Model:
        m, s = kp.Model("comb", gravity=(0, -G)), self.size
        along = 30 * s * np.array((np.cos(self.slope), np.sin(self.slope)))
        m.ground.curves(floor={"line": (tuple(along), tuple(-along))})
        rim = {"polygon": [(x * s, y * s) for x, y in self.rim]}
        m.body("b", mass=self.mass, inertia=0.1 * self.mass * s**2, curves={"rim": rim})
        law = {"friction": self.friction} if self.friction else {}
        m.contact("c", curves=["b.rim", "ground.floor"], restitution=restitution, **law)
        return m

    def state(self, tilt: float, lift: float) -> dict[str, float]:
        c, s = np.cos(tilt), np.sin(tilt)
        height = lift - min(s * x + c * y for x, y in self.rim)
        x, y = -np.sin(self.slope) * height, np.cos(self.slope) * height
        return {"b.x": x * self.size, "b.y": y * self.size, "b.angle": self.slope + tilt}


@pytest.mark.parametrize("part", range(count(3, 20)))
def test_falling(part: int) -> None:
    for seed in range(10 * part, 10 * (part + 1)):
        comb = Comb(seed)
        rng, s, fast = comb.rng, comb.size, (G * comb.size) ** 0.5
        m = comb.model(float(rng.choice([0, 0.3, 0.6])))
        tilt = float(rng.choice([0, 1e-3, 0.1, rng.uniform(-0.6, 0.6)]))
        vx, vy, omega = rng.normal(size=3) * rng.choice([0, 0.5], 3)
        rates = {"b.vx": vx * fast, "b.vy": vy * fast, "b.omega": omega * fast / s}
        start = kp.assemble(m, comb.state(tilt, float(rng.choice([1e-9, 0.2]))) | rates)
        run = kp.dynamics(m, start, t_end=2 * (s / G) ** 0.5)
        assert run["c.gap"].min() > -1e-9 * s, seed
        assert np.diff(run.energy.total).max() < 1e-6 * comb.mass * G * s, seed


@pytest.mark.parametrize("part", range(count(3, 20)))
def test_sliding(part: int) -> None:
    for seed in range(10 * part, 10 * (part + 1)):
        comb = Comb(seed)
        m, s, slope = comb.model(0), comb.size, comb.slope
        along = np.array((np.cos(slope), np.sin(slope)))
        speed = comb.rng.uniform(0.1, 0.5) * (G * s) ** 0.5
        rates = dict(zip(("b.vx", "b.vy", "b.omega"), (*speed * along, 0), strict=True))
        t_end = 0.8 * (s / G) ** 0.5
        run = kp.dynamics(m, kp.assemble(m, comb.state(0, 0) | rates), t_end=t_end)
        braked = G * (comb.friction * np.cos(slope) + np.sin(slope))
        stop = speed / braked if braked > 0 else np.inf
        way = speed * min(t_end, stop) - braked * min(t_end, stop) ** 2 / 2
        if stop < t_end and np.tan(slope) > comb.friction:
            way -= G * (np.sin(slope) - comb.friction * np.cos(slope)) * (t_end - stop) ** 2 / 2
        tipped = abs(run["b.angle"] - slope).max() > 1e-6
        moved = np.array((run["b.x"][-1] - run["b.x"][0], run["b.y"][-1] - run["b.y"][0]))
        assert tipped or np.allclose(moved, way * along, atol=1e-7 * s), seed


@pytest.mark.parametrize("seed", range(count(5, 50)))
def test_a_foot_that_is_raised(seed: int) -> None:
    """The middle one of three feet stands on a round top, which a driver raises."""
    rng = np.random.default_rng([34, seed])
    s, mass = (10 ** rng.uniform(-3, 3, 2)).tolist()
    m, time = kp.Model("bump", gravity=(0, -G)), (s / G) ** 0.5
    m.ground.points(O=(0, 0))
    m.ground.curves(floor={"line": ((9 * s, 0), (-9 * s, 0))})
    place = float(rng.uniform(-0.3, 0.3))
    feet = {"A": (-0.5 * s, -0.2 * s), "B": (0.5 * s, -0.2 * s), "C": (place * s, -0.2 * s)}
    m.body("b", mass=mass, inertia=0.1 * mass * s**2, points=feet)
    top = {"circle": (0, -0.3 * s, 0.3 * s)}
    m.body("top", mass=mass, inertia=mass * s**2, points={"P": (0, 0)}, curves={"rim": top})
    m.translational("guide", "ground.O", "top.P", axes=("90*deg", "90*deg"))
    high = rng.uniform(0.01, 0.1) * s
    law = f"step5(t, {0.1 * time!r}, 0, {3 * time!r}, {high!r})"
    m.coordinate_driver("lift", "guide.displacement", value=law)
    for foot in feet:
        curve = "top.rim" if foot == "C" else "ground.floor"
        m.contact(foot, f"b.{foot}", curve, restitution=0)
    start = kp.assemble(m, {"b.x": -place * s, "b.y": 0.2 * s, "b.angle": 0})
    run = kp.dynamics(m, start, t_end=3 * time)
    # the foot as it is: its distance from the centre of the circle
    angle = run["b.angle"]
    c, n = np.cos(angle), np.sin(angle)
    x = run["b.x"] + c * place * s + n * 0.2 * s
    y = run["b.y"] + n * place * s - c * 0.2 * s
    gap = np.hypot(x, y - run["top.y"] + 0.3 * s) - 0.3 * s
    assert gap.min() > -1e-8 * s
    assert run["C.force"].max() > 0.1 * mass * G
