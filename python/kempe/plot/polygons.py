"""Velocity and acceleration polygons, as drawn in textbooks: pole, images of points, labels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.design import polygons
from kempe.design.polygons import POLE, Polygon, Side
from kempe.draw.units import Scale, scale
from kempe.plot import style
from kempe.plot.configuration import instant
from kempe.plot.labelled import add_labels
from kempe.plot.ticks import set_ticks
from kempe.results.solution import Solution
from kempe.results.state import State

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT = 110.0
#: Look of the sides by their part.
_LOOKS: dict[str, dict[str, Any]] = {
    "absolute": {"color": "#000000", "linewidth": 1.3},
    "relative": {"color": "#0072B2", "linewidth": 1.0},
    "normal": {"color": "#D55E00", "linewidth": 1.0},
    "tangential": {"color": "#0072B2", "linewidth": 1.0},
    "slip": {"color": "#009E73", "linewidth": 1.0},
    "coriolis": {"color": "#CC79A7", "linewidth": 1.0},
}
_WORDS = {
    "absolute": "from the pole",
    "relative": "relative (ω × r)",
    "normal": "normal (−ω² r)",
    "tangential": "tangential (α × r)",
    "slip": "slip",
    "coriolis": "Coriolis (2 ω × v)",
}
#: Sides shorter than this fraction of the longest side are not drawn.
_LEAST = 1e-6


def velocity_polygon(
    solution_or_state: Solution | State, t: float | None = None, *, ax: Axes | None = None
) -> Axes:
    """Draw the velocity polygon at an instant.

    Args:
        solution_or_state: a solution or a state.
        t: the instant in a solution, s; its first when None.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: the instant is not within the solution.
    """
    return _draw(polygons.velocity_polygon(solution_or_state, t), ax)


def acceleration_polygon(
    solution_or_state: Solution | State, t: float | None = None, *, ax: Axes | None = None
) -> Axes:
    """Draw the acceleration polygon at an instant.

    Args:
        solution_or_state: a solution or a state.
        t: the instant in a solution, s; its first when None.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: the instant is not within the solution.
    """
    return _draw(polygons.acceleration_polygon(solution_or_state, t), ax)


def _draw(polygon: Polygon, ax: Axes | None) -> Axes:
    symbol = "v" if polygon.kind == "velocity" else "a"
    sizes = [float(np.hypot(*side.vector)) for side in polygon.sides]
    longest = max(sizes, default=0.0)
    unit = scale(polygon.unit, longest)
    pairs = zip(polygon.sides, sizes, strict=True)
    sides = [side for side, size in pairs if size > _LEAST * longest]
    # relative to a pin on ground, the velocity is the one from the pole
    sides = [side for side in sides if side.part != "relative" or not side.name.endswith(POLE)]
    with style.on(ax, _HEIGHT) as axes:
        _frame(axes, sides, unit)
        for part in dict.fromkeys(side.part for side in sides):
            own = [side for side in sides if side.part == part]
            axes.plot([], [], label=_WORDS[part], **_LOOKS[part])
            for side in own:
                _arrow(axes, side, unit)
        axes.set_xlabel(unit.axis(f"${symbol}_x$"))
        axes.set_ylabel(unit.axis(f"${symbol}_y$"))
        at = instant(polygon.state)
        axes.set_title(f"{polygon.kind.capitalize()} polygon, {at}", loc="left")
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
        style.lay_out(axes.figure.canvas.figure)
        axes.apply_aspect()
        _name(axes, polygon, sides, unit)
        return axes


def _frame(axes: Axes, sides: list[Side], unit: Scale) -> None:
    """Limits around all sides, with equal scales."""
    corners = [np.zeros(2), *(end for side in sides for end in (side.start, side.end))]
    low, high = np.min(corners, axis=0), np.max(corners, axis=0)
    middle, half = (low + high) / 2.0, (high - low) / 2.0
    half = np.maximum(half, 0.35 * float(half.max())) * 1.25
    half = np.where(half > 0.0, half, unit.divisor)
    axes.set_aspect("equal", adjustable="box")
    (left, bottom), (right, top) = (middle - half) / unit.divisor, (middle + half) / unit.divisor
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    set_ticks(axes.xaxis)
    set_ticks(axes.yaxis)


def _arrow(axes: Axes, side: Side, unit: Scale) -> None:
    from matplotlib.patches import FancyArrowPatch

    look = _LOOKS[side.part]
    (x, y), (to_x, to_y) = side.start / unit.divisor, side.end / unit.divisor
    axes.add_patch(
        FancyArrowPatch(
            (float(x), float(y)),
            (float(to_x), float(to_y)),
            arrowstyle="-|>",
            mutation_scale=8.0,
            shrinkA=0.0,
            shrinkB=0.0,
            zorder=3.0,
            **look,
        )
    )


def _name(axes: Axes, polygon: Polygon, sides: list[Side], unit: Scale) -> None:
    """Lower-case letters at the images, with a prime for accelerations; the pole is o."""
    prime = "" if polygon.kind == "velocity" else "′"
    places: list[tuple[Floats, list[str]]] = []
    size = max((float(np.hypot(*side.vector)) for side in sides), default=1.0)
    for name, image in polygon.images.items():
        words = POLE if name == POLE else name.lower() if len(name) <= 2 else name
        near = next((n for at, n in places if np.hypot(*(at - image)) < 1e-6 * size), None)
        if near is None:
            places.append((image, [words + prime]))
        elif words + prime not in near:
            near.append(words + prime)
    paths = [np.array([side.start, side.end]) / unit.divisor for side in sides]
    points = [at / unit.divisor for at, _ in places]
    axes.plot(*np.array(points).T, "o", color="#000000", markersize=3.0, zorder=4.0)
    words_of = [style.verbatim(", ".join(words)) for _, words in places]
    add_labels(axes, points, words_of, paths, fontweight="bold")
