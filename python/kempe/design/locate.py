"""Instants within a solution, zeros and extreme values between its outputs, and integrals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.errors import KempeError, ModelError
from kempe.model.values import instance
from kempe.results.dense import DenseOutput
from kempe.results.extrema import Extreme, largest, least
from kempe.results.motion import Motion
from kempe.results.solution import Solution

#: A quantity of a motion, (n_t,).
Read = Callable[[Motion], Floats]

#: Numbers of instants: least in each step; least and largest for the whole solution.
_LEAST, _WISHED, _MOST = 4, 721, 20_000
#: Parts into which a bracket is divided, and number of divisions; together a factor of 1e-15.
_PARTS, _ROUNDS = 32, 10
#: Parts into which the bracket of a maximum is divided; two of them form the next bracket. The
#: value converges in four rounds.
_TOPS = 6
#: A quantity below this fraction of its largest value counts as zero.
_NOISE = 1e-12


class Limits(NamedTuple):
    """The least and the largest value of a quantity over a motion.

    Attributes:
        least, largest: the value and its time, or its value of the driven quantity.
    """

    least: Extreme
    largest: Extreme


def interpolated(solution: Solution) -> Solution:
    """The solution, if it has values between its outputs.

    Raises:
        ModelError: the argument is not a solution, or has fewer than two outputs or no interpolant.
    """
    instance(solution, Solution, "a solution")
    if solution.dense is None:
        raise ModelError("the solution has no interpolant", hint="use dense_output=True")
    if len(solution.t) < 2:
        raise ModelError("the solution has only one instant", hint="compute a motion")
    return solution


def instants(solution: Solution) -> Floats:
    """Times close enough for smooth curves, in the order of the times of the solution."""
    dense = interpolated(solution).dense
    assert dense is not None
    bounds = np.unique(dense.t)
    pieces = max(_LEAST, -(-_WISHED // max(len(bounds) - 1, 1)))
    pieces = max(1, min(pieces, _MOST // max(len(bounds) - 1, 1)))
    inside = bounds[:-1, None] + np.arange(pieces) / pieces * np.diff(bounds)[:, None]
    found = np.append(inside.ravel(), bounds[-1])
    return found if dense.t[-1] >= dense.t[0] else found[::-1]


def zeros(solution: Solution, read: Read) -> Floats:
    """All instants at which a quantity changes its sign or is zero, to rounding accuracy.

    If the quantity is zero over a part of the motion, only the first and the last instant of this
    part are returned.
    """
    t = instants(solution)
    values = np.asarray(read(solution(t)))
    values = np.where(np.abs(values) <= _NOISE * np.abs(values).max(initial=0.0), 0.0, values)
    still = np.concatenate([[False], values == 0.0, [False]])
    exact = t[still[1:-1] & ~(still[:-2] & still[2:])]
    k = np.flatnonzero(values[:-1] * values[1:] < 0.0)
    low, high = t[k], t[k + 1]
    first = np.sign(values[k])
    share = np.linspace(0.0, 1.0, _PARTS + 1)
    for _ in range(_ROUNDS if len(k) else 0):
        times = low[:, None] + share * (high - low)[:, None]
        inner = np.asarray(read(solution(times.ravel()))).reshape(times.shape)
        same = inner * first[:, None] > 0.0
        same[:, 0], same[:, -1] = True, False
        last = same.cumprod(axis=1).sum(axis=1) - 1
        rows = np.arange(len(k))
        low, high = times[rows, last], times[rows, last + 1]
    found = np.unique(np.concatenate([exact, (low + high) / 2.0]))
    return found if t[-1] >= t[0] else found[::-1]


def limits(solution: Solution, read: Read, poles: Sequence[float] = ()) -> Limits:
    """The least and the largest value of a quantity; of equal values, the first.

    The quantity is smooth, except at the times ``poles``, beside which it has no bound; values
    there are ignored.
    """
    if poles:
        return Limits(least(solution, read), largest(solution, read))
    t = instants(solution)
    values = np.asarray(read(solution(t)))
    low, high = (_top(solution, read, t, values, sign) for sign in (-1.0, 1.0))
    return Limits(low, high)


def _top(solution: Solution, read: Read, t: Floats, values: Floats, sign: float) -> Extreme:
    """The largest value of sign times a quantity."""
    best = float((sign * values).max())
    room = 1e-12 * float(np.abs(values).max(initial=0.0))
    near = 1e-3 * float(np.ptp(values)) + room
    padded = np.concatenate([[-np.inf], sign * values, [-np.inf]])
    peaks = (padded[1:-1] >= padded[:-2]) & (padded[1:-1] >= padded[2:])
    k = np.flatnonzero(peaks & (sign * values >= best - near))[:8]
    brackets = t[np.clip(k[:, None] + [-1, 1], 0, len(t) - 1)]
    share = np.linspace(0.0, 1.0, _PARTS + 1)
    rows = np.arange(len(k))
    top, at = sign * values[k], t[k]
    for _ in range(_TOPS):
        times = brackets[:, :1] + share * np.diff(brackets)
        inner = sign * np.asarray(read(solution(times.ravel()))).reshape(times.shape)
        m = inner.argmax(axis=1)
        better = inner[rows, m] > top
        top, at = np.where(better, inner[rows, m], top), np.where(better, times[rows, m], at)
        ends = np.clip(m[:, None] + [-1, 1], 0, _PARTS)
        brackets = np.take_along_axis(times, ends, axis=1)
    first = int(np.argmax(top >= top.max() - room))
    return Extreme(float(sign * top[first]), float(at[first]))


def integral(solution: Solution, read: Read, ends: Sequence[float]) -> Floats:
    """Integrals of a quantity over t between neighbouring instants, (n - 1,).

    They are those of measures (docs/measures.md): Gauss's rule in each step of the interpolant.

    Args:
        solution: the solution.
        read: the quantity.
        ends: instants, ascending or descending.
    """
    dense = interpolated(solution).dense
    assert dense is not None
    return np.array([_integral(solution, read, dense, pair) for pair in pairwise(ends)])


def _integral(
    solution: Solution, read: Read, dense: DenseOutput, ends: tuple[float, float]
) -> float:
    low, high, steps = *sorted(ends), dense.t
    bounds = np.array([low, *np.unique(steps[(steps > low) & (steps < high)]), high])
    bounds = bounds if ends[0] == low else bounds[::-1].copy()
    failed: list[KempeError] = []

    def values(t: Floats) -> Floats:
        try:
            return np.ascontiguousarray(read(solution(t)), dtype=np.float64)
        except KempeError as error:
            failed.append(error)
            raise

    nothing = np.zeros(1)
    found = _core.integrals(nothing, nothing, (bounds, dense.degree, np.empty(0), values))
    if found is None:
        raise failed[-1]
    return found[0]
