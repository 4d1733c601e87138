"""Friction in several joints of a slider-crank at rest, against the statics of its bodies.

All friction that is at rest carries the same part p of its limit. Statics with friction of p times
the static coefficients has a residual force on the slider, which vanishes at this p.
"""

import math

import kempe as kp
import numpy as np
import pytest
from scipy.optimize import brentq
from sizes import count

GRAVITY = 9.81


class Crank:
    """A slider-crank with a horizontal force on its slider, and friction in some joints.

    Attributes:
        unit, mass: its size and the masses of its bodies.
        friction: for each joint with friction, µ and the radius of the pin (0 for the slide).
        given: the loads that do not follow from reactions.
        push: the force on the slider in the direction of x.
    """

    def __init__(self, seed):
        draw = np.random.default_rng(seed)
        self.unit, mass = 10.0 ** draw.uniform(-3, 3, 2)
        self.mass = mass * draw.uniform(0.5, 3, 3)
        self.lengths = self.unit * np.array([1.0, draw.uniform(2.5, 4)])
        self.angle = draw.uniform(0.4, 2.7) * draw.choice([-1, 1])
        joints = sorted(draw.choice(["A", "B", "C", "slide"], draw.integers(2, 5), replace=False))
        radius = {"slide": 0.0}
        self.friction = {
            name: (
                draw.uniform(0.1, 0.35),
                radius.get(name, self.unit * 10.0 ** draw.uniform(-1.5, -0.5)),
            )
            for name in joints
        }
        weight = self.mass.sum() * GRAVITY
        self.given = {n: weight * draw.uniform(0.2, 2) for n in joints if draw.uniform() < 0.4}
        crank, rod = self.lengths
        at = crank * np.array([math.cos(self.angle), math.sin(self.angle)])
        self.places = at, np.array([at[0] + math.sqrt(rod**2 - at[1] ** 2), 0.0])
        # the part of the limits that this force needs
        self.part = draw.uniform(0.1, 0.9)
        self.sense = draw.choice([-1, 1])
        free, most = (self.force(0.0), self.force(self.part))
        assert math.isfinite(free + most)
        self.push = most

    def model(self):
        m = kp.Model("crank", gravity=(0, -GRAVITY))
        m.ground.points(O=(0, 0))
        for name, mass, length in zip(("crank", "rod"), self.mass, self.lengths, strict=False):
            m.bar(name, mass=mass, length=length, ends=("A", "B"))
        m.body(
            "block", mass=self.mass[2], inertia=self.mass[2] * self.unit**2, points={"P": (0, 0)}
        )
        m.revolute("A", "ground.O", "crank.A")
        m.revolute("B", "crank.B", "rod.A")
        m.revolute("C", "rod.B", "block.P")
        m.translational("slide", "ground.O", "block.P")
        m.force("push", "block.P", force=(self.push, 0))
        for name, (mu, radius) in self.friction.items():
            of = {"radius": radius} if radius else {}
            of |= {"load": self.given[name]} if name in self.given else {}
            m.friction(f"rub_{name}", name, kinetic=0.5 * mu, static=mu, **of)
        return m

    def rates(self):
        """Rates of the joints for a unit speed of the slider against the friction's sense."""
        at, slider = self.places
        rod = slider - at
        # v of B = ω1 × at, along the rod as the slider
        omega1 = rod[0] / (rod[0] * -at[1] + rod[1] * at[0])
        omega2 = (0 - omega1 * at[0]) / rod[0]
        return {"A": omega1, "B": omega2 - omega1, "C": -omega2, "slide": 1.0}

    def statics(self, push, torques, slide):
        """Forces in A, B, C, on the slide, and the force on the slider that is left, along x."""
        at, slider = self.places
        rod = slider - at
        m1, m2, m3 = self.mass * GRAVITY
        a, b = torques["A"] - torques["B"], torques["B"] - torques["C"]
        rows, right = np.zeros((8, 8)), np.zeros(8)
        # unknown: A, B (on the rod), C (on the block), N, rest
        rows[0, [0, 2]], rows[1, [1, 3]], right[1] = (1, -1), (1, -1), m1
        rows[2, [2, 3]], right[2] = (at[1], -at[0]), at[0] / 2 * m1 - a
        rows[3, [2, 4]], rows[4, [3, 5]], right[4] = (1, -1), (1, -1), m2
        rows[5, [2, 3]], right[5] = (rod[1], -rod[0]), -rod[0] / 2 * m2 - b
        rows[6, [4, 7]], right[6] = (1, 1), -push - slide
        rows[7, [5, 6]], right[7] = (1, 1), m3
        return np.linalg.solve(rows, right)

    def at_part(self, push, part):
        """Torques in the pins and force on the slide with this part of the limits, and the rest."""
        sense = {name: -self.sense * math.copysign(1, rate) for name, rate in self.rates().items()}
        efforts = dict.fromkeys("ABC", 0.0) | {"slide": 0.0}
        for _ in range(2000):
            x = self.statics(push, efforts, efforts["slide"])
            loads = {n: math.hypot(*x[2 * k : 2 * k + 2]) for k, n in enumerate("ABC")}
            loads["slide"] = abs(x[6])
            loads |= self.given
            before = dict(efforts)
            for name, (mu, radius) in self.friction.items():
                goal = sense[name] * part * mu * (radius or 1.0) * loads[name]
                efforts[name] += 0.5 * (goal - efforts[name])
            if all(abs(efforts[n] - before[n]) <= 1e-15 * abs(efforts[n]) for n in efforts):
                break
        return efforts, x[7]

    def force(self, part):
        """The force on the slider that needs this part of the limits."""
        weight = self.mass.sum() * GRAVITY
        return brentq(
            lambda push: self.at_part(push, part)[1],
            -40 * weight,
            40 * weight,
            xtol=1e-14 * weight,
            rtol=1e-14,
        )


@pytest.mark.parametrize("seed", range(count(25, 300)))
def test_friction_at_rest_carries_the_same_part_in_all_joints(seed):
    crank = Crank(seed)
    model = crank.model()
    rest = kp.assemble(
        model, set={"crank.angle": crank.angle}, guess={"block.x": crank.places[1][0]}
    )
    wanted, left = crank.at_part(crank.push, crank.part)
    weight = crank.mass.sum() * GRAVITY
    assert abs(left) <= 1e-9 * weight
    sol = kp.dynamics(model, rest, t_end=0.01 * math.sqrt(crank.unit / GRAVITY))
    for name in crank.friction:
        found = sol[f"rub_{name}.{'force' if name == 'slide' else 'torque'}"]
        unit = weight * (1.0 if name == "slide" else crank.unit)
        assert np.abs(found - wanted[name]).max() <= 1e-9 * unit, (name, found[0], wanted[name])
    assert np.abs(sol["block.vx"]).max() <= 1e-9 * math.sqrt(crank.unit * GRAVITY)
