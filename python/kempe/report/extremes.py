"""Peaks of a solution with their times, also between its outputs.

A quantity is sampled at the outputs and within the steps of the integrator. The largest samples are
then refined on the interpolant, so that a peak has the accuracy of the interpolant.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from kempe.arrays import Floats
from kempe.errors import KempeError

if TYPE_CHECKING:
    from kempe.motion import Motion
    from kempe.solution import Solution

#: Samples in a step with an interpolant up to degree 4, and above.
_SAMPLES = (2, 4)
#: The largest number of samples of a solution besides its outputs.
_MOST_SAMPLES = 20_000
#: Local peaks above this share of the largest sample are refined, so many at most.
_SHARE, _CANDIDATES = 0.8, 3
#: Refinement: points in an interval, and how often the interval shrinks to two of its parts.
_POINTS, _ROUNDS = 9, 6

#: Computes one number for each time of a motion, (n_t,).
Read: TypeAlias = "Callable[[Motion], Floats]"


class Peak(NamedTuple):
    """The value of largest magnitude, with its sign, and its time, s."""

    value: float
    t: float


class Sampled:
    """A solution at its outputs and within its steps, in the order of travel.

    Attributes:
        solution: the solution.
        motion: the motion at the samples; the solution itself if it has no interpolant.
        steps: the motion at the states at which steps begin, without an error of interpolation.
    """

    def __init__(self, solution: Solution) -> None:
        self.solution = solution
        self.motion: Motion = solution
        self.steps: Motion = solution
        if solution.dense is None or len(solution.dense.t) < 2 or np.ptp(solution.t) == 0.0:
            return
        samples = _SAMPLES[solution.dense.c.shape[2] > 4]
        fine = solution(_times(solution, samples))
        try:
            _ = fine.lam
        except KempeError:  # a solution may end in a position without unique reactions
            return
        self.motion, self.steps = fine, solution(solution.dense.t[:-1])

    @property
    def is_continuous(self) -> bool:
        """Whether values between the outputs are known."""
        return self.motion is not self.solution

    def peak(self, read: Read) -> Peak:
        """The value of largest magnitude.

        Args:
            read: computes the quantity, such as ``lambda m: m.joint("C").torque(on="rocker")``.
        """
        reported = _largest(self.solution.t, read(self.solution))
        if not self.is_continuous:
            return reported
        times, magnitude = self.motion.t, np.abs(read(self.motion))
        if not magnitude.any():  # the torque of a pin
            return reported
        around = _around(magnitude)
        low, high = (times[np.clip(around + k, 0, len(times) - 1)] for k in (-1, 1))
        found = self._refined(read, low, high)
        return max(found, reported, key=lambda peak: abs(peak.value))

    def _refined(self, read: Read, low: Floats, high: Floats) -> Peak:
        """The peak in some intervals; each shrinks to the parts beside its largest value."""
        share = np.linspace(0.0, 1.0, _POINTS)
        rows = np.arange(len(low))
        for _ in range(_ROUNDS):
            times = low[:, None] + share * (high - low)[:, None]
            values = np.asarray(read(self.solution(times.ravel()))).reshape(times.shape)
            best = np.abs(values).argmax(axis=1)
            low = times[rows, np.maximum(best - 1, 0)]
            high = times[rows, np.minimum(best + 1, _POINTS - 1)]
        row = int(np.abs(values[rows, best]).argmax())
        return Peak(float(values[row, best[row]]), float(times[row, best[row]]))


def _times(solution: Solution, samples: int) -> Floats:
    """Outputs and times within the steps, in the order of travel."""
    assert solution.dense is not None
    ends = solution.dense.t
    ends = ends[:: max(1, len(ends) * samples // _MOST_SAMPLES)]
    inside = ends[:-1, None] + np.diff(ends)[:, None] * np.arange(samples) / samples
    times = np.unique(np.concatenate([inside.ravel(), ends[-1:], solution.t]))
    return times if solution.t[-1] >= solution.t[0] else times[::-1]


def _around(magnitude: Floats) -> np.typing.NDArray[np.intp]:
    """Indices of the largest local peaks."""
    padded = np.concatenate([[-np.inf], magnitude, [-np.inf]])
    is_peak = (magnitude >= padded[:-2]) & (magnitude >= padded[2:])
    peaks = np.flatnonzero(is_peak & (magnitude >= _SHARE * magnitude.max()))
    return peaks[np.argsort(-magnitude[peaks], kind="stable")[:_CANDIDATES]]


def _largest(t: Floats, values: Floats) -> Peak:
    k = int(np.abs(values).argmax())
    return Peak(float(values[k]), float(t[k]))
