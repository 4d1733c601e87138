"""The mechanism as a drawing: joints and springs named, lengths given, gravity shown."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.arrays import Floats
from kempe.draw.scene import scene
from kempe.plot import style
from kempe.plot.configuration import name_joints, state_at
from kempe.plot.dimensions import draw_dimensions
from kempe.plot.labels import clipped_lengths
from kempe.plot.picture import Picture, drawn

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.solution import Solution
    from kempe.state import State

_ARROW = 30.0  # length of the arrow of gravity, points


def mechanism(solution_or_state: Solution | State, *, ax: Axes | None = None) -> Axes:
    """Draw the mechanism with its dimensions.

    Args:
        solution_or_state: what is drawn; a solution as it starts.
        ax: where to; a figure of its own when None.
    """
    with style.on(ax) as axes:
        state = state_at(solution_or_state, None)
        made = drawn(axes, scene(state), style.short(state.model.title, 80))
        draw_dimensions(made)
        _draw_gravity(made)
        name_joints(made)
        _name_forces(made)
        return axes


def _name_forces(made: Picture) -> None:
    forces = made.scene["forces"]
    names = [style.short(force["name"]) for force in forces]
    made.write(
        names,
        [made.at(force["bodies"][1], force["point"]) for force in forces],
        fontsize=8.0,
        fontstyle="italic",
    )


def _draw_gravity(made: Picture) -> None:
    """An arrow in the corner with the most room."""
    gravity = np.array(made.scene["gravity"])
    size = float(np.hypot(*gravity))
    if not size:
        return
    along = gravity / size * _ARROW
    centre = _free_corner(made)
    dots = float(made.axes.figure.dpi) / 72.0
    begin, end = made.axes.transData.inverted().transform(
        np.array([centre - along / 2.0, centre + along / 2.0]) * dots
    )
    made.axes.annotate(
        "",
        end,
        begin,
        arrowprops={"arrowstyle": "-|>", "color": "black", "shrinkA": 0, "shrinkB": 0},
    )
    across = np.array([-along[1], along[0]])
    made.lines.append(np.array([[centre - along / 2.0, centre + along / 2.0]]))
    made.lines.append(np.array([[centre - across / 3.0, centre + across / 3.0]]))
    made.write([f"g = {size:.4g} m/s²"], [(begin + end) / 2.0], fontsize=8.0)


def _free_corner(made: Picture) -> Floats:
    box = made.axes.get_window_extent()
    dots = 72.0 / float(made.axes.figure.dpi)
    low, high = np.array(box.min) * dots, np.array(box.max) * dots
    room = np.array([1.3 * _ARROW, 1.05 * _ARROW])
    lines = np.concatenate([np.empty((0, 2, 2)), *made.lines])
    best: Floats = high - room
    least = np.inf
    for share in ((1, 1), (0, 1), (1, 0), (0, 0)):
        centre = np.where(share, high - room, low + room)
        touched = float(clipped_lengths(centre - room, centre + room, lines).sum())
        touched += sum(
            bool(np.all((taken[2:] > centre - room) & (taken[:2] < centre + room)))
            for taken in made.boxes
        )
        if touched < least:
            best, least = centre, touched
    return best
