"""Extreme values of quantities over a motion, with their times, found on the interpolant."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from kempe.arrays import Floats
from kempe.errors import KempeError
from kempe.fine import fine
from kempe.motion import Motion
from kempe.solution import Solution

#: A quantity of a motion, (n_t,), such as ``lambda motion: motion.body("crank").omega``.
Quantity = Callable[[Motion], Floats]

#: Local extreme values above this share of the largest sample are refined, so many at most.
_SHARE, _CANDIDATES = 0.9, 8
#: A bracket is divided so often into so many intervals; each time it shrinks by half as much.
_ROUNDS, _INTERVALS = 4, 16
#: Values that differ by less than this share of the largest are the same value.
_SAME = 1e-12
#: Maxima that differ by less than this share are equal within the error of the interpolant.
_EQUAL = 1e-7


class Extreme(NamedTuple):
    """An extreme value.

    Attributes:
        value: in the unit of the quantity.
        t: the time at which it is reached first, s.
    """

    value: float
    t: float


def largest(motion: Motion, quantity: Quantity) -> Extreme:
    """The largest value of a quantity.

    Args:
        motion: a solution is searched on its interpolant; any other motion at its own times.
        quantity: a function of a motion that returns a value for each time, (n_t,).

    Returns:
        The value, which is never below the largest one at the outputs, and its time.
    """
    return _extreme(motion, quantity, 1.0)


def least(motion: Motion, quantity: Quantity) -> Extreme:
    """The least value of a quantity; otherwise as ``largest``."""
    return _extreme(motion, quantity, -1.0)


def peak(motion: Motion, quantity: Quantity) -> Extreme:
    """The value of largest magnitude, with its sign; otherwise as ``largest``."""
    high, low = largest(motion, quantity), least(motion, quantity)
    return high if abs(high.value) >= abs(low.value) else low


def _extreme(motion: Motion, quantity: Quantity, sign: float) -> Extreme:
    """The largest value of sign times the quantity."""
    output = _first(motion, sign * np.atleast_1d(quantity(motion)), sign)
    dense = fine(motion)
    if dense is motion:
        return output
    values = sign * np.atleast_1d(quantity(dense))
    found = _first(dense, values, sign)
    if np.ptp(values) > _SAME * float(np.abs(values).max()):
        assert isinstance(motion, Solution)
        closer = _refined(motion, quantity, sign, _brackets(dense.t, values))
        room = _EQUAL * abs(found.value)
        found = closer if sign * closer.value >= sign * found.value - room else found
        if values[0] >= sign * found.value - _EQUAL * abs(found.value):
            found = Extreme(found.value, float(dense.t[0]))  # it begins at its extreme value
    room = _SAME * abs(output.value)
    return output if sign * output.value > sign * found.value + room else found


def _first(motion: Motion, values: Floats, sign: float) -> Extreme:
    """The largest of the values at the times of a motion, and the first time at which it occurs."""
    k = int(np.argmax(values >= values.max() - _SAME * float(np.abs(values).max())))
    return Extreme(float(sign * values[k]), float(np.atleast_1d(motion.t)[k]))


def _brackets(t: Floats, values: Floats) -> Floats:
    """Times before and after the largest local maxima, (n, 2)."""
    padded = np.concatenate([[-np.inf], values, [-np.inf]])
    is_peak = (values >= padded[:-2]) & (values >= padded[2:])
    high = values >= values.max() - (1.0 - _SHARE) * float(np.abs(values).max())
    peaks = np.flatnonzero(is_peak & high)
    kept = peaks[np.argsort(-values[peaks], kind="stable")[:_CANDIDATES]]
    found: Floats = t[np.clip(kept[:, None] + [-1, 1], 0, len(t) - 1)]
    return found


def _refined(solution: Solution, quantity: Quantity, sign: float, brackets: Floats) -> Extreme:
    """The largest value in some brackets, the first of equal ones.

    Each bracket shrinks to the parts beside its largest value.
    """
    share = np.linspace(0.0, 1.0, _INTERVALS + 1)
    rows = np.arange(len(brackets))
    highest, at = np.full(len(brackets), -np.inf), brackets[:, 0]
    for _ in range(_ROUNDS):
        times = brackets[:, :1] + share * np.diff(brackets)
        try:
            values = sign * np.asarray(quantity(solution(times.ravel()))).reshape(times.shape)
        except KempeError:  # no unique reactions at an instant between those that are known
            return Extreme(-sign * np.inf, float(at[0]))
        k = values.argmax(axis=1)
        highest, at = values[rows, k], times[rows, k]
        ends = np.clip(k[:, None] + [-1, 1], 0, _INTERVALS)
        brackets = np.take_along_axis(times, ends, axis=1)
    equal = np.flatnonzero(highest >= highest.max() - _EQUAL * abs(float(highest.max())))
    first = equal[int(np.abs(at[equal] - float(solution.t[0])).argmin())]
    return Extreme(float(sign * highest[first]), float(at[first]))
