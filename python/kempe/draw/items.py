"""The items of a display list: lines, fills and texts that follow the bodies.

An item is plain data. Its ``frame`` says what it follows; each of its ``points`` is a row
``[x, y, px, py]``: lengths of the mechanism and lengths of print, which stay the same whatever the
scale. There are four frames:

* ``body``: origin at the point ``at`` of ``body``, turned by the angle of the body ``turns_with``
  and by ``turn``. x and y are in m, px and py in points of print.
* ``line``: from a point of one body to a point of another. x is the share of the distance, y is in
  m to the left of the line, px is along the line and py to its left. On distances below ``room``
  px shrinks in proportion.
* ``ray``: from a point of one body towards a point of another. x is in m from the first point,
  otherwise as ``line``.
* ``twist``: around the point ``at`` of body j. x is the share of the angle from body i to body j
  plus ``turn``, px is the radius.

A text is centred at its one row, moved by ``offset``, which does not turn.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from kempe.arrays import Floats

Item: TypeAlias = dict[str, Any]
Frame: TypeAlias = dict[str, Any]
Rows: TypeAlias = list[list[float]]
At: TypeAlias = Sequence[float]

#: Layers: an item of a higher layer is painted later.
GROUND, BODY, SYMBOL, PIN, NUMBER, NAME = range(6)

ORIGIN = (0.0, 0.0)

#: Of each kind of text: size in points, weight, whether slanted, colour.
LOOKS = {
    "joint": (9.0, "bold", False, "ink"),
    "point": (9.0, "normal", False, "ink"),
    "element": (8.0, "normal", True, "force"),
    "driver": (8.0, "normal", True, "drive"),
    "body": (8.0, "normal", False, "ink"),
    "number": (8.0, "normal", False, "ink"),
    "measure": (8.0, "normal", False, "quiet"),
}


def on_body(
    body: int, at: At = ORIGIN, *, turns_with: int | None = None, turn: float = 0.0
) -> Frame:
    """A frame at a point of a body; it turns with the body if no other is named."""
    turning = body if turns_with is None else turns_with
    return {"type": "body", "body": body, "at": [*at], "turns_with": turning, "turn": turn}


def upright(body: int, at: At = ORIGIN) -> Frame:
    """A frame at a point of a body that does not turn."""
    return on_body(body, at, turns_with=0)


def between(bodies: Sequence[int], ends: Sequence[At], room: float = 0.0) -> Frame:
    """A frame along the line between a point of one body and a point of another."""
    return {"type": "line", "bodies": [*bodies], "ends": [[*end] for end in ends], "room": room}


def towards(bodies: Sequence[int], ends: Sequence[At]) -> Frame:
    """A frame from a point of one body in the direction of a point of another."""
    return {"type": "ray", "bodies": [*bodies], "ends": [[*end] for end in ends]}


def twisted(bodies: Sequence[int], at: At, turn: float) -> Frame:
    """A polar frame around a point of body j that winds as j turns against i."""
    return {"type": "twist", "bodies": [*bodies], "at": [*at], "turn": turn}


def metres(points: Floats | Sequence[At]) -> Rows:
    """Rows of points in lengths of the mechanism."""
    return [[float(x), float(y), 0.0, 0.0] for x, y in points]


def print_points(points: Floats | Sequence[At]) -> Rows:
    """Rows of points in lengths of print."""
    return [[0.0, 0.0, float(x), float(y)] for x, y in points]


def line(
    of: str,
    frame: Frame,
    points: Rows,
    colour: str,
    width: float = 1.0,
    *,
    layer: int = SYMBOL,
    tint: float = 0.0,
    closed: bool = False,
    hatch: int = 0,
) -> Item:
    """A line of a width in points of print; ``hatch`` is the side with strokes of ground: ±1."""
    return {
        "kind": "line",
        "of": of,
        "layer": layer,
        "frame": frame,
        "points": points,
        "colour": colour,
        "tint": tint,
        "width": width,
        "closed": closed,
        "hatch": hatch,
    }


def fill(
    of: str,
    frame: Frame,
    points: Rows,
    colour: str,
    *,
    layer: int = SYMBOL,
    tint: float = 0.0,
) -> Item:
    """An area."""
    return {
        "kind": "fill",
        "of": of,
        "layer": layer,
        "frame": frame,
        "points": points,
        "colour": colour,
        "tint": tint,
    }


def text(
    of: str, frame: Frame, point: Sequence[float], words: str, role: str, *, turned: bool = False
) -> Item:
    """A text centred at a row; ``turned`` along the x axis of its frame, never upside down.

    Args:
        of: the body or element that it names.
        frame: the frame that it follows.
        point: its row.
        words: the text.
        role: a key of ``LOOKS``.
        turned: whether it turns with the frame.
    """
    size, weight, slanted, colour = LOOKS[role]
    return {
        "kind": "text",
        "of": of,
        "layer": NUMBER if role == "number" else NAME,
        "frame": frame,
        "points": [[*point]],
        "text": words,
        "role": role,
        "size": size,
        "weight": weight,
        "slanted": slanted,
        "colour": colour,
        "tint": 0.0,
        "turned": turned,
        "offset": [0.0, 0.0],
    }


def circle(radius: float, count: int = 32) -> Floats:
    """Corners of a circle around the origin, (n, 2)."""
    return arc(radius, 0.0, 2.0 * np.pi * (1.0 - 1.0 / count), count)


def arc(radius: float, begin: float, end: float, count: int = 24) -> Floats:
    """Points of an arc around the origin, (n, 2)."""
    angle = np.linspace(begin, end, count)
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def arrow_head(tip: At, direction: float, size: float = 7.0) -> Floats:
    """Corners of an arrow's head, (3, 2)."""
    along = np.array([np.cos(direction), np.sin(direction)])
    aside = np.array([-along[1], along[0]])
    end = np.asarray(tip, dtype=np.float64)
    back = end - size * along
    return np.array([end, back + 0.36 * size * aside, back - 0.36 * size * aside])
