"""The outcomes of the variants of a study."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.sweeps.studies.variants import Variant

if TYPE_CHECKING:
    from kempe.results.solution import Solution


@dataclass(frozen=True)
class Outcome:
    """The outcome of a variant.

    Attributes:
        variant: its options.
        solution: the solution at the common output times, or until it diverged; None if even the
            start could not be computed.
        diverged_at: time of the divergence, s; None if it reached the end.
        reason: why it diverged; empty if it did not.
        angle_error: largest difference of any body's angle from the reference, rad; NaN if
            it diverged.
        position_error: largest difference of any body's position from the reference, m.
        residual: largest |Φ| over time, of lengths and of angles, m and rad; NaN if diverged.
        residual_at: time of the largest residual, s.
        imbalance: largest error of the energy balance, relative to ``Energy.scale``.
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
        """Whether it failed before the end."""
        return bool(self.reason)


@dataclass(frozen=True)
class Outcomes:
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


def differences(solution: Solution, reference: Solution) -> tuple[Floats, Floats]:
    """Largest difference of any body's angle, rad, and of any position, m, at each time, (n_t,)."""
    count = min(len(solution.t), len(reference.t))
    angle, position = np.zeros(count), np.zeros(count)
    for name in solution.compiled.bodies:
        one, other = solution.body(name), reference.body(name)
        angle = np.maximum(angle, np.abs(one.angle[:count] - other.angle[:count]))
        apart = one.r[:count] - other.r[:count]
        position = np.maximum(position, np.hypot(apart[:, 0], apart[:, 1]))
    return fixed(angle), fixed(position)
