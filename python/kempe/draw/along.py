"""Symbols along the line between two points: rods, springs, dashpots and cylinders.

Lengths are points of print unless they belong to the mechanism.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from kempe.draw import items
from kempe.draw.items import Item, between, fill, line, print_points, towards, upright
from kempe.draw.pins import Symbol, pin_at

#: Width of the lines of a force element.
FORCE = 1.2
#: Place of the bars of a spring beside a dashpot, as a part of the distance, and their distance.
_BAR, _ASIDE = 0.15, 6.5
_ROOM = 60.0  # of a dashpot along its line
#: Half width of a barrel, of its piston, and the gap between its base and its pin.
_BARREL, _PISTON, _EYE = 5.0, 3.6, 6.0
#: Length of a barrel that holds no stroke, as a share of the distance, and the least and largest.
_SHARE, _MOST = 0.6, 0.85
#: Part of a barrel in which the piston moves at most.
_TRAVEL = 0.85


def parallel(symbols: list[Symbol]) -> dict[str, float]:
    """How far to the side each mark of an element is drawn: a spring beside its dashpot."""
    both = {symbol["mark"] for symbol in symbols} >= {"spring", "dashpot"}
    return {"spring": _ASIDE, "dashpot": -_ASIDE} if both else {}


def rod(symbol: Symbol, _: float) -> Iterator[Item]:
    """A massless rod."""
    frame = between(symbol["bodies"], symbol["points"])
    yield line(symbol["element"], frame, [[0, 0, 0, 0], [1, 0, 0, 0]], "ground", 1.8)
    for k in (0, 1):
        yield from pin_at(symbol, k)


def lengths(low: float, high: float) -> tuple[float, float]:
    """Lengths of a barrel and of its piston rod, m, for distances between two limits.

    The piston is in the middle of the barrel at half stroke. If no single rod has that stroke,
    the barrel is as long as the least distance allows.
    """
    barrel = min(max(_SHARE * low, (high - low) / _TRAVEL), _MOST * low)
    return barrel, (low + high - barrel) / 2.0


def cylinder(symbol: Symbol, colour: str) -> Iterator[Item]:
    """A barrel on body i, cut open, and a piston on a rod to body j.

    The barrel and the rod keep their lengths while the piston moves. A stroke that needs a longer
    barrel than fits is drawn in shares of the distance.
    """
    low, high = symbol["reach"]
    of, ends = symbol["element"], (symbol["bodies"], symbol["points"])
    barrel, reach = lengths(low, high)
    if high - low <= barrel:
        base, top = towards(*ends), towards(*(pair[::-1] for pair in ends))
        tube, piston = barrel, reach
    else:
        base, tube = between(*ends), 0.6
        top, piston = between(*(pair[::-1] for pair in ends)), 0.7
    walls = [[x, 0.0, px, side * _BARREL] for x, px, side in _corners(tube)]
    yield fill(of, base, walls, colour, tint=0.85)
    yield line(of, base, walls, colour, FORCE, closed=True)
    yield line(of, base, [[0.0, 0.0, 0.0, 0.0], [0.0, 0.0, _EYE, 0.0]], colour, 2.4)
    yield line(of, top, [[0.0, 0.0, 0.0, 0.0], [piston, 0.0, 0.0, 0.0]], colour, 2.4)
    disc = [[piston, 0.0, 0.0, -_PISTON], [piston, 0.0, 0.0, _PISTON]]
    yield line(of, top, disc, colour, 3.0)
    for k in (0, 1):
        yield from pin_at(symbol, k)


def _corners(tube: float) -> list[tuple[float, float, int]]:
    return [(0.0, _EYE, 1), (tube, 0.0, 1), (tube, 0.0, -1), (0.0, _EYE, -1)]


def spring(symbol: Symbol, aside: float) -> Iterator[Item]:
    """A coil."""
    first, last, count = 0.22, 0.78, 18
    teeth = [
        [x, 0.0, 0.0, aside + (-5.5, 5.5)[k % 2]]
        for k, x in enumerate(np.linspace(first, last, 2 * count + 1)[1::2])
    ]
    coil = [[first, 0.0, 0.0, aside], *teeth, [last, 0.0, 0.0, aside]]
    yield from _along(symbol, aside, [_led(coil, aside)])


def dashpot(symbol: Symbol, aside: float) -> Iterator[Item]:
    """A cup with a piston in it."""

    def at(px: float, py: float) -> list[float]:
        return [0.5, 0.0, px, aside + py]

    first = _BAR if aside else 0.0
    rod = [[first, 0.0, 0.0, aside], at(-3.0, 0.0)]
    piston = [at(-3.0, -3.5), at(-3.0, 3.5)]
    cup = [at(-11.0, 5.0), at(10.0, 5.0), at(10.0, -5.0), at(-11.0, -5.0)]
    end = [at(10.0, 0.0), [1.0 - first, 0.0, 0.0, aside]]
    yield from _along(symbol, aside, [rod, piston, cup, end])


def _led(rows: items.Rows, aside: float) -> items.Rows:
    """A line with straight leads to its ends, or to the bars where it is not alone."""
    first = _BAR if aside else 0.0
    return [[first, 0.0, 0.0, aside], *rows, [1.0 - first, 0.0, 0.0, aside]]


def _along(symbol: Symbol, aside: float, lines: list[items.Rows]) -> Iterator[Item]:
    frame = between(symbol["bodies"], symbol["points"], _ROOM)
    of = symbol["element"]
    if aside > 0.0:  # the bars that both share are drawn once
        for bar in (_BAR, 1.0 - _BAR):
            lines.append([[bar, 0.0, 0.0, aside], [bar, 0.0, 0.0, -aside]])
            lines.append([[bar, 0.0, 0.0, 0.0], [round(bar), 0.0, 0.0, 0.0]])
    for rows in lines:
        yield line(of, frame, rows, "force", FORCE)
    if aside > 0.0:
        return
    for k, (body, at) in enumerate(zip(symbol["bodies"], symbol["points"], strict=True)):
        if body:
            dot = print_points(items.circle(2.0))
            yield fill(of, upright(body, at), dot, "force", layer=items.PIN)
        else:  # on ground the end turns on a pin, as a joint does
            yield from pin_at(symbol, k)
