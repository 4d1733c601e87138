"""Panels over time on a page: in rows, with fixed margins, one unit for each quantity."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kempe.base.arrays import Floats
from kempe.draw.units import Scale, scale
from kempe.plot import style
from kempe.plot.curves import draw
from kempe.plot.panel import Panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Lengths on a page, mm: beside the axes for numbers and labels, above a panel, below it
#: with and without the time, of a line of the note.
_LEFT, _RIGHT = 19.0, 4.0
_TITLE, _TIME, _GAP, _LINE = 7.0, 11.0, 2.5, 4.0
#: Height of axes, of those that are alone, and of a legend above all panels, mm.
_HIGH, _ALONE, _LEGEND = 26.0, 57.0, 5.0
#: Names in a row of the legend.
_NAMES = 4
#: Characters in a line of the note.
_WIDE = 98


@dataclass(frozen=True)
class Sheet:
    """The contents of a page.

    Attributes:
        panels: in the order of reading.
        columns: 1 or 2; an odd last panel is as wide as the page.
        note: a sentence below the panels; empty for none.
        shared: whether all panels of one unit have the same range.
        legend: whether all panels share one legend above them.
    """

    panels: Sequence[Panel]
    columns: int
    note: str = ""
    shared: bool = False
    legend: bool = False


def sheet_figure(sheet: Sheet, t: Floats, cut: float | None, fixed: Mapping[str, Scale]) -> Figure:
    """Draw a page of panels.

    Args:
        sheet: the panels.
        t: times of all curves, (n_t,), s.
        cut: time after which the time axis is compressed, s; never when None.
        fixed: units of axes by SI unit; others are chosen for the largest value on the page.
    """
    rows = [sheet.panels[k : k + sheet.columns] for k in range(0, len(sheet.panels), sheet.columns)]
    note = textwrap.wrap(sheet.note, _WIDE)
    height = _top(sheet) + sum(_row_height(rows, k) for k in range(len(rows)))
    height += _LINE * len(note) + (2.0 if note else 0.0)
    figure = style.figure(height, layout=None)
    drawing = _Drawing(figure, height, t, cut, _scales(sheet.panels, fixed), _spans(sheet))
    drawing.draw(rows, _top(sheet))
    if _names(sheet):
        fullest = max(drawing.axes, key=lambda axes: len(axes.lines))
        handles, words = fullest.get_legend_handles_labels()
        place = (1.0 - _RIGHT / style.WIDTH, 1.0)
        columns = min(len(words), _NAMES)
        figure.legend(handles, words, loc="upper right", bbox_to_anchor=place, ncols=columns)
    for k, line in enumerate(reversed(note)):
        y = (1.5 + k * _LINE) / height
        figure.text(_GAP / style.WIDTH, y, line, fontsize=8.0, va="bottom")
    return figure


def _top(sheet: Sheet) -> float:
    return _LEGEND * math.ceil(len(_names(sheet)) / _NAMES)


def _names(sheet: Sheet) -> list[str]:
    """The lines of the legend that all panels share."""
    if not sheet.legend or not sheet.panels:
        return []
    return [curve.label for curve in max(sheet.panels, key=lambda p: len(p.curves)).curves]


def _high(rows: Sequence[Sequence[Panel]]) -> float:
    return _ALONE if len(rows) == 1 and len(rows[0]) == 1 else _HIGH


def _row_height(rows: Sequence[Sequence[Panel]], k: int) -> float:
    titled = any(panel.title for panel in rows[k])
    return (_TITLE if titled else _GAP) + _high(rows) + (_TIME if _timed(rows, k) else 0.0)


def _timed(rows: Sequence[Sequence[Panel]], k: int) -> bool:
    """Whether the times are written below a row: if the next row has other widths or is missing."""
    return k + 1 == len(rows) or len(rows[k + 1]) != len(rows[k])


def _scales(panels: Sequence[Panel], fixed: Mapping[str, Scale]) -> dict[str, Scale]:
    """One unit for each quantity of the page."""
    units = dict.fromkeys(panel.unit for panel in panels)
    largest = {unit: max(p.peak for p in panels if p.unit == unit) for unit in units}
    return {unit: fixed.get(unit) or scale(unit, peak) for unit, peak in largest.items()}


def _spans(sheet: Sheet) -> dict[str, tuple[float, float]]:
    """The common range of all panels of one unit, SI units."""
    found: dict[str, tuple[float, float]] = {}
    for panel in sheet.panels if sheet.shared else []:
        low, high = found.get(panel.unit, (math.inf, -math.inf))
        found[panel.unit] = (min(low, panel.span[0]), max(high, panel.span[1]))
    return found


@dataclass
class _Drawing:
    figure: Figure
    height: float
    t: Floats
    cut: float | None
    scales: Mapping[str, Scale]
    spans: Mapping[str, tuple[float, float]]

    def draw(self, rows: Sequence[Sequence[Panel]], top: float) -> None:
        """Draw the rows from the top down; ``top`` is left free above them, mm."""
        self.axes: list[Axes] = []
        columns = max(map(len, rows), default=1)
        below = self.height - top
        for k, row in enumerate(rows):
            below -= _row_height(rows, k)
            bottom = below + (_TIME if _timed(rows, k) else 0.0)
            width = style.WIDTH / (columns if len(row) == columns else 1)
            for c, panel in enumerate(row):
                box = (c * width + _LEFT, bottom, width - _LEFT - _RIGHT, _high(rows))
                self._draw_panel(panel, box, timed=_timed(rows, k))

    def _draw_panel(
        self, panel: Panel, box: tuple[float, float, float, float], *, timed: bool
    ) -> None:
        axes = style.axes_at(self.figure, box, self.height)
        draw(
            axes,
            self.t,
            panel,
            cut=self.cut,
            chosen=self.scales[panel.unit],
            span=self.spans.get(panel.unit),
        )
        if not timed:
            axes.set_xlabel("")
            axes.tick_params(labelbottom=False)
        self.axes.append(axes)
