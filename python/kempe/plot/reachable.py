"""The region that a point reaches, with the mechanism at the start."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.draw.units import number
from kempe.plot import style
from kempe.plot.page import Page
from kempe.plot.picture import at_rest, drawn, frame, paint

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kempe.analyses.reachable import ReachableResult

#: Margins around the axes, and the largest height of the axes, mm.
_LEFT, _RIGHT, _ABOVE, _BELOW = 19.0, 3.0, 7.0, 11.0
_HIGHEST = 130.0
#: Colours of the region and of its boundary.
_INSIDE, _EDGE = "#DCE6F2", "#4A6FA5"


def pages(result: ReachableResult, _: int = 1) -> list[Page]:
    """The figure of a region."""
    return [Page(0, "reachable", "reachable", lambda: reachable(result), key=True)]


def reachable(result: ReachableResult) -> Figure:
    """Draw the region, and the mechanism at the start."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    scene = at_rest(result.final)
    low, high = np.array(scene["bounds"][:2]), np.array(scene["bounds"][2:])
    low = np.minimum(low, result.points.min(axis=0))
    high = np.maximum(high, result.points.max(axis=0))
    shown = {**scene, "bounds": [*map(float, low), *map(float, high)]}
    low, high = frame({"bounds": shown["bounds"]})
    wide = style.WIDTH - _LEFT - _RIGHT
    wide = min(wide, _HIGHEST * float((high - low)[0] / (high - low)[1]))
    height = wide * float((high - low)[1] / (high - low)[0]) + _ABOVE + _BELOW
    made = style.figure(height, layout=None)
    axes = style.axes_at(made, (_LEFT, _BELOW, wide, height - _ABOVE - _BELOW), height)
    display = drawn(axes, shown, f"{result.of} reaches {number(result.area)} m²")
    metres = shown["length"]["metres"]
    corners = [np.concatenate([one, one[:1]]) / metres for one in result.boundary]
    if corners:
        outline = Path.make_compound_path(*(Path(one, closed=True) for one in corners))
        axes.add_patch(PathPatch(outline, facecolor=_INSIDE, edgecolor=_EDGE, lw=0.8, zorder=0.4))
    display.name_joints()
    paint(axes, display)
    return made
