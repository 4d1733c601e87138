"""Marks in figures over time: thin lines at events and at passed singular positions, named once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias
from weakref import WeakKeyDictionary

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.palette import one_line, verbatim
from kempe.errors import KempeError
from kempe.model.drawing import measured
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
#: The part of the axes by which names are moved down at most.
_DEEP = 0.7

#: Time of the first line, distance of the name from it, points, and the names.
Label: TypeAlias = tuple[float, float, list[str]]

_known: WeakKeyDictionary[Solution, list[float]] = WeakKeyDictionary()


def mark_events(figure: Figure, solution: Solution) -> None:
    """Draw events and passed singular positions of a solution into all axes of a figure over time.

    The name is in the axes at the top, beside the first line of the event, where it covers the
    fewest curves. Events whose first lines are so close that their names would lie on each other
    share one label. Events that occur more often than 40 times are left out.
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
            for t in (t / divisor for t in times):
                if _visible(axes, t):
                    axes.axvline(t, color=_COLOUR, linewidth=0.4, linestyle=style, zorder=0.5)
    first = [(times[0] / divisor, name) for name, times, _ in marks]
    _write(figure, top, _labels(top, [mark for mark in first if _visible(top, mark[0])]))


def _visible(axes: Axes, t: float) -> bool:
    low, high = sorted(axes.get_xlim())
    return low <= t <= high


def _write(figure: Figure, axes: Axes, labels: list[Label]) -> None:
    """Write labels upwards beside their lines, where they cover the fewest curves."""
    engine = figure.get_layout_engine()
    if engine is not None:  # places in points follow from the final axes
        engine.execute(figure)
    dots = _POINTS_PER_INCH / figure.dpi
    box = axes.get_window_extent()
    corner, size = np.array([box.x0, box.y0]), (box.width * dots, box.height * dots)
    drawn = [line.get_xydata() for line in axes.lines if line.get_color() != _COLOUR]
    curves = [(axes.transData.transform(points) - corner) * dots for points in drawn]
    taken: list[Box] = []
    for t, beside, names in labels:
        words, length = _shortened(names, size[1])
        x = float(axes.transData.transform((t, 0.0))[0] - box.x0) * dots
        lefts = [x + beside, x - _BESIDE - _LINE * _SIZE]
        tops = np.linspace(size[1] - _BESIDE, max(length, size[1] - _BESIDE) * (1 - _DEEP), 4)
        boxes = [
            Box(left, top - length, left + _LINE * _SIZE, top) for top in tops for left in lefts
        ]
        at = min(boxes, key=lambda one: one.cost(curves, taken, size))
        taken.append(at)
        text = axes.annotate(
            words,
            (t, 1.0),
            xycoords=axes.get_xaxis_transform(),
            xytext=(at.left - x, at.top - size[1]),
            textcoords="offset points",
            rotation=90,
            fontsize=_SIZE,
            color=_COLOUR,
            ha="left",
            va="top",
            zorder=1.0,  # above the lines of events, below the curves
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5},
        )
        text.set_in_layout(False)


@dataclass(frozen=True)
class Box:
    """A place of a label, points from the lower left corner of the axes."""

    left: float
    bottom: float
    right: float
    top: float

    def cost(self, curves: list[Floats], taken: list[Box], size: tuple[float, float]) -> int:
        """Number of curves and labels below the box, and ten if it leaves the axes."""
        outside = self.left < 0.0 or self.right > size[0] or self.bottom < 0.0
        labels = sum(
            self.left < one.right
            and one.left < self.right
            and self.bottom < one.top
            and one.bottom < self.top
            for one in taken
        )
        return 10 * outside + 2 * labels + sum(self._covers(curve) for curve in curves)

    def _covers(self, curve: Floats) -> bool:
        """Whether a curve over increasing or decreasing x runs below the box."""
        x, y = curve[np.isfinite(curve).all(axis=1)].T
        if not len(x):
            return False
        order = np.argsort(x, kind="stable")
        ends = np.interp((self.left, self.right), x[order], y[order])
        inner = y[(x > self.left) & (x < self.right)]
        low, high = (float(of(np.append(inner, ends))) for of in (np.min, np.max))
        return bool(
            low < self.top and high > self.bottom and x.min() < self.right and x.max() > self.left
        )


def _shortened(names: list[str], height: float) -> tuple[str, float]:
    """The names as a text that fits into a height, and its length, points."""
    for count in range(len(names), 0, -1):
        dots = ["…"] if count < len(names) else []
        words = ", ".join([*map(one_line, names[:count]), *dots])
        length = measured(words, _SIZE)[0]
        if length <= 0.9 * height:
            break
    return verbatim(words), length


def _labels(axes: Axes, first: list[tuple[float, str]]) -> list[Label]:
    """Labels at the first lines of marks: their times, distances from the lines, and names.

    Marks whose labels would lie on each other share one, with the names in the order of time.
    """
    low, high = axes.get_xlim()
    window = axes.get_window_extent()  # in pixels
    points = window.width / axes.figure.dpi * _POINTS_PER_INCH / abs(high - low)
    found: list[Label] = []
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
