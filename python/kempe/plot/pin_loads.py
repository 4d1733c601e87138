"""The polar diagram of a pin load: the tip of the force in the frame of a body."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.design.pin_loads import PinLoad
from kempe.design.pin_loads import pin_load as load_of
from kempe.draw.units import Scale, number, scale
from kempe.plot import style
from kempe.plot.abscissa import Abscissa, abscissa
from kempe.plot.labelled import add_labels
from kempe.plot.remarked import note, titled
from kempe.plot.ticks import set_ticks
from kempe.results.remarks import remark
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT = 110.0
#: Number of parts into which dots on the curve divide the motion, and number of named dots.
_MARKS, _NAMED = 24, 4


def pin_load(
    solution: Solution,
    joint: str,
    *,
    on: str | None = None,
    over: str | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the force of a joint on a body in the frame of the body, as a polar diagram.

    The curve is the path of the tip of the force, drawn from the joint point. Dots divide the
    motion into 24 parts; some are named. A circle marks the largest force.

    Args:
        solution: a motion of ``inverse_dynamics`` or ``dynamics``.
        joint: the joint or driver.
        on: the body; its body j when None.
        over: the quantity that names the dots, or "t"; by default the driven quantity.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such joint, or the joint does not act on the body.
    """
    found, across = load_of(solution, joint, on), abscissa(solution, over)
    most = found.extremes["max"]
    unit = scale("N", most.value)
    tip = _bounded(found) / unit.divisor
    with style.on(ax, _HEIGHT) as axes:
        _frame(axes, tip)
        axes.set_xlabel(unit.axis("$F_{x′}$"))
        axes.set_ylabel(unit.axis("$F_{y′}$"))
        title = f"{style.short(joint)} on {style.short(found.on)}, axes of the body"
        title += remark(found.choice)
        titled(axes, title, note(found.unbounded_at, found.variable))
        style.lay_out(axes.figure.canvas.figure)
        axes.apply_aspect()
        axes.axhline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
        axes.axvline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
        look = style.line(0)
        axes.plot(*tip.T, **look)
        places = np.linspace(0, len(tip) - 1, _MARKS + 1).round().astype(int)
        axes.plot(*tip[places].T, ".", color=look["color"], markersize=4.0, zorder=3.0)
        _names(axes, found, tip, across, unit)
        return axes


def _bounded(found: PinLoad) -> Floats:
    """The force; NaN where it exceeds the largest one, which excludes values without bound."""
    if not found.unbounded_at:
        return found.force
    most = (1.0 + 1e-9) * found.extremes["max"].value
    return np.where((found.magnitude <= most)[:, None], found.force, np.nan)


def _frame(axes: Axes, tip: Floats) -> None:
    """Limits around the curve and the origin, with equal scales."""
    points = np.vstack([tip, np.zeros((1, 2))])
    low, high = np.nanmin(points, axis=0), np.nanmax(points, axis=0)
    middle, half = (low + high) / 2.0, (high - low) / 2.0
    half = np.maximum(half, 0.45 * float(half.max()) or 1.0) * 1.16
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlim(*(middle[0] + half[0] * np.array([-1.0, 1.0])))
    axes.set_ylim(*(middle[1] + half[1] * np.array([-1.0, 1.0])))
    set_ticks(axes.xaxis)
    set_ticks(axes.yaxis)


def _names(axes: Axes, found: PinLoad, tip: Floats, across: Abscissa, unit: Scale) -> None:
    """The largest force with its instant, and the instants of some dots."""
    most = found.extremes["max"]
    known = np.isfinite(tip[:, 0])
    k = int(np.where(known, np.abs(found.t - most.t), np.inf).argmin())
    ring: dict[str, Any] = {"markerfacecolor": "white", "markersize": 4.5, "zorder": 4.0}
    axes.plot(*tip[k], "o", color="#C2184B", **ring)
    axes.plot([0.0, tip[k, 0]], [0.0, tip[k, 1]], color="#C2184B", linewidth=1.0, zorder=2.5)
    size = float(np.hypot(*np.ptp(tip[known], axis=0))) or 1.0
    points, words = (
        [tip[k]],
        [f"{number(most.value / unit.divisor)} {unit.unit} at {across.words(most.t)}"],
    )
    for place in np.linspace(0, len(tip) - 1, _NAMED + 1).round().astype(int)[:-1]:
        if all(np.hypot(*(tip[place] - at)) > 0.04 * size for at in points):
            points.append(tip[place])
            words.append(across.words(float(found.t[place])))
    axes.plot(
        *np.array(points[1:]).reshape(-1, 2).T, "o", color=style.line(0)["color"], markersize=4.5
    )
    add_labels(axes, points, words, [tip[known], np.array([[0.0, 0.0], tip[k]])])
