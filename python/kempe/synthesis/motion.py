"""Motion synthesis: linkages whose coupler takes given poses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from kempe import _core
from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.model.values import Number
from kempe.synthesis import assemble, tasks
from kempe.synthesis.assemble import Bars, Slides
from kempe.synthesis.dyads import Conditions
from kempe.synthesis.found import Found
from kempe.synthesis.tasks import Complexes

#: Dyads that are sampled if some of their choices are free.
SAMPLES = 240
#: Subsets of more than five poses from which least squares start, and starts.
_SUBSETS, _STARTS = 24, 30


@explained
def motion(
    poses: Sequence[tasks.Pose],
    family: str = "four_bar",
    *,
    pivots: Mapping[str, Sequence[Number]] | None = None,
    samples: int = SAMPLES,
    seed: int = 0,
    **limits: Any,
) -> Found:
    """Linkages whose coupler takes poses, in the given order.

    Five poses have at most four dyads and so at most six four-bars. All of them are found, by
    elimination. Two to four poses leave free choices, which are sampled: the candidates are the
    best 100. More than five poses are approximated by least squares from several starts. Either
    dyad may be the crank; a candidate has the better one.

    Args:
        poses: x and y of the moving frame, m, and its angle, rad; numbers or texts ("30 deg").
        family: "four_bar"; or "slider_crank" for two to four poses, whose slides have all
            directions.
        pivots: fixed ground pivots, ``{"O": (x, y), "D": (x, y)}``, m; O belongs to the crank.
        samples: number of dyads that are sampled if some of their choices are free.
        seed: of the samples.
        limits: ``defects``, ``transmission_angle``, ``grashof``, ``within``, ``direction`` and
            ``masses``; ``limits`` describes them.

    Raises:
        ModelError: no linkage takes the poses, two of them are the same, or a pivot contradicts
            them.
    """
    assemble.families(family, ("four_bar", "slider_crank"), limits)
    places, angles = tasks.poses(poses)
    fixed = tasks.pivots(pivots, "O D" if family == "four_bar" else "O")
    asked = assemble.limits(**limits)
    if family == "slider_crank":
        slides = _slides(places, angles, fixed.get("O"), samples, seed)
        return assemble.collected(
            slides, asked, either=False, complete=False, task=places, poses=poses
        )
    if len(places) > 5:
        bars = _fitted(places, angles, fixed, seed)
        return assemble.collected(
            bars, asked, either=not fixed, complete=False, task=places, poses=poses
        )
    bars, complete = _exact(places, angles, fixed, samples, seed)
    return assemble.collected(
        bars, asked, either=not fixed, complete=complete, task=places, poses=poses
    )


def _exact(
    places: Complexes, angles: Floats, fixed: Mapping[str, complex], samples: int, seed: int
) -> tuple[Bars, bool]:
    """Four-bars of pairs of dyads, and whether these are all."""
    flat, error, complete = _core.four_bars(
        tasks.pairs_in(places), angles.tolist(), tasks.both(fixed), samples, seed
    )
    n = len(places)
    found = flat.view(np.complex128).reshape(len(error), 2 * n + 2)
    a, b = found[:, 1 : n + 1], found[:, n + 1 : 2 * n + 1]
    p, frame = np.broadcast_to(places, a.shape), np.full(len(found), angles[0])
    return Bars(found[:, 0], a, b, found[:, -1], p, frame, np.array(error)), complete


def bars_of(pairs: Any, chosen: Any, places: Complexes, angles: Floats) -> Bars:
    """Four-bars of pairs of dyads at poses, with their errors."""
    (pin_a, o), (pin_b, d) = pairs
    (pin_a, o), (pin_b, d) = (pin_a[chosen[0]], o[chosen[0]]), (pin_b[chosen[1]], d[chosen[1]])
    a, b = (assemble.moved(pin, places, angles) for pin in (pin_a, pin_b))
    lengths = abs(np.stack([a - o[:, None], b - d[:, None]]))
    error = abs(lengths - lengths[:, :, :1]).max(axis=(0, 2), initial=0.0)
    p = np.broadcast_to(places, a.shape)
    return Bars(o, a, b, d, p, np.full(len(o), angles[0]), error)


def _slides(
    places: Complexes, angles: Floats, pivot: complex | None, samples: int, seed: int
) -> Slides:
    """Slider-cranks of dyads of cranks and of slides at poses."""
    conditions = Conditions(places, angles)
    if len(places) > 4:
        hint = "leave out poses, or choose family='four_bar'"
        raise ModelError(f"poses: {len(places)}; slider-cranks take at most four", hint=hint)
    cranks = (
        conditions.all(samples, seed)
        if pivot is None
        else conditions.with_pivot(pivot, samples, seed)
    ).of("pin")
    slides = conditions.slides(samples, seed + 1)
    if not len(slides) or not len(cranks):
        hint = "leave out or move a pose, or let the pivot be free"
        raise ModelError("poses: no pin moves along a straight line", hint=hint)
    first, second = assemble.pairs_of(cranks, slides, seed)
    a = assemble.moved(cranks.pin[first], places, angles)
    b = assemble.moved(slides.pin[second], places, angles)
    o, way = cranks.pivot[first], slides.way[second]
    away = abs(abs(a - o[:, None]) - abs(a[:, :1] - o[:, None]))
    off = abs((np.conj(way)[:, None] * (b - b[:, :1])).imag)
    error = np.maximum(away, off).max(axis=1, initial=0.0)
    p, frame = np.broadcast_to(places, a.shape), np.full(len(o), angles[0])
    return Slides(o, a, b, b[:, 0], p, frame, error, way)


def _fitted(places: Complexes, angles: Floats, fixed: Mapping[str, complex], seed: int) -> Bars:
    """Four-bars by least squares, from exact ones through some of the poses."""
    random, n = np.random.default_rng(seed), len(places)
    starts = []
    for k in range(_SUBSETS):
        five = k % 2 == 0
        chosen = np.sort(random.choice(n, 5 if five else 4, replace=False))
        conditions = Conditions(places[chosen], angles[chosen])
        try:
            found = conditions.all(8, seed + k).of("pin")
        except ModelError:
            continue
        # the same bodies at all poses: their lengths vary at those that were left out
        turned = angles[0] - angles[chosen[0]]
        pins = found.pin - places[chosen[0]]
        pins = places[0] + pins * np.exp(1j * turned)
        dyads = (pins, found.pivot)
        pairs = assemble.pairs_of(found, None, seed)
        starts.append(bars_of((dyads, dyads), pairs, places, angles).shapely())
    bars = assemble.together(starts)
    bars = bars.taken(np.argsort(bars.error, kind="stable")[:_STARTS])
    fitted = _core.near_poses(
        tasks.pairs_in(places), angles.tolist(), tasks.both(fixed), bars.numbers()
    )
    return assemble.traced(fitted, n)
