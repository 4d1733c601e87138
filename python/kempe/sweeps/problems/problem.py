"""A problem of design: variables between bounds, an objective, and limits."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.sweeps.plan import Plan
from kempe.sweeps.problems.formulas import Formula, Limit, Parameters
from kempe.sweeps.problems.path import Path

if TYPE_CHECKING:
    from kempe.case import Case

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

    def residuals(self, slopes: Mapping[str, tuple[float, Floats]]) -> tuple[Floats, Floats]:
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
        residuals: residuals whose sum of squares is the square of the objective, and their
            derivatives; empty if it is not of this kind.
        room: the room in each limit, at least 0 where it holds.
        room_slopes: their derivatives.
        sizes: the size of each limit: of the terms that it compares, or of their change over the
            bounds where they are all near 0.
        reason: why the run failed; empty if it did not.
    """

    row: Floats
    columns: Mapping[str, float]
    objective: float
    slope: Floats
    residuals: tuple[Floats, Floats]
    room: Floats
    room_slopes: Floats
    sizes: Floats
    reason: str = ""

    @classmethod
    def failed(cls, row: Floats, reason: str) -> Run:
        """A run that failed."""
        none = np.zeros(0)
        return cls(row, {}, np.nan, none, (none, none), none, none, none, reason)

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
        plan: the analysis, the variables and the columns.
        bounds: the variables with their bounds.
        aim: "minimize", "maximize" or "target".
        objective: a formula, a path, or targets.
        limits: the limits.
    """

    case: Case
    plan: Plan
    bounds: tuple[Bound, ...]
    aim: str
    objective: Formula | Path | Targets
    limits: tuple[Limit, ...]
    parameters: Parameters

    @property
    def path(self) -> Path | None:
        """The path, if it is the objective."""
        return self.objective if isinstance(self.objective, Path) else None

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
    def unit(self) -> str:
        """The SI unit of the objective; empty if it is not known."""
        if isinstance(self.objective, Path):
            return "m"
        return self.objective.unit if isinstance(self.objective, Formula) else "1"

    @property
    def is_square(self) -> bool:
        """Whether the objective is a root of squares, which has a corner at zero."""
        of = self.objective
        return not isinstance(of, Formula) or (of.columns == [of.text] and of.text.endswith(".rms"))

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
        values = dict(zip(self.plan.names, row.tolist(), strict=True))
        parameters = {name: x for name, x in values.items() if "." not in name}
        start = {name: x for name, x in values.items() if "." in name}
        case = self.case.with_parameters(parameters) if parameters else self.case
        return case.with_start(start) if start else case

    def judged(self, row: Floats, found: Numbers) -> Run:
        """The objective and the limits of a run."""
        texts = [one.text for one in self.plan.wanted]
        slopes = dict(
            zip(texts, zip(found.columns.tolist(), found.slopes, strict=True), strict=True)
        )
        slopes |= self.parameters.at(row, self._names)
        residuals = (found.residuals, found.residual_slopes)
        if isinstance(self.objective, Targets):
            residuals = self.objective.residuals(slopes)
        if isinstance(self.objective, Formula):
            value, slope = self.objective.at(slopes)
        else:
            value = float(np.linalg.norm(residuals[0]))
            slope = residuals[0] @ residuals[1] / value if value else np.zeros(len(row))
        rooms = [limit.room.at(slopes) for limit in self.limits]
        sizes = [
            self._size(limit, slopes, (room, slope * self.rates(row)))
            for limit, (room, slope) in zip(self.limits, rooms, strict=True)
        ]
        columns = dict(zip(texts, found.columns.tolist(), strict=True))
        for name, number in [(self.label, value)] + [
            (limit.text, room) for limit, (room, _) in zip(self.limits, rooms, strict=True)
        ]:
            if not np.isfinite(number):
                return Run.failed(row, f"{name} has no value here: it is {number}")
        return Run(
            row,
            columns,
            float(value),
            slope,
            residuals,
            np.array([room for room, _ in rooms]),
            np.array([slope for _, slope in rooms]).reshape(len(rooms), len(row)),
            np.array(sizes),
        )

    @staticmethod
    def _size(
        limit: Limit, known: Mapping[str, tuple[float, Floats]], room: tuple[float, Floats]
    ) -> float:
        """The size of a limit, from its room and the change of this over the bounds."""
        sides = [abs(side.at(known)[0]) for side in limit.sides]
        size = max(*sides, limit.room.size(known))
        if min(sides) == 0.0 and abs(room[0]) > 0.5 * size:  # nothing cancels: it is near 0 itself
            size = max(size, _SMALL * float(np.abs(np.nan_to_num(room[1])).max()))
        return size

    @property
    def _names(self) -> Sequence[str]:
        """The parameters in formulas."""
        texts = {one.text for one in self.plan.wanted}
        return [name for formula in self.formulas for name in formula.names if name not in texts]

    @property
    def formulas(self) -> list[Formula]:
        """All formulas: the objective, the limits and their sides."""
        found = [formula for limit in self.limits for formula in (limit.room, *limit.sides)]
        if isinstance(self.objective, Targets):
            return [*self.objective.columns, *found]
        return [self.objective, *found] if isinstance(self.objective, Formula) else found
