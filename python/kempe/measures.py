"""Measures: named expressions of quantities over a motion, and their statistics.

A measure such as ``pin = "C.force"`` is declared in ``[measures]`` of a file or by ``m.measures``.
``sol["pin"]`` is its values at the outputs, ``sol.measure("pin")`` has its statistics.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np

from kempe import _core, quantities
from kempe.arrays import Floats, fixed
from kempe.dominant_frequency import dominant_frequency
from kempe.names import entry

if TYPE_CHECKING:
    from kempe.compiled import CompiledModel
    from kempe.extrema import Extreme
    from kempe.motion import Motion
    from kempe.solution import Solution

#: The statistics of a measure, in the order of tables.
STATISTICS = ("max", "min", "peak", "mean", "rms", "final", "settling", "frequency")


@dataclass(frozen=True)
class MeasureInfo:
    """A measure of a model.

    Attributes:
        name: name of the measure.
        expression: the expression, as written.
        quantities: names of the quantities that it uses, each once.
        unit: its SI unit; "1" for a number, "SI" if it does not follow from the expression.
    """

    name: str
    expression: str
    quantities: tuple[str, ...]
    unit: str

    @property
    def is_of_run(self) -> bool:
        """Whether it uses energies of a run or checks of it, which exist at the outputs only."""
        owners = [name.rpartition(".") for name in self.quantities]
        return any(
            owner == "energy" or last == "dissipated" or (owner, last) == ("drift", "balance")
            for owner, _, last in owners
        )


def measure_infos(model: CompiledModel) -> Iterator[MeasureInfo]:
    """The measures of a compiled model, in the order of the file."""
    for name, expression in model.tree.get("measures", {}).items():
        used, unit = _core.measure(model.core, expression)
        yield MeasureInfo(name, expression, tuple(used), unit)


def parameter_unit(model: CompiledModel, name: str) -> str:
    """The SI unit of a parameter that is written with one; "SI" for a parameter without a unit."""
    return str(_core.measure(model.core, f"`{name}`")[1])


def values(motion: Motion, name: str) -> Floats:
    """Values of a measure at the times of a motion, (n_t,).

    Raises:
        ModelError: there is no such measure, the motion lacks one of its quantities, or the
            expression has no value at one of the times.
        SingularityError: a reaction or acceleration is not unique at one of the times.
    """
    info = entry("measure", name, motion.compiled.measures)
    t = np.atleast_1d(motion.t)
    columns = [np.atleast_1d(quantities.named(motion, one).read()) for one in info.quantities]
    given = np.column_stack(columns) if columns else np.empty((len(t), 0))
    (found,) = motion._by_phase(
        lambda core, *of: (_core.measure_values(core, info.expression, *of),),
        t,
        np.ascontiguousarray(given),
    )
    return fixed(found)


class Measure:
    """A measure of a solution: its values at the outputs and their statistics.

    ``max``, ``min`` and ``peak`` are those of the interpolant, as in the summary: they are also
    found between the outputs. ``mean`` and ``rms`` are integrals by the trapezoidal rule over the
    outputs. Over a value instead of time, ``t`` is this value.

    Attributes:
        info: the measure.
        t: (n_t,), s.
        values: (n_t,), in the unit of the measure.
    """

    def __init__(self, solution: Solution, name: str) -> None:
        self._solution = solution
        self.info = entry("measure", name, solution.compiled.measures)
        self.t = solution.t
        self.values = values(solution, name)

    @property
    def name(self) -> str:
        """Name of the measure."""
        return self.info.name

    @property
    def unit(self) -> str:
        """SI unit of the values."""
        return self.info.unit

    @cached_property
    def _highest(self) -> Extreme:
        from kempe.extrema import largest

        if self.info.is_of_run:
            return self._at(int(self.values.argmax()))
        return largest(self._solution, partial(values, name=self.name))

    @cached_property
    def _lowest(self) -> Extreme:
        from kempe.extrema import least

        if self.info.is_of_run:
            return self._at(int(self.values.argmin()))
        return least(self._solution, partial(values, name=self.name))

    def _at(self, row: int) -> Extreme:
        from kempe.extrema import Extreme

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
        """The time at which the largest value is reached first, s."""
        return self._highest.t

    @property
    def t_min(self) -> float:
        """The time at which the least value is reached first, s."""
        return self._lowest.t

    @property
    def peak(self) -> float:
        """The largest magnitude."""
        return max(abs(self.max), abs(self.min))

    @property
    def mean(self) -> float:
        """Mean over time."""
        return self._mean_of(self.values)

    @property
    def rms(self) -> float:
        """Root of the mean square over time."""
        return float(np.sqrt(self._mean_of(self.values**2)))

    def _mean_of(self, of: Floats) -> float:
        span = float(self.t[-1] - self.t[0])
        area = float(np.sum(np.diff(self.t) * (of[1:] + of[:-1]) / 2.0))
        return area / span if span else float(of[-1])

    @property
    def final(self) -> float:
        """The last value."""
        return float(self.values[-1])

    @cached_property
    def settling(self) -> float:
        """Settling time, s: from then on the values stay near the last one.

        The band is 0.5 % of the largest deviation from the last value.
        NaN if the values do not stay in this band during the last tenth of the time; the first
        time if they do not change.
        """
        from kempe.report.settling import settling

        solution = self._solution
        continuous = solution.dense is not None and not self.info.is_of_run
        found = settling(
            self.t,
            self.values,
            between=(lambda t: values(solution(t), self.name)) if continuous else None,
        )
        if not found.moves:
            return float(self.t[0])
        return float("nan") if found.time is None else found.time

    @cached_property
    def frequency(self) -> float:
        """Frequency of the strongest oscillation, Hz; NaN without one.

        See ``kempe.dominant_frequency``.
        """
        return dominant_frequency(self.t, self.values)

    def statistics(self) -> dict[str, float | None]:
        """All statistics by name, and the times of the extremes; None in place of NaN."""
        found = {name: float(getattr(self, name)) for name in (*STATISTICS, "t_max", "t_min")}
        return {name: None if np.isnan(value) else value for name, value in found.items()}

    def __repr__(self) -> str:
        span = f"{self.min:.6g} to {self.max:.6g} {self.unit}"
        return f"<Measure {self.name!r} = {self.info.expression!r}: {span}>"
