"""The marks of a sweep: measures that are not unique, or that have no bound, in some variants.

Each number of each variant has a mark. Single runs set it, because the core leaves all models with
redundant joints and all variants that pass singular positions to single runs.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from kempe.results.extrema import passes_singular
from kempe.results.remarks import (
    LEFT_OUT,
    MIDDLE,
    MINIMUM_NORM,
    ONE_SHARE,
    choice_of,
    remark_of_variants,
    together,
)
from kempe.sweeps.numbers import read_at

if TYPE_CHECKING:
    from kempe.results.measures import Measure
    from kempe.results.result import Result
    from kempe.results.solution import Solution
    from kempe.sweeps.result import SweepResult

#: The bits of a mark: the choices of values that are not unique, and values without bound.
_BIT = {MINIMUM_NORM: 1, MIDDLE: 4, LEFT_OUT: 8, ONE_SHARE: 16}
NO_BOUND = 2
#: The statistic that singular positions before the end of a run do not affect.
_AT_THE_END = "final"


def mark_of_measure(measure: Measure, solution: Solution, statistic: str) -> int:
    """The mark of a statistic of a measure in a run."""
    mark = _mark(measure.choice)
    if statistic != _AT_THE_END and measure.info.solves and passes_singular(solution):
        mark |= NO_BOUND if measure.unbounded_at else 0
    return mark


def mark_of_number(found: Result, text: str) -> int:
    """The mark of a number of a result that is not a motion."""
    read = read_at(found, text)
    return 0 if read is None else _mark(choice_of(read[0], *read[1]))


def _mark(choice: str) -> int:
    return sum(bit for one, bit in _BIT.items() if one in choice)


def choices(result: SweepResult) -> Mapping[str, str]:
    """The measures whose values are not unique in some variant, and which values are given."""
    pairs = zip(result.measures, result._marks.T, strict=True)
    found = {
        text: together(one for one, bit in _BIT.items() if np.any(marks & bit))
        for text, marks in pairs
    }
    return MappingProxyType({text: choice for text, choice in found.items() if choice})


def unbounded(result: SweepResult) -> Mapping[str, tuple[int, ...]]:
    """The rows in which a measure has no bound, by its text."""
    pairs = zip(result.measures, result._marks.T, strict=True)
    rows = {text: np.flatnonzero(marks & NO_BOUND).tolist() for text, marks in pairs}
    return MappingProxyType({text: tuple(of) for text, of in rows.items() if of})


def remarks(result: SweepResult) -> Mapping[str, str]:
    """The remarks on measures by their texts."""
    given, passed, count = result.choices, result.unbounded, int(result.succeeded.sum())
    told = {
        text: remark_of_variants(
            given.get(text, ""), unbounded=len(passed.get(text, ())), count=count
        )
        for text in result.measures
    }
    return MappingProxyType({text: of.removeprefix(", ") for text, of in told.items() if of})


def labelled(result: SweepResult, column: str) -> str:
    """The name of a column of a file, with a remark if its values are not unique."""
    choice = result.choices.get(column)
    return f"{column} [{choice}]" if choice else column
