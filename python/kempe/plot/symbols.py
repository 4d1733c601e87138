"""Symbols of mechanisms as markers: they keep their size in print. Coordinates in points."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.arrays import Floats
from kempe.plot import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Lines of a symbol around its place, each (n, 2).
Symbol = tuple[Floats, ...]

SPIRAL_RADIUS = 12.0


def _hatching() -> Symbol:
    """The line of ground with short strokes below it."""
    strokes = [np.array([[x, -12.0], [x - 3.5, -15.5]]) for x in np.arange(-7.0, 12.0, 3.5)]
    return (np.array([[-10.5, -12.0], [10.5, -12.0]]), *strokes)


def _spiral() -> Symbol:
    """Two and a half turns around a pin, with a straight end."""
    angle = np.linspace(0.0, 5.0 * np.pi, 90)
    radius = 4.5 + (SPIRAL_RADIUS - 4.5) * angle / angle[-1]
    turns = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    return (turns,)


#: The triangle on which a pin stands.
SUPPORT: Symbol = (np.array([[0.0, 0.0], [-7.0, -12.0], [7.0, -12.0], [0.0, 0.0]]),)
HATCHING = _hatching()
SPIRAL = _spiral()


def draw(
    axes: Axes, symbol: Symbol, place: Floats, *, zorder: float, facecolor: str = "none"
) -> None:
    """Draw a symbol at a place on the axes.

    Args:
        axes: where to.
        symbol: its lines.
        place: (2,), in data coordinates.
        zorder: what it covers.
        facecolor: of closed lines.
    """
    from matplotlib.path import Path

    path = Path.make_compound_path(*(Path(line) for line in symbol))
    reach = float(np.abs(path.vertices).max())
    axes.plot(
        *place,
        marker=path,
        # A marker is scaled so that its farthest coordinate is at half of its size.
        markersize=2.0 * reach,
        markerfacecolor=facecolor,
        markeredgecolor=style.GROUND,
        markeredgewidth=0.9,
        linestyle="none",
        zorder=zorder,
    )
