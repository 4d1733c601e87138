"""Shaking force as a polar diagram, or shaking force and moment over the crank angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.design.shaking import shaking
from kempe.draw.units import number, scale
from kempe.plot import style
from kempe.plot.abscissa import abscissa
from kempe.plot.labelled import add_labels
from kempe.plot.pin_loads import _frame
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT = 110.0
_MARKS, _NAMED = 24, 8


def shaking_force(solution: Solution, *, over: str | None = None, ax: Axes | None = None) -> Axes:
    """Draw the tip of the shaking force on ground, without the weight, as a polar diagram.

    Dots divide the motion into 24 parts; some are named.

    Args:
        solution: a motion of ``inverse_dynamics`` or ``dynamics``.
        over: the quantity that names the dots, or "t"; by default the driven quantity.
        ax: where to; a figure of its own when None.

    Raises:
        SingularityError: reactions are not unique.
    """
    found, across = shaking(solution), abscissa(solution, over)
    size = np.hypot(*found.force.T)
    unit = scale("N", float(size.max(initial=0.0)))
    tip = found.force / unit.divisor
    k = int(size.argmax())
    with style.on(ax, _HEIGHT) as axes:
        _frame(axes, tip)
        axes.set_xlabel(unit.axis("$F_x$"))
        axes.set_ylabel(unit.axis("$F_y$"))
        axes.set_title("Shaking force on ground, without weight", loc="left")
        style.lay_out(axes.figure.canvas.figure)
        axes.apply_aspect()
        axes.axhline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
        axes.axvline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
        look = style.line(0)
        axes.plot(*tip.T, **look)
        places = np.linspace(0, len(tip) - 1, _MARKS + 1).round().astype(int)
        axes.plot(*tip[places].T, ".", color=look["color"], markersize=4.0, zorder=3.0)
        points = [tip[k]]
        words = [
            f"{number(size[k] / unit.divisor)} {unit.unit} at {across.words(float(found.t[k]))}"
        ]
        room = 0.05 * (float(np.hypot(*np.ptp(tip, axis=0))) or 1.0)
        for place in np.linspace(0, len(tip) - 1, _NAMED + 1).round().astype(int)[:-1]:
            if all(np.hypot(*(tip[place] - at)) > room for at in points):
                points.append(tip[place])
                words.append(across.words(float(found.t[place])))
        axes.plot(*np.array(points).T, "o", color=look["color"], markersize=4.5, zorder=3.5)
        add_labels(axes, points, words, [tip])
        return axes
