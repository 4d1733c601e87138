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
    dots = np.array(points).reshape(-1, 1, 2)
    lines = np.concatenate([segments, np.concatenate([dots, dots], axis=1)])
    room = np.minimum(distances(anchor + 1.2 * units, lines).min(axis=1, initial=2.0), 2.0)
    best: Floats = units[int(room.argmax())]
    return best


def distances(places: Floats, segments: Floats) -> Floats:
    """Distances of points (n, 2) from line segments (m, 2, 2), (n, m)."""
    begin, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    away = places[:, None] - begin
    square = np.einsum("mk,mk->m", along, along)
    share = np.einsum("nmk,mk->nm", away, along) / np.where(square > 0.0, square, 1.0)
    gap = away - np.clip(share, 0.0, 1.0)[..., None] * along
    found: Floats = np.hypot(gap[..., 0], gap[..., 1])
    return found
