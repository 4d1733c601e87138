"""Prescribed parts of six-bars as bounds of their unknowns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.model.given import value
from kempe.model.values import refuse
from kempe.synthesis import tasks
from kempe.synthesis.six_bar.topology import Topology


def bounds(
    family: Topology,
    parts: Mapping[str, Any] | None,
    pivots: Mapping[str, complex],
    within: Floats | None,
    frame: tuple[complex, float],
) -> tuple[Floats, Floats]:
    """Least and largest unknowns of a linkage, in units of a task.

    Args:
        family: its bodies.
        parts: lengths, ranges of lengths or points of bodies.
        pivots: fixed ground pivots.
        within: the box of the others.
        frame: origin and unit of the task.

    Raises:
        ModelError: they are wrong, or contradict each other.
    """
    low, high = np.full(family.size, -np.inf), np.full(family.size, np.inf)
    origin, unit = frame
    for k, name in enumerate(family.ground):
        columns = slice(2 * k, 2 * k + 2)
        if within is not None:
            middle = np.array([origin.real, origin.imag])
            low[columns], high[columns] = ((within - middle[:, None]) / unit).T
        if name in pivots:
            at = (pivots[name] - origin) / unit
            place = np.array([at.real, at.imag])
            if (place < low[columns]).any() or (place > high[columns]).any():
                refuse(f"pivots.{name}", "outside 'within'; move it or widen 'within'")
            low[columns] = high[columns] = place
    for body in range(len(family.bodies)):
        low[family.columns[body, 1]] = 0.0
    for name, given in (parts or {}).items():
        if name not in family.bodies:
            refuse("parts", f"{name!r}; {family.name} has {', '.join(family.bodies)}")
        _part(family, name, given, unit=unit, ends=(low, high))
    return low, high


def _part(
    family: Topology, name: str, given: Any, *, unit: float, ends: tuple[Floats, Floats]
) -> None:
    """Write a prescribed body into bounds."""
    low, high = ends
    body, points = list(family.bodies).index(name), family.bodies[name]
    column, path = family.columns[body, 1], f"parts.{name}"
    if not isinstance(given, Mapping):
        both = [given, given] if isinstance(given, (str, int, float, np.number)) else list(given)
        if len(both) != 2:
            refuse(path, f"{given!r}; must be a length, (least, largest), or points by name")
        found = [value(x, path, "m") for x in both]
        if not 0.0 < found[0] <= found[1]:
            refuse(path, f"{given!r}; must be > 0, and the least length first")
        low[column], high[column] = (x / unit for x in found)
        return
    needed = set(points) - {"P"}
    if not needed <= set(given) <= set(points):
        refuse(path, f"has {', '.join(given)}; its points are {', '.join(points)}, P is optional")
    at = {
        key: complex(*tasks.rows([xy], f"{path}.{key}", ["m", "m"], "(0, 0)")[0])
        for key, xy in given.items()
    }
    side = at[points[1]] - at[points[0]]
    if not abs(side) > 0.0:
        refuse(path, f"{points[0]} and {points[1]} are the same; move one of them")
    for k, key in enumerate(points[1:], 1):
        if key not in at:
            continue
        own = (at[key] - at[points[0]]) * side.conjugate() / abs(side) / unit
        column = family.columns[body, k]
        low[column] = high[column] = own.real
        if k > 1:
            low[column + 1] = high[column + 1] = own.imag
