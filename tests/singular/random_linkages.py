"""A garage door and random linkages that fold onto one line: models and branches."""

from __future__ import annotations

from fractions import Fraction

import kempe as kp
import numpy as np
import sympy as sp
from singular.linkages import Linkage, four_bar, rod
from singular.one_coordinate import Branch, G, Placed, S

#: Number of linkages of each kind; 40 in all.
COUNTS = {"parallelogram": 10, "kite": 10, "four-bar": 15, "door": 5}
SEED = 14


def door(
    arm: Fraction,
    height: Fraction,
    s0: float,
    rate: float,
    masses: tuple[float, float, float] = (12.0, 60.0, 1.0),
    inertia: float = 0.001,
    brake: float = 0.0,
) -> Linkage:
    """An arm that holds the lower edge of a door, whose upper edge a roller guides on a rail above.

    With the door as long as arm and height together, its horizontal part vanishes at the lowest
    position of the arm: b² - (e - a sin s)² = a (1 + sin s) (b + e - a sin s), and
    1 + sin s = 2 sin²(s/2 + π/4), whose root is smooth. The brake acts on the arm, N m s/rad.
    """
    a, e = (sp.Rational(x.numerator, x.denominator) for x in (arm, height))
    b = a + e
    ax, ay = a * sp.cos(S), a * sp.sin(S)
    reach = sp.sqrt(2 * a * (b + e - ay)) * sp.sin(S / 2 + sp.pi / 4)
    bodies = (
        rod("arm", masses[0], a, (0, 0), (ax, ay)),
        rod("door", masses[1], b, (ax, ay), (ax + reach, e)),
        Placed("roller", masses[2], inertia, ax + reach, e, (sp.Integer(1), sp.Integer(0))),
    )
    m = kp.Model("door", gravity=(0, -G))
    m.ground.points(O=(0, 0), R=(0, float(e)))
    m.bar("arm", mass=masses[0], length=float(a), ends=("O", "A"))
    m.bar("door", mass=masses[1], length=float(b), ends=("A", "B"))
    m.body("roller", mass=masses[2], inertia=inertia, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "arm.O")
    m.revolute("A", "arm.A", "door.A")
    m.revolute("B", "door.B", "roller.B")
    m.translational("rail", "ground.R", "roller.B")
    if brake:
        m.torsion_spring("brake", "ground", "arm", damping=brake)
    return Linkage(m, Branch(bodies, resistance=sp.nsimplify(brake)), s0, rate)


def garage_door(brake: float) -> Linkage:
    """Arm 2, door 3, rail at y = 1, released at 20°."""
    return door(Fraction(2), Fraction(1), float(np.deg2rad(20)), 0.0, brake=brake)


def random_linkages() -> dict[str, Linkage]:
    """The doors and the 40 linkages, by name."""
    rng = np.random.default_rng(SEED)
    made = {f"garage door, brake {brake}": garage_door(brake) for brake in (0, 150, 30_000)}
    for kind, count in COUNTS.items():
        for k in range(count):
            made[f"{kind} {k}"] = drawn(kind, rng)
    return made


def drawn(kind: str, rng: np.random.Generator) -> Linkage:
    """A random linkage of a kind. Lengths are multiples of 5 cm, so that sums are exact."""

    def length(least: float, most: float) -> Fraction:
        return Fraction(int(rng.integers(round(20 * least), round(20 * most) + 1)), 20)

    masses = tuple(float(m) for m in rng.uniform(0.3, 3.0, 3))
    s0 = float(rng.uniform(0.4, 1.6))
    side = int(rng.choice([-1, 1]))
    short = length(0.5, 1.0)
    if kind == "door":
        return door(short, length(0.2, 1.0), s0, 0.0, masses, 0.01)
    long = short + length(0.2, 1.0)
    # fast enough to lift all bars over the top
    rate = float(rng.choice([-1, 1]) * rng.uniform(7.0, 11.0) / np.sqrt(float(short)))
    if kind == "parallelogram":
        lengths = (short, long, short, long)
    elif kind == "kite":
        lengths = (short, short, long, long)
    else:  # shortest + longest = sum of the others, and the shortest turns fully
        middle = short + length(0.1, 0.6)
        other = middle + length(0.05, 0.6)
        longest = middle + other - short
        others = [
            Fraction(x) for x in rng.permutation([float(x) for x in (middle, other, longest)])
        ]
        others = [Fraction(round(20 * x), 20) for x in others]
        lengths = (
            (short, *others) if rng.random() < 0.7 else (others[0], others[1], others[2], short)
        )
    return four_bar(tuple(float(x) for x in lengths), side, s0, rate, masses)  # type: ignore[arg-type]
