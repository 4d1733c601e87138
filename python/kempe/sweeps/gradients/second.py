"""Second derivatives: exact slopes beside the values of the case, extrapolated to zero distance.

A column of the second derivatives is the derivative of all slopes by one variable. Central
differences of slopes at distances h, h/2, h/4, … are extrapolated (the table of Richardson and
Ridders) until the estimated error of each number is below 1e-10 of its scale. Mixed derivatives are
found twice, from the slopes by either variable. A number is refused with a remark if its error is
above 1e-8, by its estimate or by comparison of both.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import KempeError, ModelError

if TYPE_CHECKING:
    from kempe.sweeps.plan import Plan

#: The analyses that have second derivatives.
_KINDS = ("kinematics", "equilibrium")
#: The first distance as a part of the size of a variable, and the number of distances.
_FIRST, _DISTANCES = 1.0 / 16.0, 16
#: Estimated error that ends the extrapolation, and the largest that is accepted, by scale.
_AIM, _MOST = 1e-10, 1e-8
#: Values, slopes and remarks at values of the variables.
Evaluated = Callable[[Floats], tuple[Floats, Floats, Any]]


def refuse_second(plan: Plan) -> None:
    """Refuse second derivatives of an analysis that has none.

    Raises:
        ModelError: the analysis is neither kinematics nor an equilibrium.
    """
    kind = plan.case.analyses[plan.analysis]["type"]
    if kind not in _KINDS:
        raise ModelError(
            f"second: {plan.analysis} is of type {kind}, whose second derivatives are not "
            "available; kinematics and equilibrium have them",
            name=plan.analysis,
            hint="leave second out, or name another analysis: analysis=…",
        )


def hessian_of(
    plan: Plan, at: Evaluated, known: tuple[Floats, Floats, Floats]
) -> tuple[Floats, dict[tuple[int, int], str]]:
    """The second derivatives, (n_measures, n, n), and remarks where there are none.

    Args:
        plan: the request.
        at: values, slopes and remarks for given values of the variables.
        known: the variables, the values and the slopes there.
    """
    row, values, slopes = known
    sizes = _sizes(plan, known)
    change = np.nanmax(np.abs(slopes) * sizes, axis=1, initial=0.0)
    scales = (np.abs(values) + change)[:, None, None] / (sizes[:, None] * sizes)
    scales = np.maximum(scales, np.finfo(float).tiny)
    found, errors = np.empty_like(scales), np.empty_like(scales)
    for k in range(len(row)):
        column = _Column(at, row, k, sizes[k])
        found[:, :, k], errors[:, :, k] = column.extrapolated(scales[:, :, k])
    turned = found.transpose(0, 2, 1)
    errors = np.maximum(np.maximum(errors, errors.transpose(0, 2, 1)), np.abs(found - turned))
    good = (errors <= _MOST * scales) & np.isfinite(slopes[:, :, None] + slopes[:, None, :])
    told = {}
    for measure, i, k in np.argwhere(~good).tolist():
        pair = f"{plan.names[i]} and {plan.names[k]}"
        told[measure, i] = f"the second derivative by {pair} is not found with an accuracy of 1e-8"
    return np.where(good, (found + turned) / 2.0, np.nan), told


def _sizes(plan: Plan, known: tuple[Floats, Floats, Floats]) -> Floats:
    """The magnitudes of the variables.

    For zero, it is the largest one with the same unit; or else the least change that would change a
    number by its own size, as its slope says; or else 1.
    """
    row, values, slopes = known
    given, units = np.abs(row), [plan.unit_of(name) for name in plan.names]
    sizes, state = given.copy(), plan.case.start()
    for k in np.flatnonzero(given == 0.0):
        same = zip(units, given.tolist(), strict=True)
        alike = [x for unit, x in same if unit and unit == units[k]]
        if units[k] == "m":
            names = state.compiled.bodies
            alike += [abs(float(state[f"{name}.{axis}"])) for name in names for axis in "xy"]
        steep = np.isfinite(values) & (np.nan_to_num(slopes[:, k]) != 0.0)
        own = np.abs(values[steep] / slopes[steep, k])
        sizes[k] = max(alike, default=0.0) or min(own[own > 0.0], default=1.0)
    return np.asarray(sizes)


class _Column:
    """The derivatives of all slopes by one variable."""

    def __init__(self, at: Evaluated, row: Floats, place: int, size: float) -> None:
        self._at, self._row, self._place, self._size = at, row, place, size

    def _difference(self, h: float) -> Floats | None:
        """A central difference of the slopes; None if the mechanism does not exist there."""
        sides = []
        for sign in (1.0, -1.0):
            row = self._row.copy()
            row[self._place] += sign * h
            try:
                sides.append(self._at(row)[1])
            except KempeError:
                return None
        return np.asarray((sides[0] - sides[1]) / (2.0 * h))

    def extrapolated(self, scale: Floats) -> tuple[Floats, Floats]:
        """The derivatives and their estimated errors, (n_measures, n)."""
        best, least = np.full(scale.shape, np.nan), np.full(scale.shape, np.inf)
        before: list[Floats] = []
        for level in range(_DISTANCES):
            first = self._difference(self._size * _FIRST / 2.0**level)
            if first is None:
                before = []
                continue
            line = [first]
            for order, other in enumerate(before, 1):
                line.append(line[-1] + (line[-1] - other) / (4.0**order - 1.0))
                error = np.maximum(np.abs(line[-1] - line[-2]), np.abs(line[-1] - other))
                better = error < least
                best, least = np.where(better, line[-1], best), np.where(better, error, least)
            before = line
            if (least <= _AIM * scale).all():
                break
        return best, least
