"""Tasks of synthesis: poses, points and pairs of angles as numbers, and their checks."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.model.given import value
from kempe.model.values import Number, refuse

Complexes: TypeAlias = NDArray[np.complex128]
#: x and y, m, and the angle of the moving frame, rad; or texts such as "30 deg".
Pose: TypeAlias = Sequence[Number]
#: Called with the number of starts that were tried, and that of all.
Progress: TypeAlias = Callable[[int, int], None]

#: Two places, or angles, that differ by less, relative to the size of the task, are the same.
SAME = 1e-9


def rows(given: Any, path: str, units: Sequence[str], example: str) -> Floats:
    """Rows of numbers with these units, (n, len(units))."""
    width = len(units)
    try:
        listed = [list(row) for row in given]
    except TypeError:
        refuse(path, f"{given!r}; must be a list such as {example}")
    for k, row in enumerate(listed, 1):
        if len(row) != width or isinstance(given[k - 1], str):
            refuse(f"{path}[{k}]", f"{given[k - 1]!r}; must be {width} numbers: {example}")
    found = [
        [value(x, f"{path}[{k}]", unit) for x, unit in zip(row, units, strict=True)]
        for k, row in enumerate(listed, 1)
    ]
    return np.array(found, dtype=np.float64).reshape(-1, width)


def poses(given: Any) -> tuple[Complexes, Floats]:
    """Places and angles of the moving frame; at least two, and no two are the same.

    Raises:
        ModelError: they are not.
    """
    found = rows(given, "poses", ["m", "m", "rad"], "[(0, 0, 0), (0.1, 0.2, '30 deg')]")
    if len(found) < 2:
        refuse("poses", f"{len(found)} pose{'' if len(found) == 1 else 's'}; at least two")
    places = found[:, 0] + 1j * found[:, 1]
    apart = np.column_stack([found[:, :2] / size(places), turns(found[:, 2])])
    _distinct(apart, "poses", "pose")
    return places, found[:, 2]


def points(given: Any) -> Complexes:
    """Points; the core refuses points that are the same."""
    found = rows(given, "points", ["m", "m"], "[(0, 0), (0.1, 0.2)]")
    return np.asarray(found[:, 0] + 1j * found[:, 1])


def pairs(given: Any, unit: str = "rad") -> Floats:
    """Pairs of angles, or of numbers in any unit if it is ""; no crank angle occurs twice.

    Raises:
        ModelError: they are not.
    """
    found = rows(given, "pairs", [unit, unit], "[('10 deg', '35 deg'), ('40 deg', '60 deg')]")
    if len(found) < 2:
        refuse("pairs", f"{len(found)} pair{'' if len(found) == 1 else 's'}; at least two")
    _distinct(turns(found[:, 0]), "pairs", "pair", "have the same crank angle")
    return found


def size(places: Complexes) -> float:
    """The largest distance from the first place; 1 if there is none."""
    return float(np.abs(places - places[0]).max()) or 1.0


def pairs_in(places: Complexes) -> list[tuple[float, float]]:
    """Places as the core takes them."""
    return list(zip(places.real.tolist(), places.imag.tolist(), strict=True))


def turns(angles: Floats) -> Floats:
    """Cosine and sine, (n, 2)."""
    return np.column_stack([np.cos(angles), np.sin(angles)])


def _distinct(at: Floats, path: str, what: str, same: str = "are the same") -> None:
    for k in range(1, len(at)):
        for j in range(k):
            if np.abs(at[k] - at[j]).max() < SAME:
                refuse(path, f"{what}s {j + 1} and {k + 1} {same}; leave one of them out")


def pivots(given: Mapping[str, Sequence[Number]] | None, names: str) -> dict[str, complex]:
    """Fixed ground pivots by name."""
    found = {}
    for name, at in (given or {}).items():
        if name not in names.split():
            known = f"must be one of {', '.join(names.split())}" if names else "none is free"
            refuse("pivots", f"{name!r}; {known}")
        x, y = rows([at], f"pivots.{name}", ["m", "m"], "(0, 0)")[0]
        found[name] = complex(x, y)
    if len(found) == 2 and len(set(found.values())) == 1:
        refuse("pivots", "O and D are the same; move one of them")
    return found


def both(fixed: Mapping[str, complex]) -> tuple[tuple[float, float] | None, ...]:
    """The ground pivots of crank and rocker as the core takes them."""
    return tuple((fixed[name].real, fixed[name].imag) if name in fixed else None for name in "OD")
