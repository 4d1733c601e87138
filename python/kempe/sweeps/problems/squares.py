"""A sum of squares with limits about a point, over variables in which it is round."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from kempe.base.arrays import Floats
from kempe.sweeps.problems.problem import Problem, Run
from kempe.sweeps.problems.smooth import sizes_of

#: Least second derivative, as a part of the largest one.
_LEAST = 1e-6


class Squares:
    """The sum of the squares and the room in the limits over turned and scaled variables.

    SLSQP begins with the unit matrix in place of the second derivatives, and learns them in as many
    steps as there are variables. Those of a sum of squares are nearly JᵀJ with the slopes J of the
    residuals. In the variables x = first + T y with T JᵀJ T = 1, the unit matrix is correct.
    Bounds are limits of y. A run that fails is a wall, as in ``Smooth``.

    Args:
        problem: the problem, whose objective is a sum of squares.
        at: the run at a point of the unit cube.
        first: the first point of the unit cube, and its run.

    Attributes:
        start: the first point, zeros.
    """

    def __init__(
        self, problem: Problem, at: Callable[[Floats], Run], first: tuple[Floats, Run]
    ) -> None:
        (self._shares, run), self._problem, self._at = first, problem, at
        self._last, self._sizes = run, sizes_of(problem, run)
        self._size = float(np.linalg.norm(run.residuals[0])) or 1.0
        slopes = self._residuals(run)[1]
        second, axes = np.linalg.eigh(slopes.T @ slopes)
        least = _LEAST * float(second.max()) or 1.0
        self._turned = axes / np.sqrt(np.maximum(second, least))
        self.start = np.zeros(len(self._shares))

    def _residuals(self, run: Run) -> tuple[Floats, Floats]:
        """The residuals and their slopes over the unit cube."""
        rates = self._problem.rates(run.row)
        return run.residuals[0] / self._size, run.residuals[1] * rates / self._size

    def _run(self, at: Floats) -> tuple[Run, bool]:
        """The run at a point, or the last one that succeeded, and whether it is of this point."""
        run = self._at(np.clip(self._shares + self._turned @ at, 0.0, 1.0))
        if not run.reason:
            self._last = run
        return self._last, not run.reason

    def objective(self, at: Floats) -> tuple[float, Floats]:
        """Half the sum of the squares and its derivatives."""
        run, succeeded = self._run(at)
        residuals, slopes = self._residuals(run)
        value = 0.5 * float(residuals @ residuals)
        if succeeded:
            return value, np.asarray(residuals @ slopes @ self._turned)
        return 2.0 * value + 1.0, np.zeros(len(at))

    def room(self, at: Floats) -> Floats:
        """The room in the limits and in the bounds."""
        shares = self._shares + self._turned @ at
        return np.concatenate([self._run(at)[0].room / self._sizes, shares, 1.0 - shares])

    def room_slopes(self, at: Floats) -> Floats:
        """The derivatives of the room."""
        run, _ = self._run(at)
        slopes = np.nan_to_num(run.room_slopes) * self._problem.rates(run.row)
        of_limits = slopes / self._sizes[:, None] @ self._turned
        return np.vstack([of_limits, self._turned, -self._turned])
