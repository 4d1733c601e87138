"""A circle in a valley sharper than itself: the run names both feet, and its remedy works."""

import re
import time
from itertools import pairwise

import kempe as kp
import numpy as np
import pytest
from sizes import some

#: Seconds of CPU that a run may take.
MOST = 5.0
METHODS = [None, kp.DOP853(rtol=1e-12, atol=1e-14), kp.RK45(rtol=1e-5)]


class Valley:
    """The curve a cos(k u), and a circle above one of its valleys."""

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        self.size = 10.0 ** rng.uniform(-3, 3)
        self.mass = 10.0 ** rng.uniform(-3, 3)
        self.wave = 2 * np.pi / rng.uniform(2, 40) * self.size
        self.k = 2 * np.pi / self.wave
        self.a = self.wave * rng.uniform(0.1, 0.6)
        sharpest = 1 / (self.a * self.k**2)
        self.radius = rng.uniform(1.2, 3) * sharpest
        self.start = rng.uniform(-0.2, 0.2) * self.wave
        self.side = str(rng.choice(["left", "right"]))
        self.bottom = self.wave / 2
        self.high = 2 * self.a + self.radius + 0.2 * self.wave
        # the time in which the circle falls by 40 heights
        self.g = 9.81 * self.size
        self.t_end = np.sqrt(80 * self.high / self.g)

    def model(self, *pieces):
        m = kp.Model("valley", gravity=(0, -self.g))
        shape = f"{self.a}*cos({self.k}*u)"
        x, sign = ("u", 1.0) if self.side == "left" else ("-u", -1.0)
        ends = [-1.2 * self.wave, *pieces, 2.2 * self.wave]
        ranges = [sorted((sign * a, sign * b)) for a, b in pairwise(ends)]
        names = [f"c{k}" for k in range(len(ranges))]
        curves = {
            n: {"x": x, "y": shape, "range": tuple(r)} for n, r in zip(names, ranges, strict=True)
        }
        m.ground.curves(**curves)
        inertia = self.mass * self.radius**2 / 2
        m.body("b", mass=self.mass, inertia=inertia, points={"P": (0, 0)})
        for name in names:
            m.contact(
                f"on_{name}",
                i="b.P",
                curve=f"ground.{name}",
                radius=self.radius,
                side=self.side,
                restitution=0.0,
                rest_speed=1e-9 * self.size,
            )
        place = {"b.x": self.bottom + self.start, "b.y": self.high, "b.angle": 0}
        return m, kp.assemble(m, set=place)

    def distance(self, u, p):
        return np.hypot(u - p[0], self.a * np.cos(self.k * u) - p[1])

    def height(self):
        """The height of the centre at which the circle touches both flanks, by bisection."""
        u = np.linspace(self.bottom - self.wave, self.bottom + self.wave, 40_001)
        low, high = -self.a, self.high
        for _ in range(60):
            y = (low + high) / 2
            apart = self.distance(u, (self.bottom, y)).min() > self.radius
            low, high = (low, y) if apart else (y, high)
        return high


def run(valley, method, pieces):
    model, start = valley.model(*pieces)
    began = time.process_time()
    try:
        return kp.dynamics(
            model, start, t_end=valley.t_end, **({"method": method} if method else {})
        )
    finally:
        assert time.process_time() - began < MOST


@pytest.mark.parametrize("seed", some(range(200), 12))
def test_a_circle_on_two_feet(seed):
    valley, method = Valley(seed), METHODS[seed % 3]
    with pytest.raises(
        kp.IntegrationError, match=r"on_c0 touches the curve ground\.c0 at two"
    ) as e:
        run(valley, method, [])
    sign = 1.0 if valley.side == "left" else -1.0
    one, other, middle = (sign * float(u) for u in re.findall(r"u = (\S+?)[ ;]", str(e.value)))
    body = e.value.solution["b"]
    centre = (body.x[-1], body.y[-1])
    for u in (one, other):
        # a coarse step may pass beyond the feet by 1 % of the radius; places have six decimals
        error = 1e-2 * valley.radius + 1e-6
        assert abs(valley.distance(u, centre) - valley.radius) < error
    assert min(one, other) < valley.bottom < max(one, other)
    found = run(valley, method, [middle])
    body = found["b"]
    assert abs(body.x[-1] - valley.bottom) < 1e-6 * valley.wave
    assert abs(body.y[-1] - valley.height()) < 1e-6 * valley.wave
    forces = [found[f"on_c{k}"].force(on="b") for k in range(2)]
    weight = sum(force[-1, 1] for force in forces)
    assert abs(weight - valley.mass * valley.g) < 1e-6 * valley.mass * valley.g
