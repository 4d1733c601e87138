"""Function generation: linkages that couple the angles of crank and rocker."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from kempe import _core
from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.model.given import value
from kempe.model.values import Number, refuse
from kempe.synthesis import assemble, tasks
from kempe.synthesis.assemble import Bars, distinct
from kempe.synthesis.dyads import Conditions, Dyads, joined
from kempe.synthesis.found import Found
from kempe.synthesis.six_bar import search as six_bars
from kempe.synthesis.tasks import Complexes

#: Samples of free choices; starts of least squares, rounds until one succeeds, and steps.
SAMPLES, _STARTS, _ROUNDS, _STEPS = 400, 300, 3, 150
#: Factor of the closure in approximations.
_CLOSING = 1e3
#: A four-bar is exact if its sum of squares is below the square of this.
_EXACT = 1e-10
#: The places of a task without a point.
_NONE = np.zeros(0, dtype=complex)
#: Least range of an angle with free scales, rad.
_LEAST = 0.1


@explained
def function(
    pairs: Sequence[tuple[Number, Number]],
    family: str = "four_bar",
    *,
    scales: str = "fixed",
    offsets: str | None = None,
    ground: Number = 1.0,
    pivots: Mapping[str, Sequence[Number]] | None = None,
    parts: Mapping[str, Any] | None = None,
    samples: int | None = None,
    seed: int = 0,
    progress: tasks.Progress | None = None,
    **limits: Any,
) -> Found:
    """Linkages whose output has given angles at given angles of the crank.

    O is at (0, 0) and D at (ground, 0). With free offsets, only the differences of the angles
    count: five pairs have at most three four-bars, and all of them are found, by elimination. With
    fixed offsets, the angles are measured from the x axis, and three pairs determine one four-bar
    (Freudenstein 1955). Fewer pairs leave free choices, which are sampled; more pairs are
    approximated by least squares. With free scales, the numbers of a pair are proportional to the
    rotations, and up to seven pairs can be exact; Newton's method starts from random four-bars, so
    that solutions may be missing.

    The output of a six-bar is its body ``arm``, which turns about a ground pivot except in "watt_1"
    and "stephenson_1". Least squares start from an atlas, for any number of pairs.

    Args:
        pairs: angles of crank and output, rad, or texts such as "30 deg"; with free scales any
            numbers x and y.
        family: "four_bar", or a six-bar as for ``path``.
        scales: "fixed", or "free" if only proportions count.
        offsets: "free" or "fixed"; by default fixed for up to three pairs of a
            four-bar, otherwise free.
        ground: the distance of O and D, m.
        pivots: the fixed ground pivot of a six-bar with three of them, ``{"G": (x, y)}``, m.
        parts: prescribed bodies of a six-bar, as for ``path``.
        samples: of free choices, or starts of a six-bar; None for as many as usual.
        seed: of the samples and starts.
        progress: called with the number of rounds of starts of a six-bar, and the largest one.
        limits: ``defects``, ``transmission_angle``, ``grashof``, ``within``, ``direction`` and
            ``masses``; ``limits`` describes them.

    Raises:
        ModelError: no linkage couples the angles, or an argument is invalid.
        KeyboardInterrupt: Ctrl-C was pressed; ``result`` has six-bars found so far, or is None.
    """
    bodies = assemble.families(family, ("four_bar", *six_bars.FAMILIES), limits, parts)
    asked, length = assemble.limits(**limits), _length(ground)
    for name, given in (("scales", scales), ("offsets", offsets)):
        if given not in ("fixed", "free", None):
            refuse(name, f"{given!r}; must be 'fixed' or 'free'")
    wanted = tasks.pairs(pairs, "" if scales == "free" else "rad")
    if bodies is not None:
        six = six_bars.Asked(bodies, asked, pivots, parts, samples, seed, progress)
        return six_bars.function(six, wanted, (offsets == "fixed", scales != "free"), length)
    tasks.pivots(pivots, "")
    free = (len(wanted) > 3 or scales == "free") if offsets is None else offsets == "free"
    bars, all_ = _four_bars(wanted, (not free, scales != "free"), samples or SAMPLES, seed)
    return assemble.collected(scaled(bars, length), asked, either=False, complete=all_, task=_NONE)


def _length(ground: Number) -> float:
    """The distance of the ground pivots, m."""
    length = value(ground, "ground", "m")
    if not length > 0.0:
        refuse("ground", f"{ground!r}; must be > 0")
    return length


def _four_bars(
    pairs: Floats, fixed: tuple[bool, bool], samples: int, seed: int
) -> tuple[Bars, bool]:
    """Four-bars with ground 1 for fixed offsets and scales, and whether these are all.

    Raises:
        ModelError: none couples the pairs.
    """
    unknowns = 5 - 2 * fixed[0] + 2 * (not fixed[1])
    if not fixed[1] or len(pairs) > unknowns:
        bars = _fitted(pairs, fixed, seed, exact=len(pairs) <= unknowns)
    else:
        bars = bars_of(_dyads(pairs, fixed[0], samples, seed), *pairs.T)
    bars = bars.shapely()
    if not len(bars.o):
        none = "no four-bar couples" if fixed[1] else "no four-bar found that couples"
        more = "let the offsets or scales be free" if fixed[1] else "try another seed"
        hint = f"change or leave out a pair, or {more}"
        raise ModelError(f"pairs: {none} all {len(pairs)} pairs", hint=hint)
    return bars, fixed[1] and len(pairs) == unknowns


def scaled(bars: Bars, length: float) -> Bars:
    """Four-bars of another size; errors of lengths are angles already."""
    o, a, b, d, p = (getattr(bars, name) * length for name in "oabdp")
    return Bars(o, a, b, d, p, bars.frame, bars.error).shapely()


def _dyads(pairs: Floats, fixed: bool, samples: int, seed: int) -> Dyads:
    """The dyads of the rocker, seen from the crank."""
    crank, rocker = pairs.T
    angles = rocker - crank
    conditions = Conditions(np.exp(-1j * crank), angles, "pair")
    if fixed:
        # the pins of crank and rocker lie on the lines of their offsets
        turn, origin = np.exp(1j * angles[0]), conditions.origin
        pivot = conditions.line(3, 0.0, 1.0, -origin.imag / conditions.size)
        pin = conditions.line(1, -turn.imag, turn.real, 0.0)
        if len(pairs) == 2:
            random = np.random.default_rng(seed)
            signs = np.where(np.arange(samples) % 2, 1.0, -1.0)
            at = signs * np.exp(random.normal(0.0, 1.0, samples)) * turn / conditions.size
            found = conditions.with_end("pin", at, pivot[None])
        else:
            found = conditions.all(samples, seed, more=np.array([pivot, pin]))
    elif len(pairs) == 2:  # both ends are free on planes: any pins and pivots
        found = joined([conditions.all(samples, seed + k) for k in range(2)])
    else:
        found = conditions.all(samples, seed)
    found = found.of("pin")
    # seen from ground: the pins at the origins of both angles
    arm = (found.pin - np.exp(-1j * crank[0])) * np.exp(-1j * angles[0])
    return Dyads(np.asarray(arm), found.pivot, found.way, found.complete)


def bars_of(dyads: Dyads, crank: Floats, rocker: Floats) -> Bars:
    """Four-bars with the given pins at the origins of the angles of crank and rocker."""
    arm, a = dyads.pin, dyads.pivot[:, None] * np.exp(1j * crank)
    b = 1.0 + arm[:, None] * np.exp(1j * rocker)
    length = abs(b - a)
    return _bars(a, b, abs(length - length[:, :1]).max(axis=1, initial=0.0))


def _bars(a: Complexes, b: Complexes, error: Floats) -> Bars:
    nought = np.zeros(len(a), dtype=complex)
    frame = np.angle(b[:, 0] - a[:, 0]) if len(a) else np.zeros(0)
    one, middle = np.ones(len(a), dtype=complex), np.asarray((a + b) / 2.0)
    return Bars(nought, a, b, one, middle, np.asarray(frame), error)


def _fitted(pairs: Floats, fixed: tuple[bool, bool], seed: int, *, exact: bool) -> Bars:
    """Four-bars by least squares from random ones.

    Args:
        pairs: the pairs.
        fixed: whether the offsets and the scales are fixed.
        seed: of the starts.
        exact: whether only exact four-bars are of interest.
    """
    random = np.random.default_rng(seed)
    free = [True] * 3 + [not fixed[0]] * 2 + [not fixed[1]] * 2
    least, span = pairs.min(axis=0), np.ptp(pairs, axis=0)
    unit = np.ones(2) if fixed[1] else np.where(span > 0.0, span, 1.0)
    base = np.zeros(2) if fixed[1] else least
    targets = (pairs - base) / unit
    ranges = np.ptp(targets, axis=0)
    found = list[tuple[list[float], list[list[float]], float]]()
    for k in range(_STARTS * _ROUNDS):
        if k % _STARTS == 0 and found:
            break
        for linkage, positions in _starts(targets, fixed, random):
            reached = _core.fit_pairs(targets.tolist(), 1.0, linkage, positions, free, _STEPS)
            used = min(abs(reached[0][5]) * ranges[0], abs(reached[0][6]) * ranges[1])
            if used > _LEAST and (not exact or reached[2] < _EXACT**2):
                found.append(reached)
    found.sort(key=lambda one: one[2])
    if not exact:
        found = [
            _core.fit_pairs(targets.tolist(), _CLOSING, *one[:2], free, 4 * _STEPS)
            for one in found[:30]
        ]
    return distinct(_closed(targets, found))


def _starts(
    targets: Floats, fixed: tuple[bool, bool], random: np.random.Generator
) -> list[tuple[list[float], list[list[float]]]]:
    """Four-bars that are exact at some of the pairs, for scales at random."""
    scales = np.ones(2) if fixed[1] else np.exp(random.uniform(np.log(0.2), np.log(6.0), 2))
    scales[1] *= 1.0 if fixed[1] else random.choice([-1.0, 1.0])
    crank, rocker = pairs = (targets * scales).T
    n = min(len(targets), 3 if fixed[0] else 5)
    chosen = np.sort(random.choice(len(targets), n, replace=False))
    try:
        found = _dyads(pairs.T[chosen], fixed[0], 4, int(random.integers(1 << 30)))
    except ModelError:
        return []
    bars = bars_of(found, crank, rocker)
    coupler = np.unwrap(np.angle(bars.b - bars.a), axis=1)
    length = abs(bars.b - bars.a)[:, chosen[0]]
    starts = []
    for k, (arm, pin) in enumerate(zip(found.pin, found.pivot, strict=True)):
        if min(abs(arm), abs(pin)) < 1e-6:
            continue
        turned = (0.0, 0.0) if fixed[0] else (np.angle(pin), np.angle(arm))
        sides = (pin.real, length[k], arm.real) if fixed[0] else (abs(pin), length[k], abs(arm))
        linkage = [float(x) for x in (*sides, *turned, *scales)]
        positions = np.column_stack([turned[1] + rocker, coupler[k]])
        starts.append((linkage, positions.tolist()))
    return starts


def _closed(targets: Floats, found: Any) -> Bars:
    """Four-bars with exact closures, and their largest errors of the rocker, rad."""
    x = np.array([one[0] for one in found]).reshape(-1, 7).T[:, :, None]
    coupler = np.array([[at[1] for at in one[1]] for one in found]).reshape(-1, len(targets))
    a = x[0] * np.exp(1j * (x[3] + x[5] * targets[:, 0]))
    far = 1.0 - a
    with np.errstate(all="ignore"):
        cosine = (x[1] ** 2 + abs(far) ** 2 - x[2] ** 2) / (2.0 * abs(x[1]) * abs(far))
    turn = x[1] * np.exp(1j * coupler)
    side = np.sign((np.conj(far) * turn).imag)
    between = np.arccos(np.clip(cosine, -1.0, 1.0))
    b = a + abs(x[1]) * far / abs(far) * np.exp(1j * side * between)
    wanted = np.sign(x[2]) * np.exp(1j * (x[4] + x[6] * targets[:, 1]))
    error = abs(np.angle((b - 1.0) * np.conj(wanted))).max(axis=1, initial=0.0)
    loose = abs(abs(b - 1.0) - abs(x[2])).max(axis=1, initial=0.0)
    return _bars(a, b, np.maximum(error, loose))
