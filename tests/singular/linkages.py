"""Linkages with change points and dead points: models and branches of their motion."""

from __future__ import annotations

from dataclasses import dataclass

import kempe as kp
import numpy as np
import sympy as sp
from singular.one_coordinate import Branch, G, Placed, S


@dataclass(frozen=True)
class Linkage:
    """A linkage on a branch, whose coordinate s is the angle of the crank.

    Attributes:
        model: the linkage.
        branch: its closed form.
        s0, rate: initial coordinate and rate, rad and rad/s.
    """

    model: kp.Model
    branch: Branch
    s0: float
    rate: float

    def start(self, s0: float | None = None, rate: float | None = None) -> kp.State:
        """The assembled state on the branch, optionally with another crank angle and rate."""
        s0, rate = (self.s0 if s0 is None else s0), (self.rate if rate is None else rate)
        names = [body.name for body in self.branch.bodies]
        places = dict(zip(names, self.branch.places(np.array([s0]))[0], strict=True))
        guess: dict[str, float | str] = {}
        for name, (x, y, c, s) in places.items():
            guess |= {f"{name}.x": x, f"{name}.y": y, f"{name}.angle": float(np.arctan2(s, c))}
        crank = names[0]
        held: dict[str, float | str] = {f"{crank}.angle": s0, f"{crank}.omega": rate}
        del guess[f"{crank}.angle"]
        return kp.assemble(self.model, set=held, guess=guess)


def rod(name: str, mass: float, length: float, tail: tuple, tip: tuple) -> Placed:
    """A uniform bar between two points."""
    (x, y), (dx, dy) = tail, (tip[0] - tail[0], tip[1] - tail[1])
    along = (dx / length, dy / length)
    return Placed(name, mass, mass * length**2 / 12, x + dx / 2, y + dy / 2, along)


def root(gap: float, product: float, half: sp.Expr) -> sp.Expr:
    """sqrt(gap + 4 product half^2), with the sign of half if gap = 0, which is smooth."""
    whole = gap + 4 * product * half**2
    return 2 * sp.sqrt(product) * half if gap == 0 else sp.sqrt(whole)


def four_bar(
    lengths: tuple[float, float, float, float],
    side: int,
    s0: float,
    rate: float,
    masses: tuple[float, float, float] = (1.0, 1.0, 1.0),
) -> Linkage:
    """Crank a, coupler b, rocker c and ground d, with a rotating crank.

    With the diagonal f = |BD|, (4 area)^2 = ((b + c)^2 - f^2) (f^2 - (b - c)^2) of BCD.
    If links fold onto one line, one of the factors has a double zero. Its root changes sign there,
    which is the smooth continuation. `side` is +1 or -1.
    """
    a, b, c, d = map(sp.nsimplify, lengths)
    ax, ay = a * sp.cos(S), a * sp.sin(S)
    f2 = a**2 + d**2 - 2 * a * d * sp.cos(S)
    upper = root((b + c) ** 2 - (a + d) ** 2, a * d, sp.cos(S / 2))
    lower = root((a - d) ** 2 - (b - c) ** 2, a * d, sp.sin(S / 2))
    along, across = (f2 + b**2 - c**2) / (2 * f2), side * upper * lower / (2 * f2)
    tip = (ax + along * (d - ax) + across * ay, ay - along * ay + across * (d - ax))
    bodies = (
        rod("crank", masses[0], a, (0, 0), (ax, ay)),
        rod("coupler", masses[1], b, (ax, ay), tip),
        rod("rocker", masses[2], c, (d, 0), tip),
    )
    m = kp.Model("four-bar", gravity=(0, -G))
    m.ground.points(A=(0, 0), D=(lengths[3], 0))
    ends = (("A", "B"), ("B", "C"), ("D", "C"))
    names = ("crank", "coupler", "rocker")
    for name, mass, length, pair in zip(names, masses, lengths, ends, strict=False):
        m.bar(name, mass=mass, length=length, ends=pair)
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    return Linkage(m, Branch(bodies), s0, rate)


def slider_crank(
    lengths: tuple[float, float],
    s0: float,
    rate: float,
    *,
    at_pivot: bool = False,
    stiffness: float = 0.0,
    damping: float = 0.0,
) -> Linkage:
    """Crank r and rod b; the slider on the x axis is loaded by a spring-damper along the axis.

    With r = b the slider reaches the pivot and may stay there while the others turn: `at_pivot`.
    """
    r, b = map(sp.nsimplify, lengths)
    bx, by = r * sp.cos(S), r * sp.sin(S)
    reach = r * sp.cos(S) if r == b else sp.sqrt(b**2 - by**2)
    x = sp.Integer(0) if at_pivot else bx + reach
    zero = (sp.Integer(1), sp.Integer(0))
    bodies = (
        rod("crank", 1.0, r, (0, 0), (bx, by)),
        rod("rod", 1.0, b, (bx, by), (x, sp.Integer(0))),
        Placed("slider", 2.0, 0.1, x, sp.Integer(0), zero),
    )
    free = lengths[0] + lengths[1]
    spring = sp.nsimplify(stiffness) * (x - sp.nsimplify(free)) ** 2 / 2
    branch = Branch(bodies, spring, sp.nsimplify(damping) * sp.diff(x, S) ** 2)
    m = kp.Model("slider-crank", gravity=(0, -G))
    m.ground.points(O=(0, 0), W=(-10, 0))
    m.bar("crank", mass=1, length=lengths[0], ends=("O", "B"))
    m.bar("rod", mass=1, length=lengths[1], ends=("B", "C"))
    m.body("slider", mass=2, inertia=0.1, points={"C": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("B", "crank.B", "rod.B")
    m.revolute("C", "rod.C", "slider.C")
    m.translational("slide", "ground.O", "slider.C")
    if stiffness or damping:
        # attached far behind the pivot, so that its length x + 10 is never zero
        m.spring_damper(
            "load",
            "ground.W",
            "slider.C",
            stiffness=stiffness,
            damping=damping,
            free_length=free + 10,
        )
    return Linkage(m, branch, s0, rate)
