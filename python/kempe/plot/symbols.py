"""Symbols of mechanisms: markers that keep their size in print, and lines between two places."""

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
SPRING_WIDTH = 14.0


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


#: A zigzag beside a dashpot: lines as (share of their length, share of half of their width).
_ZIGZAG_AND_DASHPOT = (
    (
        *((0.0, -0.6), (0.0, 0.6), (0.1, 0.6)),
        *((0.15 + 0.1 * k, 1.0 if k % 2 == 0 else 0.2) for k in range(8)),
        *((0.9, 0.6), (1.0, 0.6), (1.0, -0.6), (0.7, -0.6)),
    ),
    ((0.0, -0.6), (0.5, -0.6)),
    ((0.5, -0.9), (0.5, -0.3)),
    ((0.3, -1.0), (0.7, -1.0), (0.7, -0.2), (0.3, -0.2)),
)
#: They take at most these shares of the distance and of half of the width; straight lines the rest.
_LONGEST, _SLENDER = 0.7, 8.0


def spring_damper(begin: Floats, end: Floats, half: float) -> Floats:
    """The lines of a spring-damper between two points, parted by NaN, (n, 2).

    Args:
        begin: its end on body i.
        end: its end on body j.
        half: half of its width.
    """
    along = end - begin
    length = float(np.hypot(*along)) or 1.0
    aside = np.array([-along[1], along[0]]) / length * half
    middle = min(_LONGEST, _SLENDER * half / length)
    first = (1.0 - middle) / 2.0
    lines = [
        np.array([[0.0, 0.0], [first, 0.0]]),
        *(np.array(line) * [middle, 1.0] + [first, 0.0] for line in _ZIGZAG_AND_DASHPOT),
        np.array([[1.0 - first, 0.0], [1.0, 0.0]]),
    ]
    gap = np.full((1, 2), np.nan)
    axes = np.array([along, aside])
    return np.concatenate([part for line in lines for part in (begin + line @ axes, gap)][:-1])
