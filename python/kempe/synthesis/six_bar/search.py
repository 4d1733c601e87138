"""Six-bars for functions and paths: bounds, starts, least squares, and candidates."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.model.values import Number, refuse
from kempe.synthesis import tasks
from kempe.synthesis.candidate import Candidate
from kempe.synthesis.found import Found, ended_early
from kempe.synthesis.six_bar.candidate import SixBar
from kempe.synthesis.six_bar.fit import Task, fitted
from kempe.synthesis.six_bar.judge import judged
from kempe.synthesis.six_bar.prescribed import bounds
from kempe.synthesis.six_bar.starts import atlas, between, for_function, for_path
from kempe.synthesis.six_bar.topology import FAMILIES, Topology
from kempe.synthesis.tasks import Complexes

if TYPE_CHECKING:
    from kempe.synthesis.assemble import Limits

#: Starts, those that are fitted to all positions, and six-bars whose defects are computed.
STARTS, _SECOND, _JUDGED = 64, 16, 24
#: Six-bars of the atlas.
_ATLAS = 600
#: Positions of the first fit.
_FIRST = 12
#: Weight of the gaps, steps, and the part of the error that keeps away from dead points.
_STAGES = ((2.0, 40, 0.1), (10.0, 60, 0.1), (1e3, 40, 0.03), (1e3, 30, 1e-3), (1e3, 30, 1e-3))
#: Rounds of starts until a six-bar has no defect.
_ROUNDS = 3
#: The least scales of angles if they are free.
_LEAST = 0.1
#: Two six-bars are nearly the same within this share of their size.
_NEAR = 1e-3


@dataclass(frozen=True)
class Asked:
    """What is asked besides the task, as the arguments of ``path`` and ``function``."""

    family: Topology
    limits: Limits
    pivots: Mapping[str, Sequence[Number]] | None
    parts: Mapping[str, Any] | None
    starts: int | None
    seed: int
    progress: tasks.Progress | None = None

    def bounds(
        self, frame: tuple[complex, float], more: Mapping[str, complex], free: str
    ) -> tuple[Floats, Floats]:
        """Bounds of the unknowns of a linkage: prescribed parts, pivots, and the box of pivots.

        Args:
            frame: origin and unit of the task.
            more: pivots that the task fixes.
            free: names of the others.
        """
        pivots = {**tasks.pivots(self.pivots, " ".join(free)), **more}
        return bounds(self.family, self.parts, pivots, self.limits.within, frame)


def path(asked: Asked, places: Complexes, cranks: Sequence[float], *, fixed: bool) -> Found:
    """Six-bars whose point P passes points.

    Args:
        asked: the family and the limits.
        places: the points, m.
        cranks: angles of the crank, rad; empty if they are free.
        fixed: whether these angles are measured from the x axis.

    Raises:
        ModelError: no six-bar was found, or the points or parts are wrong.
    """
    of, frame = asked.family, (complex(places.mean()), tasks.size(places))
    _apart(places, frame[1])
    low, high = asked.bounds(frame, {}, of.ground)
    low[-4:] = high[-4:] = [0.0, 0.0, 1.0, 1.0]
    given = np.unwrap(np.asarray(cranks, dtype=float)) if len(cranks) else None
    if given is not None and not fixed:
        low[-4], high[-4] = -np.inf, np.inf
    task = Task(of, low, high, (places - frame[0]) / frame[1], given)

    def started(seed: int) -> tuple[Floats, Floats]:
        random = np.random.default_rng(seed)
        found = for_path(task, atlas(of.name, _ATLAS, seed), asked.starts or STARTS, random)
        if given is not None and not fixed:
            own = np.exp(1j * (found[1][:, :, of.crank] - given))
            found[0][:, -4] = np.angle(own.mean(axis=1))
        return found

    return _searched(task, asked, started, frame, places=places)


def function(asked: Asked, pairs: Floats, fixed: tuple[bool, bool], ground: float) -> Found:
    """Six-bars whose arm has angles at angles of the crank.

    Args:
        asked: the family and the limits.
        pairs: angles of crank and arm, rad, or numbers for free scales, (n, 2).
        fixed: whether the offsets and the scales are fixed.
        ground: the distance of O and D, m.

    Raises:
        ModelError: no six-bar was found, or the parts are wrong.
    """
    if asked.starts is not None and asked.starts < 1:
        refuse("samples", f"{asked.starts}; at least one")
    of, frame = asked.family, (0j, ground)
    low, high = asked.bounds(frame, {"O": 0j, "D": complex(ground)}, of.ground.strip("OD"))
    coupler = list(of.bodies).index("coupler")
    point = of.columns[coupler, len(of.bodies["coupler"]) - 1]
    given = low[point : point + 2].copy()
    low[point : point + 2] = high[point : point + 2] = 0.0
    base, unit = np.zeros(2), np.ones(2)
    low[-4:], high[-4:] = -np.inf, np.inf
    if fixed[1]:
        low[-2:] = high[-2:] = 1.0
    else:
        base, span = pairs.min(axis=0), np.ptp(pairs, axis=0)
        unit = np.where(span > 0.0, span, 1.0)
        low[-2], high[-2] = _LEAST, 2.0 * np.pi
    if fixed[0]:
        low[-4:-2] = high[-4:-2] = 0.0
    crank, arm = ((pairs - base) / unit).T
    task = Task(of, low, high, None, crank, arm)

    def started(seed: int) -> tuple[Floats, Floats]:
        random = np.random.default_rng(seed)
        most = asked.starts or STARTS
        return for_function(task, atlas(of.name, _ATLAS, seed), most, fixed, random)

    def placed(linkage: Floats) -> None:
        """P is the middle of the coupler, or where it is prescribed."""
        linkage[:, point] = 0.5 * linkage[:, of.columns[coupler, 1]]
        if np.isfinite(given).all():
            linkage[:, point : point + 2] = given

    return _searched(task, asked, started, frame, places=np.zeros(0, dtype=complex), placed=placed)


def _searched(
    task: Task,
    asked: Asked,
    started: Callable[[int], tuple[Floats, Floats]],
    frame: tuple[complex, float],
    *,
    places: Complexes,
    placed: Callable[[Floats], None] | None = None,
) -> Found:
    """Candidates of several rounds of starts, until one is without defects."""
    made: list[SixBar] = []
    try:
        for k in range(_ROUNDS):
            if asked.progress is not None:
                asked.progress(k, _ROUNDS)
            linkage, angles = _improved(task, *started(asked.seed + 1000 * k))
            # a scale of the arm near zero fits any function
            used = abs(linkage[:, -1]) >= _LEAST
            linkage, angles = _closed(task, linkage[used], angles[used])
            if placed is not None:
                placed(linkage)
            made += _candidates(task, linkage, angles, asked.limits, frame)
            found = _ranked(made, asked.limits, places)
            if any(not one.defects for one in found):
                return found
    except KeyboardInterrupt as error:
        raise ended_early(error, _ranked(made, asked.limits, places) if made else None) from None
    if not made:
        hint = "try another seed or more starts, leave parts or pivots free, or change the task"
        raise ModelError(f"no {task.family.name} found that closes at all positions", hint=hint)
    return found


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
    n = task.count
    chosen = np.unique(np.linspace(0, n - 1, min(n, _FIRST)).round().astype(int))
    for k, (weight, steps, guard) in enumerate(_STAGES if len(linkage) else ()):
        some = task.part(chosen) if k == 0 else task
        given = angles[:, chosen] if k == 0 else angles
        linkage, angles, sums = fitted(
            some, linkage, given, weight=weight, steps=steps, guard=guard
        )
        if k == 0:
            best = np.argsort(sums, kind="stable")[: _SECOND if n > _FIRST else len(sums)]
            at = np.interp(np.arange(n), chosen, np.arange(len(chosen)))
            linkage, angles = linkage[best], between(angles, best, np.tile(at, (len(best), 1)))
    return linkage, angles


def _errors(task: Task, linkage: Floats, angles: Floats) -> Floats:
    """The largest errors of closed six-bars, in units of the task and rad."""
    found, _, _ = task.residuals(linkage, angles, 1.0)
    rest = found[:, :, 2 * len(task.family.closures) :]
    if task.places is not None:
        rest = np.concatenate([np.hypot(rest[..., :1], rest[..., 1:2]), abs(rest[..., 2:])], axis=2)
    return np.asarray(abs(rest).max(axis=(1, 2), initial=0.0))


def _closed(task: Task, linkage: Floats, angles: Floats) -> tuple[Floats, Floats]:
    """Different linkages that close at all positions, those with the least errors first."""
    of = task.family
    if task.crank is not None and len(linkage):
        aim = linkage[:, -4, None] + linkage[:, -2, None] * task.crank
        angles[:, :, of.crank] = aim
    angles = of.closed(linkage, angles)
    lengths = linkage[:, [of.columns[k, 1] for k in range(len(of.bodies))]]
    good = np.isfinite(angles).all(axis=(1, 2)) & np.isfinite(linkage).all(axis=1)
    good &= lengths.min(axis=1) > tasks.SAME * abs(linkage[:, : of.angles]).max(axis=1)
    linkage, angles = linkage[good], angles[good]
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
    return linkage[kept], angles[kept]


def _candidates(
    task: Task, linkage: Floats, angles: Floats, limits: Limits, frame: tuple[complex, float]
) -> list[SixBar]:
    """Six-bars with their defects from closed linkages."""
    of = task.family
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
    return judged(made, linkage, angles, limits.way) if made else made


def _ranked(made: list[SixBar], limits: Limits, places: Complexes) -> Found:
    """Candidates within limits, best first, and how many each defect or limit excludes."""
    excluded: dict[str, int] = {}
    kept = []
    for one in made:
        beyond = []
        if (
            limits.transmission_angle is not None
            and one.transmission_angle < limits.transmission_angle
        ):
            beyond.append("transmission angle: beyond the limit")
        if limits.grashof and not one.turns:
            beyond.append("grashof: beyond the limit")
        whole = replace(one, defects=(*one.defects, *beyond))
        for told in whole.defects:
            kind = told.partition(":")[0]
            excluded[kind] = excluded.get(kind, 0) + (not limits.tell)
        if limits.tell or not whole.defects:
            kept.append(whole)

    def key(one: Candidate) -> tuple[float, ...]:
        error = one.error if one.error > tasks.SAME * one.size else 0.0
        least = round(min(one.transmission_angle, np.pi / 4) * 100.0)
        return len(one.defects), error, -least, one.size

    return Found(sorted(kept, key=key), False, {k: n for k, n in excluded.items() if n}, places)


__all__ = ["FAMILIES", "Asked", "function", "path"]
