"""The result of an optimisation: values, what limits them, and the runs of the search."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base import files
from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats
from kempe.base.display_units import display
from kempe.sweeps.problems.formulas import Formula
from kempe.sweeps.problems.problem import TOLERANCE, Problem, Run
from kempe.sweeps.problems.search import scipy
from kempe.sweeps.variables import present

if TYPE_CHECKING:
    from kempe.case import Case

#: Parts of a range, and of the objective, by which candidates differ at least.
_APART, _ALIKE = 1e-3, 1e-4
#: Part of the slope of the objective that bounds and limits leave over, and, relative to the
#: objective, a slope over all bounds that counts as none.
_REST, _FLAT = 0.05, 1e-6
#: Room in a limit, as a part of its size, with which it holds with equality.
_TIGHT = 1e-4
#: Distances from a bound, as parts of its range, with which a value is at the bound: always, and if
#: the bound has a worth, because searches end with rounding errors.
_AT, _NEAR = 1e-9, 1e-6
#: Runs nearer than this part of the ranges of the variables lie beside each other.
_NEAR = 1e-4
#: The weight with which the shares of the load cases make up 1.
_WEIGHT = 1e3


@dataclass(frozen=True, repr=False)
class Candidate:
    """A local optimum.

    Attributes:
        values: the values of the variables by name, in SI units and rad.
        objective: the objective, of several the first.
        objectives: all objectives by their texts.
        case: the case with these values.
    """

    _problem: Problem
    _run: Run

    @property
    def values(self) -> Mapping[str, float]:  # noqa: D102 - see Attributes
        return MappingProxyType(_values(self._problem, self._run))

    @property
    def objective(self) -> float:  # noqa: D102
        return self._run.objective

    @property
    def objectives(self) -> Mapping[str, float]:  # noqa: D102
        values = (self._run.objective, *self._run.others)
        return MappingProxyType(dict(zip(self._problem.labels, values, strict=True)))

    @cached_property
    def case(self) -> Case:  # noqa: D102
        return self._problem.changed(self._run.row)

    @property
    def holds(self) -> bool:
        """Whether all limits hold."""
        return self._run.holds

    def __repr__(self) -> str:
        told = ", ".join(f"{name} = {x:.6g}" for name, x in self.values.items())
        return f"<Candidate {self._problem.label} = {self.objective:.6g}: {told}>"


@explain_methods
class Optimum:
    """The best values that a search found.

    Attributes:
        values: the values of the variables by name, in SI units and rad.
        measures: the columns in the objective and in the limits, with these values.
        objective: the objective itself, also if it is maximised.
        active: the bounds and limits that hold with equality, and by how much the objective gains
            per unit by which one of them is relaxed, at least 0; NaN where that is not known, as at
            a corner of the objective.
        case: the case with these values.
        candidates: the local optima, best first; of several objectives the points of the front,
            sorted by the first objective.
        front: the front of several objectives: variables and objectives of each candidate, a table
            like ``history``.
        history: every run: start, run, variables, columns, objective, violation and reason; a data
            frame, or a structured array without pandas.
        runs: number of runs; one with derivatives counts as one.
        success: whether all limits hold.
        message: how the search ended.
        remarks: load cases that are equally bad, so that ``active`` weighs them; whether runs
            beside the best values fail.
        units: SI units of variables and columns; empty for an unknown one.
    """

    def __init__(
        self,
        problem: Problem,
        found: Sequence[Run],
        history: Sequence[tuple[int, int, Run]],
        message: str = "",
    ) -> None:
        self._problem = problem
        runs = list(found) if problem.others else _distinct(problem, found)
        self._run, self._history = runs[0], sorted(history, key=lambda one: one[:2])
        self.candidates = tuple(Candidate(problem, run) for run in runs)
        self.values: Mapping[str, float] = self.candidates[0].values
        self.measures: Mapping[str, float] = MappingProxyType(dict(self._run.columns))
        self.objective = self._run.objective
        self.runs = len(history)
        self.success = self._run.holds
        self.message = message or _told(problem, self._run)
        self.remarks = (*_remarks(problem, self._run), *_beside(problem, self._run, history))
        plan = problem.plan
        known = {name: plan.unit_of(name) for name in plan.names}
        known |= dict(zip(problem.columns.labels, problem.columns.units, strict=True))
        self.units: Mapping[str, str] = MappingProxyType(known)

    @property
    def case(self) -> Case:  # noqa: D102 - see Attributes
        return self.candidates[0].case

    @property
    def label(self) -> str:
        """The objective in words."""
        return self._problem.label

    @property
    def labels(self) -> list[str]:
        """All objectives in words."""
        return self._problem.labels

    @property
    def units_of_objectives(self) -> list[str]:
        """Their SI units; empty for an unknown one."""
        return [one.unit for one in self._problem.objectives]

    @property
    def unit(self) -> str:
        """The SI unit of the objective; empty if it is not known."""
        return self._problem.unit

    @cached_property
    def active(self) -> Mapping[str, float]:  # noqa: D102
        return MappingProxyType(_active(self._problem, self._run))

    @property
    def start(self) -> Case:
        """The case before the search."""
        return self._problem.case

    @cached_property
    def before(self) -> Mapping[str, float]:
        """The values of the variables before the search."""
        return MappingProxyType(present(self._problem.case, self._problem.plan.names))

    @cached_property
    def bounds(self) -> Mapping[str, tuple[float, float]]:
        """The bounds of the variables."""
        return MappingProxyType({b.name: (b.least, b.largest) for b in self._problem.bounds})

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of the columns of numbers in ``history``."""
        labels = (*self._problem.plan.names, *self._problem.columns.labels)
        others = (self._problem.labels[1 + j] for j in self._further)
        return ("start", "run", *labels, *others, "objective", "violation")

    @property
    def _further(self) -> list[int]:
        """The places of the further objectives that are no columns themselves."""
        labels = self._problem.columns.labels
        return [j for j, name in enumerate(self._problem.labels[1:]) if name not in labels]

    @cached_property
    def _table(self) -> Floats:
        names = self._problem.columns.labels
        rows = []
        for start, k, run in self._history:
            columns = [run.columns.get(name, np.nan) for name in names]
            columns += [run.others[j] if run.others else np.nan for j in self._further]
            violation = np.nan if run.reason else run.violation
            rows.append([start, k, *run.row, *columns, run.objective, violation])
        return np.array(rows).reshape(len(rows), len(self.columns))

    @cached_property
    def reasons(self) -> tuple[str, ...]:
        """Why each run failed, in the order of ``history``; empty for the others."""
        return tuple(run.reason for *_, run in self._history)

    @cached_property
    def history(self) -> Any:  # noqa: D102
        pairs = dict(zip(self.columns, self._table.T, strict=True))
        return _as_table(pairs | {"reason": np.array(self.reasons, dtype=object)})

    @cached_property
    def front(self) -> Any:  # noqa: D102
        one = [{**each.values, **each.objectives} for each in self.candidates]
        return _as_table({name: np.array([of[name] for of in one]) for name in one[0]})

    def to_csv(self, path: Path | str) -> None:
        """Write the history as CSV with 17 digits, in SI units and rad.

        Raises:
            FileError: the file cannot be written; an existing file is not changed.
        """
        rows = zip(self._table.tolist(), self.reasons, strict=True)
        _write_csv(path, (*self.columns, "reason"), ([*row, told] for row, told in rows))

    def front_to_csv(self, path: Path | str) -> None:
        """Write the front as CSV with 17 digits, in SI units and rad.

        Raises:
            FileError: the file cannot be written; an existing file is not changed.
        """
        names = (*self.values, *self.labels)
        _write_csv(
            path, names, ((*of.values.values(), *of.objectives.values()) for of in self.candidates)
        )

    def __repr__(self) -> str:
        told = ", ".join(f"{name} = {x:.6g}" for name, x in self.values.items())
        if self._problem.others:
            objectives = " and ".join(self.labels)
            return f"<Optimum: {len(self.candidates)} points of the front of {objectives}>"
        unit = display(self.unit)
        return (
            f"<Optimum: {self.label} = {self.objective:.6g} {self.unit or unit.unit}".rstrip()
            + f" at {told}; {self.runs} runs; {self.message}>"
        )


