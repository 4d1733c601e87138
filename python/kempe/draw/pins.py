"""Pins, the ground below them, and points without a symbol."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from kempe.draw import items
from kempe.draw.items import Item, fill, line, print_points, upright

PIN_RADIUS = 3.0

#: An entry of ``scene["symbols"]``.
Symbol = dict[str, Any]


def pin_at(symbol: Symbol, k: int) -> Iterator[Item]:
    """A pin at the point of a symbol on body i (0) or j (1)."""
    frame = upright(symbol["bodies"][k], symbol["points"][k])
    rim = print_points(items.circle(PIN_RADIUS))
    yield fill(symbol["element"], frame, rim, "paper", layer=items.PIN)
    yield line(symbol["element"], frame, rim, "ink", layer=items.PIN, closed=True)


def support(of: str, at: items.At) -> Iterator[Item]:
    """The triangle under a pin on ground, and hatched ground below it."""
    frame = upright(0, at)
    corners = print_points([(0.0, 0.0), (-7.0, -12.0), (7.0, -12.0)])
    yield fill(of, frame, corners, "paper", layer=items.GROUND)
    yield line(of, frame, corners, "ground", layer=items.GROUND, closed=True)
    base = print_points([(-11.0, -12.0), (11.0, -12.0)])
    yield line(of, frame, base, "ground", layer=items.GROUND, hatch=-1)


def dot(of: str, body: int, at: items.At) -> Iterator[Item]:
    """The mark of a point that no symbol has."""
    colour = "ink" if body else "ground"
    yield fill(of, upright(body, at), print_points(items.circle(2.0)), colour, layer=items.PIN)
