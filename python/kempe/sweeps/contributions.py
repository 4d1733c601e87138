"""The contribution of each variable to the scatter of a measure in a sweep."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.sweeps.variables import Variable

if TYPE_CHECKING:
    from kempe.sweeps.result import SweepResult

#: Groups of equal size into which the values of a distribution are divided, and the least size.
_GROUPS, _LEAST = 20, 5


def contributions(result: SweepResult, measure: str) -> dict[str, float]:
    """The share of each variable in the variance of a measure: its correlation ratio.

    The ratio is the variance of the conditional mean at each value of the variable, divided by the
    total variance (the first-order Sobol index). The remainder up to 1 is due to interactions of
    variables. Values of a distribution are divided into groups. Only variants that succeeded are
    used.

    Raises:
        ModelError: there is no such measure.
    """
    good = result.succeeded & np.isfinite(result[measure])
    values = result[measure][good]
    total = float(values.var()) if len(values) else 0.0
    found = {}
    for variable in result.variables:
        groups = _groups(variable, result[variable.name][good])
        found[variable.name] = _between(values, groups) / total if total > 0.0 else 0.0
    return found


def _groups(variable: Variable, given: Floats) -> NDArray[np.intp]:
    """The group of each variant."""
    distinct, groups = np.unique(given, return_inverse=True)
    if variable.levels is not None and len(distinct) <= max(_GROUPS, len(given) // _LEAST):
        return groups
    count = max(1, min(_GROUPS, len(given) // _LEAST))
    return np.argsort(np.argsort(given, kind="stable")) * count // max(len(given), 1)


def _between(values: Floats, groups: NDArray[np.intp]) -> float:
    """The variance of the means of groups, weighted by their sizes."""
    _, places, sizes = np.unique(groups, return_inverse=True, return_counts=True)
    means = np.bincount(places, values) / sizes
    return float(np.average((means - values.mean()) ** 2, weights=sizes))
