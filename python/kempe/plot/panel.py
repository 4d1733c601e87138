"""Curves over time and panels of them, as data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.results.extrema import Extreme, Quantity, largest, least
from kempe.results.fine import fine
from kempe.results.variable import TIME, Variable

if TYPE_CHECKING:
    from kempe.results.motion import Motion

#: A line that varies by less than this fraction of its value is a constant.
CONSTANT = 1e-6


@dataclass(frozen=True)
class Curve:
    """A quantity over time.

    Attributes:
        label: text of the legend.
        values: (n_t,), SI units.
        line: colour, dashes and width; chosen by its place in the panel when empty.
        high, low: its largest and its least value, if they are known.
        marked: whether these values may be marked.
    """

    label: str
    values: Floats
    line: Mapping[str, Any] = field(default_factory=dict)
    high: Extreme | None = None
    low: Extreme | None = None
    marked: bool = True

    @property
    def span(self) -> tuple[float, float]:
        """The least and the largest value, SI units, excluding values beside singular positions."""
        least, most = float(np.min(self.values)), float(np.max(self.values))
        if self.low is not None and self.high is not None:
            return max(least, self.low.value), min(most, self.high.value)
        return least, most


@dataclass(frozen=True)
class Panel:
    """Curves of one unit over time.

    Attributes:
        symbol: of the quantity, such as "F".
        unit: SI unit of the values.
        curves: the curves.
        title: title above the panel, to the left.
        note: a small line below the title.
        name: its name in a sentence on the page.
        legend: whether to draw a legend above the panel to the right.
        turning_points: whether extreme values at the first and the last time stay unmarked.
        variable: the quantity on the horizontal axis.
    """

    symbol: str
    unit: str
    curves: Sequence[Curve]
    title: str = ""
    name: str = ""
    legend: bool = False
    turning_points: bool = False
    variable: Variable = TIME
    note: str = ""

    @property
    def peak(self) -> float:
        """The largest magnitude, SI units."""
        return max((max(map(abs, curve.span)) for curve in self.curves), default=0.0)

    @property
    def span(self) -> tuple[float, float]:
        """The least and the largest value, SI units."""
        lows, highs = zip(*(curve.span for curve in self.curves), strict=True)
        return min(lows), max(highs)


def curve(motion: Motion, label: str, quantity: Quantity, line: Mapping[str, Any]) -> Curve:
    """A quantity on the interpolant of a solution, or at the times of another motion."""
    values = np.atleast_1d(quantity(fine(motion)))
    return Curve(label, values, line, largest(motion, quantity), least(motion, quantity))


def times(motion: Motion) -> Floats:
    """The times of the curves of a motion, (n_t,), s."""
    return np.atleast_1d(fine(motion).t)
