"""The mechanism at the limits of its motion, with the paths of its points."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.plot import style
from kempe.plot.page import Page
from kempe.plot.picture import at_rest, drawn, frame, paint

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kempe.analyses.limits import LimitsResult
    from kempe.results.motion import Motion
    from kempe.results.state import State

#: Margins around the axes, space between them, and the largest height of a panel, mm.
_LEFT, _RIGHT, _ABOVE, _BELOW, _BETWEEN = 19.0, 3.0, 7.0, 11.0, 19.0
_HIGHEST = 110.0
#: Colour of the paths of points.
_PATH = "#6B7A8F"


def pages(result: LimitsResult, _: int = 1) -> list[Page]:
    """The figure of limits of motion."""
    return [Page(0, "limits", "limits", lambda: limits(result), key=True)]


def limits(result: LimitsResult) -> Figure:
    """Draw the mechanism at both limits, or at the start if there are no limits."""
    states = _states(result)
    paths = _paths(result.path)
    bounds = _bounds([at_rest(state)["bounds"] for _, state in states], paths)
    low, high = frame({"bounds": bounds})
    count = len(states)
    wide = (style.WIDTH - _LEFT - _RIGHT - (count - 1) * _BETWEEN) / count
    wide = min(wide, _HIGHEST * float((high - low)[0] / (high - low)[1]))
    tall = wide * float((high - low)[1] / (high - low)[0])
    height = tall + _ABOVE + _BELOW
    made = style.figure(height, layout=None)
    for k, (title, state) in enumerate(states):
        left = _LEFT + k * (wide + _BETWEEN)
        axes = style.axes_at(made, (left, _BELOW, wide, tall), height)
        shown = {**at_rest(state), "bounds": bounds}
        display = drawn(axes, shown, title)
        metres = shown["length"]["metres"]
        for x, y in paths:
            axes.plot(x / metres, y / metres, color=_PATH, linewidth=0.8, zorder=0.5)
        display.name_joints()
        paint(axes, display)
    return made


def _states(result: LimitsResult) -> list[tuple[str, State]]:
    """The positions that are drawn, with their titles."""
    name = style.short(result.over)
    ends = ((result.lower, result.at_lower()), (result.upper, result.at_upper()))
    found = [
        (f"{name} = {result.shown(value)}", state) for value, state in ends if state is not None
    ]
    if found:
        return found
    return [(f"{name} turns fully" if result.turns_fully else f"{name}: no limit", result.final)]


def _paths(path: Motion) -> list[tuple[Floats, Floats]]:
    """The paths of all named points that move, m."""
    found = []
    for name, body in path.compiled.bodies.items():
        for point in body.points:
            x, y = (np.asarray(path[f"{name}.{point}.{axis}"]) for axis in "xy")
            if len(x) > 1 and np.ptp(x) + np.ptp(y) > 0.0:
                found.append((x, y))
    return found


def _bounds(of_states: list[list[float]], paths: list[tuple[Floats, Floats]]) -> list[float]:
    """Least x and y, largest x and y of everything, m."""
    boxes = [*of_states, *([x.min(), y.min(), x.max(), y.max()] for x, y in paths)]
    low, high = np.min(boxes, axis=0)[:2], np.max(boxes, axis=0)[2:]
    return [float(value) for value in (*low, *high)]
