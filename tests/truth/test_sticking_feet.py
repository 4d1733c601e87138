"""Blocks that rock, slide and stick on two compliant feet, against an own integration.

The own friction is μ N tanh(v/V), which tends to Coulomb's law with V. Its error falls in
proportion to V, so that two values of V show that both programs tend to the same motion.
"""

import kempe as kp
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from sizes import count

G = 9.81
Vector = NDArray[np.float64]


class Block:
    """A block above a floor: masses and sizes from 1e-3 to 1e3, speeds of a fall by its size."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng([5, seed])
        self.mass, size = (10 ** rng.uniform(-3, 3, 2)).tolist()
        self.size = size
        self.feet = size * rng.uniform(0.2, 0.6, 2)
        self.inertia = self.mass * float(self.feet @ self.feet) / 3
        self.friction = float(rng.uniform(0.1, 0.8))
        self.stiffness = self.mass * G / (size * 10 ** rng.uniform(-4, -2.5))
        self.damping = float(rng.uniform(0.2, 1) / (G * size) ** 0.5)
        half, high = self.feet
        above = high + 0.05 * size * rng.random()
        speed, rate = (G * size) ** 0.5, (G / size) ** 0.5
        vx, omega, angle = rng.normal(0, 0.5) * speed, rng.normal(0, 0.3) * rate, rng.normal(0, 0.1)
        touches = half * abs(np.sin(angle)) + high * np.cos(angle)
        self.start = [0.0, max(above, touches + 1e-3 * size), angle, vx, 0.0, omega]
        self.t_end = 1.2 * (size / G) ** 0.5

    def kempe(self) -> kp.Solution:
        (half, high), far = self.feet, 90 * self.size
        m = kp.Model("block", gravity=(0, -G))
        m.ground.curves(floor={"line": ((far, 0), (-far, 0))})
        places = {"A": (-half, -high), "B": (half, -high)}
        m.body("block", mass=self.mass, inertia=self.inertia, points=places)
        law = {"stiffness": self.stiffness, "exponent": 1, "damping": self.damping}
        for foot in "AB":
            m.contact(foot, f"block.{foot}", "ground.floor", friction=self.friction, **law)
        names = ("x", "y", "angle", "vx", "vy", "omega")
        at = {f"block.{name}": x for name, x in zip(names, self.start, strict=True)}
        method = kp.DOP853(rtol=1e-9, atol=1e-12)
        return kp.dynamics(m, kp.assemble(m, set=at), t_end=self.t_end, method=method)

    def rates(self, slow: float) -> Vector:
        """The last coordinates of the own integration with V = slow √(g size)."""

        def forces(_: float, state: Vector) -> list[float]:
            _, y, angle, vx, vy, omega = state
            c, s = np.cos(angle), np.sin(angle)
            along, up, torque = 0.0, -self.mass * G, 0.0
            for half in (-self.feet[0], self.feet[0]):
                rx, ry = c * half + s * self.feet[1], s * half - c * self.feet[1]
                depth, closing = -(y + ry), -(vy + omega * rx)
                if depth <= 0:
                    continue
                normal = max(self.stiffness * depth * (1 + self.damping * closing), 0.0)
                slip = (vx - omega * ry) / (slow * (G * self.size) ** 0.5)
                rubs = -self.friction * normal * np.tanh(slip)
                along, up, torque = along + rubs, up + normal, torque + rx * normal - ry * rubs
            return [vx, vy, omega, along / self.mass, up / self.mass, torque / self.inertia]

        rate = (G / self.size) ** 0.5
        scale = np.array([self.size, self.size, 1.0])
        run = solve_ivp(
            forces,
            (0, self.t_end),
            self.start,
            method="Radau",
            rtol=1e-6,
            atol=1e-8 * np.concatenate([scale, rate * scale]),
            max_step=self.t_end / 200,
        )
        return run.y[:3, -1] / scale


@pytest.mark.parametrize("part", range(count(3, 30)))
def test_a_block_on_two_feet(part: int) -> None:
    sticks = 0
    for seed in range(6 * part, 6 * (part + 1)):
        block = Block(seed)
        run = block.kempe()
        found = run.q[-1] / np.array([block.size, block.size, 1.0])
        differences = [abs(found - block.rates(slow)).max() for slow in (1e-3, 1e-4)]
        assert differences[1] < 1e-3, seed
        # the own integration itself is exact to 1e-5
        assert differences[1] < 0.5 * differences[0] + 1e-5, seed
        sticks += run.events["A.stick"].t.size + run.events["B.stick"].t.size
        assert np.diff(run.energy.total).max() < 1e-9 * block.mass * G * block.size, seed
    assert sticks > 0
