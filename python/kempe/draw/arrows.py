"""The vectors of a motion from which arrows take their directions and their scale.

As in figures, values beside a singular position are ignored if they have no bound there. Only a
run that passes such a position is searched between its frames.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import lru_cache, partial
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.numbers import rounded
from kempe.errors import KempeError
from kempe.model.compiled import ConstraintInfo, ForceInfo
from kempe.results.extrema import Quantity, largest, passes_singular
from kempe.results.motion import Motion
from kempe.results.solution import Solution
from kempe.results.state import State

#: Number of a body and a point in its frame.
Tracked = tuple[int, Sequence[float]]


def efforts(motion: Motion) -> dict[str, tuple[Floats, Floats]]:
    """Force, (n_t, 2), N, and torque, (n_t,), N·m, on body j of elements that arrows show.

    For a driver, they are the velocity, m/s, and the angular velocity, rad/s, of body j relative
    to body i at the point on j.
    """
    names, count = list(motion.compiled.all_bodies), len(np.atleast_1d(motion.t))
    found = {}
    for symbol in motion.compiled.symbols:
        element, on = symbol["element"], names[symbol["j"]["body"]]
        force, torque = np.zeros((count, 2)), np.zeros(count)
        if symbol["mark"] == "force_arrow":
            force = np.atleast_2d(motion.force(element).force(on=on))
        elif symbol["mark"] == "torque_arrow":
            torque = np.atleast_1d(motion.force(element).torque(on=on))
        elif symbol["mark"] in ("drive_turn", "drive_shift"):
            i, j = motion.body(names[symbol["i"]["body"]]), motion.body(on)
            point = j.at(symbol["j"]["point"] or (0.0, 0.0))
            x, y = np.moveaxis(point.position - i.r, -1, 0)
            of_i = i.velocity + np.stack([-i.omega * y, i.omega * x], axis=-1)
            force = np.atleast_2d(point.velocity - of_i)
            torque = np.atleast_1d(j.omega - i.omega)
        else:
            continue
        found[element] = (force, torque)
    return found


def tracked(bodies: list[dict[str, Any]], traces: list[dict[str, Any]]) -> list[Tracked]:
    """The points with arrows: the traced ones, and the mass centre of each body without points."""
    centres = ((one["number"], one["center"]) for one in bodies[1:] if not one["points"])
    return [*((one["body"], one["point"]) for one in traces), *centres]


def peaks(drawn: Solution | State, motion: Motion, points: list[Tracked]) -> dict[str, float]:
    """The largest magnitudes, SI: of reactions, forces, and velocities and accelerations of points.

    Args:
        drawn: the whole motion.
        motion: the motion at the frames.
        points: the points with arrows.
    """
    whole = drawn if isinstance(drawn, Solution) and passes_singular(drawn) else None
    names = list(motion.compiled.all_bodies)
    at = [(names[body], (point[0], point[1])) for body, point in points]
    return {
        "reaction": _peak(whole, motion, _reaction),
        "force": _peak(whole, motion, _force),
        "velocity": _peak(whole, motion, partial(_of_points, at, "velocity")),
        "acceleration": _peak(whole, motion, partial(_of_points, at, "acceleration")),
    }


def _peak(whole: Solution | None, motion: Motion, quantity: Quantity) -> float:
    """The largest finite value, of the whole motion if it is given, otherwise at the frames."""
    found = float("inf")
    if whole is not None:
        once = lru_cache(maxsize=3)(quantity)  # a search reads the same motion several times
        with suppress(KempeError):  # somewhere in between it has no value
            found = largest(whole, once).value
    if not np.isfinite(found):
        values = quantity(motion)
        found = float(values[np.isfinite(values)].max(initial=0.0))
    return float(rounded(found) or 0.0)


def _reaction(motion: Motion) -> Floats:
    """The largest magnitude over all joints, (n_t,), N."""
    return _largest(motion, motion.compiled.joints)


def _force(motion: Motion) -> Floats:
    """The largest magnitude over all drivers and force elements, (n_t,), N."""
    return _largest(motion, {**motion.compiled.drivers, **motion.compiled.forces})


def _largest(motion: Motion, elements: Mapping[str, ConstraintInfo | ForceInfo]) -> Floats:
    """The largest force on body j over some elements, (n_t,), N."""
    found = np.zeros(np.shape(np.atleast_1d(motion.t)))
    for name, info in elements.items():
        found = np.fmax(found, _size(motion[name].force(on=info.j)))
    return found


def _of_points(
    points: list[tuple[str, tuple[float, float]]], quantity: str, motion: Motion
) -> Floats:
    """The largest magnitude over all points, (n_t,)."""
    found = np.zeros(np.shape(np.atleast_1d(motion.t)))
    for body, at in points:
        found = np.fmax(found, _size(getattr(motion.body(body).at(at), quantity)))
    return found


def _size(vectors: Floats) -> Floats:
    found: Floats = np.linalg.norm(np.atleast_2d(vectors), axis=-1)
    return found
