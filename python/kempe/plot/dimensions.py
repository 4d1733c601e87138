"""Lengths of bars and distances of ground pins, drawn as on a technical drawing; gravity."""

from __future__ import annotations

from typing import Any

import numpy as np

from kempe.arrays import Floats
from kempe.draw.display import Display
from kempe.draw.geometry import placed
from kempe.draw.items import GROUND, arrow_head, between, fill, line, print_points, text, upright
from kempe.draw.labels import Taken, clipped_lengths, measured

#: Distances of a dimension line from its object, tried in turn, points.
_DISTANCES = (20.0, 32.0, 44.0)
#: More lengths than this are not read off a drawing.
_MOST = 7
_HEAD = 6.0
_GRAVITY = 30.0  # length of the arrow of gravity, points

#: Two bodies and a point of each.
_Span = tuple[tuple[int, int], list[Any]]


def add_dimensions(made: Display) -> None:
    """A dimension line beside each bar, and between two pins on ground."""
    scene = made.scene
    spans: list[_Span] = [
        ((body["number"], body["number"]), body["outline"])
        for body in scene["bodies"]
        if body["number"] and len(body["outline"]) == 2
    ]
    grounded = [
        symbol["points"][symbol["bodies"].index(0)]
        for symbol in scene["symbols"]
        if symbol["mark"] in ("pin", "rod") and 0 in symbol["bodies"]
    ]
    if len(grounded) == 2 and grounded[0] != grounded[1]:
        spans.append(((0, 0), grounded))
    if len(spans) <= _MOST:
        for span in spans:
            _add(made, span)


def _add(made: Display, span: _Span) -> None:
    bodies, ends = span
    places = np.array([placed(made.poses[0, b], at) for b, at in zip(bodies, ends, strict=True)])
    unit = made.scene["length"]
    length = float(np.hypot(*(places[1] - places[0])))
    words = f"{length / unit['metres']:.4g} {unit['unit']}"
    dots = made.view.points(places)
    along = (dots[1] - dots[0]) / float(np.hypot(*(dots[1] - dots[0])))
    width, height = measured(words, 8.0, bold=False, slanted=False)
    half = np.abs(along) * (width / 2.0 + 2.0) + np.abs(along[::-1]) * (height / 2.0)
    aside = _best_distance(made, dots, along, half)
    frame, of = between(bodies, ends), f"length {words}"
    # Between points that are too near for it the text is beside them, the arrows point inwards.
    near = float(np.hypot(*(dots[1] - dots[0]))) < width + 2.0 * _HEAD
    out = 1.8 * _HEAD if near else 0.0
    for x, away in ((0.0, np.pi), (1.0, 0.0)):
        extension = [[x, 0.0, 0.0, 0.0], [x, 0.0, 0.0, 1.15 * aside]]
        made.add([line(of, frame, extension, "quiet", 0.6, layer=GROUND)])
        tip = arrow_head((0.0, aside), away + (np.pi if near else 0.0), _HEAD)
        made.add([fill(of, frame, [[x, 0.0, *at] for at in tip], "quiet", layer=GROUND)])
    measure = [[0.0, 0.0, -out, aside], [1.0, 0.0, out, aside]]
    made.add([line(of, frame, measure, "quiet", 0.6, layer=GROUND)])
    row = [1.0, 0.0, out + width / 2.0 + 2.0, aside] if near else [0.5, 0.0, 0.0, aside]
    made.add([text(of, frame, row, words, "measure", turned=True)])


def _best_distance(made: Display, dots: Floats, along: Floats, half: Floats) -> float:
    """To the side and at the distance where the line meets least; else away from the middle."""
    normal = np.array([-along[1], along[0]])
    outside = np.dot(normal, dots.mean(axis=0) - made.view.size / 2.0) >= 0.0
    sides = (1.0, -1.0) if outside else (-1.0, 1.0)
    aways = [side * away for away in _DISTANCES for side in sides]
    taken = made.taken()
    costs = [_touched(taken, dots + away * normal, half) for away in aways]
    return aways[int(np.argmin(costs))]


def _touched(taken: Taken, dots: Floats, half: Floats) -> float:
    """Lines and boxes of texts that cover a dimension line, at places along it."""
    boxes, reach = taken.boxes[0], taken.reach
    cost = 0.0
    for share in np.linspace(0.05, 0.95, 13):
        centre = dots[0] + share * (dots[1] - dots[0])
        room = half if 0.35 < share < 0.65 else np.full(2, 3.0)
        grown = room + reach[:, None]
        cost += float(
            clipped_lengths(centre - grown, centre + grown, taken.segments[0]).sum() > 0.0
        )
        apart = (boxes[:, 2:] <= centre - room) | (boxes[:, :2] >= centre + room)
        cost += float(np.sum(~apart.any(axis=1)))
    return cost


def add_gravity(made: Display) -> None:
    """An arrow in the corner with the most room."""
    gravity = np.array(made.scene["gravity"])
    size = float(np.hypot(*gravity))
    if not size:
        return
    along = gravity / size * _GRAVITY / 2.0
    frame = upright(0, [float(x) for x in made.view.plane(_free_corner(made))])
    shaft = print_points(np.array([-along, 0.7 * along]))
    made.add([line("gravity", frame, shaft, "ink", 1.0)])
    head = arrow_head(along.tolist(), float(np.arctan2(along[1], along[0])))
    made.add([fill("gravity", frame, print_points(head), "ink")])
    made.name("body", f"g = {size:.4g} m/s²", frame)


def _free_corner(made: Display) -> Floats:
    room = np.array([1.6 * _GRAVITY, 1.05 * _GRAVITY])
    taken = made.taken()
    best: Floats = made.view.size - room
    least = np.inf
    for share in ((1, 1), (0, 1), (1, 0), (0, 0)):
        centre = np.where(share, made.view.size - room, room)
        low, high = centre - room, centre + room
        touched = float(clipped_lengths(low, high, taken.segments[0]).sum())
        over = (taken.boxes[0, :, 2:] > low) & (taken.boxes[0, :, :2] < high)
        touched += float(np.sum(over.all(axis=1)))
        if touched < least:
            best, least = centre, touched
    return best
