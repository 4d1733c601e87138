"""Runs a study: every variant from the same state, with the same output times."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.analyses.dynamics import AccuracyWarning, simulate
from kempe.base import files
from kempe.base.arguments import explained
from kempe.base.names import one_of
from kempe.case import Case
from kempe.errors import IntegrationError, ModelError, SingularityError
from kempe.model.values import instance
from kempe.results.solution import Solution
from kempe.sweeps.studies import table
from kempe.sweeps.studies.findings import findings
from kempe.sweeps.studies.outcome import Outcome, Outcomes, differences
from kempe.sweeps.studies.variants import Variant, variants

if TYPE_CHECKING:
    from kempe.results.state import State

#: Number of output times if the analysis has no output_step.
OUTPUTS = 1500
#: A variant that needs more steps counts as failed.
MOST_STEPS = 300_000


class Study(Outcomes):
    """The outcomes of a study, with the findings."""

    def findings(self) -> list[str]:
        """The findings, in sentences."""
        return findings(self)

    def table(self) -> str:
        """All outcomes as a table in Markdown."""
        return table.markdown(self)

    def save(self, folder: Path | str) -> list[Path]:
        """Write the table (CSV, JSON, Markdown) into a folder; returns the files.

        Raises:
            FileError: a file cannot be written.
        """
        return table.write(self, files.checked_path(folder, "write"))

    def __str__(self) -> str:
        return "\n".join([self.table(), "", *self.findings()])

    def __repr__(self) -> str:
        return f"<Study of {self.title!r}, {self.analysis}: {len(self.outcomes)} variants>"


@explained
def study(
    case: Case,
    analysis: str | None = None,
    *,
    ways: Sequence[Variant] | None = None,
    progress: Callable[[str], None] | None = None,
) -> Study:
    """Compute one analysis of a case in many ways and compare them.

    The error of a variant is its largest difference from the first and most accurate variant, over
    all bodies and output times.

    Args:
        case: the case.
        analysis: name of the analysis; the first when None.
        ways: the variants, the most accurate first; ``variants()`` when None.
        progress: called with the name of each variant before it is computed.

    Raises:
        ModelError: the case has no such analysis.
        KempeError: the mechanism cannot be assembled, or the reference fails.
    """
    instance(case, Case, "a case")
    names = [name for name, entry in case.analyses.items() if entry["type"] == "dynamics"]
    if not names:
        raise ModelError(
            "the case contains no analysis of type dynamics", hint="add one, as [analyses.release]"
        )
    name = names[0] if analysis is None else one_of("analysis", analysis, names)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)  # the study compares what it warns of
        outcomes = _outcomes(case, name, variants() if ways is None else ways, progress)
    return Study(case.model.title, name, tuple(outcomes))


def _outcomes(
    case: Case, name: str, ways: Sequence[Variant], progress: Callable[[str], None] | None
) -> list[Outcome]:
    """The variants of an analysis, of which the first is the reference."""
    begin, entry = _beginning(case, name)
    reference: Solution | None = None
    outcomes = []
    for way in ways:
        if progress is not None:
            progress(way.name)
        found = _computed(case, begin, {**entry, **way.entry()}, way, reference)
        if reference is None:
            if found.diverged or found.solution is None:
                raise IntegrationError(f"{way.name}: {found.reason}", t=found.diverged_at)
            reference = found.solution
        outcomes.append(found)
    return outcomes


def _beginning(case: Case, name: str) -> tuple[State, dict[str, Any]]:
    """The state in which an analysis starts, and its entry with output times."""
    entry = {**case.analyses[name], "dense_output": False, "max_steps": MOST_STEPS}
    entry.pop("output", None)
    solutions = ((n, found) for n, found in case.each() if isinstance(found, Solution))
    solution = next(found for done, found in solutions if done == name)
    if "output_step" not in entry:
        entry["output_step"] = float(solution.t[-1] - solution.t[0]) / OUTPUTS
    return solution.initial, entry


def _computed(
    case: Case,
    begin: State,
    entry: Mapping[str, Any],
    way: Variant,
    reference: Solution | None,
) -> Outcome:
    try:
        solution = simulate(case.model.compile(), begin, entry, None)
        return _measured(way, solution, reference or solution)
    except (IntegrationError, SingularityError) as error:
        partial: Solution | None = getattr(error, "solution", None)
        reason = str(error.args[0]).partition(" at t = ")[0]  # the time is reported separately
        return _diverged(way, partial, error.t, reason)


def _measured(way: Variant, solution: Solution, reference: Solution) -> Outcome:
    angle, position = differences(solution, reference)
    drift = solution.drift.position
    cost = solution.statistics
    return Outcome(
        variant=way,
        solution=solution,
        diverged_at=None,
        reason="",
        angle_error=float(angle.max()),
        position_error=float(position.max()),
        residual=float(drift.max()),
        residual_at=float(solution.t[int(drift.argmax())]),
        imbalance=float(np.abs(solution.energy.balance).max()),
        steps=int(cost["steps"]),
        evaluations=int(cost["evaluations"]),
        seconds=float(cost["seconds"]),
    )


def _diverged(way: Variant, partial: Solution | None, t: float | None, reason: str) -> Outcome:
    cost = {} if partial is None else partial.statistics
    at = float(partial.t[-1]) if t is None and partial is not None else t
    return Outcome(
        variant=way,
        solution=partial,
        diverged_at=at,
        reason=reason,
        angle_error=np.nan,
        position_error=np.nan,
        residual=np.nan,
        residual_at=np.nan,
        imbalance=np.nan,
        steps=int(cost.get("steps", 0)),
        evaluations=int(cost.get("evaluations", 0)),
        seconds=float(cost.get("seconds", 0.0)),
    )
