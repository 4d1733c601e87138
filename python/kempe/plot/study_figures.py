"""All figures of a study, one file for each."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from kempe.plot import style
from kempe.plot.study_cost import steps, work_precision
from kempe.plot.study_gaps import gaps
from kempe.plot.study_history import error_history, residual_history

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.sweeps.studies import Study

FIGURES: dict[str, Callable[[Study, Axes], None]] = {
    "residual": residual_history,
    "error": error_history,
    "steps": steps,
    "work_precision": work_precision,
    "gaps": gaps,
}

#: Heights of figures that differ from the height of a panel, mm.
HEIGHTS = {"gaps": 110.0, "work_precision": 90.0}


def drawn(study: Study, name: str) -> Figure:
    """One of the figures, drawn, without a window."""
    with style.applied():
        figure = style.figure(HEIGHTS.get(name, style.HEIGHT))
        FIGURES[name](study, figure.add_subplot())
    return figure


def write(study: Study, folder: Path) -> list[Path]:
    """Draw all figures of a study into a folder; returns the files.

    Raises:
        FileError: a file cannot be written.
    """
    written: list[Path] = []
    for name in FIGURES:
        written += style.save(drawn(study, name), folder / name)
    return written
