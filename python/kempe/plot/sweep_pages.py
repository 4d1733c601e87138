"""The figures of a sweep that ``kempe sweep`` writes."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from kempe.plot import style
from kempe.plot.page import Page, file_names
from kempe.plot.sweep_scatter import sweep_scatter
from kempe.plot.sweeps import sweep_contributions, sweep_histogram, sweep_lines, sweep_map

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.sweeps import SweepResult


def sweep_pages(result: SweepResult) -> list[Page]:
    """The figures that fit a sweep, for each measure.

    One variable gives lines, two give a map. Three or more give histograms, contributions and a
    scatter matrix, as does a design of random values.
    """
    kinds: dict[str, tuple[Callable[..., Axes], float]] = {}
    count = len(result.variables)
    spread = any(variable.levels is None for variable in result.variables)
    if count == 1:
        kinds["lines"] = (sweep_lines, style.HEIGHT)
    if count == 2:
        kinds["map"] = (sweep_map, 100.0)
    if count > 2 or spread:
        kinds["histogram"] = (sweep_histogram, style.HEIGHT)
        kinds["contributions"] = (sweep_contributions, max(35.0, 20.0 + 8.0 * count))
    stems = file_names(text.replace(".", "_") for text in result.measures)
    pages = [
        Page(0, f"{kind}_{stem}", f"{kind} {text}", partial(_figure, draw, result, text, height))
        for text, stem in zip(result.measures, stems, strict=True)
        if np.isfinite(result[text]).any()
        for kind, (draw, height) in kinds.items()
    ]
    if count > 2 or spread:
        pages.append(Page(0, "scatter", "scatter", partial(sweep_scatter, result)))
    return pages


def _figure(draw: Callable[..., Axes], result: SweepResult, measure: str, height: float) -> Figure:
    made = style.figure(height)
    draw(result, measure, ax=made.add_subplot())
    return made
