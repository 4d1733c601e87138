"""Energy that one force element has dissipated since the start of a simulation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.results.solution import Solution

#: Gauss-Legendre points and weights in each step: exact for the square of the velocity of an
#: interpolant of degree 8.
_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(9)


def dissipated(solution: Solution, name: str) -> Floats:
    """Integral of the power that a force element dissipates, on the interpolant, (n_t,), J.

    Args:
        solution: the solution; the integral is 0 at the start of its run.
        name: of the force element.

    Raises:
        ModelError: the interpolant was not kept.
    """
    if solution.dense is None:
        raise ModelError("the solution has no interpolant", name=name, hint="use dense_output=True")
    bounds = np.unique(np.concatenate([solution.dense.t, solution.t]))
    half = np.diff(bounds)[:, None] / 2.0
    t = bounds[:-1, None] + half * (1.0 + _PLACES)
    power = solution(t.ravel()).force_energy(name)[:, 1].reshape(t.shape)
    total = np.concatenate([[0.0], np.cumsum((half * _WEIGHTS * power).sum(axis=1))])
    return fixed(total[np.searchsorted(bounds, solution.t)])
