"""Drawing of a panel: its curves with units, ticks, peaks and legend."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.units import NOISE, Scale, scale
from kempe.plot import style
from kempe.plot.legend import above_or_beside
from kempe.plot.panel import CONSTANT, Curve, Panel
from kempe.plot.peaks import ROOM, add_peaks, chosen_peaks
from kempe.plot.remarked import titled
from kempe.plot.ticks import DEGREES, STEPS, set_ticks
from kempe.plot.time_axis import TimeAxis, show_time
from kempe.results.fine import jumps

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Margin above and below the curves, as a fraction of their range.
_MARGIN = 0.06


def draw(
    axes: Axes,
    t: Floats,
    panel: Panel,
    *,
    cut: float | None = None,
    chosen: Scale | None = None,
    span: tuple[float, float] | None = None,
) -> None:
    """Draw a panel on a linear axis.

    Args:
        axes: where to.
        t: (n_t,), s.
        panel: the curves.
        cut: time after which the time axis is compressed, s; never when None.
        chosen: unit of the axis; a unit with short numbers when None.
        span: range of the axis, SI units; the range of the curves when None.
    """
    unit = chosen or scale(panel.unit, panel.peak)
    time = TimeAxis.of(t, cut, panel.variable)
    add_lines(axes, t, panel.curves, time=time, divisor=unit.divisor)
    marks = chosen_peaks(panel.curves, turning_points=panel.turning_points)
    _limit(axes, span or panel.span, unit.divisor, [side for _, side, _ in marks], span is not None)
    axes.set_ylabel(unit.axis(panel.symbol))
    finish(axes, time, panel)
    set_ticks(axes.yaxis, DEGREES if unit.unit == "°" else STEPS)
    add_peaks(axes, marks, unit, time.unit)


def add_lines(
    axes: Axes, t: Floats, curves: Sequence[Curve], *, time: TimeAxis, divisor: float = 1.0
) -> None:
    """One line for each curve; points if there are too few times for a line."""
    instants = np.atleast_1d(t) / time.unit.divisor
    marker = {"marker": "o"} if len(instants) < 3 else {}
    breaks = jumps(np.atleast_1d(t))
    instants = np.insert(instants, breaks, np.nan)
    for k, one in enumerate(curves):
        values = np.insert(np.atleast_1d(one.values), breaks, np.nan)
        shown = values if divisor == 1.0 else values / divisor
        look = {**style.line(k), **marker, **one.line}
        axes.plot(instants, shown, label=one.label, **look)


def _limit(
    axes: Axes, span: tuple[float, float], divisor: float, sides: list[int], shared: bool
) -> None:
    """Limits with room for the peaks; rounding errors of constant curves are not magnified."""
    low, high = span
    most = max(abs(low), abs(high))
    if most < NOISE:
        low, high = -divisor, divisor
    elif high - low < CONSTANT * most:
        low, high = low - 0.1 * most, high + 0.1 * most
    height = float(axes.bbox.height) * 72.0 / float(axes.figure.dpi)
    room = min(ROOM / height, 0.35)
    above, below = (room if shared or side in sides else _MARGIN for side in (1, -1))
    scale_up = (high - low) / (1.0 - above - below)
    axes.set_ylim((low - below * scale_up) / divisor, (high + above * scale_up) / divisor)


def finish(axes: Axes, time: TimeAxis, panel: Panel) -> None:
    """Time axis, title and legend."""
    show_time(axes, time)
    if panel.title:
        titled(axes, panel.title, panel.note)
    if panel.legend:
        above_or_beside(axes)
