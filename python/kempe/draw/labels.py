"""Places of names that cover nothing else, at rest and while the mechanism moves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from kempe.arrays import Floats

_ANGLES = np.deg2rad(np.arange(16) * 22.5 + 22.5)
_UNITS = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])
_GAPS = (3.0, 7.0, 12.0, 18.0, 26.0, 36.0, 48.0)
#: The same while the anchors move; a name must not be far from its anchor.
_GAPS_IN_MOTION = 4
#: Room to keep between a name and everything else.
CLEARANCE = 2.0
#: Names side by side need so much more room not to be read as one.
_BESIDE = 4.0
#: To touch a line costs this much more than to be farther away by the same length; to touch a text
#: still more.
_TOUCH, _COVER = 10.0, 60.0
#: A name that is nearer to another anchor costs so much more.
_MISLEADING = 40.0
#: Shorter contacts are rounding errors, points.
_CONTACT = 1e-3
#: Of places whose costs differ by less, the first is taken, so that rounding errors decide nothing.
_EQUAL = 0.05


@lru_cache(maxsize=1024)
def measured(words: str, size: float, bold: bool, slanted: bool) -> tuple[float, float]:
    """Width and height of a text, points."""
    import warnings

    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    font = FontProperties(
        family="DejaVu Sans",
        size=size,
        weight="bold" if bold else "normal",
        style="italic" if slanted else "normal",
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # characters that the font does not have
        width, _, _ = text_to_path.get_text_width_height_descent(words, font, ismath=False)
    return float(width), 1.25 * size


@dataclass(frozen=True)
class Taken:
    """Areas that names must not cover, at some instants of a motion; points of print.

    Attributes:
        segments: lines, (n_t, m, 2, 2).
        reach: their half widths, (m,).
        boxes: other texts, (n_t, k, 4): least x and y, largest x and y.
        inside: [[least x, least y], [largest x, largest y]] that names had better not leave.
    """

    segments: Floats
    reach: Floats
    boxes: Floats
    inside: Floats


def place_labels(anchors: Floats, sizes: Floats, taken: Taken) -> Floats:
    """Offsets from moving anchors to the centres of their names, clear of lines and of each other.

    Greedy: the names are placed one by one, the longest first, each at the candidate that touches
    least on average and is nearest.

    Args:
        anchors: (n_t, n, 2), points of print.
        sizes: widths and heights, (n, 2).
        taken: the other areas.

    Returns:
        The offsets, (n, 2).
    """
    chosen = np.zeros((len(sizes), 2))
    for k in np.argsort(-sizes[:, 0], kind="stable"):
        size = sizes[k]
        gaps = _GAPS if len(anchors) == 1 else _GAPS[:_GAPS_IN_MOTION]
        offsets = _candidates(size, gaps)
        costs = np.repeat(gaps, len(_UNITS))
        for t, anchor in enumerate(anchors[:, k]):
            costs = costs + _cost(anchor + offsets, size, taken, t) / len(anchors)
            costs = costs + _MISLEADING * _nearer(anchors[t], k, offsets) / len(anchors)
        chosen[k] = offsets[int(np.argmax(costs <= costs.min() + _EQUAL))]
        low = anchors[:, k] + chosen[k] - size / 2.0
        box = np.column_stack([low, low + size])
        taken = replace(taken, boxes=np.concatenate([taken.boxes, box[:, None]], axis=1))
    return chosen


def _nearer(anchors: Floats, k: int, offsets: Floats) -> NDArray[np.bool_]:
    """Whether a name of the k-th anchor with these offsets is nearer to another anchor."""
    apart = anchors[k] + offsets[:, None] - np.delete(anchors, k, axis=0)
    own = np.hypot(*offsets.T)
    far = np.hypot(*np.moveaxis(apart, 2, 0)).min(axis=1, initial=np.inf)
    found: NDArray[np.bool_] = far < own - _CONTACT
    return found


def _candidates(size: Floats, gaps: Sequence[float]) -> Floats:
    """Offsets such that the box of a name is one of the gaps away from its anchor."""
    with np.errstate(divide="ignore"):
        edge = np.min(np.abs(size / 2.0 / _UNITS), axis=1)  # from the centre to the edge of the box
    edge = np.minimum(edge, float(np.hypot(*size)) / 2.0)
    found: Floats = np.concatenate([(edge + gap)[:, None] * _UNITS for gap in gaps])
    return found


def _cost(centres: Floats, size: Floats, taken: Taken, t: int) -> Floats:
    """Overlap of the box of a name at each of its candidates at the t-th instant, points."""
    segments, boxes = taken.segments[t], taken.boxes[t]
    half = size / 2.0 + CLEARANCE
    low, high = centres - half, centres + half
    first, last = low.min(axis=0), high.max(axis=0)
    wide = taken.reach[:, None]
    near = np.all(segments.min(axis=1) - wide < last, axis=1)
    near &= np.all(segments.max(axis=1) + wide > first, axis=1)
    grown = taken.reach[near][:, None]
    touched = clipped_lengths(low[:, None] - grown, high[:, None] + grown, segments[near])
    cost = _TOUCH * np.sum(touched + 2.0 * (touched > _CONTACT), axis=1)
    apart = np.array([_BESIDE, 0.0])
    sides = np.minimum(high[:, None] + apart, boxes[:, 2:])
    sides = sides - np.maximum(low[:, None] - apart, boxes[:, :2])
    cost = cost + _COVER * np.sum(sides.sum(axis=2) * (sides > _CONTACT).all(axis=2), axis=1)
    outside = np.maximum(taken.inside[0] - low, 0.0) + np.maximum(high - taken.inside[1], 0.0)
    found: Floats = cost + _TOUCH * outside.sum(axis=1)
    return found


def clipped_lengths(low: Floats, high: Floats, segments: Floats) -> Floats:
    """Length of each segment (m, 2, 2) inside of a box or of many (Liang & Barsky 1984)."""
    begin, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (low - begin) / along, (high - begin) / along
    still = along == 0.0  # parallel to an edge: inside for the whole length, or never
    within = (begin >= low) & (begin <= high)
    enter = np.where(still, np.where(within, -np.inf, np.inf), np.minimum(one, other))
    leave = np.where(still, np.where(within, np.inf, -np.inf), np.maximum(one, other))
    share = np.minimum(leave.min(axis=-1), 1.0) - np.maximum(enter.max(axis=-1), 0.0)
    found: Floats = np.clip(share, 0.0, 1.0) * np.hypot(along[:, 0], along[:, 1])
    return found
