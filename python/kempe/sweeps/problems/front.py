"""Pareto fronts: values that are better in one objective only at the cost of another."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.sweeps.problems.evaluate import Evaluations
from kempe.sweeps.problems.formulas import Formula, Limit
from kempe.sweeps.problems.path import Path
from kempe.sweeps.problems.problem import TOLERANCE, Problem, Run
from kempe.sweeps.problems.search import Search

#: Members of a population for each objective, most generations, and generations without a gain
#: after which the search ends.
MEMBERS, _GENERATIONS, _PERIOD = 30, 80, 15
#: Part of the spread of an objective within which points are one.
_SAME = 1e-6
#: Threads that move points onto a front; the core has its own.
_THREADS = 4
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
        from pymoo.core.problem import Problem as Vectors
        from pymoo.optimize import minimize
        from pymoo.termination.default import DefaultMultiObjectiveTermination
    except ImportError as error:
        raise ModelError(
            "several objectives need pymoo, which is not installed",
            hint="pip install 'kempe[design]'",
        ) from error
    problem, width = runs.problem, points.shape[1]
    found: dict[bytes, Run] = {}

    class _Problem(Vectors):  # type: ignore[misc]
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
    return _polished(runs, best_of([found[x.tobytes()] for x in last.pop.get("X")], problem.sign))


def _polished(runs: Evaluations, found: Sequence[Run]) -> list[Run]:
    """The runs of a front, moved onto it with exact slopes where there are some.

    The first objective becomes as good as it can without a loss of the others.
    """
    first, *others = runs.problem.objectives
    if any(isinstance(one.objective, Path) for one in others):
        return list(found)
    if not found or not runs.has_slopes(found[0].row):
        return list(found)

    def polished(of: Run) -> Run:
        held = tuple(_no_worse(*pair) for pair in zip(others, of.others, strict=True))
        own = runs.of(replace(first, limits=(*first.limits, *held)))
        best = Search(own, 0, "slsqp", 0).run(first.shares(of.row))
        rows = [run.row for *_, run in own.history]  # they belong to the history of the front
        again = [runs.at(0, row) for row in rows]
        moved = next(
            (run for run in again if best is not None and np.array_equal(run.row, best.row)), of
        )
        gain = first.sign * (of.objective - moved.objective)
        return moved if moved.holds and gain > 0.0 else of

    with ThreadPoolExecutor(_THREADS) as pool:
        try:
            return best_of(list(pool.map(polished, found)), runs.problem.sign)
        except BaseException:
            runs.stop.set()
            raise


def _no_worse(problem: Problem, value: float) -> Limit:
    """The limit that keeps an objective as good as a value."""
    of = problem.objective
    assert isinstance(of, Formula)
    signs = ("", "-") if problem.aim == "maximize" else ("-", "")
    room = replace(of, of=f"{signs[0]}({of.of}) {'+' if signs[1] == '' else '-'} ({value!r})")
    return Limit(of.text, room, (of, replace(of, of=f"({value!r})", names=(), worst={})))


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
    same = _SAME * np.ptp(values, axis=0)
    kept: list[int] = []
    for k in order.tolist():  # sorted by the first objective, so that later ones surpass no earlier
        if not (values[kept] <= values[k] + same).all(axis=1).any():
            kept.append(k)
    return [good[k] for k in kept]
