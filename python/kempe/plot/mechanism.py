"""The mechanism as a drawing: joints, forces and drivers named, lengths given, gravity shown."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.draw.scene import scene
from kempe.plot import style
from kempe.plot.configuration import state_at
from kempe.plot.picture import drawn, paint

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.results.solution import Solution
    from kempe.results.state import State


def mechanism(solution_or_state: Solution | State, *, ax: Axes | None = None) -> Axes:
    """Draw the mechanism with its dimensions.

    Args:
        solution_or_state: the solution, drawn at its start, or the state.
        ax: where to; a figure of its own when None.
    """
    with style.on(ax) as axes:
        state = state_at(solution_or_state, None)
        made = drawn(axes, scene(state), style.short(state.compiled.title, 80))
        made.add_dimensions()
        made.add_gravity()
        made.name_joints()
        made.name_elements()
        paint(axes, made)
        return axes
