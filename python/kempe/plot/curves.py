"""Lines over time in one panel, with their unit, legend and title."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.arrays import Floats
from kempe.draw.units import NOISE, Scale, scale
from kempe.plot import style
from kempe.plot.time_axis import show_time

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: A line that varies by less than this share of its value is shown as the constant that it is.
_CONSTANT = 1e-6


@dataclass(frozen=True)
class Curve:
    """A quantity over time.

    Attributes:
        label: text of the legend.
        values: (n_t,), SI units.
        line: colour, dashes and width; chosen by its place in the panel when empty.
    """

    label: str
    values: Floats
    line: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Panel:
    """The common properties of the curves of a panel.

    Attributes:
        symbol: of the quantity, such as "F".
        unit: SI unit of the values.
        title: title above the panel, to the left.
        cut: time after which the axis is compressed, s; see ``show_time``.
        legend: whether to write one, above the panel to the right.
    """

    symbol: str
    unit: str
    title: str = ""
    cut: float | None = None
    legend: bool = True


def draw(axes: Axes, t: Floats, curves: Sequence[Curve], panel: Panel) -> None:
    """Draw curves over time on a linear axis, in units that keep the numbers short.

    Args:
        axes: where to.
        t: (n_t,) or (), s.
        curves: of one unit.
        panel: their common properties.
    """
    peaks = [float(np.abs(curve.values).max(initial=0.0)) for curve in curves]
    chosen = scale(panel.unit, max(peaks, default=0.0))
    add_lines(axes, t, curves, chosen.divisor)
    limit(axes, curves, chosen)
    axes.set_ylabel(chosen.axis(panel.symbol))
    finish(axes, t, panel)


def add_lines(axes: Axes, t: Floats, curves: Sequence[Curve], divisor: float = 1.0) -> None:
    """One line for each curve; points where there are too few times for a line."""
    times = np.atleast_1d(t)
    marker = {"marker": "o"} if len(times) < 3 else {}
    for k, curve in enumerate(curves):
        values = np.atleast_1d(curve.values)
        shown = values if divisor == 1.0 else values / divisor
        look = {**style.line(k), **marker, **curve.line}
        axes.plot(times, shown, label=curve.label, **look)


def limit(axes: Axes, curves: Sequence[Curve], chosen: Scale) -> None:
    """Do not magnify the rounding noise of constant curves."""
    values = np.concatenate([np.atleast_1d(curve.values) for curve in curves])
    low, high = float(values.min()), float(values.max())
    largest = max(abs(low), abs(high))
    if largest < NOISE:
        axes.set_ylim(-1.0, 1.0)
    elif high - low < _CONSTANT * largest:
        room = 0.1 * largest
        axes.set_ylim((low - room) / chosen.divisor, (high + room) / chosen.divisor)
    axes.ticklabel_format(axis="y", useOffset=False, style="plain")


def finish(axes: Axes, t: Floats, panel: Panel) -> None:
    """Time axis, title and legend."""
    show_time(axes, np.atleast_1d(t), panel.cut)
    if panel.title:
        axes.set_title(panel.title, loc="left")
    if panel.legend:
        legend_above(axes)


def legend_above(axes: Axes) -> None:
    """The legend where no line can be: above the panel, or beside it if there are many lines."""
    handles, labels = axes.get_legend_handles_labels()
    if len(labels) > 5 or sum(map(len, labels)) > 60:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.02), ncols=1 + len(labels) // 16)
    elif len(labels) > 1:
        axes.legend(
            handles,
            labels,
            loc="lower right",
            bbox_to_anchor=(1.0, 0.98),
            ncols=len(labels),
            columnspacing=1.2,
            borderaxespad=0.2,
        )
