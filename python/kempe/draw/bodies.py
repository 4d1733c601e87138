"""The items of a body: a link around its points, or what it has as an outline; and its curves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from kempe.arrays import Floats
from kempe.draw import items
from kempe.draw.items import Frame, Item, Rows, fill, line, metres, on_body

#: Radius of a spot, and widths of a link, of its edges, of curves, points of print.
_SPOT, _LINK, _EDGE, _CURVE = 7.0, 8.0, 1.0, 1.4
_TINT = 0.72


def body(described: dict[str, Any]) -> Iterator[Item]:
    """A moving body, or what ground has as an outline."""
    if described["drawn"]:
        yield from _drawn(described)
    elif described["number"]:
        yield from _link(described)


def corners(described: dict[str, Any]) -> Floats:
    """Corners of what is drawn of a moving body, (n, 2), m; a number is written between them."""
    drawn = [at for part in described["drawn"] for at in part["points"]]
    if drawn:
        return np.array(drawn)
    found = np.array(described["outline"])
    if described["curves"] and len(found) == 1:
        return np.array(described["curves"][0]["points"])
    return found


def rims(described: dict[str, Any]) -> Iterator[Item]:
    """The curves of a body: areas, or lines where they are open."""
    of, frame, colour = _looks(described)
    for curve in described["curves"]:
        rows, closed = metres(curve["points"]), curve["closed"]
        if closed and described["number"]:
            yield fill(of, frame, rows, colour, layer=items.GROUND, tint=_TINT)
        yield line(of, frame, rows, colour, _CURVE, layer=items.GROUND, closed=closed)


def _looks(described: dict[str, Any]) -> tuple[str, Frame, str]:
    """Name, frame and colour."""
    number = described["number"]
    return described["name"], on_body(number), f"body {number}" if number else "ground"


def _link(described: dict[str, Any]) -> Iterator[Item]:
    """A rounded bar or plate: a wide dark line and a narrower light one in it."""
    of, frame, colour = _looks(described)
    ends, look = np.array(described["outline"]), {"layer": items.BODY}
    if len(ends) == 1:
        rows = [[*end, *at] for end in ends for at in items.circle(_SPOT)]
        yield fill(of, frame, rows, colour, tint=_TINT, **look)
        yield line(of, frame, rows, colour, _EDGE, closed=True, **look)
        return
    rows, closed = metres(ends), len(ends) > 2
    yield line(of, frame, rows, colour, _LINK + 2.0 * _EDGE, closed=closed, **look)
    if closed:
        yield fill(of, frame, rows, colour, tint=_TINT, **look)
    yield line(of, frame, rows, colour, _LINK, closed=closed, tint=_TINT, **look)


def _drawn(described: dict[str, Any]) -> Iterator[Item]:
    """All edges, then all areas over them, so that only the edge of the whole remains."""
    of, frame, colour = _looks(described)
    look = {"layer": items.BODY if described["number"] else items.GROUND}
    parts = {
        form: [metres(part["points"]) for part in described["drawn"] if part["form"] == form]
        for form in ("area", "rod", "line")
    }
    for rows in parts["area"]:
        yield line(of, frame, rows, colour, 2.0 * _EDGE, closed=True, **look)
    for rows in parts["rod"]:
        yield line(of, frame, rows, colour, _LINK + 2.0 * _EDGE, **look)
    if parts["area"]:
        yield fill(of, frame, joined(parts["area"]), colour, tint=_TINT, **look)
    for rows in parts["rod"]:
        yield line(of, frame, rows, colour, _LINK, tint=_TINT, **look)
    for rows in parts["line"]:
        yield line(of, frame, rows, colour, _CURVE, **look)


def joined(rings: Sequence[Rows]) -> Rows:
    """Closed lines as one: from the first point to each ring, around it, and back.

    The ways there and back coincide, so that the winding number of every point is the sum of those
    of the rings. Painters fill where it is not 0, and a hole is a ring of the other sense.
    """
    start = rings[0][0]
    found: Rows = []
    for ring in rings:
        found += [*ring, ring[0], start]
    return found
