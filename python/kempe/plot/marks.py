"""Marks in figures over time: thin lines at events and at passed singular positions, named once."""

from __future__ import annotations

from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from kempe.draw.palette import one_line, verbatim
from kempe.errors import KempeError
from kempe.fine import fine
from kempe.plot.time_axis import TimeAxis
from kempe.report.singular import singular_positions
from kempe.solution import Solution

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Largest number of lines of an event; the lines of a more frequent event are not drawn.
_MOST = 40
_COLOUR = "#777777"
#: Name and dashes of singular positions; events have whole lines.
SINGULAR, _DASHES = "singular position", (0, (6, 4))
#: Distance of this name from the line, points: reactions have peaks there.
_BESIDE_PEAK = 8.0

_known: WeakKeyDictionary[Solution, list[float]] = WeakKeyDictionary()


def mark_events(figure: Figure, solution: Solution) -> None:
    """Draw events and passed singular positions of a solution into all axes of a figure over time.

    The name is in the axes at the top, at the first line of the event. Events that occur more often
    than 40 times are left out.
    """
    panels = [axes for axes in figure.axes if axes.lines]
    events = [(e.name, list(map(float, e.t)), "-") for e in solution.events.values()]
    marks = [*events, (SINGULAR, _singular(solution), _DASHES)]
    marks = [mark for mark in marks if 0 < len(mark[1]) <= _MOST]
    if not marks or not panels:
        return
    divisor = TimeAxis.of(np.atleast_1d(fine(solution).t), None, solution.variable).unit.divisor
    top = max(panels, key=lambda axes: axes.get_position().y1)
    for name, times, style in marks:
        for axes in panels:
            low, high = sorted(axes.get_xlim())
            for t in (t / divisor for t in times):
                if low <= t <= high:
                    axes.axvline(t, color=_COLOUR, linewidth=0.5, linestyle=style, zorder=0.5)
        top.annotate(
            verbatim(one_line(name)),
            (times[0] / divisor, 1.0),
            xycoords=top.get_xaxis_transform(),
            xytext=(_BESIDE_PEAK if name == SINGULAR else 1.5, -1.5),
            textcoords="offset points",
            rotation=90,
            fontsize=6.0,
            color=_COLOUR,
            ha="left",
            va="top",
        )


def _singular(solution: Solution) -> list[float]:
    """The times of the singular positions that a simulation passed."""
    if solution not in _known:
        try:
            passed = singular_positions(solution) if solution.variable.is_time else []
        except KempeError:  # no unique multipliers
            passed = []
        _known[solution] = [float(of["t"]) for of in passed]
    return _known[solution]
