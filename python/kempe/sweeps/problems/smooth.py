"""A problem about a point as methods of SciPy need it: scaled, smooth, with values everywhere."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from kempe.base.arrays import Floats
from kempe.sweeps.problems.problem import Problem, Run

#: Least scale of a variable, as a part of its value.
_LEAST = 1e-2


class Smooth:
    """The objective and the room in the limits over scaled variables.

    Over the bounds, a variable may change the objective by many times its size, and a method that
    starts with steps of this length ends early. The scale of a variable is therefore at most the
    change that changes the objective or the size of a limit by its own size at the first point.

    If the objective is the worst of several load cases, it has a corner where two are equally bad.
    A further variable takes its place, its level, which is at least the objective in each of them.

    A run that fails is a wall: larger than the last objective, without slopes.

    Args:
        problem: the problem.
        at: the run at a point of the unit cube.
        first: the first point of the unit cube, and its run.

    Attributes:
        start: the first point.
        bounds: least and largest values of the scaled variables.
        has_room: whether there are limits.
    """

    def __init__(
        self, problem: Problem, at: Callable[[Floats], Run], first: tuple[Floats, Run]
    ) -> None:
        shares, run = first
        self._problem, self._at, self._last = problem, at, run
        self._power = 2 if problem.is_square else 1
        values, slopes = self._pieces(run)
        self._count, self._levels = len(shares), len(values) > 1
        self._size = float(np.abs(values).max()) or float(np.abs(slopes).max(initial=0.0)) or 1.0
        rates = problem.rates(run.row)
        of_limits = np.nan_to_num(run.room_slopes) * rates
        self._sizes = sizes_of(problem, run)
        steepest = np.abs(np.vstack([slopes / self._size, of_limits / self._sizes[:, None]]))
        own = np.minimum(1.0, _LEAST * np.abs(run.row / rates))
        steepest = np.maximum(steepest.max(axis=0), 1.0)
        self._scales = np.maximum(1.0 / steepest, np.where(own > 0.0, own, _LEAST))
        level = np.array([values.max() / self._size])[: self._levels]
        none = np.full(int(self._levels), np.inf)
        self.start = np.concatenate([shares / self._scales, level])
        self.bounds = (
            np.concatenate([np.zeros(len(shares)), -none]),
            np.concatenate([1.0 / self._scales, none]),
        )
        self.has_room = self._levels or bool(len(run.room))

    def _pieces(self, run: Run) -> tuple[Floats, Floats]:
        """The objective, to be minimised, in all load cases, and its slopes over the unit cube."""
        sign, rates = self._problem.sign, self._problem.rates(run.row)
        values, slopes = run.pieces[0], np.nan_to_num(run.pieces[1]) * rates
        if self._power == 2:
            return sign * values**2, sign * 2.0 * values[:, None] * slopes
        return sign * values, sign * slopes

    def _run(self, at: Floats) -> tuple[Run, bool]:
        """The run at a point, or the last one that succeeded, and whether it is of this point."""
        shares = np.clip(at[: self._count] * self._scales, 0.0, 1.0)
        run = self._at(shares)
        if not run.reason:
            self._last = run
        return self._last, not run.reason

    def objective(self, at: Floats) -> tuple[float, Floats]:
        """The value and its derivatives."""
        run, succeeded = self._run(at)
        values, slopes = self._pieces(run)
        value, slope = values[0] / self._size, slopes[0] * self._scales / self._size
        if self._levels:
            value, slope = at[-1], np.eye(len(at))[-1]
        if succeeded:
            return float(value), slope
        return float(value) + 1.0 + abs(float(value)), np.zeros(len(at))

    def room(self, at: Floats) -> Floats:
        """The room in the limits, and of the level over the objective in each load case."""
        run, _ = self._run(at)
        room = run.room / self._sizes
        return np.append(room, at[-1] - self._pieces(run)[0] / self._size) if self._levels else room

    def room_slopes(self, at: Floats) -> Floats:
        """The derivatives of the room."""
        run, _ = self._run(at)
        slopes = np.nan_to_num(run.room_slopes) * self._problem.rates(run.row) * self._scales
        slopes = np.asarray(slopes / self._sizes[:, None])
        if not self._levels:
            return slopes
        of_pieces = self._pieces(run)[1] * self._scales / self._size
        ends = np.repeat([0.0, 1.0], (len(slopes), len(of_pieces)))
        return np.column_stack([np.vstack([slopes, -of_pieces]), ends])


def sizes_of(problem: Problem, run: Run) -> Floats:
    """The sizes of the limits, and their change over the bounds where a size is 0."""
    known = np.abs(np.nan_to_num(run.room_slopes) * problem.rates(run.row)).max(axis=1, initial=0.0)
    return np.where(run.sizes > 0.0, run.sizes, np.where(known > 0.0, known, 1.0))
