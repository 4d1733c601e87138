"""The effort of a drive over the crank angle, and over its speed for the choice of a motor."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.design.duty import Duty, duty
from kempe.draw.units import Scale, number, scale
from kempe.plot import style
from kempe.plot.abscissa import Abscissa, abscissa
from kempe.plot.labelled import add_labels
from kempe.plot.legend import above_or_beside
from kempe.plot.remarked import note, titled
from kempe.plot.ticks import set_ticks
from kempe.results.remarks import remark
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def effort(
    solution: Solution, drive: str, *, over: str | None = None, ax: Axes | None = None
) -> Axes:
    """Draw the torque or force of a drive, its mean over time, and its root mean square.

    Args:
        solution: a motion of ``inverse_dynamics`` or ``dynamics``.
        drive: a driver, or a motor, actuator or torque.
        over: quantity on the horizontal axis, or "t"; by default the driven quantity.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such drive.
    """
    found, across = duty(solution, drive), abscissa(solution, over)
    symbol, unit = _quantity(found)
    with style.on(ax) as axes:
        axes.axhline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
        shown = np.asarray(found.effort / unit.divisor)
        axes.plot(across.shown, shown, label=f"${symbol}$", **style.line(0))
        for k, (words, value) in enumerate((("mean", found.mean), ("rms", found.rms)), 1):
            look = {**style.line(k), "linewidth": 1.0}
            shown_value = value if abs(value) > 1e-9 * found.rms else 0.0
            label = f"{words} {number(shown_value / unit.divisor)} {unit.unit}"
            axes.axhline(value / unit.divisor, label=label, **look)
        across.label(axes)
        _room(axes, [*_bounded(found, shown, unit), 0.0, found.rms / unit.divisor])
        axes.set_ylabel(unit.axis(f"${symbol}$"))
        title = f"Effort of {style.short(drive)}{remark(found.choice)}"
        titled(axes, title, note(found.unbounded_at, found.variable))
        above_or_beside(axes)
        _mark_peak(axes, found, across, unit)
        return axes


def torque_speed(solution: Solution, drive: str, *, ax: Axes | None = None) -> Axes:
    """Draw the effort of a drive over its speed, in four quadrants, with the powers.

    Args:
        solution: a motion of ``inverse_dynamics`` or ``dynamics``.
        drive: a driver, or a motor, actuator or torque.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such drive.
    """
    found = duty(solution, drive)
    symbol, unit = _quantity(found)
    turning = symbol == "T"
    of = found.variable
    speed = scale(
        of.rate("rad/s" if turning else "m/s"), float(np.abs(found.rate).max(initial=0.0))
    )
    with style.on(ax, 90.0) as axes:
        x, y = found.rate / speed.divisor, found.effort / unit.divisor
        axes.axhline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
        axes.axvline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
        axes.plot(x, y, **style.line(0))
        _room(axes, [*_bounded(found, y, unit), 0.0])
        low, high = min(0.0, float(np.min(x))), max(0.0, float(np.max(x)))
        axes.set_xlim(low - 0.08 * (high - low), high + 0.08 * (high - low))
        set_ticks(axes.xaxis)
        axes.set_xlabel(speed.axis("ω" if turning else "v"))
        axes.set_ylabel(unit.axis(f"${symbol}$"))
        power = scale(of.rate("W"), abs(found.peak_power.value))
        told = f"{number(found.peak_power.value / power.divisor)} {power.unit}"
        title = f"Duty of {style.short(drive)}: peak power {told}{remark(found.choice)}"
        titled(axes, title, note(found.unbounded_at, found.variable))
        return axes


def _quantity(found: Duty) -> tuple[str, Scale]:
    """The symbol and the unit of an effort."""
    symbol, name = ("T", "N·m") if found.unit == "N*m" else ("F", "N")
    return symbol, scale(name, abs(found.peak.value))


def _bounded(found: Duty, shown: Floats, unit: Scale) -> Floats:
    """The efforts up to the peak, which excludes values without bound."""
    if not found.unbounded_at:
        return shown
    most = abs(found.peak.value) / unit.divisor
    return np.clip(shown, -most, most)


def _room(axes: Axes, values: Sequence[float]) -> None:
    low, high = float(min(values)), float(max(values))
    if high == low:
        low, high = low - 1.0, high + 1.0
    axes.set_ylim(low - 0.14 * (high - low), high + 0.14 * (high - low))
    set_ticks(axes.yaxis)


def _mark_peak(axes: Axes, found: Duty, across: Abscissa, unit: Scale) -> None:
    x, y = across.at(found.peak.t), found.peak.value / unit.divisor
    colour = style.line(0)["color"]
    axes.scatter([x], [y], s=11.0, facecolor="white", edgecolor=colour, linewidth=1.0, zorder=4)
    words = f"{number(y)} {unit.unit} at {across.words(found.peak.t)}"
    path = np.column_stack([across.shown, found.effort / unit.divisor])
    add_labels(axes, [np.array([x, y])], [words], [path])
