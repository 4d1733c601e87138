"""The linkage as one draws it: bodies as lines, joints as circles, ground pins as triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.arrays import Floats
from kempe.plot import style
from kempe.plot.labels import label_directions

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.compiled import ConstraintInfo
    from kempe.solution import Solution
    from kempe.state import State

#: Distance of a name from its joint, as a share of the width of the drawing.
_NAME_DISTANCE = 0.035
_MARGIN = 0.12
_MOST_IN_LEGEND = 12


def linkage(solution: Solution, ax: Axes | None = None) -> Axes:
    """Draw the linkage at the start (grey) and at the end (solid).

    Args:
        solution: what is drawn.
        ax: where to; a figure of its own when None.

    Returns:
        The axes.
    """
    axes = style.new_axes() if ax is None else ax
    first, last = solution.initial, solution.final
    _draw_bodies(axes, first, earlier=True)
    _draw_bodies(axes, last, earlier=False)
    _draw_joints(axes, first, style.EARLIER)
    _draw_joints(axes, last, "black")
    scale = _frame(axes, [first, last])
    _draw_ground(axes, last, scale)
    _draw_names(axes, first, last, scale)
    axes.set_title(style.verbatim(solution.model.title))
    _draw_legend(axes, first, last)
    axes.set_xlabel("x / m")
    axes.set_ylabel("y / m")
    return axes


def outline(state: State, name: str) -> Floats:
    """The corners of a body, closed where there are more than two, (n, 2), m."""
    view = state.body(name)
    corners = [view.point(point).position for point in view.info.points]
    if len(corners) < 2:
        corners.append(view.at(view.info.center).position)
    if len(corners) > 2:
        corners.append(corners[0])
    return np.array(corners)


def joint_point(state: State, info: ConstraintInfo) -> Floats:
    """Where a joint is: its point on body j, (2,), m."""
    return state.body(info.j).at(info.point_j).position


def _draw_bodies(axes: Axes, state: State, *, earlier: bool) -> None:
    for name, info in state.model.bodies.items():
        corners = outline(state, name)
        axes.plot(
            corners[:, 0],
            corners[:, 1],
            color=style.EARLIER if earlier else style.colour(info.number),
            linewidth=2.0 if earlier else 3.0,
            solid_capstyle="round",
            zorder=1 if earlier else 2,
        )


def _draw_joints(axes: Axes, state: State, edge: str) -> None:
    places = _joint_places(state)
    circles = axes.plot(places[:, 0], places[:, 1], "o", markeredgecolor=edge, zorder=4)
    circles[0].set_markerfacecolor("white")


def _draw_ground(axes: Axes, state: State, scale: float) -> None:
    """A triangle under each joint to ground."""
    joints = state.model.joints.values()
    pins = [joint_point(state, info) for info in joints if "ground" in (info.i, info.j)]
    for x, y in pins:
        half, height = 0.018 * scale, 0.032 * scale
        triangle = [[x, x - half, x + half], [y, y - height, y - height]]
        axes.fill(*triangle, facecolor="white", edgecolor=style.GROUND, zorder=3)
        axes.plot([x - 2 * half, x + 2 * half], [y - height] * 2, color=style.GROUND, zorder=3)


def _draw_names(axes: Axes, first: State, state: State, scale: float) -> None:
    names = list(state.model.joints)
    anchors = _joint_places(state)
    step = _NAME_DISTANCE * scale
    lines = [outline(drawn, name) for drawn in (first, state) for name in state.model.bodies]
    pins = [  # a name must not lie on the triangle under its joint
        np.array([place, place - [0.0, step]])
        for place, info in zip(anchors, state.model.joints.values(), strict=True)
        if "ground" in (info.i, info.j)
    ]
    pieces = [line[k : k + 2] for line in [*lines, *pins] for k in range(len(line) - 1)]
    directions = label_directions(anchors / step, np.array(pieces).reshape(-1, 2, 2) / step)
    for name, anchor, direction in zip(names, anchors, directions, strict=True):
        x, y = anchor + step * direction
        text = style.verbatim(name)
        axes.text(x, y, text, ha="center", va="center", fontsize=11, zorder=5, clip_on=False)


def _draw_legend(axes: Axes, first: State, last: State) -> None:
    """Which time is grey and which is not, and the bodies by number, if they are few."""
    from matplotlib.lines import Line2D

    times = [(style.EARLIER, 2.0, first.t), ("black", 3.0, last.t)]
    marks = [Line2D([], [], color=c, linewidth=w, label=f"t = {float(t):g} s") for c, w, t in times]
    if len(last.model.bodies) <= _MOST_IN_LEGEND:
        for name, info in last.model.bodies.items():
            label = style.verbatim(f"{info.number} {name}")
            marks.append(
                Line2D([], [], color=style.colour(info.number), linewidth=3.0, label=label)
            )
    axes.legend(handles=marks, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)


def _joint_places(state: State) -> Floats:
    places = [joint_point(state, info) for info in state.model.joints.values()]
    return np.array(places).reshape(-1, 2)


def _frame(axes: Axes, states: list[State]) -> float:
    """Equal axes with some room around the drawing; returns the size of the drawing, m."""
    drawn = [outline(state, name) for state in states for name in state.model.bodies]
    corners = np.vstack([*drawn, *(_joint_places(state) for state in states)])
    low, high = corners.min(axis=0), corners.max(axis=0)
    scale = float(max(high - low)) or 1.0
    room = _MARGIN * scale
    axes.set_aspect("equal")
    axes.set_xlim(low[0] - room, high[0] + room)
    axes.set_ylim(low[1] - room, high[1] + room)
    axes.grid(visible=True, color="#EEEEEE")
    axes.set_axisbelow(True)
    return scale
