"""Blocks, rods and discs that fall on a floor, hit it, slide, stick and lift off.

Sizes, masses, coefficients and the tilt of the floor are random. A run must end without an error,
must not gain energy, and must obey the limit of friction. Rigid contacts must not overlap.
"""

import kempe as kp
import numpy as np
import pytest
from sizes import count

G = 9.81


class Heap:
    """One to three bodies beside each other above a floor."""

    def __init__(self, seed: int) -> None:
        rng = self.rng = np.random.default_rng([77, seed])
        self.size, self.unit = (10 ** rng.uniform(-2, 2, 2)).tolist()
        self.tilt = rng.uniform(-0.35, 0.35) if rng.random() < 0.5 else 0.0
        self.rigid = rng.random() < 0.6
        self.model = m = kp.Model(f"heap {seed}", gravity=(0, -G))
        m.ground.curves(floor={"line": (self.turned(30, 0), self.turned(-30, 0))})
        #: The contacts with their largest coefficients.
        self.contacts: dict[str, float] = {}
        self.start: dict[str, float] = {}
        beside = 0.0
        for k in range(rng.integers(1, 4)):
            beside = self.add(f"b{k}", str(rng.choice(["disc", "block", "rod"])), beside)

    def turned(self, x: float, y: float) -> tuple[float, float]:
        c, s = np.cos(self.tilt), np.sin(self.tilt)
        return self.size * (c * x - s * y), self.size * (s * x + c * y)

    def law(self, mass: float) -> dict[str, float]:
        rng, law = self.rng, {}
        if coefficient := float(rng.choice([0, 0.05, 0.3, 0.8])):
            law["friction"] = coefficient
            if rng.random() < 0.4:
                law["static"] = coefficient * rng.uniform(1, 1.5)
        if self.rigid:
            return {**law, "restitution": float(rng.choice([0, 0, 0.3, 0.7]))}
        depth = self.size * 10 ** rng.uniform(-5, -3)
        return {
            **law,
            "stiffness": mass * G / depth,
            "damping": rng.uniform() / (G * self.size) ** 0.5,
        }

    def add(self, name: str, kind: str, beside: float) -> float:
        """Adds a body; returns where the next one may begin."""
        rng, s, m = self.rng, self.size, self.model
        mass = self.unit * 10 ** rng.uniform(-1, 1)
        law, angle, radius = self.law(mass), self.tilt, 0.0
        if kind == "disc":
            radius = high = wide = rng.uniform(0.3, 0.8)
            inertia, feet = 0.5 * mass * (high * s) ** 2, {"C": (0.0, 0.0)}
        elif kind == "block":
            wide, high = rng.uniform(0.2, 0.6, 2)
            corners = ((-wide, -high), (wide, -high), (wide, high), (-wide, high))
            inertia = mass * (wide**2 + high**2) / 3 * s**2
            feet = {f"C{k}": (x * s, y * s) for k, (x, y) in enumerate(corners)}
        else:
            wide, radius = rng.uniform(0.25, 0.6), 0.05
            high, angle = wide + 0.06, self.tilt + rng.uniform(0.2, 1.4)
            inertia = mass * (2 * wide * s) ** 2 / 12
            feet = {"A": (-wide * s, 0.0), "B": (wide * s, 0.0)}
        m.body(name, mass=mass, inertia=inertia, points=feet)
        for foot in feet:
            contact = f"{name}{foot}"
            m.contact(contact, f"{name}.{foot}", "ground.floor", radius=radius * s, **law)
            self.contacts[contact] = law.get("static", law.get("friction", 0.0))
        lift = float(rng.choice([1e-6, 0.5]))
        moves, turns = rng.choice([0, 1], 2)
        vx, vy = 0.7 * rng.normal(size=2) * (G * s) ** 0.5 * moves
        omega = rng.normal() * (G / s) ** 0.5 * turns
        x, y = self.turned(beside + wide + 0.1, high + lift)
        state = {"x": x, "y": y, "angle": angle, "vx": vx, "vy": vy, "omega": omega}
        self.start |= {f"{name}.{quantity}": value for quantity, value in state.items()}
        return beside + 2 * wide + 0.2


@pytest.mark.parametrize("part", range(count(4, 23)))
def test_a_random_heap(part: int) -> None:
    for seed in range(10 * part, 10 * (part + 1)):
        heap = Heap(seed)
        m, size = heap.model, heap.size
        run = kp.dynamics(m, kp.assemble(m, set=heap.start), t_end=3 * (size / G) ** 0.5)
        large = max(run.energy.kinetic.max(), 1e-3 * heap.unit * G * size)
        assert np.diff(run.energy.total).max() < 1e-6 * large, seed
        for contact, coefficient in heap.contacts.items():
            if heap.rigid:
                assert run[f"{contact}.gap"].min() > -1e-9 * size, (seed, contact)
            excess = abs(run[f"{contact}.tangential"]) - coefficient * run[f"{contact}.force"]
            assert excess.max() < 1e-6 * heap.unit * G, (seed, contact)
