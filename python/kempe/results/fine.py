"""The motion of a solution on its interpolant, at instants close enough for smooth curves."""

from __future__ import annotations

from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from kempe import _core
from kempe.base.arrays import Floats
from kempe.errors import KempeError
from kempe.results.energy import Energy

if TYPE_CHECKING:
    from kempe.results.motion import Motion
    from kempe.results.solution import Solution

_known: WeakKeyDictionary[Solution, Motion] = WeakKeyDictionary()


def fine(motion: Motion) -> Motion:
    """The motion of a solution, including instants between its outputs.

    The instants are the boundaries of the integrator's steps and 3 to 31 instants in each step, at
    most 50 000 in total. They do not depend on the output times.

    Args:
        motion: a solution; any other motion is returned unchanged.

    Returns:
        The motion at these instants. It is the solution itself if there is no interpolant, or if
        the reactions are not unique at one of the instants.
    """
    solution = continuous(motion)
    if solution is None or len(solution.t) < 2:
        return motion
    if solution not in _known:
        _known[solution] = _evaluated(solution)
    return _known[solution]


def continuous(motion: Motion) -> Solution | None:
    """A motion that is a solution with an interpolant; None for any other motion."""
    return motion if getattr(motion, "dense", None) is not None else None  # type: ignore[return-value]


def _evaluated(solution: Solution) -> Motion:
    found = solution(_instants(solution))
    try:
        _ = found.lam
    except KempeError:
        return solution
    return found


def _instants(solution: Solution) -> Floats:
    """Times, in the direction of the run, s; with the number before each jump."""
    assert solution.dense is not None
    numbers = 4 * solution.compiled.n_q + solution.compiled.n_rows + 1
    return _core.instants(solution.dense.t, solution.t, numbers)


def jumps(t: Floats) -> NDArray[np.intp]:
    """The indices of the times of a motion before which its values jump."""
    return np.flatnonzero(np.abs(np.diff(t)) <= np.spacing(np.abs(t[1:]))) + 1


def fine_energies(solution: Solution) -> tuple[Floats, Energy]:
    """Times and energies on the interpolant, or at the outputs if there is no interpolant."""
    motion = fine(solution)
    if motion is solution:
        return solution.t, solution.energy
    return motion.t, solution.energy_at(motion.t)
