"""``kp.optimize``: the values of variables that are best within limits."""

from __future__ import annotations

import hashlib
import json
import os
import warnings
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.errors import ModelError
from kempe.sweeps.problems import path as paths
from kempe.sweeps.problems.asked import MOST_STARTS, asked_of, check_method, problem_of, whole
from kempe.sweeps.problems.evaluate import Evaluations, Progress, StoppedError
from kempe.sweeps.problems.front import MEMBERS, best_of, front
from kempe.sweeps.problems.optimum import Optimum
from kempe.sweeps.problems.problem import Problem, Run
from kempe.sweeps.problems.search import Search, scipy
from kempe.sweeps.storage import Storage
from kempe.sweeps.variables import present

if TYPE_CHECKING:
    from kempe.case import Case

#: Points that are tried for each start that fails.
_TRIES = 8


@explained
def optimize(
    case: Case,
    variables: Mapping[str, Sequence[Any]] | None = None,
    *,
    minimize: str | paths.Path | Sequence[str | paths.Path] | None = None,
    maximize: str | Sequence[str] | None = None,
    target: Mapping[str, float] | None = None,
    subject_to: str | Sequence[str] = (),
    loads: Sequence[Mapping[str, Any]] | None = None,
    starts: int | None = None,
    seed: int | None = None,
    method: str | None = None,
    analysis: str | None = None,
    out: Path | str | None = None,
    progress: Progress | None = None,
) -> Optimum:
    """The values of variables with the best objective within limits.

    A run that fails is a row of the history. Without arguments, ``[optimize]`` is solved.

    Args:
        case: the case.
        variables: bounds by the name of a parameter (``L2``) or of a coordinate or rate at the
            start: ``(least, largest)`` or ``(least, largest, "log")``, SI units and rad.
        minimize: a column of sweeps such as ``"C.force.max"``, of another analysis such as
            ``"fall:C.force.max"``, a formula of columns and parameters, or a ``kp.Path``.
            A list of these gives the Pareto front of all, by NSGA-II of pymoo.
        maximize: a column or a formula, or a list of these.
        target: values that columns should have: ``{"slide.x.max": 0.3}``.
        subject_to: limits, comparisons of formulas: ``["motor.effort.peak <= 40"]``.
        loads: load cases, settings of parameters and start values: ``[{"mass": 2}, {"mass": 5}]``.
            ``worst(C.force.max)`` in a formula takes its column, or a formula, in each of them, and
            the worst counts. Other columns are those of the case itself.
        starts: number of searches; the first begins with the values of the case, the others at
            Sobol points. One by default.
        seed: number from which the points are drawn.
        method: "slsqp", "trust-constr", "least-squares" (paths and targets without limits) or
            "differential-evolution" (needs no derivatives); chosen for the problem by default.
        analysis: name of the analysis; the last one of the case by default.
        out: file in which all runs are kept. The same search resumes from its file.
        progress: called with the numbers of runs and of failed runs, and the best objective.

    Raises:
        ModelError: an argument is invalid, SciPy is not installed, or no run succeeds.
        FileError: ``out`` cannot be written, or contains another search.
        KeyboardInterrupt: Ctrl-C was pressed; ``result`` is the best so far, None before the first
            run that succeeds.
    """
    aims = (minimize, maximize, target)
    asked = asked_of(case, variables, *aims, subject_to, loads, starts, seed, method, analysis)
    return _searched(problem_of(case, asked), asked, out, progress)


def _searched(
    problem: Problem, asked: Mapping[str, Any], out: Path | str | None, progress: Progress | None
) -> Optimum:
    """Solve a problem, with the runs in a file if there is one."""
    count = whole(1 if asked["starts"] is None else asked["starts"], "starts", 1, MOST_STARTS)
    seed = whole(0 if asked["seed"] is None else asked["seed"], "seed", 0, 2**31)
    check_method(problem, asked["method"])
    scipy()
    storage = None if out is None else Storage(out, _key(problem, asked))
    try:
        workers = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1
        runs = Evaluations(problem, storage, progress, workers)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            if problem.others:
                return _fronted(runs, seed)
            return _solved(runs, asked["method"], (count, seed, workers))
    finally:
        if storage is not None:
            storage.close()


