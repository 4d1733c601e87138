"""The plan of a sweep: all data that a worker needs for any row.

A plan can be pickled. Its rows do not depend on each other. Their numbers are therefore equal in
any order, on any thread and in any process of one kind of machine.
"""

from __future__ import annotations

import hashlib
import json
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from kempe import _core
from kempe._version import __version__
from kempe.analyses.request_cache import encode
from kempe.base.arrays import Floats
from kempe.base.names import one_of
from kempe.errors import IntegrationError, InternalError, KempeError, ModelError
from kempe.model.measure_infos import measure_info, parameter_unit
from kempe.model.values import numbers
from kempe.sweeps.numbers import reads_quantities
from kempe.sweeps.reasons import origin_of, reason
from kempe.sweeps.variables import changed
from kempe.sweeps.wanted import Number, Wanted

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.model.compiled import CompiledModel
    from kempe.results.result import Result
    from kempe.results.solution import Solution


#: The format of files of sweeps: 3 since rows have checksums.
FORMAT = 3


class NoSlopesError(IntegrationError):
    """A motion has no derivatives."""


@dataclass(frozen=True)
class Block:
    """Rows of results.

    Attributes:
        values: the wanted numbers, (n, n_wanted); NaN in rows that failed.
        reasons: why a row failed; empty for the others.
        marks: the marks of the numbers, (n, n_wanted); see ``kempe.sweeps.remarked``.
    """

    values: Floats
    reasons: list[str]
    marks: NDArray[np.uint8]

    @classmethod
    def of(cls, values: Floats) -> Block:
        """Rows without reasons and marks."""
        return cls(values, [""] * len(values), np.zeros(values.shape, np.uint8))


