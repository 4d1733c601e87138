"""How many teeth drawn gears have, and where, so that those of a pair mesh.

Meshing wheels and racks have one module. Where the model does not give it, it is chosen such that
the radii have nearly whole numbers of teeth.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator
from itertools import groupby
from typing import Any

import numpy as np

from kempe.arrays import Floats
from kempe.draw.geometry import placed

WHEELS = ("toothed_wheel", "toothed_ring")
TOOTHED = (*WHEELS, "toothed_line")
#: Numbers of teeth of the smallest wheel, the usual one first.
_COUNTS = (18, *range(14, 31))
#: Error of a number of teeth at which it is a whole one.
_WHOLE = 1e-6

Symbol = dict[str, Any]


def add_teeth(symbols: list[Symbol], poses: Floats) -> None:
    """Give each toothed symbol its ``teeth``: ``module``, m, and ``phase``.

    The phase is the place of a tooth: of a wheel its angle in the frame of the body, rad, of a rack
    its distance from the point of body i along the axis, m.

    Args:
        symbols: all symbols; those of an element follow each other, and the toothed ones mesh.
        poses: of all bodies at one instant, ground first, (n_bodies, 3).
    """
    pairs = list(_pairs(symbols))
    for group in _connected(pairs):
        module = _module([one for pair in group for one in pair])
        phases: dict[Hashable, float] = {}
        for pair in _in_order(group):
            first, second = pair if _key(pair[0]) in phases else pair[::-1]
            known = phases.setdefault(_key(first), 0.0)
            phases.setdefault(_key(second), _meshing(first, second, known, module, poses))
        for one in (one for pair in group for one in pair):
            one["teeth"] = {"module": module, "phase": phases[_key(one)]}


def _pairs(symbols: list[Symbol]) -> Iterator[tuple[Symbol, Symbol]]:
    for _, own in groupby(symbols, key=lambda symbol: symbol["element"]):
        toothed = [symbol for symbol in own if symbol["mark"] in TOOTHED]
        if len(toothed) == 2:
            yield toothed[0], toothed[1]


def _key(symbol: Symbol) -> Hashable:
    """Symbols with one key are one wheel or rack."""
    k = 1 if symbol["mark"] in WHEELS else 0
    at = tuple(round(x, 12) for x in symbol["points"][k])
    return symbol["mark"], symbol["bodies"][k], at, abs(symbol["radii"][1]) * k


def _connected(pairs: list[tuple[Symbol, Symbol]]) -> list[list[tuple[Symbol, Symbol]]]:
    groups: list[list[tuple[Symbol, Symbol]]] = []
    for pair in pairs:
        keys = {_key(one) for one in pair}
        touching = [g for g in groups if keys & {_key(one) for other in g for one in other}]
        groups = [g for g in groups if g not in touching]
        groups.append([*(other for g in touching for other in g), pair])
    return groups


def _in_order(group: list[tuple[Symbol, Symbol]]) -> Iterator[tuple[Symbol, Symbol]]:
    """The pairs of a group such that each has a wheel in common with those before."""
    left, seen = list(group), {_key(group[0][0])}
    while left:
        pair = next(pair for pair in left if seen & {_key(one) for one in pair})
        left.remove(pair)
        seen |= {_key(one) for one in pair}
        yield pair


def _module(symbols: list[Symbol]) -> float:
    given = [one["module"] for one in symbols if one["module"]]
    if given:
        return float(given[0])
    radii = np.array([abs(one["radii"][1]) for one in symbols])
    least = float(radii.min())

    def error(count: int) -> float:
        teeth = radii / least * count
        return float(np.abs(teeth - teeth.round()).max())

    best: int = next((n for n in _COUNTS if error(n) < _WHOLE), min(_COUNTS, key=error))
    return 2.0 * least / best


def _meshing(first: Symbol, second: Symbol, phase: float, module: float, poses: Floats) -> float:
    """The phase of the second symbol whose teeth are in the gaps of the first."""
    pitch = math.pi * module
    contact = _contact(first, second, poses)
    place, sign = _of_pitches(first, contact, pitch, poses)
    other, other_sign = _of_pitches(second, contact, pitch, poses)
    place -= phase * (float(first["radii"][1]) if first["mark"] in WHEELS else 1.0) / pitch
    # a gap of the first one is at this distance along the common tangent, in pitches
    gap = (0.5 - place) * sign
    shift = other + other_sign * gap  # whole where a tooth of the second one is in the gap
    if second["mark"] in WHEELS:
        return shift * pitch / float(second["radii"][1])
    return shift * pitch


def _contact(first: Symbol, second: Symbol, poses: Floats) -> tuple[Floats, Floats]:
    """Pitch point and the direction of the common tangent."""
    wheel, other = (first, second) if first["mark"] in WHEELS else (second, first)
    centre, radius = _end(wheel, 1, poses), float(wheel["radii"][1])
    if other["mark"] not in WHEELS:
        angle = poses[other["bodies"][0], 2] + other["axes"][0]
        along = np.array([math.cos(angle), math.sin(angle)])
        side = -math.copysign(1.0, other["radii"][1])
        return centre + side * radius * np.array([-along[1], along[0]]), along
    away = _end(other, 1, poses) - centre
    out = away / (float(np.hypot(*away)) or 1.0)
    if other["mark"] == "toothed_ring":
        out = -out
    return centre + radius * out, np.array([-out[1], out[0]])


def _of_pitches(
    symbol: Symbol, contact: tuple[Floats, Floats], pitch: float, poses: Floats
) -> tuple[float, float]:
    """The place of the pitch point on a symbol, in pitches, and its sense along the tangent."""
    point, along = contact
    if symbol["mark"] in WHEELS:
        arm = point - _end(symbol, 1, poses)
        turn = math.atan2(arm[1], arm[0]) - poses[symbol["bodies"][1], 2]
        sense = math.copysign(1.0, arm[0] * along[1] - arm[1] * along[0])
        return turn * float(symbol["radii"][1]) / pitch, sense
    angle = poses[symbol["bodies"][0], 2] + symbol["axes"][0]
    axis = np.array([math.cos(angle), math.sin(angle)])
    place = float(axis @ (point - _end(symbol, 0, poses)))
    return place / pitch, math.copysign(1.0, float(axis @ along))


def _end(symbol: Symbol, k: int, poses: Floats) -> Floats:
    return placed(poses[symbol["bodies"][k]], symbol["points"][k])
