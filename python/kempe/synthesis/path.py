"""Path synthesis: four-bars whose coupler point passes given points."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import Any

import numpy as np

from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.model.given import value
from kempe.model.values import Number, refuse
from kempe.synthesis import assemble, tasks
from kempe.synthesis.assemble import Bars
from kempe.synthesis.cognates import cognate_bars
from kempe.synthesis.dyads import Conditions
from kempe.synthesis.fit import EXACT, Start, Task, distinct
from kempe.synthesis.found import Found
from kempe.synthesis.tasks import Complexes

#: Cranks that are sampled, and couplers for each of them; random starts.
_CRANKS, _COUPLERS, STARTS = 60, 24, 160
#: Subsets of the points from which least squares start.
_SUBSETS = 24
#: Sets of random crank angles for up to five points; rounds of starts until one is exact.
_TIMES, _ROUNDS = 120, 12
#: Most points that can be exact; for more, rounds of starts with a few points, and those kept.
MOST, _MANY, _KEPT = 9, 4, 12


@explained
def path(
    points: Sequence[Sequence[Number]],
    family: str = "four_bar",
    angles: Sequence[Number] | None = None,
    *,
    offsets: str = "free",
    pivots: Mapping[str, Sequence[Number]] | None = None,
    starts: int = STARTS,
    seed: int = 0,
    **limits: Any,
) -> Found:
    """Four-bars whose coupler point passes points, in the given order.

    With crank angles, all solutions for five points are found, by elimination. Fewer points leave
    choices, which are sampled; up to four can be exact if the angles are measured from the x axis.
    Without angles, up to nine points can be exact: the method of Levenberg and Marquardt starts
    from random four-bars, so that solutions may be missing. More points are approximated by least
    squares.

    Args:
        points: x and y, m.
        family: "four_bar".
        angles: angle of the crank at each point, rad, or texts such as "30 deg"; None if free.
        offsets: "free" if only differences of the angles count, "fixed" if they are measured from
            the x axis.
        pivots: fixed ground pivots, ``{"O": (x, y), "D": (x, y)}``, m; O belongs to the crank.
        starts: number of random starts.
        seed: of samples and starts.
        limits: ``defects``, ``transmission_angle``, ``grashof``, ``within``, ``direction`` and
            ``masses``; ``limits`` describes them.

    Raises:
        ModelError: no four-bar was found, or an argument is invalid.
    """
    assemble.families(family)
    asked, places = assemble.limits(**limits), tasks.points(points)
    fixed = tasks.pivots(pivots, "O D")
    if offsets not in ("free", "fixed"):
        refuse("offsets", f"{offsets!r}; must be 'free' or 'fixed'")
    free = offsets == "free"
    cranks = None if angles is None else _angles(angles, len(places))
    task = Task(places, None, cranks, free, fixed)
    exact = cranks is not None and len(places) <= 4 + free and not fixed
    if exact:
        assert cranks is not None
        bars = _timed(places, cranks, free, seed)
    else:
        bars = together([]) if cranks is None or fixed else _from_parts(task, seed)
        bars = bars if len(bars.o) else _searched(task, starts, seed)
    if not len(bars.o):
        hint = "move or leave out a point, relax the angles or pivots, or try another seed"
        raise ModelError(f"points: no four-bar found for all {len(places)} points", hint=hint)
    complete = exact and len(places) == 5
    either = cranks is None and not fixed
    return assemble.collected(bars, asked, either=either, complete=complete, task=places)


def _angles(given: Sequence[Number], n: int) -> Floats:
    found = np.array([value(x, f"angles[{k}]", "rad") for k, x in enumerate(given, 1)])
    if len(found) != n:
        refuse("angles", f"{len(found)} for {n} points; one for each point")
    at = tasks.turns(found)
    for k in range(1, n):
        if (np.abs(at[:k] - at[k]).max(axis=1) < tasks.SAME).any():
            refuse("angles", f"angle {k + 1} occurs twice; a crank has one point at each angle")
    return found


def _timed(
    places: Complexes,
    cranks: Floats,
    free: bool,
    seed: int,
    counts: tuple[int, int] = (_CRANKS, _COUPLERS),
) -> Bars:
    """Four-bars with given crank angles by dyads, first of the crank, then of the rocker.

    Seen from the crank, the ground is a moving plane with the poses (P e^{-iβ}, -β), and |P - A| is
    constant. The dyads of this plane give O and A, hence the angles of the coupler, and its other
    dyads give B and D.

    Args:
        places: the points.
        cranks: angles of the crank.
        free: whether only their differences count.
        seed: of samples.
        counts: samples of cranks, and of couplers for each of them.
    """
    seen = Conditions(places * np.exp(-1j * cranks), -cranks, "point")
    line = seen.line(3, 0.0, 1.0, -seen.origin.imag / seen.size)
    more = None if free else line[None]
    kinds = "pin pivot" if free else "pin"
    first = seen.all(counts[0], seed, more=more, kinds=kinds).of("pin")
    parts = []
    for k, (pin, arm) in enumerate(zip(first.pin, first.pivot, strict=True)):
        if not free and arm.real < 0.0:  # the crank would point the other way
            continue
        o = places[0] - pin * np.exp(1j * cranks[0])
        a = o + arm * np.exp(1j * cranks)
        frames = np.angle(places - a)
        conditions = Conditions(places, frames)
        try:
            second = conditions.all(counts[1], seed + k).of("pin")
        except ModelError:  # the coupler does not turn
            continue
        other = abs(second.pin - a[0]) > 1e-6 * abs(a[0] - o)
        pins, d = second.pin[other], second.pivot[other]
        b = assemble.moved(pins, places, frames)
        error = abs(abs(b - d[:, None]) - abs(pins - d)[:, None]).max(axis=1, initial=0.0)
        one = np.ones(len(d))
        both = np.multiply.outer(one, a), np.multiply.outer(one, places)
        parts.append(Bars(o * one, both[0], b, d, both[1], np.angle(b[:, 0] - a[0]), error))
    return together(parts)


def together(parts: list[Bars]) -> Bars:
    """Four-bars of several lists."""
    parts = [part for part in parts if len(part.o)]
    if not parts:
        none, wide = np.zeros(0, dtype=complex), np.zeros((0, 1), dtype=complex)
        return Bars(none, wide, wide, none, wide, np.zeros(0), np.zeros(0))
    names = Bars.__dataclass_fields__
    return Bars(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def _from_parts(task: Task, seed: int) -> Bars:
    """Least squares for many points with crank angles, from four-bars exact at some of them."""
    assert task.cranks is not None
    random, n = np.random.default_rng(seed), len(task.places)
    starts = []
    for k in range(_SUBSETS):
        chosen = np.sort(random.choice(n, 4 + task.offset, replace=False))
        starts += _of_timed(task, chosen, (_CRANKS, 2), seed + k)
    return _best(task, starts)


def _spread(task: Task, part: Task, start: Start, cranks: Floats) -> Start:
    """A four-bar of some of the points, with its crank at an angle for each point.

    Args:
        task: all points.
        part: some of them.
        start: the four-bar, relative to them.
        cranks: angles of the crank for all points.
    """
    ratio, shift = part.size / task.size, (part.centre - task.centre) / task.size
    x = [ratio * value for value in start.linkage[:9]] + start.linkage[9:]
    for k in (0, 6):
        x[k], x[k + 1] = x[k] + shift.real, x[k + 1] + shift.imag
    pin = complex(x[0], x[1]) + x[2] * np.exp(1j * cranks)
    toward = task.relative(task.places) - pin
    coupler = np.unwrap(np.angle(toward) - np.angle(complex(x[4], x[5])))
    return Start(x, np.column_stack([cranks, coupler]))


def _of_timed(task: Task, chosen: Any, counts: tuple[int, int], seed: int) -> list[Start]:
    """Four-bars that pass some points at the crank angles of a task."""
    assert task.cranks is not None
    cranks = task.cranks[chosen]
    part = replace(task, places=task.places[chosen], cranks=cranks)
    bars = _timed(part.places, cranks, task.offset, seed, counts).shapely()
    starts = [part.start_of(bars, k) for k in range(len(bars.o))]
    return [_spread(task, part, one, one.linkage[9] + task.cranks) for one in starts]


def _searched(task: Task, starts: int, seed: int) -> Bars:
    """Exact four-bars or the best approximations from random starts."""
    random, n = np.random.default_rng(seed), len(task.places)
    if n <= 5 and not task.pivots:
        cranks = (_cranks(task, random) for _ in range(_TIMES))
        return together([_timed(task.places, one, True, k, (6, 6)) for k, one in enumerate(cranks)])
    if n > MOST:
        return _best(task, _from_few(task, starts, random))
    ready = _timed_starts(task, random)
    if task.pivots:
        ready = (_start(task, random) for _ in range(starts * _ROUNDS))
    bars = together([])
    for _ in range(_ROUNDS):
        bars = _best(task, list(islice(ready, starts)))
        if len(bars.o) and not (task.exact and bars.error.min() > EXACT * task.size):
            break
    return bars


def _from_few(task: Task, starts: int, random: np.random.Generator) -> list[Start]:
    """Starts for many points: the best four-bars for a few of them."""
    n = len(task.places)
    chosen = np.linspace(0, n - 1, MOST + 1).round().astype(int)
    part = replace(task, places=task.places[chosen])
    ready = _timed_starts(part, random)
    if task.pivots or task.cranks is not None:
        part = part if task.cranks is None else replace(part, cranks=task.cranks[chosen])
        ready = (_start(part, random) for _ in range(starts * _MANY))
    found = [part.fitted(one, steps=60, closing=(1.0,)) for one in islice(ready, starts * _MANY)]
    found.sort(key=lambda one: one[1])
    spread = []
    for one, _ in found[:_KEPT]:
        cranks = np.interp(np.arange(n), chosen, one.positions[:, 0])
        spread.append(_spread(task, part, one, cranks))
    return spread


def _cranks(task: Task, random: np.random.Generator) -> Floats:
    """Random angles of a crank that turns one way through the points."""
    n = len(task.places)
    steps = random.exponential(size=n - 1) + 0.2
    least = 1.0 if n <= MOST else np.pi
    span = random.uniform(least, 2.0 * np.pi * (n - 1) / n) * random.choice([-1.0, 1.0])
    return np.asarray(np.concatenate([[0.0], np.cumsum(steps) / steps.sum()]) * span)


def _timed_starts(task: Task, random: np.random.Generator) -> Iterator[Start]:
    """Four-bars that pass five of the points at random crank angles."""
    while True:
        timed = replace(task, cranks=_cranks(task, random), offset=True)
        chosen = np.sort(random.choice(len(task.places), 5, replace=False))
        for start in _of_timed(timed, chosen, (0, 0), 0):
            yield Start([*start.linkage[:9], 0.0, 0.0], start.positions)


def _best(task: Task, starts: list[Start]) -> Bars:
    with np.errstate(all="ignore"):
        reached = [task.fitted(start) for start in starts]
    reached = [one for one in reached if np.isfinite(one[1])]
    if task.cranks is not None and not task.offset:
        reached = [one for one in reached if one[0].linkage[2] > 0.0]
    if task.exact and any(one[1] < EXACT**2 for one in reached):
        reached = [one for one in reached if one[1] < EXACT**2]
    reached.sort(key=lambda one: one[1])
    kept = [one[0] for one in reached[: len(reached) if task.exact else 40]]
    bars = distinct(task.bars(kept)) if kept else together([])
    if task.exact and task.cranks is None and not task.pivots:
        bars = bars.shapely()
        bars = distinct(together([bars, cognate_bars(bars).shapely()]))
    return bars


def _start(task: Task, random: np.random.Generator) -> Start:
    """A random four-bar: P is at all points, and A and B turn about O and D only nearly."""
    at, pins, pivots, radii = task.relative(task.places), [], [], []
    for name in "OD":
        given = (task.pivots or {}).get(name)
        pivot = complex(*random.normal(size=2)) * 1.2
        if given is not None:
            pivot = complex(task.relative(np.array([given]))[0])
        far = abs(at - pivot)
        radius = np.ptp(far) / 2.0 * (1.0 + random.exponential(0.7)) + random.uniform(0.02, 0.3)
        low, high = abs(far.max() - radius), far.min() + radius
        bar = random.uniform(min(low, high), max(low, high))
        cosine = (radius**2 + far**2 - bar**2) / (2.0 * radius * far + 1e-12)
        side = random.choice([-1.0, 1.0]) * np.arccos(np.clip(cosine, -1.0, 1.0))
        pins.append(pivot + radius * np.exp(1j * (np.angle(at - pivot) + side)))
        pivots.append(pivot)
        radii.append(radius)
    (a, b), (o, d) = pins, pivots
    toward = np.angle(at - a)
    bar = float(np.mean(abs(b - a)))
    between = float(np.angle(np.mean((b - a) / abs(b - a) * np.exp(-1j * toward))))
    coupler = np.unwrap(toward + between)
    point = float(np.mean(abs(at - a))) * np.exp(-1j * between)
    crank = np.unwrap(np.angle(a - o))
    offset = 0.0
    if task.cranks is not None:
        offset = float(np.angle(np.mean(np.exp(1j * (crank - task.cranks))))) * task.offset
        crank = offset + task.cranks
    x = [
        o.real,
        o.imag,
        radii[0],
        bar,
        point.real,
        point.imag,
        d.real,
        d.imag,
        radii[1],
        offset,
        0.0,
    ]
    return Start([float(value) for value in x], np.column_stack([crank, coupler]))
