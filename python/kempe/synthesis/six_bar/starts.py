"""An atlas of six-bars, and those of it that resemble a task."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.synthesis.six_bar.fit import Task
from kempe.synthesis.six_bar.topology import Topology, topology
from kempe.synthesis.tasks import Complexes

#: Positions of a turn of the crank in the atlas, and coupler points of each six-bar.
TURN, _POINTS = 36, 3
#: Points of equal distance with which curves are compared, and parts of a turn that are compared.
_COMPARED, _PARTS = 16, (5, 8, 12, 18, 24, 30, 36)
#: Starts from the same six-bar of the atlas.
_EACH = 2


class Atlas:
    """Random six-bars with O at (0, 0) and D at (1, 0), each with its mirror image.

    Attributes:
        linkage: (n, size).
        angles: of the bodies, (n, 2 TURN + 1, n_bodies); NaN where the six-bar does not close. A
            crank that turns fully makes two turns, any other one half a turn to both sides.
    """

    def __init__(self, family: Topology, samples: int, seed: int) -> None:
        random = np.random.default_rng(seed)
        at = {
            name: random.normal(size=samples) + 1j * random.normal(size=samples)
            for name in family.names
        }
        at["A"] = at["O"] + random.uniform(0.1, 0.7, samples) * (at["A"] - at["O"])
        origin, unit = at["O"], at["D"] - at["O"]
        at = {name: (z - origin) / unit for name, z in at.items()}
        linkage, start = family.from_points(at)
        half = np.arange(1, TURN // 2 + 1) * (2.0 * np.pi / TURN)
        back, ahead = (
            family.followed(linkage, start, np.asarray(way * half)) for way in (-1.0, 1.0)
        )
        turn = np.concatenate([back[:, ::-1], start[:, None], ahead], axis=1)
        with np.errstate(invalid="ignore"):
            gap = abs(np.exp(1j * turn[:, -1]) - np.exp(1j * turn[:, 0])).max(axis=1)
        more = turn[:, 1:] + (turn[:, -1:] - turn[:, :1])
        more[~(gap < 1e-6)] = np.nan
        turns = np.concatenate([turn, more], axis=1)
        other = linkage.copy()
        for (body, k), column in family.columns.items():
            if body < 0 or k > 1:
                other[:, column + 1] *= -1.0
        self.linkage, self.angles = (
            np.concatenate([linkage, other]),
            np.concatenate([turns, -turns]),
        )

    @property
    def turns(self) -> NDArray[Any]:
        """Whether each crank turns fully, (n,)."""
        return np.asarray(np.isfinite(self.angles[:, [0, -1], 0]).all(axis=1))


@lru_cache(maxsize=8)
def atlas(family: str, samples: int, seed: int) -> Atlas:
    """The atlas of a family."""
    return Atlas(topology(family), samples, seed)


def between(angles: Floats, rows: NDArray[Any], at: Floats) -> Floats:
    """Angles of the bodies at places between positions, (n_rows, n, n_bodies)."""
    low = np.clip(np.floor(at).astype(int), 0, angles.shape[1] - 2)
    share = (at - low)[..., None]
    after = np.where(share > 0.0, angles[rows[:, None], low + 1], 0.0)
    return np.asarray(angles[rows[:, None], low] * (1.0 - share) + after * share)


def for_function(
    task: Task, of: Atlas, most: int, fixed: tuple[bool, bool], random: np.random.Generator
) -> tuple[Floats, Floats]:
    """Starts whose arms have nearly the given angles."""
    assert task.crank is not None and task.arm is not None
    family, found = task.family, []
    first = of.angles[:, :, family.crank]
    middle = first[:, TURN // 2]
    way = np.where(np.arange(len(first)) < len(first) // 2, 1.0, -1.0) * TURN / (2.0 * np.pi)
    scales = [1.0] if fixed[1] else list(np.exp(random.uniform(np.log(0.3), np.log(6.0), 12)))
    for scale in scales:
        for phase in [0.0] if fixed[0] else np.arange(TURN) * (2.0 * np.pi / TURN):
            at = TURN // 2 + way[:, None] * (phase + scale * task.crank - middle[:, None])
            at = np.where(of.turns[:, None], at % TURN, at)
            if not fixed[0] or not of.turns.all():
                at = np.where((at < 0) & (at + TURN <= 2 * TURN), at % TURN, at)
            at = np.where((at >= 0.0) & (at <= 2 * TURN), at, np.nan)
            found.append(_arms(task, of, at, (phase, scale), fixed))
    errors, phases, scaled, offsets, arms, places = (
        np.concatenate(part) for part in zip(*found, strict=True)
    )
    rows = np.tile(np.arange(len(first)), len(found))
    chosen = _best(np.where(np.isfinite(errors), errors, np.inf), rows, most)
    linkage = of.linkage[rows[chosen]].copy()
    linkage[:, -4:] = np.stack(
        [phases[chosen], offsets[chosen], scaled[chosen], arms[chosen]], axis=1
    )
    return linkage, between(of.angles, rows[chosen], places[chosen])


def _arms(
    task: Task, of: Atlas, at: Floats, crank: tuple[float, float], fixed: tuple[bool, bool]
) -> tuple[Floats, ...]:
    """Errors, offsets and scales of the arms of all six-bars at some places."""
    assert task.arm is not None
    rows = np.arange(len(at))
    filled = np.nan_to_num(at)
    arm = between(of.angles[:, :, task.family.arm, None], rows, filled)[..., 0]
    arm = np.where(np.isfinite(at), arm, np.nan)
    if fixed[1]:
        scale = np.ones(len(at))
    else:
        arm = np.unwrap(arm, axis=1)
        own = task.arm - task.arm.mean()
        scale = ((arm - arm.mean(axis=1, keepdims=True)) @ own) / (own @ own)
    gap = np.exp(1j * (arm - scale[:, None] * task.arm))
    offset = np.zeros(len(at)) if fixed[0] else np.angle(gap.mean(axis=1))
    error = abs(np.angle(gap * np.exp(-1j * offset)[:, None])).max(axis=1)
    if not fixed[1]:
        error = np.where(abs(scale) > 0.2, error, np.inf)
    full = np.ones(len(at))
    return error, crank[0] * full, crank[1] * full, offset, scale, filled


def for_path(
    task: Task, of: Atlas, most: int, random: np.random.Generator
) -> tuple[Floats, Floats]:
    """Starts whose coupler points move along nearly the given curve."""
    assert task.places is not None
    family, places = task.family, task.places
    half = len(of.linkage) // 2
    coupler = list(family.bodies).index("coupler")
    column = family.columns[coupler, len(family.bodies["coupler"]) - 1]
    known = of.turns[:half] if closed(places) else np.ones(half, dtype=bool)
    rows = np.repeat(np.flatnonzero(known), _POINTS)
    linkage, angles = of.linkage[rows].copy(), of.angles[rows]
    own = random.normal(size=(len(rows), 2)) * abs(linkage[:, family.columns[coupler, 1]])[:, None]
    linkage[:, column : column + 2] = own
    curve = family.points(linkage, np.nan_to_num(angles))["P"]
    curve[~np.isfinite(angles[:, :, 0])] = np.nan
    windows = _windows(places)
    arcs = along(places)
    aim = _normal(np.interp(np.linspace(0.0, 1.0, _COMPARED), arcs, places)[None])[0]
    scores, kinds = [], []
    for first, last in windows:
        drawn = _resampled(curve, first, last)
        shown = _normal(drawn)
        for mirror in (False, True):
            for reverse in (False, True):
                w = shown.conj() if mirror else shown
                w = w[:, ::-1] if reverse else w
                scores.append(1.0 - abs(w @ aim.conj()) ** 2)
                kinds.append((first, last, mirror, reverse))
    errors = np.concatenate(scores)
    errors = np.where(np.isfinite(errors), errors, np.inf)
    chosen = _best(errors, np.tile(rows, len(kinds)), most)
    made = [
        _placed(
            task,
            linkage[k % len(rows)],
            angles[k % len(rows)],
            curve=curve[k % len(rows)],
            kind=kinds[k // len(rows)],
            arcs=arcs,
        )
        for k in chosen
    ]
    return np.stack([one[0] for one in made]), np.stack([one[1] for one in made])


def _windows(places: Complexes) -> list[tuple[int, int]]:
    """The parts of a turn, or of two, with which a task is compared."""
    if closed(places):
        return [(first, first + TURN) for first in range(TURN)]
    return [
        (first, first + part)
        for part in _PARTS
        for first in range(0, 2 * TURN + 1 - part, 3)
        if first < TURN or part > TURN // 2
    ]


def closed(places: Complexes) -> bool:
    """Whether a curve through points is closed: its ends are as near as its points."""
    apart = abs(np.diff(places))
    return len(places) > 4 and bool(abs(places[-1] - places[0]) <= 2.0 * apart.max())


def along(places: Complexes) -> Floats:
    """The distances along a polyline, from 0 to 1; to its beginning if it is nearly closed."""
    apart = abs(np.diff(places))
    total = apart.sum()
    if closed(places):
        total += abs(places[-1] - places[0])
    return np.asarray(np.concatenate([[0.0], np.cumsum(apart)]) / total)


def _resampled(curve: Complexes, first: int, last: int) -> Complexes:
    """Points at equal distances along a part of curves, (n, _COMPARED)."""
    part = curve[:, first : last + 1]
    arcs = np.concatenate([np.zeros((len(part), 1)), np.cumsum(abs(np.diff(part)), axis=1)], axis=1)
    bad = ~np.isfinite(arcs[:, -1])
    arcs = np.where(bad[:, None], np.linspace(0.0, 1.0, part.shape[1]), arcs / arcs[:, -1:])
    shift = 2.0 * np.arange(len(part))[:, None]
    asked = (np.linspace(0.0, 1.0, _COMPARED) + shift).ravel()
    found = np.interp(asked, (arcs + shift).ravel(), np.nan_to_num(part).ravel())
    drawn = found.reshape(-1, _COMPARED)
    drawn[bad] = np.nan
    return np.asarray(drawn)


def _normal(curves: Complexes) -> Complexes:
    own = curves - curves.mean(axis=1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(own / np.sqrt((abs(own) ** 2).sum(axis=1, keepdims=True)))


def _placed(
    task: Task,
    linkage: Floats,
    angles: Floats,
    *,
    curve: Complexes,
    kind: tuple[int, int, bool, bool],
    arcs: Floats,
) -> tuple[Floats, Floats]:
    """A six-bar turned, scaled and moved to the points of a task, with its angles at them."""
    first, last, mirror, reverse = kind
    assert task.places is not None
    family, part = task.family, curve[first : last + 1]
    own = np.concatenate([[0.0], np.cumsum(abs(np.diff(part)))])
    share = np.interp((1.0 - arcs) if reverse else arcs, own / own[-1], np.arange(first, last + 1))
    turned = between(angles[None], np.zeros(1, dtype=int), share[None])[0]
    linkage = linkage.copy()
    if mirror:
        turned = -turned
        for (body, k), column in family.columns.items():
            if body < 0 or k > 1:
                linkage[column + 1] *= -1.0
    here = family.points(linkage[None], turned[None])["P"][0]
    w, z = here - here.mean(), task.places - task.places.mean()
    ratio = (w.conj() @ z) / (w.conj() @ w).real
    linkage[: family.angles] *= abs(ratio)
    for k in range(len(family.ground)):
        at = complex(linkage[2 * k], linkage[2 * k + 1]) / (abs(ratio) or 1.0)
        at = ratio * (at - here.mean()) + task.places.mean()
        linkage[2 * k], linkage[2 * k + 1] = at.real, at.imag
    return linkage, turned + np.angle(ratio)


def _best(errors: Floats, rows: NDArray[Any], most: int) -> NDArray[Any]:
    """The places of the least errors, with few of each row."""
    order = np.argsort(errors, kind="stable")[: 40 * most]
    order = order[np.isfinite(errors[order])]
    kept, count = [], dict[int, int]()
    for k in order:
        row = int(rows[k])
        if count.get(row, 0) < _EACH:
            count[row] = count.get(row, 0) + 1
            kept.append(k)
        if len(kept) == most:
            break
    return np.array(kept, dtype=int)
