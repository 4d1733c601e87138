"""Random mechanisms: chains, linkages, sliders and rods, with ordinary and extreme numbers."""

from collections.abc import Callable
from dataclasses import dataclass, field

import kempe as kp
import numpy as np

Random = np.random.Generator


@dataclass(frozen=True)
class Drawn:
    """A mechanism with the arguments of its assembly.

    Attributes:
        model: the mechanism.
        set: prescribed coordinates and rates.
        guess: starting values.
    """

    model: kp.Model
    set: dict[str, float]
    guess: dict[str, float] = field(default_factory=dict)


def power(random: Random, low: float, high: float) -> float:
    """A number between 10^low and 10^high with a uniformly distributed logarithm."""
    return float(10 ** random.uniform(low, high))


def chance(random: Random, probability: float) -> bool:
    return bool(random.random() < probability)


def wide(random: Random) -> float:
    """A number that is mostly near 1, otherwise within a ratio of 1e12."""
    return power(random, -6, 6) if chance(random, 0.4) else power(random, -0.5, 0.5)


def empty(random: Random) -> kp.Model:
    gravity = (0.0, -9.81) if chance(random, 0.8) else (0.0, 0.0)
    return kp.Model("drawn", gravity=gravity)


def inertia(random: Random, mass: float, length: float) -> float:
    """The inertia of a uniform bar, zero, or any number."""
    bar = mass * length**2 / 12
    return float(random.choice([bar, bar, 0.0, bar * power(random, -12, 6)]))


def link(random: Random, m: kp.Model, name: str, length: float) -> None:
    """A body with points P and Q at its ends and its frame in between."""
    at = length * float(random.choice([0.5, random.uniform(0, 1)]))
    mass = wide(random)
    m.body(
        name,
        mass=mass,
        inertia=inertia(random, mass, length),
        points={"P": (-at, 0), "Q": (length - at, 0)},
    )


def springs(random: Random, m: kp.Model, bodies: list[str]) -> None:
    """Torques and springs with stiffness and damping over twelve decades."""
    for number, body in enumerate(bodies):
        stiffness, damping = power(random, -6, 6), power(random, -6, 6) * random.integers(0, 2)
        kind, name = random.random(), f"force{number}"
        if kind < 0.15:
            m.torsion_spring(name, "ground", body, stiffness=stiffness, damping=float(damping))
        elif kind < 0.3:
            m.spring_damper(
                name,
                "ground.S",
                f"{body}.Q",
                stiffness=stiffness,
                damping=float(damping),
                free_length=float(random.uniform(0, 2)),
            )
        elif kind < 0.35:
            m.torque(name, body, torque=wide(random))


def pin(m: kp.Model, name: str, i: str, j: str) -> None:
    m.revolute(name, i, j)


def chain(random: Random) -> Drawn:
    """A pendulum of 1 to 6 links, straight or not, sometimes with a driven first link."""
    m, count = empty(random), int(random.integers(1, 7))
    m.ground.points(O=(0, 0), S=(1, 1))
    bodies, end, held = [], "ground.O", {}
    straight = chance(random, 0.3)
    for number in range(count):
        name = f"link{number}"
        link(random, m, name, power(random, -1, 1) if chance(random, 0.5) else 1.0)
        pin(m, f"J{number}", end, f"{name}.P")
        end = f"{name}.Q"
        bodies.append(name)
        held[f"{name}.angle"] = 0.3 if straight else float(random.uniform(-3, 3))
        held[f"{name}.omega"] = wide(random) * float(random.integers(-1, 2))
    springs(random, m, bodies)
    if chance(random, 0.2):
        m.coordinate_driver("motor", "link0.angle", value=f"0.3 + {wide(random)!r}*t")
        held = {key: x for key, x in held.items() if not key.startswith("link0")}
    return Drawn(m, held)


def lengths(random: Random) -> tuple[float, float, float, float]:
    """Lengths of crank, coupler, rocker and ground, some with change points or dead points."""
    a, b = float(random.uniform(0.2, 1)), float(random.uniform(1, 3))
    kind = random.integers(0, 4)
    if kind == 0:  # parallelogram
        return a, b, a, b
    if kind == 1:  # kite
        return a, a, b, b
    if kind == 2:  # almost folds onto a line
        return a, b, b + power(random, -12, -1), a
    return a, b, float(random.uniform(1, 3)), float(random.uniform(1, 3))


