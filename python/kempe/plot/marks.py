"""Marks of events in figures over time: thin lines, with the name of each event once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.draw.palette import one_line, verbatim
from kempe.fine import fine
from kempe.plot.time_axis import TimeAxis

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kempe.solution import Solution

#: More lines of one event than this are not drawn.
_MOST = 40
_COLOUR = "#777777"


def mark_events(figure: Figure, solution: Solution) -> None:
    """Draw the events of a solution into all axes of a figure over time.

    The name is in the axes at the top, at the first line of the event. Events that occur more often
    than 40 times are left out.
    """
    occurred = [e for e in solution.events.values() if 0 < len(e.t) <= _MOST]
    panels = [axes for axes in figure.axes if axes.lines]
    if not occurred or not panels:
        return
    divisor = TimeAxis.of(np.atleast_1d(fine(solution).t), None, solution.variable).unit.divisor
    top = max(panels, key=lambda axes: axes.get_position().y1)
    for event in occurred:
        for axes in panels:
            low, high = sorted(axes.get_xlim())
            for t in event.t / divisor:
                if low <= t <= high:
                    axes.axvline(t, color=_COLOUR, linewidth=0.5, zorder=0.5)
        top.annotate(
            verbatim(one_line(event.name)),
            (float(event.t[0]) / divisor, 1.0),
            xycoords=top.get_xaxis_transform(),
            xytext=(1.5, -1.5),
            textcoords="offset points",
            rotation=90,
            fontsize=6.0,
            color=_COLOUR,
            ha="left",
            va="top",
        )
