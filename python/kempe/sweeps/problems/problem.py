"""A problem of design: variables between bounds, an objective, and limits."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from kempe.base.arrays import Floats
from kempe.sweeps.plan import Plan
from kempe.sweeps.problems.columns import Columns
from kempe.sweeps.problems.formulas import Formula, Limit, Parameters
from kempe.sweeps.problems.path import Path
from kempe.sweeps.variables import changed

if TYPE_CHECKING:
    from kempe.case import Case

#: Values and derivatives of columns and parameters by their names.
Known: TypeAlias = "Mapping[str, tuple[float, Floats]]"
#: Part of the size of a limit by which it may be exceeded.
TOLERANCE = 1e-6
#: Part of the change of a limit over the bounds that is its least size.
_SMALL = 1e-3


@dataclass(frozen=True)
class Bound:
    """A variable between its bounds.

    Attributes:
        name: a parameter, or a coordinate or rate at the start.
        least: its least value.
        largest: its largest value.
        log: whether it is searched on a logarithmic scale.
    """

    name: str
    least: float
    largest: float
    log: bool

    def at(self, share: float) -> float:
        """Its value at a point of the unit interval; both ends are exact."""
        if share <= 0.0 or share >= 1.0:
            return self.least if share <= 0.0 else self.largest
        if self.log:
            return float(self.least * (self.largest / self.least) ** share)
        return self.least + share * (self.largest - self.least)

    def share(self, value: float) -> float:
        """The point of the unit interval that belongs to a value, at an end for values beyond."""
        if self.log:
            if value * self.least <= 0.0:
                return 0.0
            found = np.log(value / self.least) / np.log(self.largest / self.least)
        else:
            found = (value - self.least) / (self.largest - self.least)
        return float(np.clip(found, 0.0, 1.0))

    def rate(self, value: float) -> float:
        """The derivative of the value by the point of the unit interval."""
        if self.log:
            return float(value * np.log(self.largest / self.least))
        return self.largest - self.least


@dataclass(frozen=True)
class Targets:
    """Values that columns should have; the objective is the root mean square of their deviations.

    Attributes:
        columns: formulas of the columns.
        values: the values; a deviation is relative to its magnitude, in SI units where it is 0.
    """

    columns: tuple[Formula, ...]
    values: tuple[float, ...]

    def residuals(self, slopes: Known) -> tuple[Floats, Floats]:
        """The relative deviations, divided by √n, and their derivatives."""
        found = [column.at(slopes) for column in self.columns]
        sizes = [(abs(of) or 1.0) * len(self.values) ** 0.5 for of in self.values]
        apart = [
            (x - of) / size for (x, _), of, size in zip(found, self.values, sizes, strict=True)
        ]
        rows = [slope / size for (_, slope), size in zip(found, sizes, strict=True)]
        return np.array(apart), np.array(rows)


@dataclass(frozen=True)
class Numbers:
    """What was read of a run.

    Attributes:
        columns: the columns, (n_columns,).
        slopes: their derivatives by the variables, (n_columns, n_variables).
        residuals: the residuals of a path, (m,); empty without one.
        residual_slopes: their derivatives, (m, n_variables).
    """

    columns: Floats
    slopes: Floats
    residuals: Floats
    residual_slopes: Floats


@dataclass(frozen=True)
class Run:
    """A run of a search: the values of the objective and of the limits.

    Attributes:
        row: the values of the variables.
        columns: the columns by name.
        objective: its value; NaN if the run failed.
        slope: its derivatives by the variables.
        pieces: its values and derivatives in all load cases, of which it is the worst; one without
            ``worst``.
        residuals: residuals whose sum of squares is the square of the objective, and their
            derivatives; empty if it is not of this kind.
        room: the room in each limit, at least 0 where it holds; for ``worst`` in all load cases.
        room_slopes: their derivatives.
        limits: the place of the limit to which each room belongs.
        sizes: the size of each limit: of the terms that it compares, or of their change over the
            bounds where they are all near 0.
        others: the values of further objectives.
        reason: why the run failed; empty if it did not.
    """

    row: Floats
    columns: Mapping[str, float]
    objective: float
    slope: Floats
    pieces: tuple[Floats, Floats]
    residuals: tuple[Floats, Floats]
    room: Floats
    room_slopes: Floats
    limits: tuple[int, ...]
    sizes: Floats
    others: tuple[float, ...] = ()
    reason: str = ""

    @classmethod
    def failed(cls, row: Floats, reason: str) -> Run:
        """A run that failed."""
        none = np.zeros(0)
        pair = (none, none)
        return cls(row, {}, np.nan, none, pair, pair, none, none, (), none, reason=reason)

    @property
    def violation(self) -> float:
        """The largest excess of a limit, as a part of its size; 0 if all hold."""
        if self.reason:
            return np.inf
        if not len(self.room):
            return 0.0
        parts = -self.room / np.maximum(self.sizes, np.finfo(float).tiny)
        return max(0.0, float(parts.max()))

    @property
    def holds(self) -> bool:
        """Whether it succeeded and all limits hold."""
        return self.violation <= TOLERANCE


@dataclass(frozen=True)
class Problem:
    """A problem.

    Attributes:
        case: the whole case.
        plan: the analysis and the variables.
        columns: the columns.
        bounds: the variables with their bounds.
        aim: "minimize", "maximize" or "target".
        objective: a formula, a path, or targets.
        limits: the limits.
        parameters: the parameters of the case, and then those of each load case.
        others: further objectives of a Pareto front.
    """

    case: Case
    plan: Plan
    columns: Columns
    bounds: tuple[Bound, ...]
    aim: str
    objective: Formula | Path | Targets
    limits: tuple[Limit, ...]
    parameters: tuple[Parameters, ...]
    others: tuple[Formula | Path, ...] = ()

    @property
    def path(self) -> Path | None:
        """The path, if it is an objective."""
        own = (self.objective, *self.others)
        return next((one for one in own if isinstance(one, Path)), None)

    @property
    def sign(self) -> float:
        """1 if smaller objectives are better, -1 if larger ones are."""
        return -1.0 if self.aim == "maximize" else 1.0

    @property
    def label(self) -> str:
        """The objective in words."""
        if isinstance(self.objective, Path):
            return f"distance of {self.objective.of}"
        return "deviation from the target" if self.aim == "target" else self.objective.text  # type: ignore[union-attr]

    @property
    def labels(self) -> list[str]:
        """All objectives in words."""
        return [one.label for one in self.objectives]

    @property
    def unit(self) -> str:
        """The SI unit of the objective; empty if it is not known."""
        if isinstance(self.objective, Path):
            return "m"
        return self.objective.unit if isinstance(self.objective, Formula) else "1"

    @property
    def is_square(self) -> bool:
        """Whether the objective is a root of squares, which has a corner at zero."""
        return not isinstance(self.objective, Formula) or _is_rms(self.objective)

    @property
    def has_smooth_residuals(self) -> bool:
        """Whether it is a sum of squares of smooth residuals.

        An rms has the shape of a cone at its target 0. Only its square is smooth.
        """
        of = self.objective
        if isinstance(of, Targets):
            pairs = zip(of.columns, of.values, strict=True)
            return not any(value == 0.0 and _is_rms(column) for column, value in pairs)
        return isinstance(of, Path)

    def row(self, shares: Floats) -> Floats:
        """The values of the variables at a point of the unit cube."""
        pairs = zip(self.bounds, shares.tolist(), strict=True)
        return np.array([bound.at(share) for bound, share in pairs])

    def shares(self, row: Iterable[float]) -> Floats:
        """The point of the unit cube that belongs to values."""
        return np.array([bound.share(x) for bound, x in zip(self.bounds, row, strict=True)])

    def rates(self, row: Floats) -> Floats:
        """The derivatives of the values by the point of the unit cube."""
        return np.array([bound.rate(x) for bound, x in zip(self.bounds, row.tolist(), strict=True)])

    def changed(self, row: Floats) -> Case:
        """The case with values of the variables."""
        return changed(self.case, dict(zip(self.plan.names, row.tolist(), strict=True)))

    def judged(self, row: Floats, found: Numbers) -> Run:
        """The objective and the limits of a run."""
        known = self._known(row, found)
        pieces, residuals = self._objective(row, known, found)
        worst = int(np.argmax(self.sign * pieces[0]))
        others = tuple(one._value(row, known, found) for one in self.objectives[1:])
        rooms, owners, sizes = [], [], []
        for k, limit in enumerate(self.limits):
            for piece in self._pieces(limit.room, known):
                room, slope = limit.room.at(piece)
                rooms.append((room, slope))
                owners.append(k)
                sizes.append(self._size(limit, piece, (room, slope * self.rates(row))))
        named = list(zip(self.labels, (pieces[0][worst], *others), strict=True))
        named += [(self.limits[k].text, room) for k, (room, _) in zip(owners, rooms, strict=True)]
        for name, number in named:
            if not np.isfinite(number):
                return Run.failed(row, f"{name} has no value here: it is {number}")
        return Run(
            row,
            dict(zip(self.columns.labels, found.columns.tolist(), strict=True)),
            float(pieces[0][worst]),
            pieces[1][worst],
            pieces,
            residuals,
            np.array([room for room, _ in rooms]),
            np.array([slope for _, slope in rooms]).reshape(len(rooms), len(row)),
            tuple(owners),
            np.array(sizes),
            others,
        )

    def _value(self, row: Floats, known: list[Known], found: Numbers) -> float:
        """The objective."""
        values = self._objective(row, known, found)[0][0]
        return float(values[int(np.argmax(self.sign * values))])

    def _objective(
        self, row: Floats, known: list[Known], found: Numbers
    ) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
        """The pieces of the objective, and its residuals."""
        residuals = (found.residuals, found.residual_slopes)
        if isinstance(self.objective, Formula):
            of = self.objective
            pieces = [of.at(piece) for piece in self._pieces(of, known)]
            return (np.array([x for x, _ in pieces]), np.array([by for _, by in pieces])), residuals
        if isinstance(self.objective, Targets):
            residuals = self.objective.residuals(known[0])
        value = float(np.linalg.norm(residuals[0]))
        slope = residuals[0] @ residuals[1] / value if value else np.zeros(len(row))
        return (np.array([value]), slope[None]), residuals

    def _known(self, row: Floats, found: Numbers) -> list[Known]:
        """Columns and parameters of the case itself, and then of each load case."""
        known: list[dict[str, tuple[float, Floats]]] = [{} for _ in self.parameters]
        values, slopes = map(self.columns.split, (found.columns, found.slopes))
        for part, x, by in zip(self.columns.parts, values, slopes, strict=True):
            pairs = zip(x.tolist(), by, strict=True)
            known[part.load] |= dict(zip(part.texts, pairs, strict=True))
        for own, formulas, parameters in zip(known, self._by_load, self.parameters, strict=True):
            names = (name for one in formulas for name in one.names if name not in one.worst)
            own.update(parameters.at(row, [name for name in names if name not in own]))
        return list(known)

    def _pieces(self, formula: Formula, known: list[Known]) -> Iterator[Known]:
        """The columns and parameters of a formula, with each ``worst`` in every load case."""
        for loads in product(known[1:], repeat=len(formula.worst)):
            pairs = zip(formula.worst.items(), loads, strict=True)
            yield {**known[0], **{name: one.at(load) for (name, one), load in pairs}}

    @staticmethod
    def _size(limit: Limit, known: Known, room: tuple[float, Floats]) -> float:
        """The size of a limit, from its room and the change of this over the bounds."""
        sides = [abs(side.at(known)[0]) for side in limit.sides]
        size = max(*sides, limit.room.size(known))
        if min(sides) == 0.0 and abs(room[0]) > 0.5 * size:  # nothing cancels: it is near 0 itself
            size = max(size, _SMALL * float(np.abs(np.nan_to_num(room[1])).max()))
        return size

    @property
    def _by_load(self) -> list[list[Formula]]:
        """The formulas whose names belong to the case itself, and then to each load case."""
        within = [one for formula in self.formulas for one in formula.worst.values()]
        return [self.formulas, *([within] * (len(self.parameters) - 1))]

    @property
    def formulas(self) -> list[Formula]:
        """All formulas: the objectives, the limits and their sides."""
        found = [formula for limit in self.limits for formula in (limit.room, *limit.sides)]
        of = self.objective
        own = of.columns if isinstance(of, Targets) else (of, *self.others)
        return [*(one for one in own if isinstance(one, Formula)), *found]

    @property
    def objectives(self) -> tuple[Problem, ...]:
        """The problem with each of its objectives alone."""
        all_of = (self.objective, *self.others)
        return tuple(replace(self, objective=one, others=()) for one in all_of)


def _is_rms(of: Formula) -> bool:
    """Whether a formula is one column that is a root of squares."""
    return of.columns == [of.text] and of.text.endswith(".rms")
