"""The items of a display list: lines, fills and texts that follow the bodies.

An item is plain data. Its ``frame`` names the body that it follows. Each of its ``points`` is a row
``[x, y, px, py]``: lengths of the mechanism, and lengths of print, which do not depend on the
scale. There are four frames:

* ``body``: origin at the point ``at`` of ``body``, turned by the angle of the body ``turns_with``
  and by ``turn``. x and y are in m, px and py in points of print.
* ``line``: from a point of one body to a point of another. x is the share of the distance, y is in
  m to the left of the line, px is along the line and py to its left. On distances below ``room``
  px shrinks in proportion.
* ``ray``: from a point of one body towards a point of another. x is in m from the first point;
  otherwise as for ``line``.
* ``twist``: around the point ``at`` of body j. x is the share of the angle from body i to body j
  plus ``turn``, px is the radius.

A text has one row. It is centred at this point, moved by ``offset``, which does not turn.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from kempe.base.arrays import Floats

Item: TypeAlias = dict[str, Any]
Frame: TypeAlias = dict[str, Any]
Rows: TypeAlias = list[list[float]]
At: TypeAlias = Sequence[float]

#: Layers: an item of a higher layer is painted later.
GROUND, BODY, SYMBOL, PIN, NUMBER, NAME = range(6)

ORIGIN = (0.0, 0.0)


def on_body(
    body: int, at: At = ORIGIN, *, turns_with: int | None = None, turn: float = 0.0
) -> Frame:
    """A frame at a point of a body; it turns with this body unless another body is named."""
    turning = body if turns_with is None else turns_with
    return {"type": "body", "body": body, "at": [*at], "turns_with": turning, "turn": turn}


def upright(body: int, at: At = ORIGIN) -> Frame:
    """A frame at a point of a body that does not turn."""
    return on_body(body, at, turns_with=0)


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
