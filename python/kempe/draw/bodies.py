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
#: Places along a body from end to end, where a number is tried in turn.
_SHARES = (0.5, 0.35, 0.65, 0.25, 0.75, 0.15, 0.85)


def body(described: dict[str, Any]) -> Iterator[Item]:
    """A moving body, or what ground has as an outline."""
    if described["drawn"]:
        yield from _drawn(described)
    elif described["number"] and not is_plate(described):
        yield from _link(described)


def is_plate(described: dict[str, Any]) -> bool:
    """Whether a body has a closed curve around its points: the curve is all of it."""
    corners = np.array(described["outline"])
    return any(all(winding([ring], at) for at in corners) for ring in _rings(described))


def _rings(described: dict[str, Any]) -> list[Floats]:
    """The closed curves of a body, each (n, 2), m."""
    return [np.array(curve["points"]) for curve in described["curves"] if curve["closed"]]


def middles(described: dict[str, Any]) -> Iterator[Floats]:
    """Places on a moving body, (2,), m, the best ones for a number first."""
    areas = [np.array(part["points"]) for part in described["drawn"] if part["form"] == "area"]
    drawn = [at for part in described["drawn"] for at in part["points"]]
    corners = np.array(drawn or described["outline"])
    if not drawn and len(corners) > 1 and is_plate(described):
        areas = _rings(described)
    elif not drawn and described["curves"] and len(corners) == 1:
        corners = np.array(described["curves"][0]["points"])
    across = [(0, len(corners) // 2)]
    if areas:
        largest = max(areas, key=lambda ring: float(np.ptp(ring, axis=0).max()))
        corners, n = largest, len(largest)
        across = [(0, n // 2), (n // 4, 3 * n // 4), (n // 8, 5 * n // 8), (3 * n // 8, 7 * n // 8)]
    found = [corners.mean(axis=0), np.array(described["center"])]
    for first, last in across:
        found += [corners[first] + share * (corners[last] - corners[first]) for share in _SHARES]
    yield from (at for at in found if not areas or winding(areas, at))


def winding(rings: Sequence[Floats], at: Floats) -> int:
    """How many times closed lines, each (n, 2), go around a point, counter-clockwise."""
    turns = 0.0
    for ring in rings:
        away = ring - at
        angles = np.arctan2(away[:, 1], away[:, 0])
        steps = np.diff(angles, append=angles[:1])
        turns += float((steps - 2.0 * np.pi * np.round(steps / (2.0 * np.pi))).sum())
    return round(turns / (2.0 * np.pi))


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
    ends, layer = np.array(described["outline"]), items.BODY
    if len(ends) == 1:
        rows = [[*end, *at] for end in ends for at in items.circle(_SPOT)]
        yield fill(of, frame, rows, colour, tint=_TINT, layer=layer)
        yield line(of, frame, rows, colour, _EDGE, closed=True, layer=layer)
        return
    rows, closed = metres(ends), len(ends) > 2
    yield line(of, frame, rows, colour, _LINK + 2.0 * _EDGE, closed=closed, layer=layer)
    if closed:
        yield fill(of, frame, rows, colour, tint=_TINT, layer=layer)
    yield line(of, frame, rows, colour, _LINK, closed=closed, tint=_TINT, layer=layer)


def _drawn(described: dict[str, Any]) -> Iterator[Item]:
    """All edges, then all areas over them, so that only the edge of the whole remains."""
    of, frame, colour = _looks(described)
    layer = items.BODY if described["number"] else items.GROUND
    parts = {
        form: [metres(part["points"]) for part in described["drawn"] if part["form"] == form]
        for form in ("area", "rod", "line")
    }
    for rows in parts["area"]:
        yield line(of, frame, rows, colour, 2.0 * _EDGE, closed=True, layer=layer)
    for rows in parts["rod"]:
        yield line(of, frame, rows, colour, _LINK + 2.0 * _EDGE, layer=layer)
    if parts["area"]:
        yield fill(of, frame, joined(parts["area"]), colour, tint=_TINT, layer=layer)
    for rows in parts["rod"]:
        yield line(of, frame, rows, colour, _LINK, tint=_TINT, layer=layer)
    for rows in parts["line"]:
        yield line(of, frame, rows, colour, _CURVE, layer=layer)


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
