"""The transmission angle over the crank angle, with the range that textbooks recommend."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.design.places import Place
from kempe.design.transmission import transmission_angle as angle_of
from kempe.draw.units import number
from kempe.plot import style
from kempe.plot.abscissa import abscissa
from kempe.plot.labelled import add_labels
from kempe.plot.ticks import DEGREES, set_ticks
from kempe.results.extrema import Extreme
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Recommended deviation from 90°, degrees.
_GOOD = 50.0


def transmission_angle(
    solution: Solution,
    joint: str,
    *,
    over: str | None = None,
    lines: Mapping[str, Place] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the transmission angle at a joint; the recommended range, 40° to 140°, is shaded.

    Args:
        solution: the motion.
        joint: a pin between a coupler and an output link.
        over: quantity on the horizontal axis, or "t"; by default the driven quantity.
        lines: see ``kp.design.transmission_angle``.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: see ``kp.design.transmission_angle``.
    """
    found = angle_of(solution, joint, lines=lines)
    across = abscissa(solution, over)
    angle = np.degrees(found.angle)
    with style.on(ax) as axes:
        axes.axhspan(90.0 - _GOOD, 90.0 + _GOOD, color="#E8F4EE", linewidth=0.0, zorder=0.2)
        axes.axhline(90.0, color="#888888", linewidth=0.7, linestyle="--", zorder=0.5)
        axes.plot(across.shown, angle, **style.line(0))
        across.label(axes)
        low, high = min(30.0, float(angle.min()) - 8.0), max(150.0, float(angle.max()) + 8.0)
        axes.set_ylim(max(low, 0.0), min(high, 180.0))
        set_ticks(axes.yaxis, DEGREES)
        axes.set_ylabel("μ / °")
        axes.set_title(
            f"Transmission angle at {style.short(joint)}: at least "
            f"{number(np.degrees(found.worst.value))}°, at {across.words(found.worst.t)}",
            loc="left",
        )
        marks = list(dict.fromkeys([found.limits.least, found.limits.largest]))
        points = [_mark(axes, extreme, across.at(extreme.t)) for extreme in marks]
        words = [f"{number(np.degrees(extreme.value))}°" for extreme in marks]
        add_labels(axes, points, words, [np.column_stack([across.shown, angle])])
        return axes


def _mark(axes: Axes, extreme: Extreme, x: float) -> Floats:
    y = float(np.degrees(extreme.value))
    colour = style.line(0)["color"]
    axes.scatter([x], [y], s=11.0, facecolor="white", edgecolor=colour, linewidth=1.0, zorder=4)
    return np.array([x, y])
