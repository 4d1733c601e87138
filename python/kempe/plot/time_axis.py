"""The horizontal axis: the time, or a driven quantity.

If a motion comes to rest early, the later part of the axis can be compressed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.units import Scale, scale
from kempe.plot.ticks import DEGREES, STEPS, labels, set_ticks
from kempe.results.settling import settling
from kempe.results.variable import TIME, Variable

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.results.motion import Motion

#: The fraction of the axis for the transient when the later part is compressed.
SHARE = 0.72
#: A transient longer than this fraction of the time is shown on an axis without compression.
_LONGEST = 0.4
#: Coordinates are ignored if they move less than this fraction of the largest movement.
_STILL = 1e-3


@dataclass(frozen=True)
class TimeAxis:
    """A time axis.

    Attributes:
        first, last: its ends, s.
        unit: unit of the numbers on it.
        cut: time after which it is compressed, s; never when None.
        variable: its quantity.
    """

    first: float
    last: float
    unit: Scale
    cut: float | None
    variable: Variable = TIME

    @classmethod
    def of(cls, t: Floats, cut: float | None = None, variable: Variable = TIME) -> TimeAxis:
        """The axis for times (n_t,) or (), s, or for values of another variable."""
        first, last = float(np.min(t)), float(np.max(t))
        inside = cut is not None and first < cut < last
        most = max(abs(first), abs(last))
        # never thousands of seconds
        unit = scale(variable.unit, min(most, 1.0) if variable.is_time else most)
        return cls(first, last, unit, cut if inside else None, variable)


def transient(motion: Motion) -> float | None:
    """The time by which the motion has settled, s, rounded up; None if it does not settle early.

    Args:
        motion: a motion at many increasing times, such as a solution.
    """
    t = np.atleast_1d(motion.t)
    duration = float(t[-1] - t[0])
    if len(t) < 3 or duration <= 0.0:
        return None
    bodies = [motion.body(name) for name in motion.compiled.bodies]
    angles = [body.angle for body in bodies]
    places = [values for body in bodies for values in (body.x, body.y)]
    times = []
    for family in (angles, places):
        travel = [float(np.ptp(values)) for values in family]
        for values, far in zip(family, travel, strict=True):
            if far > _STILL * max(travel):
                found = settling(t, values)
                if found.time is None:
                    return None
                times.append(found.time - float(t[0]))
    until = _rounded_up(max(times, default=duration))
    return float(t[0]) + until if until <= _LONGEST * duration else None


def _rounded_up(value: float) -> float:
    """The next half of a power of ten, such as 2.13 → 2.5."""
    if value <= 0.0:
        return 0.0
    step = 0.5 * 10.0 ** math.floor(math.log10(value))
    return step * math.ceil(value / step)


def show_time(axes: Axes, time: TimeAxis, *, label: bool = True) -> None:
    """Draw a time axis on axes whose values are in its unit.

    Args:
        axes: the axes.
        time: the time axis; the compressed part has a grey background.
        label: whether to write the label of the axis.
    """
    first, last = time.first / time.unit.divisor, time.last / time.unit.divisor
    told = ""
    if first == last:
        axes.set_xlim(first - 0.5, last + 0.5)
        set_ticks(axes.xaxis)
    elif time.cut is None:
        axes.set_xlim(first, last)
        set_ticks(axes.xaxis, DEGREES if time.unit.unit == "°" else STEPS)
    else:
        cut = time.cut / time.unit.divisor
        _compress(axes, first, cut, last)
        told = f"  (grey: compressed after {cut:g} {time.unit.unit})"
    if label:
        from kempe.plot.style import verbatim

        axes.set_xlabel(f"{time.unit.axis(verbatim(time.variable.words))}{told}")


def _compress(axes: Axes, first: float, cut: float, last: float) -> None:
    """Two linear parts that meet at ``cut``: one axis, so that no line is interrupted."""
    from kempe.plot import style

    slow, fast = SHARE / (cut - first), (1.0 - SHARE) / (last - cut)

    def forward(t: Floats) -> Floats:
        t = np.asarray(t, dtype=np.float64)
        return np.where(t <= cut, (t - first) * slow, SHARE + (t - cut) * fast)

    def inverse(share: Floats) -> Floats:
        share = np.asarray(share, dtype=np.float64)
        return np.where(share <= SHARE, first + share / slow, cut + (share - SHARE) / fast)

    axes.set_xscale("function", functions=(forward, inverse))
    axes.set_xlim(first, last)
    ticks = _ticks(first, cut, last)
    axes.set_xticks(ticks, [labels([tick])[0] for tick in ticks])
    axes.axvspan(cut, last, color=style.QUIET, linewidth=0.0, zorder=0.1)


def _ticks(first: float, cut: float, last: float) -> list[float]:
    """Round times in both parts; after the cut, a minimum distance separates the numbers."""
    from matplotlib.ticker import MaxNLocator

    early = MaxNLocator(5, steps=[1, 2, 5, 10]).tick_values(first, cut)
    late = MaxNLocator(3, steps=[1, 2, 5, 10]).tick_values(cut, last)
    far = cut + 0.35 * (last - cut)
    kept = [float(t) for t in early if first <= t <= cut]
    return [*kept, *(float(t) for t in late if far < t <= last)]