def _write_csv(path: Path | str, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write a table; NaN is an empty cell."""
    text = io.StringIO()
    write = csv.writer(text, lineterminator="\n").writerow
    write(header)
    for row in rows:
        write([x if isinstance(x, str) else "" if np.isnan(x) else f"{x:.17g}" for x in row])
    files.write_text(path, text.getvalue())


def _as_table(columns: Mapping[str, Any]) -> Any:
    """A data frame, or a structured array without pandas."""
    try:
        import pandas
    except ImportError:
        kinds = [(name, of.dtype) for name, of in columns.items()]
        found = np.empty(len(next(iter(columns.values()))), np.dtype(kinds))
        for name, of in columns.items():
            found[name] = of
        return found
    frame = pandas.DataFrame({name: list(of) for name, of in columns.items()})
    return frame.astype({name: int for name in ("start", "run") if name in columns})


def _values(problem: Problem, run: Run) -> dict[str, float]:
    return dict(zip(problem.plan.names, run.row.tolist(), strict=True))


def _distinct(problem: Problem, found: Sequence[Run]) -> list[Run]:
    """Runs in order, best first, without those that are near to a better one."""
    if any(run.holds for run in found):
        found = [run for run in found if run.holds]
    else:
        found = [min(found, key=lambda run: run.violation)]
    kept: list[Run] = []
    for run in sorted(found, key=lambda run: problem.sign * run.objective):
        shares = problem.shares(run.row)
        scale = max(abs(run.objective), abs(kept[0].objective) if kept else 0.0)
        near = (
            np.abs(problem.shares(one.row) - shares).max() < _APART
            and abs(one.objective - run.objective) <= _ALIKE * scale
            for one in kept
        )
        if not any(near):
            kept.append(run)
    return kept


def _told(problem: Problem, run: Run) -> str:
    """How a search ended: done, or which limit cannot be met and by how much."""
    if problem.others:
        return f"a front of {len(problem.labels)} objectives"
    if run.holds:
        return "all limits hold" if problem.limits else "done"
    beyond: dict[int, float] = {}
    for k, room, size in zip(run.limits, run.room, run.sizes, strict=True):
        if -room > TOLERANCE * size:
            beyond[k] = max(beyond.get(k, 0.0), -room)
    told = []
    for k, missing in beyond.items():
        unit = display(problem.limits[k].room.unit)
        by = f"{missing / unit.divisor:.4g} {unit.symbol}".rstrip()
        told.append(f"{problem.limits[k].text} is missed by {by}")
    return "the search found no values that satisfy all limits: at the nearest, " + ", ".join(told)


def _tied(problem: Problem, run: Run) -> list[int]:
    """The pieces of the objective that are equally bad to a part of their size."""
    values = problem.sign * run.pieces[0]
    near = values.max() - values <= _TIGHT * np.abs(values).max()
    return [k for k, of in enumerate(near) if of]


def _remarks(problem: Problem, run: Run) -> tuple[str, ...]:
    """Load cases that are equally bad."""
    if not isinstance(problem.objective, Formula) or not problem.objective.worst:
        return ()
    tied, count = _tied(problem, run), len(problem.parameters) - 1
    if len(tied) < 2:
        return ()
    places = range(len(problem.objective.worst))
    loads = sorted({1 + k // count**place % count for k in tied for place in places})
    told = f"{problem.label}: loads {' and '.join(map(str, loads))} are equally bad"
    return (f"{told}, so that the best values lie in a corner; one load alone has no worth",)


def _active(problem: Problem, run: Run) -> dict[str, float]:
    """What holds with equality, with the multipliers of Karush, Kuhn and Tucker.

    At the optimum, the slope of the objective is a sum of the slopes of these bounds and limits
    with factors that are not negative. Least squares finds them. Points of a front have none.
    """
    if problem.others:
        return {}
    shares, rates = problem.shares(run.row), problem.rates(run.row)
    texts: list[str] = []
    doubtful: set[int] = set()
    slopes, per_unit = [], []
    for k, bound in enumerate(problem.bounds):
        for end, sign, value in ((0.0, 1.0, bound.least), (1.0, -1.0, bound.largest)):
            if (away := abs(shares[k] - end)) < _NEAR:
                doubtful |= {len(texts)} if away >= _AT else set()
                texts.append(f"{bound.name} {'>=' if sign > 0.0 else '<='} {_short(value)}")
                slopes.append(sign * np.eye(len(shares))[k])
                per_unit.append(1.0 / rates[k])
    for j, k in enumerate(run.limits):
        if run.room[j] <= _TIGHT * run.sizes[j]:
            slope = np.nan_to_num(run.room_slopes[j]) * rates
            size = float(np.abs(slope).max()) or 1.0
            texts.append(problem.limits[k].text)
            slopes.append(slope / size)
            per_unit.append(1.0 / size)
    if not texts or not np.isfinite(run.slope).all():
        return dict.fromkeys(texts, float("nan"))
    aims = problem.sign * run.pieces[1][_tied(problem, run)] * rates
    scale = float(np.abs(aims).max()) or 1.0
    # the slope of the objective is a mean of those of the worst load cases, whose weights are found
    rows = np.vstack([np.reshape(slopes, (len(texts), -1)), -aims / scale])
    ones = np.repeat([0.0, _WEIGHT], (len(texts), len(aims)))
    factors, rest = scipy().nnls(
        np.vstack([rows.T, ones]), np.append(np.zeros(len(shares)), _WEIGHT)
    )
    if rest > _REST and scale > _FLAT * abs(run.objective):  # a corner of the objective
        return dict.fromkeys(texts, float("nan"))
    found: dict[str, float] = {}
    for k, text in enumerate(texts):  # a text may occur twice: a bound is also a limit
        if k not in doubtful or factors[k] > 0.0:
            found[text] = found.get(text, 0.0) + float(factors[k] * scale * abs(per_unit[k]))
    return found


def _short(value: float) -> str:
    """A number as in a file: ``1e7``, not ``1e+07``."""
    mantissa, _, power = f"{value:.6g}".partition("e")
    return f"{mantissa}e{int(power)}" if power else mantissa


def _beside(problem: Problem, run: Run, history: Sequence[tuple[int, int, Run]]) -> tuple[str, ...]:
    """Whether runs beside the best values failed, so that the search could not go on there."""
    if problem.others:
        return ()
    best = problem.shares(run.row)
    failed = (one for *_, one in history if one.reason)
    reasons = [one.reason for one in failed if np.abs(problem.shares(one.row) - best).max() < _NEAR]
    if not reasons:
        return ()
    told = f"runs beside the best values fail ({reasons[-1]})"
    return (f"{told}: the search ended there; other starts may find better values",)
