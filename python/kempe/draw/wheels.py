"""Wheels, gears, racks and belts, in the size of the mechanism.

Lengths are points of print unless they belong to the mechanism.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from kempe.arrays import Floats
from kempe.draw import items
from kempe.draw.items import Item, between, fill, line, metres, on_body
from kempe.draw.pins import Symbol, pin_at

#: Length of the rails and lines beyond the places where something is on them.
OVERHANG = 24.0
#: Corners of a tooth: along the pitch line and outwards, as shares of the pitch.
_TOOTH = np.array([(-0.38, -0.27), (-0.14, 0.25), (0.14, 0.25), (0.38, -0.27)])
#: Distance of the rim of a ring and of the back of a rack from the pitch line, in pitches.
_RIM, _BACK = 0.9, 0.8
_TINT = 0.84


def outer_radius(symbol: Symbol) -> float:
    """How far the drawing of a wheel reaches from its centre, m."""
    radius, teeth = float(symbol["radii"][1]), symbol["teeth"]
    share = _RIM if symbol["mark"] == "toothed_ring" else _TOOTH[1, 1]
    return radius + (share * np.pi * teeth["module"] if teeth else 0.0)


def circle(symbol: Symbol) -> Iterator[Item]:
    """A plain wheel, with a radius of it that shows how it turns if it can."""
    rim = items.circle(symbol["radii"][1], 96)
    yield from _wheel(symbol, rim, "ground" if not symbol["bodies"][1] else None)


def toothed_wheel(symbol: Symbol) -> Iterator[Item]:
    """A wheel with teeth on its outside."""
    yield from _wheel(symbol, _teeth(symbol, 1.0))
    yield from _pitch_circle(symbol)


def toothed_ring(symbol: Symbol) -> Iterator[Item]:
    """A ring with teeth on its inside; on ground its outside is hatched."""
    of, body = symbol["element"], symbol["bodies"][1]
    frame, colour = on_body(body, symbol["points"][1]), f"body {body}"
    inside, rim = _teeth(symbol, -1.0), items.circle(outer_radius(symbol), 96)
    seam = np.vstack([rim, rim[:1], inside[:1], inside[::-1]])
    yield fill(of, frame, metres(seam), colour, layer=items.GROUND, tint=_TINT)
    yield line(of, frame, metres(inside), colour, 1.0, layer=items.GROUND, closed=True)
    hatch = 0 if body else -1
    around = metres(np.vstack([rim, rim[:1]]))
    yield line(of, frame, around, colour, 1.0, layer=items.GROUND, hatch=hatch)
    yield from _pitch_circle(symbol)


def toothed_line(symbol: Symbol) -> Iterator[Item]:
    """The teeth of a rack on body i across its pitch line, and its back."""
    of, i, side = symbol["element"], symbol["bodies"][0], np.sign(symbol["radii"][1])
    pitch, phase = np.pi * symbol["teeth"]["module"], symbol["teeth"]["phase"]
    low, high = symbol["reach"]
    tooth = _TOOTH * (pitch, pitch * side)
    first, last = np.floor((low - phase) / pitch) - 2.0, np.ceil((high - phase) / pitch) + 2.0
    teeth = [(x + phase + k * pitch, y) for k in np.arange(first, last + 1.0) for x, y in tooth]
    back = -_BACK * pitch * side
    rim = metres([(teeth[0][0], back), *teeth, (teeth[-1][0], back)])
    frame = on_body(i, symbol["points"][0], turn=symbol["axes"][0])
    yield fill(of, frame, rim, f"body {i}", layer=items.BODY, tint=0.72)
    yield line(of, frame, rim, f"body {i}", 1.0, layer=items.BODY, closed=True)


def _wheel(symbol: Symbol, rim: Floats, colour: str | None = None) -> Iterator[Item]:
    body, of = symbol["bodies"][1], symbol["element"]
    frame, colour = on_body(body, symbol["points"][1]), colour or f"body {body}"
    if body:
        yield fill(of, frame, metres(rim), colour, layer=items.GROUND, tint=_TINT)
    yield line(of, frame, metres(rim), colour, 1.0, layer=items.GROUND, closed=True)
    if body:
        spoke = metres([(0.0, 0.0), (symbol["radii"][1], 0.0)])
        yield line(of, frame, spoke, colour, 0.8, layer=items.GROUND)


def _pitch_circle(symbol: Symbol) -> Iterator[Item]:
    body = symbol["bodies"][1]
    frame, pitch = on_body(body, symbol["points"][1]), items.circle(symbol["radii"][1], 96)
    rows, colour = metres(pitch), f"body {body}"
    yield line(symbol["element"], frame, rows, colour, 0.5, layer=items.GROUND, closed=True)


def _teeth(symbol: Symbol, outwards: float) -> Floats:
    """The corners of all teeth of a wheel, counter-clockwise, (n, 2), m."""
    radius, module = symbol["radii"][1], symbol["teeth"]["module"]
    count, pitch = round(2.0 * radius / module), np.pi * module
    middle = symbol["teeth"]["phase"] + 2.0 * np.pi / count * np.arange(count)
    angle = middle[:, None] + _TOOTH[:, 0] * pitch / radius
    away = np.broadcast_to(radius + outwards * _TOOTH[:, 1] * pitch, angle.shape)
    found: Floats = np.stack([away * np.cos(angle), away * np.sin(angle)], axis=-1)
    return found.reshape(-1, 2)


def track(symbol: Symbol) -> Iterator[Item]:
    """The line of body i on which a wheel rolls, hatched on ground."""
    i, side = symbol["bodies"][0], 1 if symbol["radii"][1] > 0.0 else -1
    low, high = symbol["reach"]
    frame = on_body(i, symbol["points"][0], turn=symbol["axes"][0])
    rows = [[low, 0.0, -OVERHANG, 0.0], [high, 0.0, OVERHANG, 0.0]]
    hatch = 0 if i else -side
    yield line(symbol["element"], frame, rows, f"body {i}", 1.2, layer=items.GROUND, hatch=hatch)


def strands(symbol: Symbol, crossed: bool) -> Iterator[Item]:
    """A belt: common tangents of two circles, and the arcs between their ends."""
    (r_i, r_j), length = symbol["radii"], max(symbol["reach"][1], 1e-300)
    sigma = 1.0 if crossed else -1.0
    turn = float(np.arccos(np.clip((r_i + sigma * r_j) / length, -1.0, 1.0)))
    begin = np.pi - turn if crossed else turn
    on_j = np.array([length, 0.0]) + items.arc(r_j, -begin, begin, 48)
    on_i = items.arc(r_i, turn, 2.0 * np.pi - turn, 48)
    around = np.vstack([on_j[::-1] if crossed else on_j, on_i])
    rows = [[float(x) / length, float(y), 0.0, 0.0] for x, y in around]
    frame = between(symbol["bodies"], symbol["points"])
    yield line(symbol["element"], frame, rows, "ground", 1.8, closed=True)


def roller(symbol: Symbol) -> Iterator[Item]:
    """A roller of body i on its pin."""
    (i, _), of = symbol["bodies"], symbol["element"]
    frame, rim = on_body(i, symbol["points"][0]), metres(items.circle(symbol["radii"][0], 64))
    yield fill(of, frame, rim, "paper", layer=items.BODY)
    yield line(of, frame, rim, f"body {i}", 1.4, layer=items.BODY, closed=True)
    yield from pin_at(symbol, 0)


def round_end(symbol: Symbol) -> Iterator[Item]:
    """A round end of body i."""
    (i, _), of = symbol["bodies"], symbol["element"]
    frame, rim = on_body(i, symbol["points"][0]), metres(items.circle(symbol["radii"][0], 64))
    yield fill(of, frame, rim, f"body {i}", layer=items.BODY, tint=0.72)
    yield line(of, frame, rim, f"body {i}", 1.4, layer=items.BODY, closed=True)
