"""Carries a study out: every variant from the same state, on the same output times."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.analyses import simulate
from kempe.arrays import Floats, fixed
from kempe.errors import IntegrationError, ModelError, SingularityError
from kempe.names import one_of
from kempe.studies.variants import Variant, variants

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.solution import Solution
    from kempe.state import State

#: Output times where the analysis names no output_step.
OUTPUTS = 1500
#: A variant that needs more is told as one that does not get through.
MOST_STEPS = 300_000


@dataclass(frozen=True)
class Outcome:
    """What a variant gave.

    Attributes:
        variant: how it was computed.
        solution: on the common output times, or until it diverged; None if not even the start
            could be computed.
        diverged_at: time of the divergence, s; None if it got to the end.
        reason: why it diverged; empty if it did not.
        angle_error: largest difference of any body's angle from the reference, rad; NaN if
            it diverged.
        position_error: the same of any body's position, m.
        residual: largest |Φ| over time, lengths and angles alike, m and rad; NaN if diverged.
        residual_at: when, s.
        imbalance: largest error of the energy balance, relative to the largest kinetic energy.
        steps: steps taken.
        evaluations: evaluations of the accelerations.
        seconds: time that the integration took, s.
    """

    variant: Variant
    solution: Solution | None
    diverged_at: float | None
    reason: str
    angle_error: float
    position_error: float
    residual: float
    residual_at: float
    imbalance: float
    steps: int
    evaluations: int
    seconds: float

    @property
    def diverged(self) -> bool:
        """Whether it did not get to the end."""
        return bool(self.reason)


@dataclass(frozen=True)
class Study:
    """The outcomes of a study.

    Attributes:
        title: of the model.
        analysis: name of the analysis.
        outcomes: in the order of ``variants()``; the first is the reference.
    """

    title: str
    analysis: str
    outcomes: tuple[Outcome, ...]

    @property
    def reference(self) -> Outcome:
        """The most accurate run."""
        return self.outcomes[0]

    def group(self, name: str) -> tuple[Outcome, ...]:
        """The outcomes of one group of variants."""
        return tuple(o for o in self.outcomes if o.variant.group == name)

    def findings(self) -> list[str]:
        """What the numbers say, in sentences."""
        from kempe.studies.findings import findings

        return findings(self)

    def table(self) -> str:
        """All outcomes as a table in Markdown."""
        from kempe.studies.table import markdown

        return markdown(self)

    def save(self, folder: Path | str) -> list[Path]:
        """Write the table (CSV, JSON, Markdown) into a folder; returns the files.

        Raises:
            FileError: a file cannot be written.
        """
        from kempe.studies.table import write

        return write(self, Path(folder))

    def __str__(self) -> str:
        return "\n".join([self.table(), "", *self.findings()])

    def __repr__(self) -> str:
        return f"<Study of {self.title!r}, {self.analysis}: {len(self.outcomes)} variants>"


def study(
    case: Case,
    analysis: str | None = None,
    *,
    ways: Sequence[Variant] | None = None,
    progress: Callable[[str], None] | None = None,
) -> Study:
    """Compute one analysis of a case in many ways and compare them.

    The error of a variant is its largest difference from the first, most accurate one, over all
    bodies and output times.

    Args:
        case: what is computed.
        analysis: name of the analysis; the first when None.
        ways: the variants, the most accurate first; ``variants()`` when None.
        progress: called with the name of each variant before it is computed.

    Raises:
        ModelError: the case has no such analysis.
        KempeError: the mechanism does not go together, or the reference itself fails.
    """
    names = list(case.analyses)
    if not names:
        raise ModelError("the case asks for no analysis", hint="add one, as [analyses.release]")
    name = names[0] if analysis is None else one_of("analysis", analysis, names)
    begin, entry = _beginning(case, name)
    reference: Solution | None = None
    outcomes = []
    for way in variants() if ways is None else ways:
        if progress is not None:
            progress(way.name)
        found = _computed(case, begin, {**entry, **way.entry()}, way, reference)
        if reference is None:
            if found.diverged or found.solution is None:
                raise IntegrationError(f"{way.name}: {found.reason}", t=found.diverged_at)
            reference = found.solution
        outcomes.append(found)
    return Study(case.model.title, name, tuple(outcomes))


def _beginning(case: Case, name: str) -> tuple[State, dict[str, Any]]:
    """The state in which an analysis starts, and its entry with output times."""
    entry = {**case.analyses[name], "dense_output": False, "max_steps": MOST_STEPS}
    entry.pop("output", None)
    for done, solution in case.each():
        if done == name:
            begin = solution.initial
            break
    if "output_step" not in entry:
        entry["output_step"] = float(solution.t[-1] - solution.t[0]) / OUTPUTS
    return begin, entry


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
        reason = str(error.args[0]).partition(" at t = ")[0]  # the time is told apart
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


def differences(solution: Solution, reference: Solution) -> tuple[Floats, Floats]:
    """Largest difference of any body's angle, rad, and of any position, m, at each time, (n_t,)."""
    count = min(len(solution.t), len(reference.t))
    apart = (solution.q[:count] - reference.q[:count]).reshape(count, -1, 3)
    angle = np.abs(apart[:, :, 2]).max(axis=1, initial=0.0)
    position = np.hypot(apart[:, :, 0], apart[:, :, 1]).max(axis=1, initial=0.0)
    return fixed(angle), fixed(position)
