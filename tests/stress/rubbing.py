"""Parts of random mechanisms with impacts: bars, friction, stops, contacts and springs."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import kempe as kp
import numpy as np
from stress.mechanisms import Random, chance

#: Length that a mechanism has about, m.
SIZE = 1.0
#: Depth at which a compliant contact has taken the energy below, relative to the size.
DEPTH = 1e-3
#: Energy that a compliant contact takes within this depth, J.
ENERGY = 10.0
#: Restitutions, with those at the ends of the range.
RESTITUTIONS = (0.0, 0.3, 0.7, 0.95, 1.0)


@dataclass
class Drawn:
    """A random mechanism and what its assembly gets.

    Attributes:
        random: the source of its numbers.
        model: the mechanism.
        set: prescribed coordinates and rates.
        guess: starting values of coordinates that follow.
    """

    random: Random
    model: kp.Model
    set: dict[str, float] = field(default_factory=dict)
    guess: dict[str, float] = field(default_factory=dict)

    def uniform(self, low: float, high: float) -> float:
        return float(self.random.uniform(low, high))

    def chance(self, probability: float) -> bool:
        return chance(self.random, probability)

    def one(self, of: Any) -> Any:
        return of[self.random.integers(len(of))]


def empty(random: Random) -> Drawn:
    gravity = (0.0, -9.81) if chance(random, 0.8) else (0.0, 0.0)
    drawn = Drawn(random, kp.Model("drawn", gravity=gravity))
    drawn.model.ground.points(O=(0, 0))
    return drawn


def bar(d: Drawn, name: str, length: float) -> None:
    d.model.bar(name, mass=d.uniform(0.2, 3), length=length, ends=("A", "B"))


def friction(d: Drawn, joint: str, probability: float = 0.5) -> None:
    """Friction in a joint: sticking or with a velocity, loaded by the reaction or by a law."""
    if not d.chance(probability):
        return
    kinetic = d.uniform(0.05, 0.5)
    fields: dict[str, Any] = {"kinetic": kinetic}
    kind = next(info for name, info in d.model.tree()["joints"].items() if name == joint)["type"]
    if kind == "revolute":
        fields["radius"] = d.uniform(0.005, 0.1)
    if kind == "translational" and d.chance(0.4):
        fields["guide"] = d.uniform(0.1, 0.5)
        fields["kinetic"] = kinetic = d.uniform(0.02, 0.15)
    if d.chance(0.5):
        fields["static"] = kinetic + d.uniform(0, 0.3)
    if d.chance(0.3):
        fields["viscous"] = d.uniform(0, 2)
    if d.chance(0.3):
        fields["velocity"] = 10 ** d.uniform(-3, -1)
        if "static" in fields and d.chance(0.5):
            fields["stribeck"] = 10 ** d.uniform(-2, 0)
    if d.chance(0.3):
        fields["load"] = d.one([d.uniform(0, 40), "20 + 10*sin(7*t)"])
    d.model.friction(f"rub_{joint}", joint, **fields)


def touch(d: Drawn, exponent: float, rubs: bool) -> dict[str, Any]:
    """Restitution, or a stiffness that takes the energy within the depth."""
    if d.chance(0.5):
        return {"restitution": d.one(RESTITUTIONS)}
    depth = DEPTH * SIZE
    fields: dict[str, Any] = {
        "exponent": exponent,
        "stiffness": ENERGY * (exponent + 1) / depth ** (exponent + 1),
    }
    if d.chance(0.6):
        fields["damping"] = d.uniform(0, 1)
    if rubs and d.chance(0.6):
        fields |= {"friction": d.uniform(0.05, 0.6), "velocity": 10 ** d.uniform(-2, -1)}
    return fields


def stop(d: Drawn, coordinate: str, at: float, probability: float = 0.5, room: float = 1.5) -> None:
    """A stop on one or both sides of the value at the start."""
    if not d.chance(probability):
        return
    limits = {"lower": at - d.uniform(0.03, 1) * room, "upper": at + d.uniform(0.03, 1) * room}
    if d.chance(0.4):
        limits.pop(d.one(["lower", "upper"]))
    name = f"stop_{coordinate.replace('.', '_')}"
    d.model.stop(name, coordinate, **limits, **touch(d, d.one([1.0, 1.5]), rubs=False))


def spring(d: Drawn, i: str, j: str, probability: float = 0.4) -> None:
    """A spring with damping between two points."""
    if not d.chance(probability):
        return
    name = f"spring_{i}_{j}".replace(".", "_")
    d.model.spring_damper(
        name,
        i,
        j,
        stiffness=10 ** d.uniform(0, 3),
        damping=d.one([0.0, d.uniform(0, 5)]),
        free_length=d.uniform(0.2, 1),
    )


def speed(d: Drawn, most: float = 5.0) -> float:
    return float(d.one([0.0, d.uniform(-most, most)]))


def angle(d: Drawn) -> float:
    return d.uniform(-np.pi, np.pi)
