"""Counterweights that balance the shaking force or moment, or the torque of the drive."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.names import unknown
from kempe.design.locate import instants
from kempe.design.places import is_pin
from kempe.design.shaking import shaking
from kempe.design.weights import least
from kempe.errors import ModelError
from kempe.model.values import instance, refuse
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from kempe.case import Case

#: Change of a motion that is an error of runs: angles in rad, lengths as a part of the largest.
_MOVED = 1e-6
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
        of: "force", "moment" or "torque".
        masses: the counterweights by the name of their body.
        case: the case with them, each a body ``NAME_counterweight`` that is welded on.
        before: the largest magnitude of the shaking force in N, of the shaking moment in N·m, or
            of the effort of the drive in N·m or N, without them.
        after: the largest one with them, measured on a run of ``case``.
    """

    of: str
    masses: Mapping[str, Counterweight]
    case: Case
    before: float
    after: float

    def __repr__(self) -> str:
        told = ", ".join(f"{name} {one.mass:.4g} kg" for name, one in self.masses.items())
        what, unit = _BALANCED[self.of]
        what = f"{what} {self.before:.4g}{unit} to {self.after:.4g}{unit}"
        return f"<Balance: {told or 'no counterweights'}; {what}>"


#: What is balanced, and its unit.
_BALANCED = {
    "force": ("shaking force", " N"),
    "moment": ("shaking moment", " N·m"),
    "torque": ("effort of the drive", ""),
}


def balance(
    case: Case,
    of: str = "force",
    on: Sequence[str] | None = None,
    *,
    radius: float | Mapping[str, float] | None = None,
    about: str | tuple[float, float] = (0.0, 0.0),
) -> Balance:
    """Counterweights for the least mean square of a force, moment or torque over a motion.

    With the moment of mass u = m r of a counterweight about its pivot, a vector fixed in the body,
    and its moment of inertia |u| r, the shaking force is linear in u, and the shaking moment and
    the effort of the drive are linear in u and in |u| r (Berkof and Lowen, *A new method for
    completely force balancing simple linkages*, J. Eng. Ind. 91 (1969) 21; Berkof, *Complete force
    and moment balancing of inline four-bar linkages*, Mech. Mach. Theory 8 (1973) 397). Three runs
    with a counterweight on one body give its factors. The best vectors follow from linear equations
    for the force, and from a least-squares search with many starts for the others.

    Args:
        case: a case whose last analysis is a motion with reactions that drivers determine, such as
            ``inverse_dynamics``.
        of: "force" and "moment" for the shaking force and moment on ground, "torque" for the effort
            of the only driver. In a case with ``static=True``, the effort contains the weights
            alone.
        on: bodies with a revolute joint to ground; all of them by default.
        radius: distance of the counterweights from their pivots, m, or one for each body; by
            default half the distance to the farthest point of the body.
        about: the point of ground to which the shaking moment refers.

    Raises:
        ModelError: a body has no pivot on ground, the case has no motion, counterweights would
            change the motion, or the case of a torque has not exactly one driver.
    """
    if of not in _BALANCED:
        raise unknown("quantity to balance", of, _BALANCED)
    own = _Measure(case, of, about)
    pivots = _pivots(case)
    for name in on or ():
        if name not in pivots:
            raise unknown("body with a revolute joint to ground", name, pivots)
    chosen = list(dict.fromkeys(on)) if on else list(pivots)
    places = {name: _place(case, name, pivots[name][1], radius) for name in chosen}
    columns = []
    for name in chosen:
        way = {
            sign: own.with_weights(_weights(places, {name: sign * own.scale}))
            for sign in (1, -1, 1j)
        }
        inertia = (way[1] + way[-1]) / 2
        columns.append([(way[1] - way[-1]) / 2, way[1j] - inertia, inertia])
    found = least(own.base, np.array(columns), linear=of == "force")
    most = abs(found).max()
    kept = {
        name: complex(moment) * own.scale
        for name, moment in zip(chosen, found, strict=True)
        if abs(moment) > _NONE * most
    }
    masses = _weights(places, kept)
    made = _with(case, pivots, masses)
    return Balance(of, MappingProxyType(masses), made, own.before, own.largest(made))


