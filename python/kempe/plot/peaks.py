"""Peaks of curves: a circle on the curve, and the value with its time beside it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.draw.units import Scale
from kempe.model.drawing import measured
from kempe.plot import style
from kempe.plot.panel import Curve
from kempe.results.extrema import Extreme

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Room for the text of a peak, and its distance from the curve, points.
ROOM, _GAP = 17.0, 4.0
#: Its least distance from the sides of the axes, points.
_INSET = 2.0
_SIZE = 8.0
#: Of two opposite peaks, the smaller is also marked if it is at least this fraction of the larger.
_WORTH = 0.3

#: A peak, the side of the curve on which its text is (1 above, -1 below), and its colour.
Mark = tuple[Extreme, int, Any]


def chosen_peaks(curves: Sequence[Curve], *, turning_points: bool) -> list[Mark]:
    """The marked peaks of a panel; if it has several curves, only the largest magnitude is marked.

    The text of a marked peak is above or below all curves, so that it covers no curve.

    Args:
        curves: the curves.
        turning_points: whether extreme values at the first and the last time stay unmarked.
    """
    found: list[Mark] = []
    for k, curve in enumerate(curves):
        if curve.high is None or curve.low is None or curve.high.value == curve.low.value:
            continue
        if not curve.marked:
            continue
        colour = {**style.line(k), **curve.line}["color"]
        found += [(curve.high, 1, colour), (curve.low, -1, colour)]
    if not found:
        return []
    if len(curves) > 1:
        high = max(found, key=lambda mark: mark[0].value)
        low = min(found, key=lambda mark: mark[0].value)
        most = max(high, low, key=lambda mark: abs(mark[0].value))
        return [(most[0], 1 if most is high else -1, most[2])]
    if turning_points:
        values = np.atleast_1d(curves[0].values)
        ends = {float(values[0]), float(values[-1])}
        return [mark for mark in found if mark[0].value not in ends]
    most_value = max(abs(mark[0].value) for mark in found)
    return [mark for mark in found if abs(mark[0].value) >= _WORTH * most_value]


def peak_text(extreme: Extreme, unit: Scale, time: Scale) -> str:
    """Such as ``−12.3 kN at 0.42 s``."""
    return f"{unit.written(extreme.value)} at {time.written(extreme.t)}"


def add_peaks(axes: Axes, marks: Sequence[Mark], unit: Scale, time: Scale) -> None:
    """Mark peaks on axes whose limits are set."""
    from matplotlib.transforms import ScaledTranslation, blended_transform_factory

    across = blended_transform_factory(axes.transAxes, axes.transData)
    width = float(axes.bbox.width) * 72.0 / float(axes.figure.dpi)
    for extreme, side, colour in marks:
        x, y = extreme.t / time.divisor, extreme.value / unit.divisor
        axes.scatter([x], [y], s=11.0, facecolor="white", edgecolor=colour, linewidth=1.0, zorder=4)
        words = peak_text(extreme, unit, time)
        half = (measured(words, _SIZE)[0] / 2.0 + _INSET) / width
        share = float(axes.transAxes.inverted().transform(axes.transData.transform((x, y)))[0])
        axes.text(
            float(np.clip(share, half, max(half, 1.0 - half))),
            y,
            words,
            fontsize=_SIZE,
            ha="center",
            va="bottom" if side > 0 else "top",
            zorder=5,
            transform=across
            + ScaledTranslation(0.0, side * _GAP / 72.0, axes.figure.dpi_scale_trans),
        )
