"""Six-bars for functions and paths: bounds, starts, least squares, and candidates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.model.given import value
from kempe.model.values import Number, refuse
from kempe.synthesis import tasks
from kempe.synthesis.found import Found
from kempe.synthesis.six_bar.candidate import SixBar
from kempe.synthesis.six_bar.fit import Task, fitted
from kempe.synthesis.six_bar.judge import judged
from kempe.synthesis.six_bar.starts import atlas, between, for_function, for_path
from kempe.synthesis.six_bar.topology import FAMILIES, Topology, topology
from kempe.synthesis.tasks import Complexes

if TYPE_CHECKING:
    from kempe.synthesis.assemble import Limits

#: Starts, those that are fitted to all positions, and six-bars whose defects are computed.
STARTS, _SECOND, _JUDGED = 64, 16, 24
#: Six-bars of the atlas.
_ATLAS = 600
#: Positions of the first fit.
_FIRST = 12
#: Weight of the gaps, steps, and weight of the unknowns in each fit.
_STAGES = ((2.0, 40, 1e-3), (10.0, 60, 1e-4), (1e3, 40, 0.0))
#: Two six-bars are nearly the same within this share of their size.
_NEAR = 1e-3


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
    for body, points in enumerate(family.bodies.values()):
        low[family.columns[body, 1]] = 0.0
    for name, given in (parts or {}).items():
        if name not in family.bodies:
            refuse("parts", f"{name!r}; {family.name} has {', '.join(family.bodies)}")
        _part(family, name, given, unit, low, high)
    return low, high


def _part(family: Topology, name: str, given: Any, unit: float, low: Floats, high: Floats) -> None:
    """Write a prescribed body into bounds."""
    body, points = list(family.bodies).index(name), family.bodies[name]
    column, path = family.columns[body, 1], f"parts.{name}"
    if not isinstance(given, Mapping):
        ends = [given, given] if isinstance(given, (str, int, float, np.number)) else list(given)
        if len(ends) != 2:
            refuse(path, f"{given!r}; must be a length, (least, largest), or points by name")
        found = [value(x, path, "m") for x in ends]
        if not 0.0 < found[0] <= found[1]:
            refuse(path, f"{given!r}; must be > 0, and the least length first")
        low[column], high[column] = (x / unit for x in found)
        return
    needed = set(points) - {"P"}
    if not needed <= set(given) <= set(points):
        refuse(path, f"has {', '.join(given)}; its points are {', '.join(points)}, P is optional")
    at = {key: complex(*tasks.rows([xy], f"{path}.{key}", ["m", "m"], "(0, 0)")[0]) for key, xy in given.items()}
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


def path_of(
    family: str,
    places: Complexes,
    cranks: Sequence[float] | None,
    limits: Limits,
    *,
    offset: bool,
    pivots: Mapping[str, complex],
    parts: Mapping[str, Any] | None,
    starts: int,
    seed: int,
) -> Found:
    """Six-bars whose point P passes points.

    Args:
        family: of the six-bars.
        places: the points, m.
        cranks: angles of the crank, rad, or None.
        limits: of the candidates.
        offset: whether only differences of the crank angles count.
        pivots: fixed ground pivots, m.
        parts: prescribed parts.
        starts: their number.
        seed: of the atlas and the starts.
    """
    of, frame = topology(family), (complex(places.mean()), tasks.size(places))
    _apart(places, frame[1])
    low, high = bounds(of, parts, pivots, limits.within, frame)
    low[-4:] = high[-4:] = [0.0, 0.0, 1.0, 1.0]
    given = None
    if cranks is not None:
        given = np.unwrap(np.asarray(cranks, dtype=float))
        if offset:
            low[-4], high[-4] = -np.inf, np.inf
    task = Task(of, low, high, (places - frame[0]) / frame[1], given)
    random = np.random.default_rng(seed)
    linkage, angles = for_path(task, atlas(family, _ATLAS, seed), starts, random)
    if given is not None and offset:
        linkage[:, -4] = np.angle(np.exp(1j * (angles[:, :, of.crank] - given)).mean(axis=1))
    linkage, angles = _improved(task, linkage, angles)
    return _collected(task, linkage, angles, limits, frame, places)


def function_of(
    family: str,
    pairs: Floats,
    limits: Limits,
    *,
    fixed: tuple[bool, bool],
    ground: float,
    pivots: Mapping[str, complex],
    parts: Mapping[str, Any] | None,
    starts: int,
    seed: int,
) -> Found:
    """Six-bars whose arm has angles at angles of the crank.

    Args:
        family: of the six-bars.
        pairs: angles of crank and arm, rad, or numbers for free scales, (n, 2).
        limits: of the candidates.
        fixed: whether the offsets and the scales are fixed.
        ground: the distance of O and D, m.
        pivots: a fixed pivot G, m.
        parts: prescribed parts.
        starts: their number.
        seed: of the atlas and the starts.
    """
    of = topology(family)
    pivots = {**pivots, "O": 0j, "D": complex(ground)}
    low, high = bounds(of, parts, pivots, limits.within, (0j, ground))
    coupler = list(of.bodies).index("coupler")
    point = of.columns[coupler, len(of.bodies["coupler"]) - 1]
    low[point : point + 2] = high[point : point + 2] = 0.0
    base, unit = np.zeros(2), np.ones(2)
    low[-4:], high[-4:] = -np.inf, np.inf
    if fixed[1]:
        low[-2:] = high[-2:] = 1.0
    else:
        base, span = pairs.min(axis=0), np.ptp(pairs, axis=0)
        unit = np.where(span > 0.0, span, 1.0)
        low[-2], high[-2] = 0.1, 2.0 * np.pi
    if fixed[0]:
        low[-4:-2] = high[-4:-2] = 0.0
    crank, arm = ((pairs - base) / unit).T
    task = Task(of, low, high, None, crank, arm)
    random = np.random.default_rng(seed)
    linkage, angles = for_function(task, atlas(family, _ATLAS, seed), starts, fixed, random)
    linkage, angles = _improved(task, linkage, angles)
    used = fixed[1] | (abs(linkage[:, -1]) > 0.1)
    linkage, angles = linkage[used], angles[used]
    linkage[:, point] = 0.5 * linkage[:, of.columns[coupler, 1]]
    return _collected(task, linkage, angles, limits, (0j, ground), np.zeros(0, dtype=complex))


def _apart(places: Complexes, size: float) -> None:
    """Refuse points that are the same, or neighbours of a curve that are."""
    if len(places) < 2:
        refuse("points", f"{len(places)}; at least two")
    for k in range(1, len(places)):
        first = 0 if len(places) <= 9 else k - 1
        same = np.flatnonzero(abs(places[first:k] - places[k]) < tasks.SAME * size)
        if len(same):
            told = f"points {first + int(same[0]) + 1} and {k + 1} are the same"
            refuse("points", f"{told}; leave one of them out")


def _improved(task: Task, linkage: Floats, angles: Floats) -> tuple[Floats, Floats]:
    """Six-bars near starts: some positions first, then all of them, with gaps that vanish."""
    if len(linkage):
        n = task.count
        chosen = np.unique(np.linspace(0, n - 1, min(n, _FIRST)).round().astype(int))
        linkage, some, sums = fitted(task.part(chosen), linkage, angles[:, chosen], *_STAGES[0])
        best = np.argsort(sums, kind="stable")[: _SECOND if n > _FIRST else len(sums)]
        at = np.interp(np.arange(n), chosen, np.arange(len(chosen)))
        angles = between(some, best, np.tile(at, (len(best), 1)))
        linkage = linkage[best]
        for stage in _STAGES[1:]:
            linkage, angles, sums = fitted(task, linkage, angles, *stage)
    return linkage, angles


def _errors(task: Task, linkage: Floats, angles: Floats) -> Floats:
    """The largest errors of closed six-bars, in units of the task and rad."""
    found, _, _ = task.residuals(linkage, angles, 1.0)
    rest = found[:, :, 2 * len(task.family.closures) :]
    if task.places is not None:
        rest = np.concatenate([np.hypot(rest[..., :1], rest[..., 1:2]), abs(rest[..., 2:])], axis=2)
    return np.asarray(abs(rest).max(axis=(1, 2), initial=0.0))


def _collected(
    task: Task,
    linkage: Floats,
    angles: Floats,
    limits: Limits,
    frame: tuple[complex, float],
    places: Complexes,
) -> Found:
    """Candidates from fitted linkages.

    Raises:
        ModelError: none closes.
    """
    of = task.family
    if task.crank is not None and len(linkage):
        aim = linkage[:, -4, None] + linkage[:, -2, None] * task.crank
        angles[:, :, of.crank] = aim
    angles = of.closed(linkage, angles)
    lengths = linkage[:, [of.columns[k, 1] for k in range(len(of.bodies))]]
    good = np.isfinite(angles).all(axis=(1, 2)) & np.isfinite(linkage).all(axis=1)
    good &= lengths.min(axis=1) > tasks.SAME * abs(linkage[:, : of.angles]).max(axis=1)
    linkage, angles = linkage[good], angles[good]
    if not len(linkage):
        hint = "try another seed or more starts, leave parts or pivots free, or change the task"
        raise ModelError(f"no {of.name} found that closes at all positions", hint=hint)
    errors = _errors(task, linkage, angles)
    size = abs(linkage[:, : of.angles]).max(axis=1)
    errors = np.where(errors < 1e-10, 0.0, errors)
    kept: list[int] = []
    for k in np.lexsort((size, errors)):
        apart = abs(linkage[kept] - linkage[k]).max(axis=1, initial=np.inf if not kept else 0.0)
        if not (apart < _NEAR * size[k]).any():
            kept.append(int(k))
        if len(kept) == _JUDGED:
            break
    linkage, angles = linkage[kept], angles[kept]
    errors = _errors(task, linkage, angles) * (frame[1] if task.places is not None else 1.0)
    linkage[:, : of.angles] *= frame[1]
    ends = slice(0, 2 * len(of.ground))
    linkage[:, ends] += np.tile([frame[0].real, frame[0].imag], len(of.ground))
    at = of.points(linkage, angles[:, :1])
    made = []
    for k, error in enumerate(errors):
        pins = tuple(complex(at[name][k, 0]) for name in of.names)
        crank = angles[k, :, of.crank]
        one = SixBar(pins, 0.0, float(error), 0.0, False, True, (), crank, limits.masses, of)
        made.append(one)
    return _ranked(judged(made, linkage, angles, limits.way), limits, places)


def _ranked(made: list[SixBar], limits: Limits, places: Complexes) -> Found:
    """Candidates within limits, best first, and how many each defect or limit excludes."""
    excluded: dict[str, int] = {}
    kept = []
    for one in made:
        beyond = []
        if limits.transmission_angle is not None and one.transmission_angle < limits.transmission_angle:
            beyond.append("transmission angle: beyond the limit")
        if limits.grashof and not one.turns:
            beyond.append("grashof: beyond the limit")
        one = replace(one, defects=(*one.defects, *beyond))
        for told in one.defects:
            kind = told.partition(":")[0]
            excluded[kind] = excluded.get(kind, 0) + (not limits.tell)
        if limits.tell or not one.defects:
            kept.append(one)

    def key(one: SixBar) -> tuple[float, ...]:
        error = one.error if one.error > tasks.SAME * one.size else 0.0
        least = round(min(one.transmission_angle, np.pi / 4) * 100.0)
        return len(one.defects), error, -least, one.size

    return Found(sorted(kept, key=key), False, {k: n for k, n in excluded.items() if n}, places)


__all__ = ["FAMILIES", "STARTS", "function_of", "path_of"]
