"""The motion of a solution on its interpolant, at instants close enough for smooth curves."""

from __future__ import annotations

import math
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from kempe.arrays import Floats
from kempe.energy import Energy
from kempe.errors import KempeError
from kempe.motion import Motion
from kempe.solution import Solution

#: Instants in a step of the integrator: at least, at most, and for all steps together.
_LEAST, _MOST, _WISHED = 4, 32, 3000
#: Numbers in the arrays of a fine motion, and instants, at most.
_MOST_NUMBERS, _MOST_INSTANTS = 6_000_000, 50_000

_known: WeakKeyDictionary[Solution, Motion] = WeakKeyDictionary()


def fine(motion: Motion) -> Motion:
    """The motion of a solution between its outputs too.

    The instants are the boundaries of the integrator's steps and 3 to 31 instants in each step, at
    most 50 000 in total. They do not depend on the output times.

    Args:
        motion: a solution; any other motion is returned as it is.

    Returns:
        The motion at these instants. It is the solution itself if there is no interpolant, or if
        the reactions are not unique at one of the instants.
    """
    if not isinstance(motion, Solution) or motion.dense is None or len(motion.t) < 2:
        return motion
    if motion not in _known:
        _known[motion] = _evaluated(motion)
    return _known[motion]


def _evaluated(solution: Solution) -> Motion:
    found = solution(_with_jumps(solution, _instants(solution)))
    try:
        _ = found.lam
    except KempeError:
        return solution
    return found


def _instants(solution: Solution) -> Floats:
    """Times, in the direction of the run, s."""
    assert solution.dense is not None
    bounds = solution.dense.t
    steps = len(bounds) - 1
    numbers = 4 * solution.compiled.n_q + solution.compiled.n_rows + 1
    most = max(2, min(_MOST_INSTANTS, _MOST_NUMBERS // numbers))
    pieces = min(max(_LEAST, math.ceil(_WISHED / steps)), _MOST)
    if pieces * steps > most:
        pieces = max(1, most // steps)
    shares = np.arange(pieces) / pieces
    inside = bounds[:-1, None] + shares * np.diff(bounds)[:, None]
    found = np.append(inside.ravel(), bounds[-1])
    return found[:: math.ceil(len(found) / most)] if len(found) > 2 * most else found


def _with_jumps(solution: Solution, instants: Floats) -> Floats:
    """The instants and, where a solution has two states at one time, the number before it."""
    jumps = solution.t[1:][np.diff(solution.t) == 0.0]
    if not len(jumps):
        return instants
    forward = 1.0 if solution.t[-1] >= solution.t[0] else -1.0
    before = np.nextafter(jumps, -forward * np.inf)
    return forward * np.unique(forward * np.concatenate([instants, before, jumps]))


def jumps(t: Floats) -> NDArray[np.intp]:
    """The places in times of a motion before which its values jump."""
    return np.flatnonzero(np.abs(np.diff(t)) <= np.spacing(np.abs(t[1:]))) + 1


def fine_energies(solution: Solution) -> tuple[Floats, Energy]:
    """Times and energies on the interpolant; those at the outputs if there is no interpolant."""
    motion = fine(solution)
    if motion is solution:
        return solution.t, solution.energy
    return motion.t, solution.energy_at(motion.t)
