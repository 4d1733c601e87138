"""The horizontal axis of design figures: the angle of a crank, or the time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.design.locate import instants
from kempe.draw.units import Scale, number
from kempe.plot.time_axis import TimeAxis, show_time
from kempe.results.quantities import named
from kempe.results.solution import Solution
from kempe.results.variable import TIME, Variable

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Abscissa:
    """A horizontal axis.

    Attributes:
        variable: its quantity.
        t: instants close enough for smooth curves, (n,), s.
        values: the variable at the instants, (n,), SI units.
        unit: unit of the numbers on the axis.
    """

    variable: Variable
    t: Floats
    values: Floats
    unit: Scale

    @property
    def shown(self) -> Floats:
        """The values in the unit of the axis, (n,)."""
        return np.asarray(self.values / self.unit.divisor)

    def at(self, t: float) -> float:
        """The number on the axis at an instant."""
        order = np.argsort(self.t)
        return float(np.interp(t, self.t[order], self.values[order])) / self.unit.divisor

    def words(self, t: float) -> str:
        """The number on the axis at an instant, with its unit."""
        gap = "" if self.unit.unit == "°" else " "
        value = self.at(t)
        if abs(value) < 1e-6 * float(np.abs(self.shown).max()):
            value = 0.0  # an instant is found to rounding
        return f"{number(value)}{gap}{self.unit.unit}"

    def label(self, axes: Axes) -> None:
        """Limits, ticks and label of the axis."""
        show_time(axes, TimeAxis.of(self.values, None, self.variable))


def abscissa(solution: Solution, over: str | None = None) -> Abscissa:
    """The horizontal axis of a figure of a solution.

    Args:
        solution: the motion.
        over: a position quantity, or "t". When None, it is the driven quantity, or in a motion over
            time the coordinate of the only driver if this changes in one direction only.
    """
    t = instants(solution)
    chosen = over if over is not None else _only_driver(solution)
    if chosen is None or chosen in (TIME.name, solution.variable.name):
        of = solution.variable
        return Abscissa(of, t, t, TimeAxis.of(t, None, of).unit)
    quantity = named(solution(t), chosen)
    values = np.asarray(quantity.read(), dtype=np.float64)
    steps = np.diff(values)
    if over is None and not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        return abscissa(solution, TIME.name)
    of = Variable(chosen, quantity.unit)
    return Abscissa(of, t, values, TimeAxis.of(values, None, of).unit)


def _only_driver(solution: Solution) -> str | None:
    """The coordinate of the only driver of a motion over time."""
    drivers = solution.compiled.tree.get("drivers", {})
    if not solution.variable.is_time or len(drivers) != 1 or solution.compiled.released:
        return None
    coordinate = next(iter(drivers.values())).get("coordinate")
    return str(coordinate) if coordinate else None
