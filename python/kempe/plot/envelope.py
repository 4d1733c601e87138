"""Envelopes: an oscillation over many orders of magnitude becomes one clear band."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.units import power_of_ten

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Spans of time of which the largest value is drawn.
BINS = 200
#: A positive value below every axis.
_TINY = 1e-300
#: Decades of a logarithmic axis, at least and at most.
_FEWEST, _MOST = 3, 9


def envelope(t: Floats, y: Floats, bins: int = BINS) -> tuple[Floats, Floats, Floats]:
    """The least and the largest value in each of equal spans of time.

    Args:
        t: (n_t,), s, increasing or decreasing.
        y: (n_t,).
        bins: number of spans; with fewer values than spans every value is its own span.

    Returns:
        The time in the middle of each span, the least value and the largest value, (n,).
    """
    if len(t) <= bins:
        return t, y, y
    span = np.minimum((bins * (t - t[0]) / (t[-1] - t[0])).astype(int), bins - 1)
    first = np.flatnonzero(np.diff(span, prepend=-1))
    middle = t[0] + (span[first] + 0.5) / bins * (t[-1] - t[0])
    return middle, np.minimum.reduceat(y, first), np.maximum.reduceat(y, first)


def draw_envelope(axes: Axes, t: Floats, y: Floats, label: str, look: Mapping[str, Any]) -> None:
    """The largest values as a line, and a light band down to the least values."""
    middle, low, high = envelope(t, y)
    axes.plot(middle, high, label=label, **look)
    if (
        low.min(initial=0.0) >= 0.0
    ):  # a logarithmic axis leaves out zeros, with false wedges beside them
        low, high = np.maximum(low, _TINY), np.maximum(high, _TINY)
    if not np.array_equal(low, high):
        axes.fill_between(middle, low, high, color=look["color"], alpha=0.18, linewidth=0.0)


def logarithmic(axes: Axes, drawn: list[Floats], most: int = _MOST) -> None:
    """Make the axis logarithmic, without zeros; it is linear if all values are zero.

    Args:
        axes: the axes.
        drawn: the values that must be visible.
        most: largest number of decades of the axis; the highest decades are shown.
    """
    positive = [values[values > 0.0] for values in drawn]
    lowest = min((float(values.min()) for values in positive if len(values)), default=None)
    if lowest is None:
        return
    highest = max(float(values.max()) for values in positive if len(values))
    # Whole decades: their numbers are short.
    top = math.ceil(math.log10(highest))
    bottom = min(max(math.floor(math.log10(lowest)), top - most), top - _FEWEST)
    axes.set_yscale("log", nonpositive="mask")
    axes.set_ylim(10.0**bottom, 10.0**top)
    step = math.ceil((top - bottom) / 6)
    powers = range(bottom, top + 1, step)
    axes.set_yticks([10.0**power for power in powers], [power_of_ten(power) for power in powers])
    axes.minorticks_off()
