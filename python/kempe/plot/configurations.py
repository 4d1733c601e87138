"""A sheet with one panel for each configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.plot import style
from kempe.plot.page import Page
from kempe.plot.picture import at_rest, drawn, frame, paint

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kempe.analyses.configurations import ConfigurationsResult

#: Panels beside each other, and on one sheet.
_COLUMNS, _MOST = 3, 12
#: Margins around the axes, space between them, and the largest height of a panel, mm.
_LEFT, _RIGHT, _ABOVE, _BELOW, _BETWEEN = 19.0, 4.0, 7.0, 11.0, 20.0
_HIGHEST = 70.0


def pages(result: ConfigurationsResult, _: int = 1) -> list[Page]:
    """Sheets of at most twelve configurations."""
    firsts = range(0, len(result), _MOST)
    names = ["configurations"] + [f"configurations_{k + 1}" for k in range(1, len(firsts))]
    return [
        Page(0, name, name, lambda first=first: sheet(result, first), key=True)  # type: ignore[misc]
        for name, first in zip(names, firsts, strict=True)
    ]


def sheet(result: ConfigurationsResult, first: int = 0) -> Figure:
    """Draw up to twelve configurations, all at one scale."""
    states = result[first : first + _MOST]
    scenes = [at_rest(state) for state in states]
    boxes = np.array([scene["bounds"] for scene in scenes])
    bounds = [*map(float, boxes.min(axis=0)[:2]), *map(float, boxes.max(axis=0)[2:])]
    low, high = frame({"bounds": bounds})
    columns = min(_COLUMNS, len(states))
    rows = -(-len(states) // columns)
    wide = (style.WIDTH - _LEFT - _RIGHT - (columns - 1) * _BETWEEN) / columns
    wide = min(wide, _HIGHEST * float((high - low)[0] / (high - low)[1]))
    tall = wide * float((high - low)[1] / (high - low)[0])
    row_height = tall + _ABOVE + _BELOW
    made = style.figure(rows * row_height, layout=None)
    for k, scene in enumerate(scenes):
        column, row = k % columns, k // columns
        left = _LEFT + column * (wide + _BETWEEN)
        bottom = (rows - 1 - row) * row_height + _BELOW
        axes = style.axes_at(made, (left, bottom, wide, tall), rows * row_height)
        display = drawn(axes, {**scene, "bounds": bounds}, f"Configuration {first + k + 1}")
        display.name_joints()
        paint(axes, display)
    return made
