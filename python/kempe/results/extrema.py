"""Extreme values of quantities over a motion, with their times, found on the interpolant."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, TypeAlias
from weakref import WeakKeyDictionary

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.results.fine import continuous, fine
from kempe.results.refine import Indices, Maxima

if TYPE_CHECKING:
    from kempe.results.motion import Motion
    from kempe.results.solution import Solution

#: A quantity of a motion, (n_t,), such as ``lambda motion: motion.body("crank").omega``.
Quantity: TypeAlias = "Callable[[Motion], Floats]"


class _Passed(NamedTuple):
    """The singular positions of a run, and the instants at which its quantities are searched.

    Attributes:
        t: the instants, (n,), s.
        keep: their places among the instants of ``fine``, (n,).
        maxima: the maxima of all multipliers together; None if nothing changes or is singular.
    """

    t: Floats
    keep: Indices
    maxima: Maxima | None


#: The singular positions of each solution that was searched.
_passed: WeakKeyDictionary[Solution, _Passed] = WeakKeyDictionary()


class Extreme(NamedTuple):
    """An extreme value.

    Attributes:
        value: the value, in the unit of the quantity.
        t: the first time at which it is reached, s.
    """

    value: float
    t: float


def largest(motion: Motion, quantity: Quantity) -> Extreme:
    """The largest value of a quantity.

    Args:
        motion: a solution, which is searched on its interpolant, or another motion, which is
            searched at its times.
        quantity: a function of a motion that returns a value for each time, (n_t,).

    Returns:
        The value and its time. Values beside a singular position are ignored if they have no bound
        there, or if they are errors of the state divided by a small number; see ``unbounded``.
        Otherwise the value is never below the largest value at the outputs.
    """
    return _extreme(motion, quantity, 1.0)


def least(motion: Motion, quantity: Quantity) -> Extreme:
    """The least value of a quantity; otherwise as ``largest``."""
    return _extreme(motion, quantity, -1.0)


def peak(motion: Motion, quantity: Quantity) -> Extreme:
    """The value of largest magnitude, with its sign; otherwise as ``largest``."""
    high, low = largest(motion, quantity), least(motion, quantity)
    return high if abs(high.value) >= abs(low.value) else low


def unbounded(motion: Motion, quantity: Quantity) -> Floats:
    """Times of singular positions beside which a quantity has no bound.

    Args:
        motion: a solution; any other motion has no values between its times, and no such times.
        quantity: as for ``largest``.

    Returns:
        The times, s, in ascending order.
    """
    maxima = _maxima(motion, quantity, 1.0)
    return np.empty(0) if maxima is None else maxima.poles


def passes_singular(motion: Motion) -> bool:
    """Whether a run passes positions beside which multipliers are meaningless."""
    solution = continuous(motion)
    if solution is None or fine(solution) is solution:
        return False
    found = _singular(solution).maxima
    return found is not None and len(found.near) > 0


def singular_times(solution: Solution) -> Floats:
    """Times of positions beside which multipliers are meaningless, s; needs an interpolant."""
    found = None if fine(solution) is solution else _singular(solution).maxima
    return np.empty(0) if found is None else np.sort(found.near_t)


def _extreme(motion: Motion, quantity: Quantity, sign: float) -> Extreme:
    """The largest value of sign times the quantity."""
    t = np.ascontiguousarray(np.atleast_1d(motion.t))
    outputs = sign * np.atleast_1d(quantity(motion))
    between = None
    if (maxima := _maxima(motion, quantity, sign)) is not None:
        between = (*maxima.samples, maxima.values, maxima.t, len(maxima.near) > 0)
    return Extreme(*_core.extreme(sign, t, outputs, between))


def _maxima(motion: Motion, quantity: Quantity, sign: float) -> Maxima | None:
    """The maxima of sign times a quantity; None for a constant and without an interpolant."""
    solution = continuous(motion)
    if solution is None or (dense := fine(solution)) is solution:
        return None
    passed = _singular(solution)
    values = sign * np.atleast_1d(quantity(dense))[passed.keep]
    if not _core.changes(values):
        return None
    read = partial(_read, solution, quantity, sign)
    return Maxima(read, passed.t, values, passed.maxima, resolved=_resolved(solution))


def _read(solution: Solution, quantity: Quantity, sign: float, t: Floats) -> Floats:
    found: Floats = sign * np.asarray(quantity(solution(t)))
    return found


def _singular(solution: Solution) -> _Passed:
    """The singular positions of a run: where it is not regular, or all multipliers have a pole."""
    if solution not in _passed:
        dense = fine(solution)
        read = partial(_read, solution, lambda motion: motion.regularity, 1.0)
        keep, near, near_t = _core.singular_instants(dense.t, dense.regularity, read)
        places = np.array(keep, dtype=np.intp)
        t, size = dense.t[places], _multipliers(dense)[places]
        found = None
        if near or _core.changes(size):
            read, known = partial(_read, solution, _multipliers, 1.0), (near, near_t)
            found = Maxima(read, t, size, known, resolved=_resolved(solution))
        _passed[solution] = _Passed(t, places, found)
    return _passed[solution]


def _resolved(solution: Solution) -> bool:
    """Whether each step has an instant, so that only errors are steeper than between instants."""
    assert solution.dense is not None
    return len(fine(solution).t) >= len(solution.dense.t)


def _multipliers(motion: Motion) -> Floats:
    return _core.row_norms(np.atleast_2d(motion.lam))