@dataclass(frozen=True)
class Plan:
    """A case, the names of its variables, and the wanted numbers.

    Attributes:
        case: the case.
        analysis: name of the analysis.
        names: the variables, in the order of columns.
        wanted: the numbers of each row.
    """

    case: Case
    analysis: str
    names: tuple[str, ...]
    wanted: tuple[Wanted, ...]

    def rows(self, given: Floats, workers: int) -> Block:
        """Run variants.

        Args:
            given: values of the variables, (n, n_variables).
            workers: number of threads.
        """
        if not self.is_native:
            return self._singly(given)
        values, reasons, left = self._native(given, workers)
        block = Block.of(values)
        for row, message in reasons:
            block.reasons[row] = reason(message, self._origin)
        for row in left.tolist():
            one = self._singly(given[row : row + 1])
            block.values[row], block.reasons[row] = one.values[0], one.reasons[0]
            block.marks[row] = one.marks[0]
        return block

    def variant(self, row: Floats) -> Case:
        """The case with the values of a row.

        Raises:
            ModelError: the model is impossible with these values.
        """
        return changed(self.case, dict(zip(self.names, map(float, row), strict=True)))

    def run(self, row: Floats) -> Solution | Result:
        """The result of the analysis with the values of a row.

        Raises:
            KempeError: it fails.
        """
        return self._run(row)[0]

    def read(self, row: Floats) -> list[tuple[float, int]]:
        """The wanted numbers of a single run with the values of a row, and their marks.

        Raises:
            KempeError: the run fails, or a number has no value.
        """
        found, number = self._run(row)
        return [one.read(found, number) for one in self.wanted]

    def _run(self, row: Floats) -> tuple[Solution | Result, Number]:
        """The result, and the function that reads its numbers."""
        *_, (_, found, number) = self.variant(row).found()
        return found, number

    @cached_property
    def is_native(self) -> bool:
        """Whether the core runs the variants on its threads.

        A frequency, a measure of a whole run, functions in Python, and measures of redundant joints
        are computed by single runs, one after the other.
        """
        if any(one.of_run for one in self.wanted):
            return False
        kind = self.case.analyses[self.analysis]["type"]
        statistics = [one.statistic for one in self.wanted if one.statistic]
        reads = reads_quantities(kind, [one.text for one in self.wanted])
        return _core.sweeps(self.case.model.compile().core, statistics, reads, False)

    def unit_of(self, name: str) -> str:
        """The SI unit of a variable; empty for a parameter that is written without one."""
        model = self.case.model.compile()
        of = parameter_unit if name in model.parameters else _unit_of_coordinate
        found = of(model, name)
        return "" if found == "SI" else found

    def check(self) -> None:
        """Refuse a variable of the start that no coordinate or rate has.

        Raises:
            ModelError: there is no such coordinate or rate, or it cannot be set.
        """
        start = {name: 0.0 for name in self.names if "." in name}
        if start:
            self.case.with_start(start)

    def key_of(self, given: Floats) -> str:
        """A fingerprint of the sweep of these rows: equal fingerprints imply equal results."""
        try:
            tree = self.case.model.with_points(self.case.tree())
        except KempeError as error:
            raise ModelError(
                f"results of this sweep cannot be kept in a file: {error.args[0]}",
                hint="leave out= out, or write the law as a formula",
            ) from error
        texts = [one.text for one in self.wanted]
        asked = [self.analysis, self.names, texts, __version__, FORMAT]
        text = json.dumps([tree, asked], sort_keys=True)
        digest = hashlib.sha256(text.encode())
        digest.update(np.ascontiguousarray(given, dtype="<f8").tobytes())
        return digest.hexdigest()

    @cached_property
    def _request(
        self,
    ) -> tuple[_core.Model, str, str, str, list[str], list[tuple[int | None, str]]]:
        """The arguments of the core that all rows share."""
        of_start = {name: 0.0 for name in self.names if "." in name}
        tree = (self.case.with_start(of_start) if of_start else self.case)._start.tree()
        measures = list(dict.fromkeys(one.expression for one in self.wanted if one.statistic))
        wanted: list[tuple[int | None, str]] = [
            (measures.index(one.expression), one.statistic) if one.statistic else (None, one.text)
            for one in self.wanted
        ]
        return (
            self.case.model.compile().core,
            encode(numbers(tree.get("set"), "set")),
            encode(numbers(tree.get("guess"), "guess")),
            encode(self.case.analyses),
            measures,
            wanted,
        )

    @cached_property
    def _order(self) -> list[int]:
        """The columns of parameters, then those of start values."""
        return sorted(range(len(self.names)), key=lambda k: "." in self.names[k])

    @cached_property
    def _columns(self) -> tuple[list[str], list[str]]:
        """The names of parameters, and those of start values."""
        of_start = ["." in name for name in self.names]
        pairs = list(zip(self.names, of_start, strict=True))
        return [name for name, of in pairs if not of], [name for name, of in pairs if of]

    def _native(self, given: Floats, workers: int) -> tuple[Floats, list[tuple[int, str]], Any]:
        ordered = np.ascontiguousarray(given[:, self._order])
        return _core.sweep(*self._request, *self._columns, ordered, workers)

    def _seen(self, row: Floats) -> Plan:
        """The plan whose functions in Python see the model with the values of a row."""
        case = self.case
        return replace(self, case=self.variant(row)) if case.model.compile().functions else self

    def slopes(self, row: Floats) -> tuple[Floats, Floats, dict[tuple[int, int], str]]:
        """The wanted numbers with these values of the variables, and their derivatives.

        Returns:
            The numbers, (n_wanted,); the derivatives, (n_wanted, n_variables), NaN where there is
            none; remarks by the places of number and variable.

        Raises:
            KempeError: the run fails.
        """
        ordered = np.ascontiguousarray(row[self._order])
        request = self._seen(row)._request
        values, ordered_slopes, remarks = _core.gradient(*request, *self._columns, ordered)
        slopes = np.empty_like(ordered_slopes)
        slopes[:, self._order] = ordered_slopes
        return values, slopes, {(k, self._order[of]): text for k, of, text in remarks}

    def slopes_at(
        self, measures: Sequence[str], times: Floats, row: Floats
    ) -> tuple[Floats, Floats]:
        """Measures of the motion at given times, and their derivatives.

        Args:
            measures: expressions of quantities.
            times: times within the motion, or values of the quantity over which it goes.
            row: values of the variables.

        Returns:
            (n_times, n_measures) and (n_times, n_measures, n_variables).

        Raises:
            NoSlopesError: there are no derivatives.
            KempeError: the run fails.
        """
        core, start, guess, analyses, *_ = self._seen(row)._request
        request = (core, start, guess, analyses, list(measures), times)
        values, slopes, reason = _core.slopes_at(*request, *self._columns, row[self._order])
        if reason:
            raise NoSlopesError(f"{', '.join(measures)}: no derivatives: {reason}")
        slopes = slopes.reshape(len(times), len(measures), len(row))
        ordered = np.empty_like(slopes)
        ordered[..., self._order] = slopes
        return values, ordered

    def _singly(self, given: Floats) -> Block:
        block = Block.of(np.full((len(given), len(self.wanted)), np.nan))
        for row, values in enumerate(given):
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    block.values[row], block.marks[row] = zip(*self.read(values), strict=True)
            except InternalError:
                raise
            except KempeError as error:
                block.reasons[row] = reason(str(error.args[0]), self._origin)
        return block

    @cached_property
    def _origin(self) -> str:
        """The name of the file of the model, which is part of messages."""
        return origin_of(self.case.model)

    def __getstate__(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in ("case", "analysis", "names", "wanted")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)


def _unit_of_coordinate(model: CompiledModel, name: str) -> str:
    return measure_info(model, name).unit


def chosen(case: Case, analysis: str | None) -> str:
    """The analysis of a sweep or gradient: the last one by default.

    Raises:
        ModelError: there is none of this name, or the case has none.
    """
    names = list(case.analyses)
    if not names:
        raise ModelError("the case has no analysis", hint="add one, such as kp.Dynamics")
    return names[-1] if analysis is None else one_of("analysis", analysis, names)


def without_later(case: Case, analysis: str) -> Case:
    """The case without the analyses after a given one, which does not depend on them."""
    from kempe.case import Case

    names = list(case.analyses)
    if analysis == names[-1]:
        return case
    kept: Sequence[str] = names[: names.index(analysis) + 1]
    return Case(case.model, case._start, {name: case.analyses[name] for name in kept})
