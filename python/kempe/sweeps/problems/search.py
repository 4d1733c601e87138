"""Searches from one start: SciPy's methods on a problem in the unit cube."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import KempeError, ModelError
from kempe.sweeps.problems.evaluate import Evaluations
from kempe.sweeps.problems.problem import Run
from kempe.sweeps.problems.smooth import Smooth, sizes_of
from kempe.sweeps.problems.squares import Squares
from kempe.sweeps.reasons import reason

#: Relative change of the scaled objective at which a method ends; most runs of a round, and rounds.
_SMALL, _MOST, _ROUNDS = 1e-10, 300, 4
#: A root of squares that is this part of its size is 0: what is left are rounding errors.
_ZERO = 1e-10
#: A gap in a message.
_GAP = re.compile(r"\bby (\d[\d.]*(?:e-?\d+)?) (?:m|rad)\b")
#: Step of a difference of gaps, as a part of the range of a variable; part of the first gap by
#: which a mechanism must be further than closed; most steps.
_WIDE, _BEYOND, _CLOSING = 0.02, 0.02, 40
#: Members of a population for each variable, and generations.
_MEMBERS, _GENERATIONS = 15, 200
#: Spread of the objectives of a population, relative to their mean and to the first objective.
_SPREAD = 1e-6
#: Distance from a bound, as a part of its range, within which the bound itself is tried.
_NEAR = 1e-3


def scipy() -> Any:
    """SciPy's optimisers.

    Raises:
        ModelError: SciPy is not installed.
    """
    try:
        import scipy.optimize
    except ImportError as error:
        raise ModelError(
            "kp.optimize and kp.fit need SciPy, which is not installed",
            hint="pip install 'kempe[design]'",
        ) from error
    return scipy.optimize


class _EndedError(Exception):
    """A round has had its runs, as at a corner, where steps hardly gain anything."""


class Search:
    """A search from one start.

    Args:
        runs: the runs.
        start: the number of the start.
        method: the name of the method.
        seed: for random methods.
    """

    def __init__(self, runs: Evaluations, start: int, method: str, seed: int) -> None:
        self.runs, self.start, self.method, self.seed = runs, start, method, seed
        self.problem = runs.problem
        self.best: Run | None = None
        self._last: Run | None = None
        self._seen: tuple[bytes, Run] | None = None
        self._left, self._zero = _MOST, -np.inf

    def at(self, shares: Floats) -> Run:
        """The run at a point of the unit cube."""
        key = np.asarray(shares).tobytes()  # methods ask for objective, limits and slopes apart
        if self._seen is None or self._seen[0] != key:
            self._left -= 1
            if self._left < 0 or self._is_met:
                raise _EndedError
            self._seen = key, self.runs.at(self.start, self.problem.row(np.asarray(shares)))
            self._note(self._seen[1])
        return self._seen[1]

    def _note(self, run: Run) -> None:
        if not run.reason:
            self._last = run
        if self.best is None or self._is_better(run, self.best):
            self.best = run

    def _is_better(self, one: Run, other: Run) -> bool:
        if one.reason or other.reason:
            return bool(other.reason) and not one.reason
        if not one.holds or not other.holds:
            return one.violation < other.violation
        return self.problem.sign * (one.objective - other.objective) < 0.0

    def run(self, shares: Floats) -> Run | None:
        """Search from a point; the best run, or None if all fail."""
        if self.method == "differential-evolution":
            self._evolve(shares)
            return self.best
        first = self.at(shares)
        if first.reason:
            closer = self._closed(shares)
            first = self.at(closer) if closer is not None else first
        if first.reason:
            return None
        if self.problem.is_square and self.problem.sign > 0.0:
            of_values = np.abs(first.slope * first.row)  # what a value changes if it doubles
            self._zero = _ZERO * max(
                abs(first.objective), np.nan_to_num(of_values).max(initial=0.0)
            )
        solve = {"least-squares": self._squares, "slsqp": self._slsqp}.get(self.method, self._trust)
        if self.problem.has_smooth_residuals and self.method == "slsqp":
            self._rounds(self._squares)  # which takes the fewest runs if no limit cuts
        if not self._rounds(solve) and self._rounds(self._nearer):
            self._rounds(solve)
        return self.best

    def _rounds(self, solve: Callable[[Floats, Run], None]) -> bool:
        """Search from the best run with new scales until nothing is gained; whether limits hold."""
        for _ in range(_ROUNDS):
            before = self.best
            assert before is not None
            self._left = _MOST
            with suppress(_EndedError):
                solve(self.problem.shares(before.row), before)
            self._left = _MOST
            if self._is_met:
                break
            self._snap()
            if self.best is before or self._is_close(before):
                break
        return self.best is not None and self.best.holds

    @property
    def _is_met(self) -> bool:
        """Whether the objective of the best run cannot be less: it is a root of squares and 0."""
        return self.best is not None and self.best.holds and self.best.objective <= self._zero

    def _is_close(self, before: Run) -> bool:
        """Whether the best run is hardly better than an earlier one."""
        assert self.best is not None
        gain = abs(self.best.objective - before.objective)
        return before.holds and gain <= 1e-9 * abs(before.objective)

    def _snap(self) -> None:
        """Try the bounds to which the best run is near; methods may end a little before them."""
        assert self.best is not None
        shares = self.problem.shares(self.best.row)
        near = np.where(shares < _NEAR, 0.0, np.where(shares > 1.0 - _NEAR, 1.0, shares))
        if (near != shares).any():
            self.at(near)

    def _closed(self, shares: Floats) -> Floats | None:
        """A point near a given one where the mechanism closes: least squares of its gap.

        The gap is known to some digits only, so that its slopes are differences over wide steps.
        """
        first = self._gap(shares)

        def gap(at: Floats) -> Floats:
            found = self._gap(at)
            return np.array([found / first + _BEYOND if found else 0.0])

        def slopes(at: Floats) -> Floats:
            steps = np.where(at < 1.0 - _WIDE, _WIDE, -_WIDE)
            points = (at + step * one for step, one in zip(steps, np.eye(len(at)), strict=True))
            beside = [self._gap(point) for point in points]
            return (np.array([beside]) - self._gap(at)) / first / steps

        if not first:
            return None
        found = scipy().least_squares(
            gap, shares, jac=slopes, bounds=(-1e-12, 1.0 + 1e-12), max_nfev=_CLOSING
        )
        return None if found.fun[0] else np.asarray(found.x)

    def _gap(self, shares: Floats) -> float:
        """The gap that stays open in the assembly, m or rad; 0 if it closes."""
        try:
            self.problem.plan.variant(self.problem.row(shares)).start()
        except KempeError as error:
            told = _GAP.search(reason(str(error.args[0])))
            return float(told[1]) if told else 0.0
        return 0.0

    def _slsqp(self, shares: Floats, first: Run) -> None:
        of: Smooth | Squares
        if self.problem.has_smooth_residuals:
            of, bounds, has_room = Squares(self.problem, self.at, (shares, first)), None, True
        else:
            of = Smooth(self.problem, self.at, (shares, first))
            bounds, has_room = list(zip(*of.bounds, strict=True)), of.has_room
        room = [{"type": "ineq", "fun": of.room, "jac": of.room_slopes}] if has_room else []
        scipy().minimize(
            of.objective,
            of.start,
            jac=True,
            bounds=bounds,
            constraints=room,
            method="SLSQP",
            options={"ftol": _SMALL, "maxiter": _MOST},
        )

    def _nearer(self, shares: Floats, first: Run) -> None:
        """The least of the largest excess of a limit, where a method found no values that hold.

        The excess is a further variable, so that some step always satisfies all slopes.
        """
        of = Smooth(self.problem, self.at, (shares, first))
        excess = np.append(np.zeros_like(of.start), 1.0)
        scipy().minimize(
            lambda at: (at[-1], excess),
            np.append(of.start, -of.room(of.start).min()),
            jac=True,
            bounds=[*zip(*of.bounds, strict=True), (0.0, np.inf)],
            constraints={
                "type": "ineq",
                "fun": lambda at: of.room(at[:-1]) + at[-1],
                "jac": lambda at: np.insert(of.room_slopes(at[:-1]), len(at) - 1, 1.0, axis=1),
            },
            method="SLSQP",
            options={"ftol": _SMALL, "maxiter": _MOST},
        )

    def _trust(self, shares: Floats, first: Run) -> None:
        of = Smooth(self.problem, self.at, (np.clip(shares, 1e-6, 1.0 - 1e-6), first))
        optimize = scipy()
        limits = optimize.NonlinearConstraint(of.room, 0.0, np.inf, jac=of.room_slopes)
        optimize.minimize(
            of.objective,
            of.start,
            jac=True,
            bounds=optimize.Bounds(*of.bounds, keep_feasible=True),
            constraints=[limits] if of.has_room else [],
            method="trust-constr",
            options={"gtol": 1e-10, "xtol": 1e-12, "maxiter": _MOST},
        )

    def _squares(self, shares: Floats, first: Run) -> None:
        """Least squares; the excess of a limit is a further residual."""
        size = float(np.linalg.norm(first.residuals[0])) or 1.0
        sizes = sizes_of(self.problem, first)

        def of(run: Run) -> Floats:
            return np.append(run.residuals[0] / size, np.minimum(run.room / sizes, 0.0))

        def residuals(at: Floats) -> Floats:
            run = self.at(at)
            if not run.reason:
                return of(run)
            return np.abs(of(self._last or first)) * 10.0 + 1.0

        def slopes(at: Floats) -> Floats:
            run = self.at(at)
            run = (self._last or first) if run.reason else run
            excess = np.where(run.room < 0.0, 1.0 / sizes, 0.0)[:, None]
            rows = np.vstack([run.residuals[1] / size, np.nan_to_num(run.room_slopes) * excess])
            return np.asarray(rows * self.problem.rates(run.row))

        scipy().least_squares(
            residuals,
            shares,
            jac=slopes,
            bounds=(0.0, 1.0),
            x_scale="jac",
            ftol=_SMALL,
            xtol=_SMALL,
            gtol=1e-15,
            max_nfev=_MOST,
        )

    def _evolve(self, shares: Floats) -> None:
        """Differential evolution: points that fail are worst, then those beyond limits."""
        (first,) = self.runs.values(self.start, self.problem.row(shares)[None])
        self._note(first)
        size = 0.0 if first.reason else abs(first.objective)
        sign, worst = self.problem.sign, 1e100

        def objective(points: Floats) -> Floats:
            rows = np.array([self.problem.row(point) for point in points.T])
            found = self.runs.values(self.start, rows)
            for run in found:
                self._note(run)
            return np.array(
                [
                    worst
                    if run.reason
                    else sign * run.objective
                    if run.holds
                    else 1e-6 * worst * (1.0 + min(run.violation, 1e5))
                    for run in found
                ]
            )

        scipy().differential_evolution(
            objective,
            [(0.0, 1.0)] * len(self.problem.bounds),
            vectorized=True,
            updating="deferred",
            polish=False,
            init="sobol",
            popsize=_MEMBERS,
            maxiter=_GENERATIONS,
            x0=shares,
            tol=_SPREAD,
            atol=_SPREAD * size,
            **_seed(self.seed),
        )


def _seed(seed: int) -> dict[str, Any]:
    """The argument of SciPy for the seed, which has another name since version 1.15."""
    import inspect

    known = inspect.signature(scipy().differential_evolution).parameters
    return {"rng" if "rng" in known else "seed": seed}
