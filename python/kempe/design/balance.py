"""Counterweights that balance the shaking force of a mechanism."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.names import unknown
from kempe.design.places import is_pin
from kempe.design.shaking import shaking
from kempe.errors import ModelError
from kempe.model.values import refuse
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from kempe.case import Case

#: A counterweight below this share of the largest moment of mass is left out.
_NONE = 1e-9


@dataclass(frozen=True)
class Counterweight:
    """A point mass on a body.

    Attributes:
        mass: kg.
        at: its place in the frame of the body, m.
    """

    mass: float
    at: tuple[float, float]


@dataclass(frozen=True, repr=False)
class Balance:
    """Counterweights and the mechanism with them.

    Attributes:
        masses: the counterweights by the name of their body.
        case: the case with them, each a body ``NAME_counterweight`` that is welded on.
        before: the largest shaking force without them, N.
        after: the largest one that is left, N.
    """

    masses: Mapping[str, Counterweight]
    case: Case
    before: float
    after: float

    def __repr__(self) -> str:
        told = ", ".join(f"{name} {one.mass:.4g} kg" for name, one in self.masses.items())
        return f"<Balance: {told}; shaking force {self.before:.4g} N to {self.after:.4g} N>"


def balance(
    case: Case,
    of: str = "force",
    on: Sequence[str] | None = None,
    *,
    radius: float | Mapping[str, float] | None = None,
) -> Balance:
    """Counterweights for the least mean square of the shaking force over a motion of a case.

    A body that turns about a fixed pivot by the angle φ changes this force by -u d²e^{iφ}/dt²,
    where u is the moment of mass of its counterweight about the pivot, a complex number. The best u
    of all bodies follow from linear equations. On both pivoted links of a four-bar, they are the
    conditions of Berkof and Lowen (1969), and nothing is left.

    Args:
        case: a case whose last analysis is a motion with reactions.
        of: "force".
        on: bodies with a revolute joint to ground; all of them by default.
        radius: distance of the counterweights from their pivots, m, or one for each body; by
            default half the distance to the farthest point of the body.

    Raises:
        ModelError: a body has no pivot on ground, or the case has no motion.
    """
    if of != "force":
        hint = "choose of='force', or use kp.optimize with counterweights as parameters"
        raise ModelError(f"of: {of!r}; only the shaking force has a closed form", hint=hint)
    solutions = [one for one in case.run().values() if isinstance(one, Solution)]
    if not solutions:
        raise ModelError("the case has no motion", hint="add an analysis inverse_dynamics")
    pivots = _pivots(case)
    for name in on or ():
        if name not in pivots:
            raise unknown("body with a revolute joint to ground", name, pivots)
    chosen = list(dict.fromkeys(on)) if on else list(pivots)
    found = shaking(solutions[-1])
    force = found.force @ [1.0, 1.0j]
    motion = solutions[-1](found.t)
    columns = []
    for name in chosen:
        body = motion.body(name)
        columns.append(np.exp(1j * body.angle) * (1j * body.alpha - body.omega**2))
    matrix = np.column_stack(columns)
    moments = np.linalg.lstsq(matrix, force, rcond=1e-12)[0]
    left = force - matrix @ moments
    masses = {}
    for name, moment in zip(chosen, moments, strict=True):
        if abs(moment) > _NONE * abs(moments).max():
            points = case.model.compile().bodies[name].points
            at = complex(*points[pivots[name][1]])
            far = _radius(name, radius, [complex(*point) - at for point in points.values()])
            place = at + far * moment / abs(moment)
            masses[name] = Counterweight(
                float(abs(moment) / far), (float(place.real), float(place.imag))
            )
    made = _with(case, pivots, masses)
    return Balance(MappingProxyType(masses), made, float(abs(force).max()), float(abs(left).max()))


def _radius(name: str, given: float | Mapping[str, float] | None, arms: Sequence[complex]) -> float:
    """The distance of a counterweight from its pivot."""
    own = given.get(name) if isinstance(given, Mapping) else given
    far = max(abs(arm) for arm in arms) / 2.0 if own is None else float(own)
    if not far > 0.0:
        refuse(f"radius.{name}", f"{far}; must be > 0, so pass radius=")
    return far


def _pivots(case: Case) -> dict[str, tuple[str, str]]:
    """The joint with ground and the point of each body that turns about a fixed pivot."""
    found = dict[str, tuple[str, str]]()
    joints = case.model.compile().constraints
    for joint, entry in case.model.tree().get("joints", {}).items():
        if is_pin(joints[joint]):
            ends = entry["i"].split(".", 1), entry["j"].split(".", 1)
            for (body, point), (other, _) in (ends, ends[::-1]):
                if other == "ground" and body != "ground":
                    found.setdefault(body, (joint, point))
    return found


def _with(
    case: Case, pivots: Mapping[str, tuple[str, str]], masses: Mapping[str, Counterweight]
) -> Case:
    """A case with counterweights as bodies that are welded on at the pivots."""
    from copy import copy

    made = copy(case)
    m = made.model
    points = case.model.compile().bodies
    for name, one in masses.items():
        point = pivots[name][1]
        arm = np.subtract(one.at, points[name].points[point])
        weight = f"{name}_counterweight"
        m.body(
            weight,
            mass=one.mass,
            inertia=0.0,
            center=(float(arm[0]), float(arm[1])),
            points={point: (0.0, 0.0), "W": (float(arm[0]), float(arm[1]))},
        )
        m.weld(f"{name}_weld", f"{name}.{point}", f"{weight}.{point}")
    return made