class _Measure:
    """What is balanced, over the motion of a case.

    Attributes:
        most: the changes of the coordinates that are errors of runs, (n_q of the bodies,).
        scale: the mass of a counterweight that is large enough to be felt, kg.
        base: its values at the instants without counterweights, weighted by their share of time.
        before: its largest magnitude.
    """

    def __init__(self, case: Case, of: str, about: str | tuple[float, float]) -> None:
        from kempe.case import Case

        instance(case, Case, "a case, as kp.load(path) returns")
        self.case, self.of, self.about = case, of, about
        drivers = list(case.model.tree().get("drivers", {}))
        if of == "torque" and len(drivers) != 1:
            told = ", ".join(drivers) or "none"
            raise ModelError(
                f"of: 'torque' needs exactly one driver, and the case has {told}",
                hint="leave one coordinate_driver, or balance the force or the moment",
            )
        self.drive = f"{drivers[0]}.effort" if drivers else ""
        solution = _motion(case)
        self.t = instants(solution) if solution.dense is not None else solution.t
        # the bodies come first in q, in the order in which they were added
        units = solution.compiled.column_units()
        count = sum(body.count for body in solution.compiled.bodies.values())
        self.q = solution(self.t).q[:, :count]
        angles = np.array([unit == "rad" for unit in units[:count]])
        length = float(np.abs(self.q[:, ~angles]).max(initial=0.0)) or 1.0
        self.most = _MOVED * np.where(angles, 1.0, length)
        # the square root of the weights of the trapezoidal rule
        share = np.abs(np.gradient(self.t)) / np.ptp(self.t)
        share[[0, -1]] /= 2
        self.share = np.sqrt(share)
        values = self.values(solution)
        self.before = _largest(values)
        # beside a singular position, an effort may have no bound
        self.finite = np.isfinite((values.T * self.share).ravel())
        self.base = self.flat(values)
        self.scale = sum(body.mass for body in case.model.compile().bodies.values()) or 1.0

    def values(self, solution: Solution) -> Floats:
        """The values at the instants, (n,) or (n, 2)."""
        motion = solution(self.t)
        if self.of == "torque":
            return np.asarray(motion[self.drive])
        found = shaking(motion, self.about, fine=False)
        return found.force if self.of == "force" else found.moment

    def flat(self, values: Floats) -> Floats:
        """Weighted values in one row."""
        return np.asarray((values.T * self.share).ravel()[self.finite])

    def with_weights(self, masses: Mapping[str, Counterweight]) -> Floats:
        """The change of the weighted values by counterweights.

        Raises:
            ModelError: the motion changes too.
        """
        solution = _motion(_with(self.case, _pivots(self.case), masses))
        moved = solution(self.t).q[:, : len(self.most)] - self.q
        if (np.abs(moved) > self.most).any():
            raise ModelError(
                "counterweights change the motion of the case, which must not depend on them",
                hint="add a coordinate_driver and use inverse_dynamics, or kp.optimize with "
                "counterweights as parameters",
            )
        return np.asarray(self.flat(self.values(solution)) - self.base)

    def largest(self, case: Case) -> float:
        """The largest magnitude in a run of a case."""
        return _largest(self.values(_motion(case)))


def _largest(values: Floats) -> float:
    sizes = np.hypot(*values.T) if values.ndim > 1 else np.abs(values)
    return float(np.nanmax(sizes))


def _motion(case: Case) -> Solution:
    """The last motion of a case."""
    solutions = [one for one in case.run().values() if isinstance(one, Solution)]
    if not solutions:
        raise ModelError("the case has no motion", hint="add an analysis inverse_dynamics")
    return solutions[-1]


def _place(
    case: Case, name: str, point: str, radius: float | Mapping[str, float] | None
) -> tuple[complex, float]:
    """The pivot of a body in its frame, and the distance of its counterweight, m."""
    points = case.model.compile().bodies[name].points
    at = complex(*points[point])
    return at, _radius(name, radius, [complex(*point) - at for point in points.values()])


def _weights(
    places: Mapping[str, tuple[complex, float]], masses: Mapping[str, complex]
) -> dict[str, Counterweight]:
    """Counterweights; each complex number has their mass and their direction in the body."""
    found = {}
    for name, one in masses.items():
        pivot, far = places[name]
        at = pivot + far * one / abs(one)
        found[name] = Counterweight(float(abs(one)), (float(at.real), float(at.imag)))
    return found


def _radius(name: str, given: float | Mapping[str, float] | None, arms: Sequence[complex]) -> float:
    """The distance of a counterweight from its pivot."""
    own = given.get(name) if isinstance(given, Mapping) else given
    far = max(abs(arm) for arm in arms) / 2.0 if own is None else float(own)
    if not far > 0.0:
        refuse(f"radius.{name}", f"{far}; must be > 0, so pass radius=")
    return far


def _pivots(case: Case) -> dict[str, tuple[str, str]]:
    """The joint with ground and the point of each body that turns about a fixed pivot.

    Raises:
        ModelError: there is none.
    """
    found = dict[str, tuple[str, str]]()
    joints = case.model.compile().constraints
    for joint, entry in case.model.tree().get("joints", {}).items():
        if is_pin(joints[joint]):
            ends = entry["i"].split(".", 1), entry["j"].split(".", 1)
            for (body, point), (other, _) in (ends, ends[::-1]):
                if other == "ground" and body != "ground":
                    found.setdefault(body, (joint, point))
    if not found:
        hint = "counterweights turn with bodies that have one"
        raise ModelError("no body has a revolute joint to ground", hint=hint)
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
