"""The symbols of mechanisms as items of a display list: one function for each word of the scene.

Lengths are points of print unless they belong to the mechanism.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from kempe.draw import items
from kempe.draw.items import Item, between, fill, line, metres, on_body, print_points, upright

PIN_RADIUS = 3.0
_BLOCK = np.array([[-13.0, -7.5], [13.0, -7.5], [13.0, 7.5], [-13.0, 7.5]])
_RAIL, _OVERHANG = 9.0, 24.0
#: Place of the bars of a spring beside a dashpot, as a part of the distance, and their distance.
_BAR, _ASIDE = 0.15, 6.5
_SLOT, _BEYOND = 5.5, 14.0  # half width, length beyond the places of the pin
_TEETH = 18.0  # of a wheel
_TOOTH = [(-0.38, -1.0), (-0.14, 1.0), (0.14, 1.0), (0.38, -1.0)]
_ROOM = 60.0  # of a dashpot along its line
_SPIRAL = (4.5, 12.0)  # inner and outer radius
_WINDINGS = 5.0 * np.pi
_FIRST_RING, _RING = 13.0, 8.0
_FORCE = 1.2
_FACE = 8.0  # overhang of a face beyond its contacts

#: An entry of ``scene["symbols"]``.
Symbol = dict[str, Any]


class Rings:
    """Radii of the symbols around one point, from the inside to the outside."""

    def __init__(self) -> None:
        self._used: dict[tuple[int, float, float], float] = {}

    def radius(self, symbol: Symbol, least: float = _FIRST_RING) -> float:
        """The next free radius around the point of a symbol on body j."""
        x, y = symbol["points"][1]
        key = (symbol["bodies"][1], round(x, 9), round(y, 9))
        found = max(least, self._used.get(key, 0.0) + _RING)
        self._used[key] = found
        return found


def draw(symbol: Symbol, rings: Rings, aside: float = 0.0) -> Iterator[Item]:
    """The items of a symbol.

    Args:
        symbol: an entry of the scene.
        rings: the symbols around each point so far.
        aside: distance from the line of a symbol drawn in parallel to others; 0 for one alone.
    """
    mark = symbol["mark"]
    if mark in _ALONG:
        yield from _ALONG[mark](symbol, aside)
    elif mark in _AROUND:
        yield from _AROUND[mark](symbol, rings)
    else:
        yield from _AT[mark](symbol)


def parallel(symbols: list[Symbol]) -> dict[str, float]:
    """How far to the side each mark of an element is drawn: a spring beside its dashpot."""
    both = {symbol["mark"] for symbol in symbols} >= {"spring", "dashpot"}
    return {"spring": _ASIDE, "dashpot": -_ASIDE} if both else {}


def support(of: str, at: items.At) -> Iterator[Item]:
    """The triangle under a pin on ground, and hatched ground below it."""
    frame = upright(0, at)
    corners = print_points([(0.0, 0.0), (-7.0, -12.0), (7.0, -12.0)])
    yield fill(of, frame, corners, "paper", layer=items.GROUND)
    yield line(of, frame, corners, "ground", layer=items.GROUND, closed=True)
    base = print_points([(-11.0, -12.0), (11.0, -12.0)])
    yield line(of, frame, base, "ground", layer=items.GROUND, hatch=-1)


def cross(of: str, body: int, at: items.At) -> Iterator[Item]:
    """The mark of a point that no symbol has: a cross on ground, a dot on a body."""
    if body:
        yield fill(of, upright(body, at), print_points(items.circle(2.0)), "ink", layer=items.PIN)
        return
    for stroke in ([(-4.0, 0.0), (4.0, 0.0)], [(0.0, -4.0), (0.0, 4.0)]):
        yield line(of, upright(0, at), print_points(stroke), "ground", layer=items.GROUND)


def _pin_at(symbol: Symbol, k: int) -> Iterator[Item]:
    frame = upright(symbol["bodies"][k], symbol["points"][k])
    rim = print_points(items.circle(PIN_RADIUS))
    yield fill(symbol["element"], frame, rim, "paper", layer=items.PIN)
    yield line(symbol["element"], frame, rim, "ink", layer=items.PIN, closed=True)


def _pin(symbol: Symbol) -> Iterator[Item]:
    yield from _pin_at(symbol, 1)


def _clamp(symbol: Symbol) -> Iterator[Item]:
    body, at = symbol["bodies"][1], symbol["points"][1]
    square = print_points([(-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0)])
    yield fill(symbol["element"], on_body(body, at), square, "ink", layer=items.PIN)
    if 0 in symbol["bodies"]:
        wall = print_points([(-10.0, -5.0), (10.0, -5.0)])
        at = symbol["points"][symbol["bodies"].index(0)]
        yield line(symbol["element"], upright(0, at), wall, "ground", layer=items.GROUND, hatch=-1)


def _slide(symbol: Symbol) -> Iterator[Item]:
    """A block of body j between rails of body i, which are hatched on ground."""
    of, (i, j) = symbol["element"], symbol["bodies"]
    (at_i, at_j), (turn_i, turn_j) = symbol["points"], symbol["axes"]
    low, high = symbol["reach"]
    for side in (1, -1):
        y = side * _RAIL
        rail = [[low, 0.0, -_OVERHANG, y], [high, 0.0, _OVERHANG, y]]
        frame = on_body(i, at_i, turn=turn_i)
        hatch = side if i == 0 else 0
        yield line(of, frame, rail, f"body {i}", layer=items.GROUND, hatch=hatch)
    frame, block = on_body(j, at_j, turn=turn_j), print_points(_BLOCK)
    yield fill(of, frame, block, f"body {j}", layer=items.BODY, tint=0.72)
    yield line(of, frame, block, f"body {j}", 1.2, layer=items.BODY, closed=True)


def _circle(symbol: Symbol) -> Iterator[Item]:
    """A pitch circle, with a radius of it that shows how the wheel turns if it can."""
    body, radius = symbol["bodies"][1], symbol["radii"][1]
    frame, of, colour = on_body(body, symbol["points"][1]), symbol["element"], f"body {body}"
    yield line(of, frame, metres(items.circle(radius, 96)), colour, 1.2, closed=True)
    if body:
        yield line(of, frame, metres([(0.0, 0.0), (radius, 0.0)]), colour, 0.8)


def _slot(symbol: Symbol) -> Iterator[Item]:
    """A slot in body i, as long as the pin of body j moves, and the pin."""
    of, i = symbol["element"], symbol["bodies"][0]
    low, high = symbol["reach"]
    frame = on_body(i, symbol["points"][0], turn=symbol["axes"][0])
    quarter = np.pi / 2.0
    ends = [
        (low, items.arc(_SLOT, quarter, 3.0 * quarter)),
        (high, items.arc(_SLOT, -quarter, quarter)),
    ]
    rim = [
        [x, 0.0, float(px) + beyond, float(py)]
        for (x, arc), beyond in zip(ends, (-_BEYOND, _BEYOND), strict=True)
        for px, py in arc
    ]
    yield fill(of, frame, rim, "paper", layer=items.BODY)
    yield line(of, frame, rim, f"body {i}", 1.2, layer=items.BODY, closed=True)
    yield from _pin_at(symbol, 1)


def _track(symbol: Symbol) -> Iterator[Item]:
    """The line of body i on which a wheel rolls, hatched on ground."""
    i, side = symbol["bodies"][0], 1 if symbol["radii"][1] > 0.0 else -1
    low, high = symbol["reach"]
    frame = on_body(i, symbol["points"][0], turn=symbol["axes"][0])
    rows = [[low, 0.0, -_OVERHANG, 0.0], [high, 0.0, _OVERHANG, 0.0]]
    hatch = 0 if i else -side
    yield line(symbol["element"], frame, rows, f"body {i}", 1.2, layer=items.GROUND, hatch=hatch)


def _toothed_line(symbol: Symbol) -> Iterator[Item]:
    """The teeth of a rack on body i across its pitch line, and its back."""
    of, i, radius = symbol["element"], symbol["bodies"][0], symbol["radii"][1]
    pitch, side = 2.0 * np.pi * abs(radius) / _TEETH, np.sign(radius)
    low, high = symbol["reach"]
    tooth = np.array(_TOOTH) * (pitch, 0.25 * pitch * side)
    first, last = np.floor(low / pitch) - 2.0, np.ceil(high / pitch) + 2.0
    teeth = [(x + k * pitch, y) for k in np.arange(first, last + 1.0) for x, y in tooth]
    back = -0.8 * pitch * side
    rim = metres([(teeth[0][0], back), *teeth, (teeth[-1][0], back)])
    frame = on_body(i, symbol["points"][0], turn=symbol["axes"][0])
    yield fill(of, frame, rim, f"body {i}", layer=items.BODY, tint=0.72)
    yield line(of, frame, rim, f"body {i}", 1.0, layer=items.BODY, closed=True)


def _strands(symbol: Symbol, crossed: bool) -> Iterator[Item]:
    """The straight parts of a belt: common tangents of two circles."""
    (r_i, r_j), length = symbol["radii"], max(symbol["reach"][1], 1e-300)
    sigma = 1.0 if crossed else -1.0
    cos = float(np.clip((r_i + sigma * r_j) / length, -1.0, 1.0))
    sin = float(np.sqrt(1.0 - cos * cos))
    frame = between(symbol["bodies"], symbol["points"])
    for side in (1.0, -1.0):
        begin = [r_i * cos / length, side * r_i * sin, 0.0, 0.0]
        end = [1.0 - sigma * r_j * cos / length, -sigma * side * r_j * sin, 0.0, 0.0]
        yield line(symbol["element"], frame, [begin, end], "ground", 1.8)


def _roller(symbol: Symbol) -> Iterator[Item]:
    """A roller of body i on its pin."""
    (i, _), of = symbol["bodies"], symbol["element"]
    frame, rim = on_body(i, symbol["points"][0]), metres(items.circle(symbol["radii"][0], 64))
    yield fill(of, frame, rim, "paper", layer=items.BODY)
    yield line(of, frame, rim, f"body {i}", 1.4, layer=items.BODY, closed=True)
    yield from _pin_at(symbol, 0)


def _contact(symbol: Symbol) -> Iterator[Item]:
    """The point of body i that slides on a curve."""
    frame = upright(symbol["bodies"][0], symbol["points"][0])
    dot = print_points(items.circle(3.5))
    yield fill(symbol["element"], frame, dot, f"body {symbol['bodies'][0]}", layer=items.PIN)


def _face(symbol: Symbol) -> Iterator[Item]:
    """A face of body i as far as the curve touches it."""
    (i, _), (low, high) = symbol["bodies"], symbol["reach"]
    frame = on_body(i, symbol["points"][0], turn=symbol["axes"][0])
    rows = [[min(low, 0.0), 0.0, -_FACE, 0.0], [max(high, 0.0), 0.0, _FACE, 0.0]]
    yield line(symbol["element"], frame, rows, f"body {i}", 3.0, layer=items.BODY)


def _straight_arrow(symbol: Symbol, colour: str, width: float) -> Iterator[Item]:
    (i, j), at = symbol["bodies"], symbol["points"][1]
    frame = on_body(j, at, turns_with=i, turn=symbol["axes"][0])
    shaft = print_points([(16.0, 0.0), (40.0, 0.0)])
    yield line(symbol["element"], frame, shaft, colour, width)
    head = print_points(items.arrow_head((47.0, 0.0), 0.0, 8.0))
    yield fill(symbol["element"], frame, head, colour)


def _rod(symbol: Symbol, _: float) -> Iterator[Item]:
    frame = between(symbol["bodies"], symbol["points"])
    yield line(symbol["element"], frame, [[0, 0, 0, 0], [1, 0, 0, 0]], "ground", 1.8)
    for k in (0, 1):
        yield from _pin_at(symbol, k)


def _spring(symbol: Symbol, aside: float) -> Iterator[Item]:
    first, last, count = 0.22, 0.78, 18
    teeth = [
        [x, 0.0, 0.0, aside + (-5.5, 5.5)[k % 2]]
        for k, x in enumerate(np.linspace(first, last, 2 * count + 1)[1::2])
    ]
    coil = [[first, 0.0, 0.0, aside], *teeth, [last, 0.0, 0.0, aside]]
    yield from _along(symbol, aside, [_led(coil, aside)])


def _dashpot(symbol: Symbol, aside: float) -> Iterator[Item]:
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
        yield line(of, frame, rows, "force", _FORCE)
    if aside > 0.0:
        return
    for k, (body, at) in enumerate(zip(symbol["bodies"], symbol["points"], strict=True)):
        if body:
            dot = print_points(items.circle(2.0))
            yield fill(of, upright(body, at), dot, "force", layer=items.PIN)
        else:  # on ground the end turns on a pin, as a joint does
            yield from _pin_at(symbol, k)


def _spiral(symbol: Symbol, rings: Rings) -> Iterator[Item]:
    """A spiral from body i to body j that winds as they turn against each other."""
    inner, outer = _SPIRAL
    radius = rings.radius(symbol, outer)
    rest, most = symbol["turning"]
    count = int(np.clip(6.0 * (_WINDINGS + most), 90, 2000))
    share = np.linspace(0.0, 1.0, count)
    rows = [[s, 0.0, inner + (radius - inner) * s, 0.0] for s in share]
    frame = items.twisted(symbol["bodies"], symbol["points"][1], _WINDINGS - rest)
    yield line(symbol["element"], frame, rows, "force", _FORCE)


def _rotary_dashpot(symbol: Symbol, rings: Rings) -> Iterator[Item]:
    """A dashpot bent around the pin: rod, piston, cup, rod, each end on a leg from the pin."""
    r = rings.radius(symbol, _FIRST_RING + 3.0)
    begin, piston, end = np.radians([20.0, 86.0, 160.0])
    low, high = np.radians([70.0, 110.0])
    ray = np.array([np.cos, np.sin])

    def at(radius: float, angle: float) -> list[float]:
        return [radius * float(f(angle)) for f in ray]

    lines = [
        [at(4.5, begin), *items.arc(r, begin, piston)],
        [at(r - 3.0, piston), at(r + 3.0, piston)],
        [*items.arc(r + 4.5, low, high), *items.arc(r - 4.5, high, low)],
        [*items.arc(r, high, end), at(4.5, end)],
    ]
    frame = upright(symbol["bodies"][1], symbol["points"][1])
    for points in lines:
        yield line(symbol["element"], frame, print_points(points), "force", _FORCE)


def _curved_arrow(symbol: Symbol, rings: Rings, colour: str, width: float) -> Iterator[Item]:
    """A counter-clockwise arrow around the pin: the positive sense."""
    r = rings.radius(symbol)
    begin, end = np.radians([10.0, 170.0])
    frame = upright(symbol["bodies"][1], symbol["points"][1])
    shaft = print_points(items.arc(r, begin, end - 4.0 / r))
    yield line(symbol["element"], frame, shaft, colour, width)
    tip = items.arc(r, end, end, 1)[0]
    head = items.arrow_head(tip, end + np.pi / 2.0 - 3.5 / r, 8.0)
    yield fill(symbol["element"], frame, print_points(head), colour)


_AT: dict[str, Callable[[Symbol], Iterator[Item]]] = {
    "pin": _pin,
    "clamp": _clamp,
    "slide": _slide,
    "slot": _slot,
    "track": _track,
    "toothed_line": _toothed_line,
    "open_strands": lambda symbol: _strands(symbol, crossed=False),
    "crossed_strands": lambda symbol: _strands(symbol, crossed=True),
    "circle": _circle,
    "roller": _roller,
    "contact": _contact,
    "face": _face,
    "force_arrow": lambda symbol: _straight_arrow(symbol, "force", 1.6),
    "drive_shift": lambda symbol: _straight_arrow(symbol, "drive", 2.4),
}
_ALONG: dict[str, Callable[[Symbol, float], Iterator[Item]]] = {
    "rod": _rod,
    "spring": _spring,
    "dashpot": _dashpot,
}
_AROUND: dict[str, Callable[[Symbol, Rings], Iterator[Item]]] = {
    "spiral_spring": _spiral,
    "rotary_dashpot": _rotary_dashpot,
    "torque_arrow": lambda symbol, rings: _curved_arrow(symbol, rings, "force", 1.6),
    "drive_turn": lambda symbol, rings: _curved_arrow(symbol, rings, "drive", 2.4),
}
#: Symbols that turn on a pin where an end of theirs is on ground.
PINNED = ("pin", *_ALONG)
#: The vocabulary.
MARKS = (*_AT, *_ALONG, *_AROUND)
