"""Where to write names so that they lie on nothing else."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from kempe.arrays import Floats

_ANGLES = np.deg2rad(np.arange(16) * 22.5 + 22.5)
_GAPS = (3.0, 7.0, 12.0, 18.0, 26.0, 36.0, 48.0)
#: Room to keep between a name and everything else.
CLEARANCE = 2.0
#: What is touched costs this much more than to stand farther away by the same length.
_TOUCH = 10.0


def place_labels(
    anchors: Floats,
    sizes: Floats,
    segments: Floats,
    boxes: Sequence[Floats],
    inside: Floats,
) -> Floats:
    """Centres of names near their anchors, clear of lines and of each other.

    All lengths in points of print. Greedy: the names are placed in order, each at the candidate
    that touches least and is nearest.

    Args:
        anchors: (n, 2).
        sizes: widths and heights, (n, 2).
        segments: lines of the drawing, (m, 2, 2).
        boxes: more places that are taken, each [least x, least y, largest x, largest y].
        inside: [[least x, least y], [largest x, largest y]] that names had better not leave.

    Returns:
        The centres, (n, 2).
    """
    taken = list(boxes)
    chosen = []
    for anchor, size in zip(anchors, sizes, strict=True):
        candidates = _candidates(anchor, size)
        costs = [_cost(centre, size, segments, taken, inside) for centre in candidates]
        costs += np.hypot(*(candidates - anchor).T)
        best = candidates[int(np.argmin(costs))]
        chosen.append(best)
        taken.append(np.concatenate([best - size / 2.0, best + size / 2.0]))
    return np.array(chosen).reshape(-1, 2)


def _candidates(anchor: Floats, size: Floats) -> Floats:
    """Centres such that the box of the name is one of the gaps away from its anchor."""
    units = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])
    with np.errstate(divide="ignore"):
        reach = np.min(np.abs(size / 2.0 / units), axis=1)  # from the centre to the edge of the box
    reach = np.minimum(reach, float(np.hypot(*size)) / 2.0)
    found: Floats = np.concatenate([anchor + (reach + gap)[:, None] * units for gap in _GAPS])
    return found


def _cost(
    centre: Floats, size: Floats, segments: Floats, taken: Sequence[Floats], inside: Floats
) -> float:
    """What the box of a name touches, in points."""
    half = size / 2.0 + CLEARANCE
    touched = clipped_lengths(centre - half, centre + half, segments)
    cost = _TOUCH * float(np.sum(touched + 2.0 * (touched > 0.0)))
    for box in taken:
        width, height = np.minimum(centre + half, box[2:]) - np.maximum(centre - half, box[:2])
        if width > 0.0 and height > 0.0:
            cost += _TOUCH * float(width + height)
    outside = np.maximum([inside[0] - (centre - half), (centre + half) - inside[1]], 0.0)
    return cost + _TOUCH * float(outside.sum())


def clipped_lengths(low: Floats, high: Floats, segments: Floats) -> Floats:
    """Length of each segment (m, 2, 2) inside of a box, (m,) (Liang & Barsky 1984)."""
    begin, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (low - begin) / along, (high - begin) / along
    still = along == 0.0  # parallel to an edge: inside for the whole length, or never
    within = (begin >= low) & (begin <= high)
    enter = np.where(still, np.where(within, -np.inf, np.inf), np.minimum(one, other))
    leave = np.where(still, np.where(within, np.inf, -np.inf), np.maximum(one, other))
    share = np.minimum(leave.min(axis=1), 1.0) - np.maximum(enter.max(axis=1), 0.0)
    found: Floats = np.clip(share, 0.0, 1.0) * np.hypot(along[:, 0], along[:, 1])
    return found
