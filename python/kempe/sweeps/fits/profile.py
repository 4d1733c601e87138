"""Intervals by profile likelihood, where those of a linear model mislead."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from kempe.base.arrays import Floats
from kempe.sweeps.problems.search import scipy

#: The residuals in standard deviations and their derivatives at values; None if a run fails.
Residuals: TypeAlias = "Callable[[Floats], tuple[Floats, Floats] | None]"
#: Part of its width by which the end of a linear interval may be wrong.
_LINEAR = 0.1
#: Most runs of a search with a fixed parameter; most steps to an end; precision of an end, as a
#: part of its distance; most times by which an end is farther away than a linear one.
_RUNS, _STEPS, _PRECISE, _FAR = 30, 30, 1e-3, 1e3


class Profile:
    """The least sum of squares for each value of one parameter.

    An end of an interval is where its root is as large as a quantile: there the data speak against
    the value as much as they do at the end of a linear interval.

    Args:
        residuals: the residuals.
        values: the values with the least squares.
        bounds: the bounds of the parameters, (n, 2).
        quantile: half the width of an interval in standard errors.
    """

    def __init__(
        self, residuals: Residuals, values: Floats, bounds: Floats, quantile: float
    ) -> None:
        self._residuals, self._values, self._bounds = residuals, values, bounds
        self._quantile = quantile
        best = residuals(values)
        assert best is not None
        self._least = float(best[0] @ best[0])

    def _excess(self, at: Floats) -> float:
        """The root of what the sum of squares exceeds the least one by; infinite if a run fails."""
        found = self._residuals(at)
        return np.inf if found is None else self._root(float(found[0] @ found[0]))

    def _root(self, square: float) -> float:
        return float(np.sqrt(max(0.0, square - self._least)))

    def misleads(self, k: int, end: float, along: Floats) -> bool:
        """Whether a linear end is wrong.

        Args:
            k: the place of the parameter.
            end: the end.
            along: the change of all parameters by that of this one in a linear model.
        """
        at = self._values + along * (end - self._values[k])
        apart = self._excess(np.clip(at, *self._bounds.T))
        return abs(apart / self._quantile - 1.0) > _LINEAR

    def end(self, k: int, width: float) -> float:
        """An end of the interval of a parameter, at the distance ``width`` in a linear model.

        Infinite if the data speak against no value; the bound if it comes first.
        """
        middle, limit = self._values[k], self._bounds[k, int(width > 0.0)]
        near, far, others = 0.0, np.nan, self._values.copy()
        step = width
        for _ in range(_STEPS):
            if not np.isnan(far) and abs(far - near) <= _PRECISE * abs(far):
                break
            inside = abs(middle + step - limit) > 0.0 and (limit - middle - step) * width > 0.0
            place = middle + step if inside else limit
            excess, found = self._fixed(k, place, others)
            if excess >= self._quantile:
                far = place - middle
            elif not inside:
                return float(limit)
            else:
                near, others = step, found
                if abs(step) > _FAR * abs(width):
                    return float(np.copysign(np.inf, width))
            step = 2.0 * near if np.isnan(far) else 0.5 * (near + far)
        return float(middle + (near if np.isnan(far) else 0.5 * (near + far)))

    def _fixed(self, k: int, value: float, start: Floats) -> tuple[float, Floats]:
        """The excess with one parameter fixed, and the values of all."""
        values = start.copy()
        values[k] = value
        free = np.arange(len(values)) != k
        if not free.any() or self._residuals(values) is None:
            return self._excess(values), values
        known = [self._residuals(values)]

        def whole(at: Floats) -> Floats:
            both: Floats = values.copy()
            both[free] = at
            return both

        def residuals(at: Floats) -> Floats:
            found = self._residuals(whole(at))
            if found is None:
                return np.abs(known[-1][0]) * 10.0 + 1.0  # type: ignore[index]
            known.append(found)
            return np.asarray(found[0])

        def slopes(at: Floats) -> Floats:
            found = self._residuals(whole(at)) or known[-1]
            assert found is not None
            return np.asarray(found[1][:, free])

        ends = self._bounds[free].T
        low, high = ends
        inside = np.clip(values[free], low, high)
        found = scipy().least_squares(
            residuals, inside, jac=slopes, bounds=(low, high), x_scale="jac", max_nfev=_RUNS
        )
        return self._root(float(found.fun @ found.fun)), whole(found.x)
