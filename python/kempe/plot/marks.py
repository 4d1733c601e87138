"""Marks in figures over time: thin lines at events and at passed singular positions, named once."""

from __future__ import annotations

from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from kempe.draw.palette import one_line, verbatim
from kempe.errors import KempeError
from kempe.plot.time_axis import TimeAxis
from kempe.results.fine import fine
from kempe.results.singular import singular_positions
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Largest number of lines of an event; the lines of a more frequent event are not drawn.
_MOST = 40
_COLOUR = "#777777"
#: Name and dashes of singular positions; events have whole lines.
SINGULAR, _DASHES = "singular position", (0, (6, 4))
#: Distance of a name from the line, points, and that of this name: reactions have peaks there.
_BESIDE, _BESIDE_PEAK = 1.5, 8.0
#: Size of names, points, and the distance of two lines of text, relative to it.
_SIZE, _LINE = 6.0, 1.2
_POINTS_PER_INCH = 72.0

_known: WeakKeyDictionary[Solution, list[float]] = WeakKeyDictionary()


def mark_events(figure: Figure, solution: Solution) -> None:
    """Draw events and passed singular positions of a solution into all axes of a figure over time.

    The name is in the axes at the top, at the first line of the event. Events whose first lines are
    so close that their names would lie on each other share one label. Events that occur more often
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
    for _, times, style in marks:
        for axes in panels:
            low, high = sorted(axes.get_xlim())
            for t in (t / divisor for t in times):
                if low <= t <= high:
                    axes.axvline(t, color=_COLOUR, linewidth=0.5, linestyle=style, zorder=0.5)
    for t, beside, names in _labels(top, [(times[0] / divisor, name) for name, times, _ in marks]):
        top.annotate(
            verbatim(", ".join(map(one_line, names))),
            (t, 1.0),
            xycoords=top.get_xaxis_transform(),
            xytext=(beside, -1.5),
            textcoords="offset points",
            rotation=90,
            fontsize=_SIZE,
            color=_COLOUR,
            ha="left",
            va="top",
        )


def _labels(axes: Axes, first: list[tuple[float, str]]) -> list[tuple[float, float, list[str]]]:
    """Labels at the first lines of marks: their times, distances from the lines, and names.

    Marks whose labels would lie on each other share one, with the names in the order of time.
    """
    low, high = axes.get_xlim()
    window = axes.get_window_extent()  # in pixels
    points = window.width / axes.figure.dpi * _POINTS_PER_INCH / abs(high - low)
    found: list[tuple[float, float, list[str]]] = []
    for t, name in sorted(first, key=lambda mark: mark[0]):
        beside = _BESIDE_PEAK if name == SINGULAR else _BESIDE
        if found:
            at, last, names = found[-1]
            if points * (t - at) + beside - last < _LINE * _SIZE:
                names.append(name)
                continue
        found.append((t, beside, [name]))
    return found


def _singular(solution: Solution) -> list[float]:
    """The times of the singular positions that a simulation passed."""
    if solution not in _known:
        try:
            passed = singular_positions(solution) if solution.variable.is_time else []
        except KempeError:  # no unique multipliers
            passed = []
        _known[solution] = [float(of["t"]) for of in passed]
    return _known[solution]
