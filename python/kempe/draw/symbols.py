"""The symbols of mechanisms as items of a display list: one function for each word of the scene.

Lengths are points of print unless they belong to the mechanism.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator

import numpy as np

from kempe.draw import along, items, wheels
from kempe.draw.along import FORCE
from kempe.draw.items import Item, fill, line, on_body, print_points, upright
from kempe.draw.pins import Symbol, pin_at
from kempe.draw.wheels import OVERHANG

_BLOCK = np.array([[-13.0, -7.5], [13.0, -7.5], [13.0, 7.5], [-13.0, 7.5]])
_RAIL = 9.0
_SLOT, _BEYOND = 5.5, 14.0  # half width, length beyond the places of the pin
_SPIRAL = (4.5, 12.0)  # inner and outer radius
_WINDINGS = 5.0 * np.pi
_FIRST_RING, _RING = 13.0, 8.0
_EYE = 8.5  # radius of the eye of a sleeve
_PAD = 3.0  # half thickness of a brake pad around a pin
_STOP = 9.0  # half the height of a stop
_FACE = 8.0  # overhang of a face beyond its contacts


class Rings:
    """Radii of the symbols around each place, from the inside to the outside.

    Args:
        place: the place of a symbol's point on body j; by default that point of that body.
    """

    def __init__(self, place: Callable[[Symbol], Hashable] | None = None) -> None:
        self._place = place or _on_body_j
        self._used: dict[Hashable, float] = {}

    def radius(self, symbol: Symbol, least: float = _FIRST_RING) -> float:
        """The next free radius around the point of a symbol on body j."""
        key = self._place(symbol)
        found = max(least, self._used.get(key, 0.0) + _RING)
        self._used[key] = found
        return found


def _on_body_j(symbol: Symbol) -> Hashable:
    x, y = symbol["points"][1]
    return symbol["bodies"][1], round(x, 9), round(y, 9)


def draw(symbol: Symbol, rings: Rings, aside: float = 0.0) -> Iterator[Item]:
    """The items of a symbol.

    Args:
        symbol: an entry of the scene.
        rings: the symbols around each point so far.
        aside: distance from the line of a symbol drawn in parallel to others; 0 for one alone.
    """
    mark = symbol["mark"]
    if mark in ALONG:
        yield from ALONG[mark](symbol, aside)
    elif mark in AROUND:
        yield from AROUND[mark](symbol, rings)
    else:
        yield from _AT[mark](symbol)


def _clamp(symbol: Symbol) -> Iterator[Item]:
    body, at = symbol["bodies"][1], symbol["points"][1]
    square = print_points([(-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0)])
    yield fill(symbol["element"], on_body(body, at), square, "ink", layer=items.PIN)
    if 0 in symbol["bodies"]:
        wall = print_points([(-10.0, -5.0), (10.0, -5.0)])
        at = symbol["points"][symbol["bodies"].index(0)]
        yield line(symbol["element"], upright(0, at), wall, "ground", layer=items.GROUND, hatch=-1)


def _sleeve(symbol: Symbol) -> Iterator[Item]:
    """A rubber ring in an eye of body i around a pin of body j; on ground the eye has feet."""
    of, i = symbol["element"], symbol["bodies"][0]
    frame, eye = upright(i, symbol["points"][0]), print_points(items.circle(_EYE))
    if i == 0:
        feet = [(-12.0, -14.0), (-7.0, -5.0), (7.0, -5.0), (12.0, -14.0)]
        yield line(of, frame, print_points(feet), "ground", layer=items.GROUND)
        base = print_points([(-15.0, -14.0), (15.0, -14.0)])
        yield line(of, frame, base, "ground", layer=items.GROUND, hatch=-1)
    yield fill(of, frame, eye, "force", layer=items.PIN, tint=0.7)
    yield line(of, frame, eye, "force", 1.6, layer=items.PIN, closed=True)
    apart = items.between(symbol["bodies"], symbol["points"])
    yield line(of, apart, [[0, 0, 0, 0], [1, 0, 0, 0]], "force", FORCE, layer=items.PIN)
    yield from pin_at(symbol, 1)


def _slide(symbol: Symbol) -> Iterator[Item]:
    """A block of body j between rails of body i, which are hatched on ground."""
    of, (i, j) = symbol["element"], symbol["bodies"]
    (at_i, at_j), (turn_i, turn_j) = symbol["points"], symbol["axes"]
    low, high = symbol["reach"]
    for side in (1, -1):
        y = side * _RAIL
        rail = [[low, 0.0, -OVERHANG, y], [high, 0.0, OVERHANG, y]]
        frame = on_body(i, at_i, turn=turn_i)
        hatch = side if i == 0 else 0
        yield line(of, frame, rail, f"body {i}", layer=items.GROUND, hatch=hatch)
    frame, block = on_body(j, at_j, turn=turn_j), print_points(_BLOCK)
    yield fill(of, frame, block, f"body {j}", layer=items.BODY, tint=0.72)
    yield line(of, frame, block, f"body {j}", 1.2, layer=items.BODY, closed=True)


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
    yield from pin_at(symbol, 1)


def _rubbing_slide(symbol: Symbol) -> Iterator[Item]:
    """Teeth of friction on both sides of the block of body j."""
    (i, j), at = symbol["bodies"], symbol["points"][1]
    frame = on_body(j, at, turns_with=i, turn=symbol["axes"][0])
    for side in (1.0, -1.0):
        x = np.linspace(-_BLOCK[1, 0], _BLOCK[1, 0], 11)
        y = side * np.where(np.arange(11) % 2, _RAIL + 2.5, _RAIL - 2.5)
        teeth = print_points(np.column_stack([x, y]))
        yield line(symbol["element"], frame, teeth, "force", FORCE, layer=items.PIN)


def _rubbing_pin(symbol: Symbol, rings: Rings) -> Iterator[Item]:
    """Two brake pads on body j around the pin."""
    r = rings.radius(symbol, _FIRST_RING - 2.0)
    frame = on_body(symbol["bodies"][1], symbol["points"][1])
    for middle in (0.0, np.pi):
        begin, end = middle - 0.6, middle + 0.6
        outer, inner = items.arc(r + _PAD, begin, end), items.arc(r - _PAD, end, begin)
        pad = print_points(np.vstack([outer, inner]))
        yield fill(symbol["element"], frame, pad, "force", tint=0.6)
        yield line(symbol["element"], frame, pad, "force", FORCE, closed=True)


def _touch(symbol: Symbol) -> Iterator[Item]:
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


def _spiral(symbol: Symbol, rings: Rings) -> Iterator[Item]:
    """A spiral from body i to body j that winds as they turn against each other."""
    inner, outer = _SPIRAL
    radius = rings.radius(symbol, outer)
    rest, most = symbol["turning"]
    count = int(np.clip(6.0 * (_WINDINGS + most), 90, 2000))
    share = np.linspace(0.0, 1.0, count)
    rows = [[s, 0.0, inner + (radius - inner) * s, 0.0] for s in share]
    frame = items.twisted(symbol["bodies"], symbol["points"][1], _WINDINGS - rest)
    yield line(symbol["element"], frame, rows, "force", FORCE)


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
        yield line(symbol["element"], frame, print_points(points), "force", FORCE)


def _shift_stop(symbol: Symbol) -> Iterator[Item]:
    """A stop of body i, hatched on the side to which nothing passes."""
    i = symbol["bodies"][0]
    frame = on_body(i, symbol["points"][0], turn=symbol["axes"][0])
    face = print_points([(0.0, -_STOP), (0.0, _STOP)])
    yield line(symbol["element"], frame, face, f"body {i}", 2.0, hatch=-1)


def _turn_stop(symbol: Symbol, _: Rings) -> Iterator[Item]:
    """A stop of body i at an angle of body j around their joint."""
    (i, j), r = symbol["bodies"], _FIRST_RING + _RING
    frame = on_body(j, symbol["points"][1], turns_with=i, turn=symbol["axes"][0])
    rows = print_points([(r - 5.0, 0.0), (r + 5.0, 0.0)])
    yield line(symbol["element"], frame, rows, f"body {i}", 4.0)


def _curved_arrow(symbol: Symbol, rings: Rings, colour: str, width: float) -> Iterator[Item]:
    """An arrow around the pin, counter-clockwise unless its sense is negative."""
    r = rings.radius(symbol)
    begin, end = np.radians([10.0, 170.0])
    frame = upright(symbol["bodies"][1], symbol["points"][1])
    turned = np.array([symbol["sense"], 1.0])
    shaft = print_points(items.arc(r, begin, end - 4.0 / r) * turned)
    yield line(symbol["element"], frame, shaft, colour, width)
    tip = items.arc(r, end, end, 1)[0]
    head = items.arrow_head(tip, end + np.pi / 2.0 - 3.5 / r, 8.0)
    yield fill(symbol["element"], frame, print_points(head * turned), colour)


_AT: dict[str, Callable[[Symbol], Iterator[Item]]] = {
    "pin": lambda symbol: pin_at(symbol, 1),
    "clamp": _clamp,
    "sleeve": _sleeve,
    "slide": _slide,
    "slot": _slot,
    "track": wheels.track,
    "toothed_line": wheels.toothed_line,
    "toothed_wheel": wheels.toothed_wheel,
    "toothed_ring": wheels.toothed_ring,
    "open_strands": lambda symbol: wheels.strands(symbol, crossed=False),
    "crossed_strands": lambda symbol: wheels.strands(symbol, crossed=True),
    "circle": wheels.circle,
    "roller": wheels.roller,
    "round": wheels.round_end,
    "rubbing_slide": _rubbing_slide,
    "touch": _touch,
    "face": _face,
    "shift_stop": _shift_stop,
    "force_arrow": lambda symbol: _straight_arrow(symbol, "force", 1.6),
    "drive_shift": lambda symbol: _straight_arrow(symbol, "drive", 2.4),
}
#: Symbols along the line between two points.
ALONG: dict[str, Callable[[Symbol, float], Iterator[Item]]] = {
    "rod": along.rod,
    "spring": along.spring,
    "dashpot": along.dashpot,
    "cylinder": lambda symbol, _: along.cylinder(symbol, "force"),
    "drive_cylinder": lambda symbol, _: along.cylinder(symbol, "drive"),
}
#: Symbols around a point.
AROUND: dict[str, Callable[[Symbol, Rings], Iterator[Item]]] = {
    "spiral_spring": _spiral,
    "rotary_dashpot": _rotary_dashpot,
    "rubbing_pin": _rubbing_pin,
    "torque_arrow": lambda symbol, rings: _curved_arrow(symbol, rings, "force", 1.6),
    "turn_stop": _turn_stop,
    "drive_turn": lambda symbol, rings: _curved_arrow(symbol, rings, "drive", 2.4),
}
#: Symbols that turn on a pin where an end of theirs is on ground.
PINNED = ("pin", *ALONG)
#: Symbols of the size of the mechanism around the point of body j.
WHEELS = ("circle", "toothed_wheel", "toothed_ring")
#: Marks that show the point of body i only if it is in the place of another.
UNMARKED_I = (
    *WHEELS,
    "slide",
    "slot",
    "rubbing_slide",
    "track",
    "face",
    "toothed_line",
    "force_arrow",
    "drive_shift",
)
#: Marks that show neither point.
_UNMARKED = ("shift_stop", "round")
#: The vocabulary.
MARKS = (*_AT, *ALONG, *AROUND)


def unmarked(symbol: Symbol) -> int:
    """How many of the two points of a symbol it does not mark, that of body i first."""
    mark = symbol["mark"]
    return 2 if mark in _UNMARKED else int(mark in UNMARKED_I)
