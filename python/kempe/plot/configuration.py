"""The mechanism as it stands at one time, bodies numbered and joints named."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.arrays import Floats
from kempe.draw.scene import scene
from kempe.plot import style
from kempe.plot.picture import Picture, drawn
from kempe.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.state import State

_NUMBER = 8.0  # radius of the circle around a number, points


def configuration(
    solution_or_state: Solution | State,
    t: float | None = None,
    *,
    ax: Axes | None = None,
    index_base: int = 1,
) -> Axes:
    """Draw where all bodies are, with numbers and names.

    Args:
        solution_or_state: what is drawn.
        t: the time within a solution, s; its first when None.
        ax: where to; a figure of its own when None.
        index_base: number of the first body.

    Raises:
        ModelError: the time is outside of the solution.
    """
    state = state_at(solution_or_state, t)
    with style.on(ax) as axes:
        made = drawn(axes, scene(state), f"t = {float(state.t):g} s")
        _number_bodies(made, index_base)
        name_joints(made)
        return axes


def state_at(solution_or_state: Solution | State, t: float | None) -> State:
    """A state as it is, or that of a solution at a time, at its first by default."""
    if not isinstance(solution_or_state, Solution):
        return solution_or_state
    for state in (solution_or_state.initial, solution_or_state.final):
        if t is None or t == float(state.t):
            return state
    found: State = solution_or_state(t)  # type: ignore[arg-type, assignment]
    return found


def name_joints(made: Picture) -> None:
    """Write the names of the joints beside their pins."""
    names = [style.short(joint["name"]) for joint in made.scene["joints"]]
    made.write(names, made.pins(), fontweight="bold")


def _number_bodies(made: Picture, index_base: int) -> None:
    """A number in a circle on each body and its name beside it; both beside it if it is small."""
    names, anchors = [], []
    for body in made.scene["bodies"]:
        if not body["number"]:
            continue
        number = body["number"] - 1 + index_base
        name, place = style.short(body["name"]), _free_place(made, body)
        if place is None:
            name, place = f"{number} {name}", made.at(body["number"], body["center"])
        else:
            _circle(made, place, str(number), style.colour(body["number"]))
        names.append(name)
        anchors.append(place)
    made.write(names, anchors, fontsize=8.0)


def _free_place(made: Picture, body: dict[str, object]) -> Floats | None:
    """The mass centre or the middle of the outline, if no pin and no other number is there."""
    corners = made.corners(body)
    centre = made.at(body["number"], body["center"])  # type: ignore[arg-type]
    for place in (centre, corners[: max(2, len(corners) - 1)].mean(axis=0)):
        dots = made.points(place)
        low, high = dots - _NUMBER, dots + _NUMBER
        if not any(np.all((box[2:] > low) & (box[:2] < high)) for box in made.boxes):
            return place
    return None


def _circle(made: Picture, place: Floats, text: str, edge: str) -> None:
    made.axes.plot(
        *place,
        "o",
        markersize=2.0 * _NUMBER - 2.0,
        markerfacecolor="white",
        markeredgecolor=edge,
        zorder=7,
    )
    made.axes.annotate(
        text, (place[0], place[1]), ha="center", va="center_baseline", fontsize=8.0, zorder=7.5
    )
    made.keep_clear(place, _NUMBER)
