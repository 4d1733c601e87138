"""A solution for a summary: at its outputs, between them, and at the steps of the integrator."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.results.extrema import Extreme, Quantity, peak
from kempe.results.fine import fine

if TYPE_CHECKING:
    from kempe.results.motion import Motion
    from kempe.results.solution import Solution


class Sampled:
    """A solution at its outputs and within its steps.

    Attributes:
        solution: the solution.
        motion: the motion within the steps too; the solution itself if it has no interpolant.
        steps: the motion at the states at which steps begin, without an error of interpolation.
    """

    def __init__(self, solution: Solution) -> None:
        self.solution = solution
        self.motion: Motion = fine(solution)
        self.steps: Motion = solution
        if self.is_continuous:
            assert solution.dense is not None
            self.steps = solution(solution.dense.t[:-1])

    @property
    def is_continuous(self) -> bool:
        """Whether values between the outputs are known."""
        return self.motion is not self.solution

    def peak(self, read: Quantity) -> Extreme:
        """The value of largest magnitude, with its sign, and its time; see ``extrema.peak``."""
        return peak(self.solution, read)
