"""The motion of all bodies on one page: a panel for each coordinate, a line for each body."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

from kempe.compiled import COORDINATES
from kempe.plot import style
from kempe.plot.body_motion import QUANTITIES, body_title
from kempe.plot.curves import Curve, Panel, draw
from kempe.plot.page import Page

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kempe.solution import Solution

#: More lines than this cannot be distinguished.
MOST_BODIES = 24
#: Height of a panel, of the texts around all panels, and of a row of the legend, mm.
_PANEL, _AROUND, _ROW = 38.0, 14.0, 5.0
#: Names in a row of the legend.
_COLUMNS = 4


def of_motion(solution: Solution, cut: float | None, index_base: int) -> Page:
    """x, y and angle of all bodies."""
    bodies = [*solution.model.bodies.values()][:MOST_BODIES]
    turning = any(body.turns for body in bodies)
    quantities = COORDINATES if turning else COORDINATES[:2]
    rows = math.ceil(len(bodies) / _COLUMNS)
    height = len(quantities) * _PANEL + _AROUND + rows * _ROW
    drawing = partial(_draw, solution, quantities, cut, index_base)
    return Page(0, "motion", "motion", height, drawing)


def _draw(
    solution: Solution,
    quantities: tuple[str, ...],
    cut: float | None,
    index_base: int,
    figure: Figure,
) -> None:
    known = [*solution.model.bodies.values()]
    bodies = known[:MOST_BODIES]
    panels = figure.subplots(len(quantities), 1, squeeze=False)[:, 0]
    for panel, quantity in zip(panels, quantities, strict=True):
        symbol, unit = QUANTITIES[quantity]
        curves = [
            Curve(
                body_title(body, index_base),
                getattr(solution.body(body.name), quantity),
                style.line(body.number - 1),
            )
            for body in bodies
            if quantity in body.quantities
        ]
        draw(panel, solution.t, curves, Panel(symbol, unit, cut=cut, legend=False))
    count = f"the first {len(bodies)} of {len(known)} bodies" if bodies != known else "all bodies"
    panels[0].set_title(f"Motion of {count}", loc="left")
    for panel in panels[:-1]:
        panel.set_xlabel("")
        panel.tick_params(labelbottom=False)
    figure.align_ylabels(panels)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=_COLUMNS)
