"""Lengths of bars and distances of ground pins, drawn as on a technical drawing."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.arrays import Floats
from kempe.plot.labels import clipped_lengths

if TYPE_CHECKING:
    from kempe.plot.picture import Picture

#: Distance of a dimension line from what it measures, tried in turn, points.
_DISTANCES = (20.0, 32.0, 44.0)
#: More lengths than this are not read off a drawing.
_MOST = 7
_TEXT = 8.0
_LINE: dict[str, Any] = {"color": "#555555", "linewidth": 0.6, "shrinkA": 0.0, "shrinkB": 0.0}


def draw_dimensions(made: Picture) -> None:
    """A dimension line beside each bar, and between two pins on ground."""
    spans = [
        made.corners(body)
        for body in made.scene["bodies"]
        if body["number"] and len(body["outline"]) == 2
    ]
    grounded = [
        pin
        for joint, pin in zip(made.scene["joints"], made.pins(), strict=True)
        if 0 in joint["bodies"]
    ]
    if len(grounded) == 2 and np.any(grounded[0] != grounded[1]):
        spans.append(np.array(grounded))
    if len(spans) <= _MOST:
        for span in spans:
            _draw(made, span)


def _draw(made: Picture, span: Floats) -> None:
    length = float(np.hypot(*(span[1] - span[0])))
    begin, end = made.points(span)
    along = (end - begin) / np.hypot(*(end - begin))
    text = f"{length:.4g} {made.scale.unit}"
    half = np.array([0.31 * _TEXT * len(text) + 3.0, 0.6 * _TEXT + 1.0])
    offset = _best_offset(made, np.array([begin, end]), along, half)
    for place in span:
        made.axes.annotate(
            "",
            place,
            tuple(offset * 1.15),
            textcoords="offset points",
            zorder=1,
            arrowprops={"arrowstyle": "-", **_LINE},
        )
    _draw_arrow(made, span, offset)
    turned = float(np.degrees(np.arctan2(along[1], along[0])))
    made.axes.annotate(
        text,
        tuple(span.mean(axis=0)),
        tuple(offset),
        textcoords="offset points",
        ha="center",
        va="center",
        rotation=(turned + 90.0) % 180.0 - 90.0,
        rotation_mode="anchor",
        fontsize=_TEXT,
        zorder=3,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
    )
    made.lines.append(np.array([[begin + offset, end + offset]]))
    made.lines += [np.array([[place, place + offset * 1.15]]) for place in (begin, end)]
    centre = (begin + end) / 2.0 + offset
    cover = np.abs(along) * half[0] + np.abs(along[::-1]) * half[1]
    made.boxes.append(np.concatenate([centre - cover, centre + cover]))


def _draw_arrow(made: Picture, span: Floats, offset: Floats) -> None:
    from matplotlib.patches import FancyArrowPatch
    from matplotlib.transforms import ScaledTranslation

    aside = ScaledTranslation(offset[0] / 72.0, offset[1] / 72.0, made.axes.figure.dpi_scale_trans)
    arrow = FancyArrowPatch(
        tuple(span[0]),
        tuple(span[1]),
        arrowstyle="<|-|>",
        mutation_scale=7.0,
        transform=made.axes.transData + aside,
        clip_on=False,
        zorder=1,
        **_LINE,
    )
    made.axes.add_patch(arrow)


def _best_offset(made: Picture, dots: Floats, along: Floats, half: Floats) -> Floats:
    """To the side and at the distance where the line meets least; else away from the middle."""
    normal = np.array([-along[1], along[0]])
    low, high = (np.array(made.axes.get_window_extent().get_points()) * 72.0) / float(
        made.axes.figure.dpi
    )
    middle = (low + high) / 2.0
    if np.dot(normal, dots.mean(axis=0) - middle) < 0.0:
        normal = -normal
    offsets = [side * away * normal for away in _DISTANCES for side in (1.0, -1.0)]
    costs = [_touched(made, dots + offset, half) for offset in offsets]
    return offsets[int(np.argmin(costs))]


def _touched(made: Picture, dots: Floats, half: Floats) -> float:
    """What lies on a dimension line: lengths of lines and number of boxes, at places along it."""
    lines = np.concatenate([np.empty((0, 2, 2)), *made.lines])
    cost = 0.0
    for share in np.linspace(0.05, 0.95, 13):
        centre = dots[0] + share * (dots[1] - dots[0])
        reach = np.full(2, half[0] if 0.35 < share < 0.65 else 3.0)
        cost += float(clipped_lengths(centre - reach, centre + reach, lines).sum() > 0.0)
        cost += sum(
            bool(np.all((box[2:] > centre - reach) & (box[:2] < centre + reach)))
            for box in made.boxes
        )
    return cost