def _solved(runs: Evaluations, method: str | None, how: tuple[int, int, int]) -> Optimum:
    """Search from all starts on threads."""
    count, seed, workers = how
    points = _Points(runs.problem, seed)
    method = method or _method(runs, points.of(0, count))
    count = 1 if method == "differential-evolution" else count
    searches: list[Search] = []

    def search(start: int) -> Run | None:
        """The best run from a start; another point if nothing succeeds there."""
        for point in points.of(start, count):
            searches.append(one := Search(runs, start, method, seed))
            if (found := one.run(point)) is not None and not found.reason:
                return found
        return None

    with ThreadPoolExecutor(min(count, workers)) as pool:
        futures: list[Future[Run | None]] = []
        try:
            futures += [pool.submit(search, start) for start in range(count)]
            found = [run for future in futures if (run := future.result()) is not None]
        except BaseException as error:
            runs.stop.set()
            _ended(futures)
            best = [one.best for one in searches if one.best is not None and not one.best.reason]
            if isinstance(error, KeyboardInterrupt):
                told = "interrupted"
                result = Optimum(runs.problem, best, runs.history, told) if best else None
                error.result = result  # type: ignore[attr-defined]
            raise
    if not found:
        raise _nothing(runs)
    return Optimum(runs.problem, found, runs.history)


def _fronted(runs: Evaluations, seed: int) -> Optimum:
    """The Pareto front of several objectives."""
    count = MEMBERS * (1 + len(runs.problem.others))
    points = _Points(runs.problem, seed)
    try:
        found = front(runs, np.vstack([points.own, points.drawn(count)[: count - 1]]), seed)
    except KeyboardInterrupt as error:
        found = best_of([run for *_, run in runs.history[-4 * count :]], runs.problem.sign)
        told = "interrupted"
        result = Optimum(runs.problem, found, runs.history, told) if found else None
        error.result = result  # type: ignore[attr-defined]
        raise
    if not found:
        raise _nothing(runs)
    return Optimum(runs.problem, found, runs.history)


def _ended(futures: Sequence[Future[Run | None]]) -> None:
    """Wait until all searches have noticed that they must stop."""
    for future in futures:
        if not future.cancel() and not isinstance(future.exception(), StoppedError | type(None)):
            continue


class _Points:
    """The starts: the values of the case, then Sobol points."""

    def __init__(self, problem: Problem, seed: int) -> None:
        values = present(problem.case, problem.plan.names)
        self.own = problem.shares(values.values())
        self._dimension, self._seed = len(self.own), seed

    def of(self, start: int, count: int) -> Iterator[Floats]:
        """The points that a start tries one after the other."""
        if start == 0:
            yield self.own  # often the only one: drawing others loads a large package first
        drawn = self.drawn(count * _TRIES)
        yield from (drawn[start - 1 + k * count] for k in range(_TRIES) if start or k)

    def drawn(self, count: int) -> Floats:
        """Sobol points, at least so many."""
        from scipy.stats import qmc

        sobol = (
            qmc.Sobol(self._dimension, rng=self._seed)
            if _has_rng(qmc.Sobol)
            else qmc.Sobol(self._dimension, seed=self._seed)
        )
        return np.asarray(sobol.random_base2(int(np.ceil(np.log2(max(2, count))))))


def _has_rng(kind: Any) -> bool:
    import inspect

    return "rng" in inspect.signature(kind).parameters


def _method(runs: Evaluations, points: Iterable[Floats]) -> str:
    """The method that fits a problem: derivatives are needed at one of the first two points.

    At one point alone, two equal peaks may leave a measure without a slope.
    """
    problem = runs.problem
    tried = (runs.has_slopes(problem.row(point)) for point in points)
    found: list[bool] = []
    for one in tried:
        found += [] if one is None else [one]
        if any(found) or len(found) == 2:
            break
    if found and not any(found):
        return "differential-evolution"
    is_squares = problem.has_smooth_residuals and not problem.limits
    return "least-squares" if is_squares else "slsqp"


def _nothing(runs: Evaluations) -> ModelError:
    """The error of a search without any run that succeeds."""
    told = Counter(run.reason for *_, run in runs.history).most_common(1)[0][0]
    if not told:
        return ModelError(
            f"optimize: none of {len(runs.history)} runs satisfies all limits",
            hint="minimize one objective, which names the missed limits, or relax the limits",
        )
    return ModelError(
        f"optimize: all {len(runs.history)} runs within the bounds fail; most frequently: {told}",
        hint="widen the bounds, or begin with values in the file for which the case runs",
    )


def _key(problem: Problem, asked: Mapping[str, Any]) -> str:
    """A fingerprint of a search: equal fingerprints imply equal runs."""
    bounds = np.array([[bound.least, bound.largest, bound.log] for bound in problem.bounds])
    tree = {key: _plain(of) for key, of in asked.items() if key != "starts"}
    keys = [
        plan.key_of(bounds) for plan in (problem.plan, *(p.plan for p in problem.columns.parts))
    ]
    text = json.dumps([keys, tree], sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()


def _plain(of: Any) -> Any:
    if isinstance(of, paths.Path):
        return of.tree()
    if isinstance(of, list | tuple):
        return [_plain(one) for one in of]
    return dict(of) if isinstance(of, Mapping) else of
