"""The subject of a report: a model with its start, its analyses and their results."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.analyses.dynamics import AccuracyWarning
from kempe.analyses.iterations import iterations
from kempe.analyses.record import AssemblyWarning
from kempe.case import Case, parsed
from kempe.errors import KempeError, ModelError
from kempe.model.compiled import CompiledModel
from kempe.results.assembly_report import Iteration
from kempe.results.events import EventWarning
from kempe.results.result import Result
from kempe.results.solution import Solution
from kempe.results.state import State

if TYPE_CHECKING:
    from kempe.sweeps.studies import Study

#: The name of the analysis of a solution that was not computed from a case.
_UNNAMED = "motion"


@dataclass(frozen=True)
class Subject:
    """The subject of a report: model, start and results.

    Attributes:
        tree: the case as nested mappings.
        start: the state in which the first analysis starts.
        newton: Newton–Raphson iterations from the unchanged guess; empty if they fail.
        entries: the analyses as in a file, by name.
        results: their results.
        study: a study of one of them.
        listing: the model file.
    """

    tree: Mapping[str, Any]
    start: State
    newton: Sequence[Iteration]
    entries: Mapping[str, Mapping[str, Any]]
    results: Mapping[str, Solution | Result]
    study: Study | None
    listing: str

    @property
    def model(self) -> CompiledModel:
        """The compiled model at the start."""
        return self.start.compiled

    @property
    def motions(self) -> dict[str, Solution]:
        """The results that are motions."""
        return {k: found for k, found in self.results.items() if isinstance(found, Solution)}

    @property
    def held(self) -> Mapping[str, Any]:
        """The quantities that are set at the start, as in a file."""
        return self._start("set")

    @property
    def guessed(self) -> Mapping[str, Any]:
        """The quantities that are guessed at the start, as in a file."""
        return self._start("guess")

    def _start(self, key: str) -> Mapping[str, Any]:
        found: Mapping[str, Any] = self.tree.get("start", {}).get(key, {})
        return found


def of_case(case: Case, listing: str | None, study: Study | None) -> Subject:
    """A case, whose analyses are run.

    Raises:
        ModelError: it has no analysis.
        KempeError: an analysis fails.
    """
    if not case.analyses:
        raise ModelError("the case contains no analysis", hint="add one, as [analyses.release]")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AssemblyWarning)
        warnings.simplefilter("ignore", EventWarning)
        warnings.simplefilter("ignore", AccuracyWarning)
        start = case.start()
        results = dict(case.each(start=start))
    text = _text(case) if listing is None else listing
    return Subject(_tree(case), start, _newton(case), case.analyses, results, study, text)


def of_solution(solution: Solution, listing: str | None, study: Study | None) -> Subject:
    """A solution, which is not computed again."""
    case = _case(solution)
    name = next(iter(case.analyses), _UNNAMED)
    start = solution.initial
    newton: Sequence[Iteration] = ()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", AssemblyWarning)
            assembled = case.start()
        if np.allclose(assembled.q, start.q, rtol=1e-9, atol=1e-9):
            start, newton = assembled, _newton(case)
    except KempeError:  # the start of the solution is of another origin
        pass
    text = _text(case) if listing is None else listing
    return Subject(_tree(case), start, newton, case.analyses, {name: solution}, study, text)


def _case(solution: Solution) -> Case:
    """The case of a solution; only its model contains laws that are Python functions."""
    model = solution.compiled
    try:
        return parsed(model.case, "json", "the solution")
    except ModelError:
        tree = model.tree
        return Case(model.model, tree.get("start"), tree.get("analyses", {}))


def _tree(case: Case) -> Mapping[str, Any]:
    return case._with_rest(case.model.shown())


def _newton(case: Case) -> Sequence[Iteration]:
    try:
        return iterations(case).rows
    except KempeError:  # they need not converge from a rough guess
        return ()


def _text(case: Case) -> str:
    """The case as TOML; a remark where laws are Python functions."""
    try:
        return case.text()
    except ModelError as error:
        return f"# {error}"
