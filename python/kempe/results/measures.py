"""Measures: named expressions of quantities over a motion, and their statistics.

A measure such as ``pin = "C.force"`` is declared in ``[measures]`` of a file or by ``m.measures``.
``sol["pin"]`` contains its values at the outputs, ``sol.measure("pin")`` its statistics.
"""

from __future__ import annotations

from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.base.names import unknown
from kempe.model.measure_infos import MeasureInfo
from kempe.results import remarks
from kempe.results.dominant_frequency import dominant_frequency
from kempe.results.extrema import Extreme, largest, least, singular_times
from kempe.results.quantities import values_of
from kempe.results.settling import settling

if TYPE_CHECKING:
    from kempe.results.solution import Solution

#: The statistics of a measure, in the order of tables.
STATISTICS = ("max", "min", "peak", "mean", "rms", "integral", "final", "settling", "frequency")
#: The last parts of quantities of a run that have values at the outputs only, of one element.
_AT_OUTPUTS = ("balance", "dissipated")


def is_continuous(info: MeasureInfo) -> bool:
    """Whether a measure has values between the outputs."""
    parts = [name.rpartition(".") for name in info.quantities if info.is_of_run]
    return all(
        last not in _AT_OUTPUTS or (owner, last) == ("energy", "dissipated")
        for owner, _, last in parts
    )


class Measure:
    """A measure of a solution: its values at the outputs and their statistics.

    ``max``, ``min`` and ``peak`` are found on the interpolant, also between the outputs, as in the
    summary. ``integral``, ``mean`` and ``rms`` are integrals of the interpolant and do not depend
    on the outputs either. In a motion over a value instead of time, ``t`` is this value.

    Attributes:
        info: the measure.
        t: (n_t,), s.
        values: (n_t,), in the unit of the measure.
    """

    def __init__(self, solution: Solution, of: str | MeasureInfo) -> None:
        self._solution = solution
        if isinstance(of, str) and of not in solution.compiled.measures:
            error = unknown("measure", of, solution.compiled.measures)
            error.hint = f"{error.hint}; declare it as a measure of the model or the file"
            raise error
        self.info = solution.compiled.measures[of] if isinstance(of, str) else of
        self.t = solution.t
        self.values = values_of(solution, self.info)

    @property
    def name(self) -> str:
        """Name of the measure."""
        return self.info.name

    @property
    def unit(self) -> str:
        """SI unit of the values."""
        return self._solution.variable.rate(self.info.unit)

    @property
    def unique(self) -> bool:
        """Whether the reactions in it are unique; ``choice`` says which are given if not.

        See ``ConstraintView.unique``. A measure without reactions is unique.
        """
        return not self.choice

    @cached_property
    def choice(self) -> str:
        """Which of the possible reactions are in it; empty if they are unique."""
        return remarks.choice_of(self._solution, *self.info.quantities)

    @cached_property
    def unbounded_at(self) -> tuple[float, ...]:
        """Times of singular positions beside which it has no bound, s.

        ``max``, ``min`` and ``peak`` exclude the values there; integrals include them.
        """
        return remarks.measure_unbounded_at(self._solution, self.info)

    @cached_property
    def _highest(self) -> Extreme:
        if self.info.is_of_run:
            return self._at(int(self.values.argmax()))
        return largest(self._solution, partial(values_of, info=self.info))

    @cached_property
    def _lowest(self) -> Extreme:
        if self.info.is_of_run:
            return self._at(int(self.values.argmin()))
        return least(self._solution, partial(values_of, info=self.info))

    def _at(self, row: int) -> Extreme:
        return Extreme(float(self.values[row]), float(self.t[row]))

    @property
    def max(self) -> float:
        """The largest value."""
        return self._highest.value

    @property
    def min(self) -> float:
        """The least value."""
        return self._lowest.value

    @property
    def t_max(self) -> float:
        """The first time at which the largest value is reached, s."""
        return self._highest.t

    @property
    def t_min(self) -> float:
        """The first time at which the least value is reached, s."""
        return self._lowest.t

    @property
    def peak(self) -> float:
        """The largest magnitude."""
        return max(abs(self.max), abs(self.min))

    @cached_property
    def _integrals(self) -> list[float]:
        """The integral, the mean and the root mean square."""
        solution, found = self._solution, None
        if solution.dense is not None and is_continuous(self.info):
            near = singular_times(solution) if self.info.solves else np.empty(0)
            found = _core.integrals(
                self.t, self.values, (solution.dense.t, solution.dense.degree, near, self._between)
            )
        # a value between the outputs that is not unique leaves the outputs
        found = found or _core.integrals(self.t, self.values)
        assert found is not None
        return found

    def _between(self, t: Floats) -> Floats:
        """The values at any times."""
        solution = self._solution
        energy = solution.energy_at(t) if self.info.is_of_run else None
        return values_of(solution(t), self.info, energy)

    @property
    def integral_unit(self) -> str:
        """SI unit of the integral, such as N*s for a force over time."""
        return self._solution.variable.integral(self.unit)

    @property
    def integral(self) -> float:
        """Integral over time, in ``integral_unit``."""
        return self._integrals[0]

    @property
    def mean(self) -> float:
        """Mean over time."""
        return self._integrals[1]

    @property
    def rms(self) -> float:
        """Root of the mean square over time."""
        return self._integrals[2]

    @property
    def final(self) -> float:
        """The last value."""
        return float(self.values[-1])

    @cached_property
    def settling(self) -> float:
        """Settling time, s: from this time on the values stay in a band about the last value.

        The band is 0.5 % of the largest deviation from the last value. The settling time is NaN if
        the values leave this band in the last tenth of the time, and the first time if they do not
        change.
        """
        solution = self._solution
        continuous = solution.dense is not None and not self.info.is_of_run
        found = settling(
            self.t,
            self.values,
            between=self._between if continuous else None,
        )
        if not found.moves:
            return float(self.t[0])
        return float("nan") if found.time is None else found.time

    @cached_property
    def frequency(self) -> float:
        """Frequency of the strongest oscillation, Hz; NaN if there is no oscillation.

        See ``kempe.results.dominant_frequency``.
        """
        return dominant_frequency(self.t, self.values)

    def statistics(self) -> dict[str, float | None]:
        """All statistics by name, and the times of the extremes; None in place of NaN."""
        found = {name: float(getattr(self, name)) for name in (*STATISTICS, "t_max", "t_min")}
        return {name: None if np.isnan(value) else value for name, value in found.items()}

    def __repr__(self) -> str:
        span = f"{self.min:.6g} to {self.max:.6g} {self.unit}"
        variable = self._solution.variable
        told = remarks.remark(self.choice, times=self.unbounded_at, variable=variable)
        return f"<Measure {self.name!r} = {self.info.expression!r}: {span}{told}>"
