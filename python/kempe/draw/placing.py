"""Places of the items of a display list at one instant; only here metres become points.

``studio/src/draw/place.ts`` has the same rules for pages, ``drawing/src/display/placing.rs`` for
names.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.geometry import placed
from kempe.draw.items import Frame, Item
from kempe.model import drawing

#: Of the hatching of ground: distance and length of its strokes, and their width, points.
_SPACING, _STROKE, HATCH_WIDTH = 4.0, 5.0, 0.7


@dataclass(frozen=True)
class View:
    """The visible part of the plane.

    Attributes:
        low: least x and y, m.
        scale: points of print for each metre.
        size: width and height, points.
    """

    low: Floats
    scale: float
    size: Floats

    def points(self, places: Floats) -> Floats:
        """Places in the plane in points of print, from the lower left corner."""
        found: Floats = (places - self.low) * self.scale
        return found

    def plain(self) -> tuple[tuple[float, float], float, tuple[float, float]]:
        """The view as plain numbers: lower left corner, scale, width and height."""
        (left, bottom), (width, height) = map(float, self.low), map(float, self.size)
        return (left, bottom), float(self.scale), (width, height)

    def plane(self, points: Floats) -> Floats:
        """The place in the plane, m, of points of print."""
        found: Floats = points / self.scale + self.low
        return found


def view_around(bounds: Sequence[float], size: tuple[float, float]) -> View:
    """The view of bounds, m, with room around them, of a width and height in points of print."""
    low, scale, found = drawing.view_around(bounds, size)
    return View(np.array(low), scale, np.array(found))


def place(item: Item, poses: Floats, view: View) -> Floats:
    """The points of an item, (n, 2), points of print.

    Args:
        item: of a display list.
        poses: x, y and angle of each body, ground first, (n_bodies, 3).
        view: the visible area.
    """
    origin, angle, local = _in_frame(
        item["frame"], np.asarray(item["points"], dtype=np.float64), poses, view
    )
    c, s = np.cos(angle), np.sin(angle)
    found: Floats = origin + local @ np.array([[c, s], [-s, c]])
    return found


def direction(item: Item, poses: Floats, view: View) -> float:
    """The angle of the x axis of an item's frame, rad."""
    return float(_in_frame(item["frame"], np.zeros((1, 4)), poses, view)[1])


def _in_frame(
    frame: Frame, rows: Floats, poses: Floats, view: View
) -> tuple[Floats, float, Floats]:
    """Origin and angle of a frame, and the rows in it, points."""
    if frame["type"] == "body":
        origin = view.points(placed(poses[frame["body"]], frame["at"]))
        angle = poses[frame["turns_with"], 2] + frame["turn"]
        return origin, angle, rows[:, :2] * view.scale + rows[:, 2:]
    i, j = frame["bodies"]
    if frame["type"] in ("line", "ray"):
        begin, end = (view.points(placed(poses[b], at)) for b, at in _ends(frame))
        along = end - begin
        length = float(np.hypot(*along))
        squeezed = min(1.0, length / frame["room"]) if frame.get("room") else 1.0
        unit = length if frame["type"] == "line" else view.scale
        x = rows[:, 0] * unit + rows[:, 2] * squeezed
        local = np.column_stack([x, rows[:, 1] * view.scale + rows[:, 3]])
        return begin, float(np.arctan2(along[1], along[0])), local
    turn = frame["turn"] + poses[j, 2] - poses[i, 2]
    polar = poses[i, 2] + rows[:, 0] * turn
    local = rows[:, 2:3] * np.column_stack([np.cos(polar), np.sin(polar)])
    return view.points(placed(poses[j], frame["at"])), 0.0, local


def _ends(frame: Frame) -> Sequence[tuple[int, Sequence[float]]]:
    return list(zip(frame["bodies"], frame["ends"], strict=True))


def hatching(points: Floats, side: int) -> Floats:
    """Short strokes on one side of a line, (k, 2, 2), points."""
    found, left = [], 0.75 * _SPACING  # to the next stroke
    for begin, end in pairwise(points):
        length = float(np.hypot(*(end - begin)))
        if length == 0.0:
            continue
        along = (end - begin) / length
        aside = side * np.array([-along[1], along[0]])
        stroke = _STROKE * (aside - along) / np.sqrt(2.0)
        while left < length:
            found.append([begin + left * along, begin + left * along + stroke])
            left += _SPACING
        left -= length
    return np.array(found).reshape(-1, 2, 2)