def crank_angle(random: Random) -> float:
    """Any angle, or an angle near a singular position with links in line."""
    if chance(random, 0.5):
        return float(random.uniform(-3.1, 3.1))
    side = float(random.choice([0.0, np.pi]))
    return side + power(random, -14, -1) * float(random.choice([-1, 1]))


def four_bar(random: Random) -> Drawn:
    a, b, c, d = lengths(random)
    m = empty(random)
    m.ground.points(A=(0, 0), D=(d, 0), S=(0.5, 2))
    for name, length in (("crank", a), ("coupler", b), ("rocker", c)):
        link(random, m, name, length)
    pin(m, "A", "ground.A", "crank.P")
    pin(m, "B", "crank.Q", "coupler.P")
    pin(m, "C", "coupler.Q", "rocker.Q")
    pin(m, "D", "rocker.P", "ground.D")
    springs(random, m, ["crank", "coupler", "rocker"])
    return turned(random, m, "crank")


def slider_crank(random: Random) -> Drawn:
    m = empty(random)
    m.ground.points(O=(0, 0), S=(0.5, 2))
    link(random, m, "crank", 1.0)
    link(random, m, "rod", float(random.choice([1.0, random.uniform(1, 4)])))
    m.body("slider", mass=wide(random), inertia=wide(random), points={"P": (0, 0), "Q": (0, 0)})
    pin(m, "A", "ground.O", "crank.P")
    pin(m, "B", "crank.Q", "rod.P")
    pin(m, "C", "rod.Q", "slider.P")
    m.translational("slide", "ground.O", "slider.P")
    springs(random, m, ["crank", "rod", "slider"])
    return turned(random, m, "crank")


def turned(random: Random, m: kp.Model, crank: str) -> Drawn:
    """A linkage with a released or a driven crank."""
    angle, rate = crank_angle(random), wide(random) * float(random.integers(-1, 2))
    if chance(random, 0.2):
        m.coordinate_driver("motor", f"{crank}.angle", value=f"{angle!r} + {rate!r}*t")
        return Drawn(m, {})
    return Drawn(m, {f"{crank}.angle": angle, f"{crank}.omega": rate})


def rods(random: Random) -> Drawn:
    """Point masses on massless rods, one below the other."""
    m, held, guess, end = empty(random), {}, {}, "ground.O"
    m.ground.points(O=(0, 0), S=(1, 1))
    x = y = 0.0
    bodies = []
    for number in range(int(random.integers(1, 5))):
        name, length = f"bob{number}", float(random.uniform(0.5, 2))
        m.body(name, mass=wide(random), inertia=0.0, points={"P": (0, 0), "Q": (0, 0)})
        m.distance(f"rod{number}", end, f"{name}.P", length=length)
        angle = float(random.uniform(-3, 3))
        x, y = x + length * np.cos(angle), y + length * np.sin(angle)
        held |= {f"{name}.x": float(x), f"{name}.angle": 0.0}
        guess[f"{name}.y"] = float(y)
        end = f"{name}.P"
        bodies.append(name)
    springs(random, m, [body for body in bodies if chance(random, 0.5)])
    return Drawn(m, held, guess)


def free(random: Random) -> Drawn:
    """Bodies connected by springs only."""
    m, held = empty(random), {}
    m.ground.points(S=(0, 0))
    bodies = [f"body{number}" for number in range(int(random.integers(1, 4)))]
    for name in bodies:
        link(random, m, name, 1.0)
        held |= {f"{name}.{c}": float(random.uniform(-2, 2)) for c in ("x", "y", "angle")}
    springs(random, m, bodies)
    return Drawn(m, held)


KINDS: dict[str, Callable[[Random], Drawn]] = {
    "chain": chain,
    "four-bar": four_bar,
    "slider-crank": slider_crank,
    "rods": rods,
    "free bodies": free,
}
