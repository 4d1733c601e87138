"""Pareto fronts: values that are better in one objective only at the cost of another."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.sweeps.problems.evaluate import Evaluations
from kempe.sweeps.problems.problem import TOLERANCE, Run

#: Members of a population for each objective, most generations, and generations without a gain
#: after which the search ends.
MEMBERS, _GENERATIONS, _PERIOD = 30, 80, 15
#: The violation of limits by a run that fails.
_FAILED = 1e30


def front(runs: Evaluations, points: Floats, seed: int) -> list[Run]:
    """The front that NSGA-II (Deb and others, 2002) finds, sorted by the first objective.

    Args:
        runs: the runs.
        points: the first population, points of the unit cube.
        seed: for the random choices.

    Raises:
        ModelError: pymoo is not installed.
        StoppedError: the search was stopped.
    """
    try:
        from pymoo.algorithms.moo.nsga2 import NSGA2
        from pymoo.core.problem import Problem
        from pymoo.optimize import minimize
        from pymoo.termination.default import DefaultMultiObjectiveTermination
    except ImportError as error:
        raise ModelError(
            "several objectives need pymoo, which is not installed",
            hint="pip install 'kempe[design]'",
        ) from error
    problem, width = runs.problem, points.shape[1]
    found: dict[bytes, Run] = {}

    class _Problem(Problem):  # type: ignore[misc]
        def _evaluate(self, x: Floats, out: dict[str, Floats], *_: Any, **__: Any) -> None:
            tried = runs.values(0, np.array([problem.row(point) for point in x]))
            found.update(zip(map(np.ndarray.tobytes, x), tried, strict=True))
            out["F"] = problem.sign * np.nan_to_num(objectives(tried, 1 + len(problem.others)))
            out["G"] = np.array([[min(run.violation, _FAILED) - TOLERANCE] for run in tried])

    last = minimize(
        _Problem(width, 1 + len(problem.others), 1, xl=0.0, xu=1.0),
        NSGA2(len(points), sampling=points),
        DefaultMultiObjectiveTermination(period=_PERIOD, n_max_gen=_GENERATIONS),
        seed=seed,
    )
    return best_of([found[x.tobytes()] for x in last.pop.get("X")], problem.sign)


def objectives(runs: Sequence[Run], count: int) -> Floats:
    """The objectives of runs, (n, count); NaN for one that failed."""
    none = (np.nan,) * (count - 1)
    return np.array([[run.objective, *(run.others or none)] for run in runs]).reshape(-1, count)


def best_of(runs: Sequence[Run], sign: float) -> list[Run]:
    """The runs that no other one surpasses in all objectives, sorted by the first one."""
    good = [run for run in runs if run.holds]
    if not good:
        return []
    values = sign * objectives(good, 1 + len(good[0].others))
    order = np.lexsort(values.T[::-1])
    kept: list[int] = []
    for k in order.tolist():  # sorted by the first objective, so that later ones surpass no earlier
        if not (values[kept] <= values[k]).all(axis=1).any():
            kept.append(k)
    return [good[k] for k in kept]
