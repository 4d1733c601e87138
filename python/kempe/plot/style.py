"""What all figures have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Colours of the bodies in order: Okabe & Ito (2008), told apart with any colour vision.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
EARLIER = "#BBBBBB"
GROUND = "#444444"
SIZE = (8.0, 6.0)
DOTS_PER_INCH = 150


def colour(number: int) -> str:
    """Colour of the k-th moving body, from 1."""
    return COLOURS[(number - 1) % len(COLOURS)]


def new_axes() -> Axes:
    """Axes in a figure of their own that a notebook or ``plt.show()`` shows."""
    from matplotlib import pyplot

    axes: Axes = pyplot.subplots(figsize=SIZE, layout="constrained")[1]
    return axes


def figure() -> Figure:
    """A figure without a window, for a file."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    made = Figure(figsize=SIZE, layout="constrained")
    FigureCanvasAgg(made)
    return made


def save(made: Figure, path: Path) -> None:
    """Write a figure as PNG, whole or not at all.

    Raises:
        FileError: the file cannot be written.
    """
    from kempe import files

    with files.writing(path) as file:
        made.savefig(file, format="png", dpi=DOTS_PER_INCH)


def verbatim(text: str) -> str:
    """Text that matplotlib is to show as it is, not to read as mathematics."""
    return text.replace("$", r"\$")
