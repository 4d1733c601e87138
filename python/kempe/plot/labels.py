"""Where to write a name so that it lies on nothing else."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from kempe.arrays import Floats

_DIRECTIONS = np.deg2rad(np.arange(16) * 22.5 + 22.5)


def label_directions(anchors: Floats, segments: Floats) -> Floats:
    """For each point the direction in which its name is farthest from lines and other names.

    Args:
        anchors: the points, (n, 2), in units in which a name is about 1 away from its point.
        segments: the lines of the drawing, (m, 2, 2).

    Returns:
        Unit vectors, (n, 2).
    """
    chosen: list[Floats] = []
    for k, anchor in enumerate(anchors):
        others = np.delete(anchors, k, axis=0)
        taken = [anchors[i] + 1.2 * direction for i, direction in enumerate(chosen)]
        chosen.append(_best(anchor, [*others, *taken], segments))
    return np.array(chosen).reshape(-1, 2)


def _best(anchor: Floats, points: Sequence[Floats], segments: Floats) -> Floats:
    """The direction with the most room, up to twice the distance of the name."""
    units = np.column_stack([np.cos(_DIRECTIONS), np.sin(_DIRECTIONS)])
    room = np.full(len(units), 2.0)
    for k, place in enumerate(anchor + 1.2 * units):
        for point in points:
            room[k] = min(room[k], float(np.hypot(*(place - point))))
        for begin, end in segments:
            room[k] = min(room[k], distance(place, begin, end))
    best: Floats = units[int(room.argmax())]
    return best


def distance(place: Floats, begin: Floats, end: Floats) -> float:
    """Distance of a point from a line segment."""
    along = end - begin
    square = float(along @ along)
    share = 0.0 if square == 0.0 else float(np.clip((place - begin) @ along / square, 0.0, 1.0))
    return float(np.hypot(*(place - begin - share * along)))
