"""The style of all figures: sizes for print, fonts, colours suitable for any colour vision."""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, BinaryIO, Literal, TypeAlias

from kempe.draw.palette import COLOURS, GROUND, LONGEST_NAME, colour, one_line, verbatim

__all__ = ["COLOURS", "GROUND", "LONGEST_NAME", "colour", "one_line", "verbatim"]

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: The lines of one panel in order: in print without colours the dashes distinguish them.
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)), (0, (1, 2)))
#: Of the curves of a study: ten colours, dashes and markers, each only once.
_MANY_COLOURS = (*COLOURS, "#7A3DB8", "#8B5A2B", "#7F7F7F")
_MANY_DASHES = (*DASHES, (0, (8, 2, 1, 2)), (0, (12, 3)), (0, (4, 1, 1, 1, 1, 1, 1, 1)))
MARKERS = "osD^vP*X<>"
SUM = {"color": "#000000", "linestyle": "-", "linewidth": 1.6, "zorder": 1.9}
EARLIER = "#BBBBBB"
QUIET = "#F2F2F2"

MILLIMETRE = 1.0 / 25.4
WIDTH = 160.0  # mm: the text of an A4 page
HEIGHT = 75.0  # mm: of a figure with one panel
DOTS_PER_INCH = 200
#: Distances of the labels from their axes, mm.
_X_LABEL, _Y_LABEL = 6.3, 14.3
Format: TypeAlias = Literal["png", "svg", "pdf"]
FORMATS: tuple[Format, ...] = ("png", "svg", "pdf")

_FONTS: dict[Any, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.titley": 1.0,  # a fixed place; the search for a place takes as long as drawing the axes
    "axes.labelsize": 9.0,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 8.0,
    "mathtext.fontset": "dejavusans",
}
_LINES: dict[Any, Any] = {
    "lines.linewidth": 1.2,
    "lines.markersize": 4.0,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.5,
    "legend.frameon": False,
    "legend.handlelength": 2.6,
}
# The same solution gives the same bytes.
_FILES: dict[Any, Any] = {"svg.hashsalt": "kempe", "svg.fonttype": "path", "pdf.fonttype": 42}


@contextmanager
def applied() -> Iterator[None]:
    """Apply the style of kempe in the block; the user's own style is not changed."""
    import matplotlib

    with matplotlib.rc_context({**_FONTS, **_LINES, **_FILES}), warnings.catch_warnings():
        # A name may contain characters that the font lacks; they are drawn as boxes.
        warnings.filterwarnings("ignore", message=r"Glyph \d+")
        yield


@contextmanager
def on(ax: Axes | None, height: float = HEIGHT) -> Iterator[Axes]:
    """The axes for a figure, in the style of kempe: given axes, or new axes of a height, mm."""
    with applied():
        yield new_axes(height) if ax is None else ax


def line(k: int) -> dict[str, Any]:
    """Colour and dashes of the k-th line of a panel, from 0; the first 49 are different."""
    shift = k // len(COLOURS)
    return {
        "color": COLOURS[k % len(COLOURS)],
        "linestyle": DASHES[(k + shift) % len(DASHES)],
    }


def marked_line(k: int) -> dict[str, Any]:
    """Colour, dashes and marker of the k-th curve of a study, from 0; all of ten are different."""
    return {
        "color": _MANY_COLOURS[k % len(_MANY_COLOURS)],
        "linestyle": _MANY_DASHES[k % len(_MANY_DASHES)],
        "marker": MARKERS[k % len(MARKERS)],
    }


def new_axes(height: float = HEIGHT) -> Axes:
    """Axes in a figure of their own that a notebook or ``plt.show()`` shows."""
    from matplotlib import pyplot

    size = (WIDTH * MILLIMETRE, height * MILLIMETRE)
    axes: Axes = pyplot.subplots(figsize=size, layout="constrained", dpi=DOTS_PER_INCH)[1]
    return axes


def figure(height: float = HEIGHT, layout: Literal["constrained"] | None = "constrained") -> Figure:
    """A figure without a window, for a file, as wide as the text of a page.

    Args:
        height: mm.
        layout: None if all axes have fixed places, by ``axes_at``.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    size = (WIDTH * MILLIMETRE, height * MILLIMETRE)
    made = Figure(figsize=size, layout=layout, dpi=DOTS_PER_INCH)
    FigureCanvasAgg(made)
    return made


def axes_at(made: Figure, box: tuple[float, float, float, float], height: float) -> Axes:
    """Axes at a fixed place; their labels have fixed places too, so that nothing is laid out.

    Args:
        made: the figure.
        box: left and lower edge, width and height, mm.
        height: height of the figure, mm.
    """
    left, bottom, wide, high = box
    found: Axes = made.add_axes((left / WIDTH, bottom / height, wide / WIDTH, high / height))
    found.yaxis.set_label_coords(-_Y_LABEL / wide, 0.5)
    found.xaxis.set_label_coords(0.5, -_X_LABEL / high)
    return found


def save(made: Figure, path: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Write a figure, each file whole or not at all; returns the files.

    Args:
        made: the figure.
        path: its name without suffix.
        formats: some of ``FORMATS``.

    Raises:
        FileError: a file cannot be written.
    """
    from kempe.base import files

    written = []
    with applied():
        lay_out(made)
        made.set_layout_engine("none")
        for name in formats:
            target = path.with_name(f"{path.name}.{name}")
            with files.writing(target) as file:
                _print(made, name, file)
            written.append(target)
    return written


def svg(made: Figure) -> str:
    """A figure as an SVG element for a page, without the declarations of a file."""
    file = io.BytesIO()
    with applied():
        lay_out(made)
        made.set_layout_engine("none")
        _print(made, "svg", file)
    text = file.getvalue().decode("utf-8")
    return text[text.index("<svg") :]


def lay_out(made: Figure) -> None:
    """Lay out the axes once, and not again at every drawing."""
    engine = made.get_layout_engine()
    if engine is not None:
        engine.execute(made)


def _print(made: Figure, form: str, file: BinaryIO) -> None:
    """Draw once, where ``savefig`` draws twice."""
    if form == "png":
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        FigureCanvasAgg(made).print_png(file)  # type: ignore[no-untyped-call]
    elif form == "svg":
        from matplotlib.backends.backend_svg import FigureCanvasSVG

        FigureCanvasSVG(made).print_svg(file, metadata={"Date": None})  # type: ignore[no-untyped-call]
    else:
        made.savefig(file, format=form, metadata={"CreationDate": None})


def short(name: str, longest: int = LONGEST_NAME) -> str:
    """A name for a title or a legend: verbatim, on one line, its middle left out if too long."""
    return verbatim(one_line(name, longest))
