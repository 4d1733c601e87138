"""A scene on the axes of a figure: framed, drawn by its display list, painted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.display import Display
from kempe.draw.placing import View
from kempe.draw.scene import Scene
from kempe.draw.scene import scene as scene_of
from kempe.draw.units import Scale
from kempe.plot import style
from kempe.plot.remarked import titled
from kempe.plot.ticks import set_ticks
from kempe.results.state import State

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Margin around the mechanism, as a fraction of its larger side.
_MARGIN = 0.17
#: Least height of a drawing relative to its width, and least width relative to its height.
_LEAST_SIDE = 0.45


def at_rest(state: State) -> Scene:
    """The scene of a position without forces, which may not be unique in this position."""
    still = State(state.compiled, state.t, state.q, np.zeros_like(state.v), z=state.z)
    # in place of what follows from the equations of motion
    vars(still)["_dynamics"] = (np.zeros_like(still.q), np.zeros(still.compiled.n_multipliers))
    return scene_of(still)


def frame(scene: Scene) -> tuple[Floats, Floats]:
    """Least and largest x and y of the axes, m: the mechanism with a margin."""
    low, high = np.array(scene["bounds"]).reshape(2, 2)
    middle, sides = (low + high) / 2.0, high - low
    sides = sides + 2.0 * _MARGIN * (float(sides.max()) or 1.0)
    half = np.maximum(sides, _LEAST_SIDE * sides.max()) / 2.0
    return middle - half, middle + half


def drawn(axes: Axes, scene: Scene, title: str, note: str = "") -> Display:
    """The mechanism without names, as a display list for axes.

    The axes get their limits and are laid out, so that lengths of print are known. ``note`` is a
    small line below the title.
    """
    low, high = frame(scene)
    unit = Scale(scene["length"]["metres"], scene["length"]["unit"])
    (left, bottom), (right, top) = low / unit.divisor, high / unit.divisor
    titled(axes, title, note)
    axes.set_aspect("equal")
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_xlabel(unit.axis("x"))
    axes.set_ylabel(unit.axis("y"))
    axes.grid(color="#EEEEEE")
    style.lay_out(axes.figure.canvas.figure)
    axes.apply_aspect()
    set_ticks(axes.xaxis)
    set_ticks(axes.yaxis)
    size = np.array(axes.get_window_extent().size) * 72.0 / float(axes.figure.dpi)
    made = Display(scene, View(low, float(size[0] / (high - low)[0]), size))
    made.draw_mechanism()
    return made


def paint(axes: Axes, made: Display) -> None:
    """Paint a display list as it is at its first instant."""
    from kempe.draw.painter import Painting

    Painting(axes, made.finish(), made.first, made.scene["length"]["metres"])
