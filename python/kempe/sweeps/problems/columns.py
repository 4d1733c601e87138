"""The columns of a problem: numbers of several analyses, in several load cases."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import InternalError, KempeError
from kempe.sweeps.gradients.run import in_analyses, numbers_and_slopes
from kempe.sweeps.plan import Plan
from kempe.sweeps.problems.formulas import Parameters
from kempe.sweeps.reasons import origin_of, reason

#: Changes of a variable, as parts of its range, for a slope that the core does not give; the second
#: where a run with the first fails on both sides.
_CHANGES = (1e-4, 1e-6)


@dataclass(frozen=True)
class Part:
    """The columns of one analysis in one load case.

    Attributes:
        plan: the analysis with the settings of the load case.
        texts: the columns as the user writes them.
        prefix: name of the analysis with a colon; empty for that of the problem.
        load: the number of the load case; 0 for the case itself.
    """

    plan: Plan
    texts: tuple[str, ...]
    prefix: str
    load: int
    _known: dict[str, dict[int, str]] = field(default_factory=dict)

    @property
    def labels(self) -> list[str]:
        """The names of the columns in tables."""
        return [f"{text}, load {self.load}" if self.load else text for text in self.texts]

    def told(self, message: str) -> str:
        """A reason with its place."""
        told = reason(message, origin_of(self.plan.case.model))
        place = f"load {self.load}, {self.prefix}" if self.load else self.prefix
        return f"{place.rstrip(', :')}: {told}" if place else told

    @cached_property
    def parameters(self) -> Parameters:
        """The parameters in formulas."""
        return Parameters(self.plan)

    def slopes(self, row: Floats, ranges: Floats, workers: int) -> tuple[Floats, Floats]:
        """The numbers and their derivatives; differences where the core has none.

        Args:
            row: the values of the variables.
            ranges: least and largest values of the variables, (n, 2).
            workers: number of threads.

        Raises:
            KempeError: the run fails.
        """
        try:
            values, slopes, _ = numbers_and_slopes(self.plan, row)
            slopes[:, list(self._formulas(row))] = np.nan
        except InternalError:
            raise
        except KempeError as error:
            error.args = (self.told(str(error.args[0])), *error.args[1:])
            raise
        missing = np.isnan(slopes)
        for of in np.flatnonzero(missing.any(axis=0)):
            found = self._difference(row, values, (of, *ranges[of]), workers)
            slopes[missing[:, of], of] = found[missing[:, of]]
        return values, slopes

    def _formulas(self, row: Floats) -> dict[int, str]:
        """The variables in formulas of analyses, whose slopes are differences."""
        if "formulas" not in self._known:
            self._known["formulas"] = in_analyses(self.plan, row)
        return self._known["formulas"]

    def _difference(
        self, row: Floats, values: Floats, variable: tuple[int, float, float], workers: int
    ) -> Floats:
        """The slopes by a variable from two neighbours, or from one if the other fails."""
        of, least, largest = variable
        slopes = np.full(len(values), np.nan)
        for change in _CHANGES:
            near = np.tile(row, (2, 1))
            step = change * (largest - least)
            near[:, of] = np.clip(row[of] + np.array([step, -step]), least, largest)
            up, down = self.plan.rows(near, workers).values
            high, low = (np.where(np.isnan(side), values, side) for side in (up, down))
            apart = np.where(np.isnan(up), row[of], near[0, of])
            apart = apart - np.where(np.isnan(down), row[of], near[1, of])
            found = np.divide(high - low, apart, out=np.full_like(slopes, np.nan), where=apart != 0)
            slopes = np.where(np.isnan(slopes), found, slopes)
        return slopes


@dataclass(frozen=True)
class Columns:
    """All columns of a problem, one part after the other."""

    parts: tuple[Part, ...]

    def __len__(self) -> int:
        return sum(len(part.texts) for part in self.parts)

    @property
    def labels(self) -> list[str]:
        """The names of the columns in tables."""
        return [label for part in self.parts for label in part.labels]

    @property
    def units(self) -> list[str]:
        """Their SI units; empty for an unknown one."""
        return [one.unit.removeprefix("SI") for part in self.parts for one in part.plan.wanted]

    def split(self, numbers: Floats) -> list[Floats]:
        """Numbers of all columns, divided into those of the parts."""
        ends = np.cumsum([len(part.texts) for part in self.parts])
        return [
            numbers[end - len(part.texts) : end] for part, end in zip(self.parts, ends, strict=True)
        ]

    def rows(self, given: Floats, workers: int) -> tuple[Floats, list[str]]:
        """The numbers with these values of the variables, (n, n_columns), and why a run failed."""
        values, reasons = [np.zeros((len(given), 0))], [""] * len(given)
        for part in self.parts:
            block = part.plan.rows(given, workers)
            values.append(block.values)
            for k, told in enumerate(block.reasons):
                reasons[k] = reasons[k] or (part.told(told) if told else "")
        return np.hstack(values), reasons

    def slopes(self, row: Floats, ranges: Floats, workers: int) -> tuple[Floats, Floats]:
        """The numbers and their derivatives; see ``Part.slopes``.

        Raises:
            KempeError: a run fails.
        """
        found = [part.slopes(row, ranges, workers) for part in self.parts]
        return np.concatenate([a for a, _ in found]), np.concatenate([b for _, b in found])


def has_slopes(parts: Sequence[Part], row: Floats) -> bool | None:
    """Whether the core gives some slope of each column at a point; None if a run fails."""
    try:
        found = [numbers_and_slopes(part.plan, row)[1] for part in parts]
    except InternalError:
        raise
    except KempeError:
        return None
    return not any(np.isnan(slopes).all(axis=1).any() for slopes in found)
