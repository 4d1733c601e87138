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

#: A bracket is divided so often into so many intervals; each time it shrinks by half as much.
_ROUNDS, _INTERVALS = 4, 16
#: Values that differ by less than this share of the largest are the same value.
_SAME = 1e-12


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
    output, _ = _best(motion, quantity, sign, _SAME)
    dense = fine(motion)
    if dense is motion:
        return output
    found, bracket = _best(dense, quantity, sign, _SAME)
    for _ in range(_ROUNDS):
        try:
            closer, bracket = _best(_between(motion, *bracket), quantity, sign, 0.0)
        except KempeError:  # no unique reactions at an instant between those that are known
            break
        if sign * closer.value >= sign * found.value:
            found = closer
    room = _SAME * abs(output.value)
    return output if sign * output.value > sign * found.value + room else found


def _best(
    motion: Motion, quantity: Quantity, sign: float, room: float
) -> tuple[Extreme, tuple[float, float]]:
    """The extreme value at the times of a motion, and the times before and after it.

    Of values within a share ``room`` of the extreme one the first counts.
    """
    t = np.atleast_1d(motion.t)
    values = sign * np.atleast_1d(quantity(motion))
    near = values >= values.max() - room * float(np.abs(values).max())
    k = int(np.argmax(near))
    extreme = Extreme(float(sign * values[k]), float(t[k]))
    if room and near[k : k + 3].all():  # constant there
        return extreme, (extreme.t, extreme.t)
    return extreme, (float(t[max(k - 1, 0)]), float(t[min(k + 1, len(t) - 1)]))


def _between(motion: Motion, begin: float, end: float) -> Motion:
    assert isinstance(motion, Solution)
    found = motion(np.linspace(begin, end, _INTERVALS + 1))
    assert isinstance(found, Motion)
    return found
