"""Sobol indices of a measure, by SALib: the share of each variable in its variance."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.sweeps.plan import Plan


class Share(NamedTuple):
    """The share of a variable in the variance of a measure.

    Attributes:
        first: by this variable alone.
        total: with all interactions in which it takes part.
        first_error: half the width of the interval that contains ``first`` with 95 %.
        total_error: the same for ``total``.
    """

    first: float
    total: float
    first_error: float
    total_error: float


def shares(
    plan: Plan, middle: Mapping[str, float], deviations: Sequence[float], n: int, seed: int
) -> dict[str, Share]:
    """The shares of variables with normal distributions, from n (n_variables + 2) runs.

    Args:
        plan: the analysis with one measure.
        middle: the means of the variables by name.
        deviations: their standard deviations.
        n: number of base points, a power of two.
        seed: for the points.

    Raises:
        ModelError: SALib is not installed, n is not a power of two, or a run fails.
    """
    try:
        from SALib.analyze import sobol as analyze
        from SALib.sample import sobol as sample
    except ImportError as error:
        raise ModelError(
            "sobol= needs SALib, which is not installed", hint="pip install 'kempe[design]'"
        ) from error
    if not isinstance(n, int | np.integer) or n < 2 or n & (n - 1):
        raise ModelError(f"sobol: {n!r}; must be a power of two", hint="give 256 or 1024")
    ends = [[mean, width] for mean, width in zip(middle.values(), deviations, strict=True)]
    about = {
        "num_vars": len(ends),
        "names": list(middle),
        "bounds": ends,
        "dists": ["norm"] * len(ends),
    }
    rows: Floats = np.asarray(sample.sample(about, int(n), calc_second_order=False, seed=seed))
    block = plan.rows(rows, os.cpu_count() or 1)
    told = next((text for text in block.reasons if text), "")
    values = block.values[:, 0]
    if told or not np.isfinite(values).all():
        raise ModelError(
            f"sobol: a variant within the tolerances fails: {told or 'its measure has no value'}",
            hint="take smaller deviations, or leave sobol out",
        )
    if np.ptp(values) == 0.0:
        return dict.fromkeys(middle, Share(0.0, 0.0, 0.0, 0.0))
    scaled = (values - values.mean()) / values.std()
    found = analyze.analyze(about, scaled, calc_second_order=False, seed=seed)
    columns = (found[key].tolist() for key in ("S1", "ST", "S1_conf", "ST_conf"))
    return {name: Share(*of) for name, of in zip(middle, zip(*columns, strict=True), strict=True)}
