"""Defects of four-bars at the positions of a task, for many linkages at once.

A linkage closes in two ways: B lies on the left or on the right of the line from A to D. As the
crank turns, the two closures meet where B lies on this line, at a dead point. A linkage that obeys
Grashof's condition, s + l < p + q, has two circuits that never join: the two angles at the ends of
the link opposite the shortest one keep their signs. Any other linkage has one circuit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.synthesis.tasks import Complexes

Flags = NDArray[np.bool_]

#: The defects that exclude a candidate, in the order in which a candidate lists them.
KINDS = ("circuit", "branch", "dead point", "order")
#: Sine of the transmission angle at a dead point, and relative margin of Grashof's condition.
_DEAD, _MARGIN = 1e-6, 1e-9


@dataclass(frozen=True)
class Judged:
    """Properties of linkages at the positions of a task.

    Attributes:
        lengths: crank, coupler, rocker and ground, (n, 4).
        places: for each of ``KINDS``, the first position with this defect from 0, or -1, (4, n).
        turns: whether the crank makes full turns.
        grashof: whether s + l ≤ p + q.
        least: the least transmission angle over the full turn; 0 if there is a dead point.
        here: the least transmission angle at the positions.
        forward: whether the crank turns counter-clockwise through the positions.
    """

    lengths: Floats
    places: NDArray[np.int64]
    turns: Flags
    grashof: Flags
    least: Floats
    here: Floats
    forward: Flags

    @property
    def count(self) -> NDArray[np.int64]:
        """The number of defects of each linkage."""
        return np.asarray((self.places >= 0).sum(axis=0))


def judged(o: Complexes, a: Complexes, b: Complexes, d: Complexes, way: int = 0) -> Judged:
    """The defects of four-bars.

    Args:
        o: ground pivots of the cranks, (n,).
        a: moving pins of the cranks at the positions, (n, n_positions).
        b: moving pins of the rockers at the positions, (n, n_positions).
        d: ground pivots of the rockers, (n,).
        way: 1 if the crank must turn counter-clockwise, -1 for clockwise, 0 for either.
    """
    sides = abs(a[:, 0] - o), abs(b[:, 0] - a[:, 0]), abs(b[:, 0] - d), abs(d - o)
    lengths: Floats = np.column_stack(sides).astype(np.float64)
    crank, coupler, rocker, ground = lengths.T
    ordered = np.sort(lengths, axis=1)
    room = ordered[:, 1] + ordered[:, 2] - ordered[:, 0] - ordered[:, 3]
    margin = _MARGIN * ordered[:, 3]
    double = room > margin
    # signs at B, O and D: of the triangle of the joint and its two neighbours
    with np.errstate(all="ignore"):
        sine = cross(a - b, d[:, None] - b) / (coupler * rocker)[:, None]
    at_o, at_d = cross(a - o[:, None], (d - o)[:, None]), cross(b - d[:, None], (o - d)[:, None])
    shortest = np.argmin(lengths, axis=1)[:, None]
    circuit = np.where(shortest == 2, at_o, np.where(shortest == 1, at_d, sine)) > 0.0
    low = abs(crank - ground) < abs(coupler - rocker) - margin
    high = crank + ground > coupler + rocker + margin
    turning = ~low & ~high & double
    angle = np.angle(a - o[:, None])
    order, forward = _order(angle, turning, np.angle(d - o), (low, high), way)
    dead = np.abs(sine) < _DEAD
    # a linkage at the margin of Grashof's condition passes a dead point where it folds
    folding = (~double & (room > -margin))[:, None] & (at_o * at_o[:, :1] < 0.0)
    places = np.stack(
        [
            _first(double[:, None] & (circuit != circuit[:, :1])),
            _first((sine > 0.0) != (sine[:, :1] > 0.0)),
            _first(dead | folding),
            order,
        ]
    )
    places[1] = np.where(places[0] >= 0, -1, places[1])
    places[3] = np.where((places[:2] >= 0).any(axis=0), -1, places[3])
    least = np.where(turning, _over_turn(lengths), 0.0)
    here = np.arcsin(np.clip(np.abs(sine), 0.0, 1.0)).min(axis=1)
    return Judged(lengths, places, turning, room >= -margin, least, here, forward)


def judged_slides(
    o: Complexes, a: Complexes, b: Complexes, way_of_slide: Complexes, way: int = 0
) -> Judged:
    """The defects of slider-cranks, as ``judged``.

    The closures meet where the coupler is normal to the slide. A crank turns fully if its pin
    stays within the length of the coupler from the line of the slide.

    Args:
        o: ground pivots, (n,).
        a: pins of the cranks, (n, n_positions).
        b: pins of the slides, (n, n_positions).
        way_of_slide: directions of the slides, (n,).
        way: see ``judged``.
    """
    slide = way_of_slide[:, None]
    crank, coupler = abs(a - o[:, None])[:, 0], abs(b - a)[:, 0]
    offset = cross(slide, o[:, None] - b)[:, 0]
    margin = _MARGIN * (coupler + crank + abs(offset))
    high, low = offset + crank > coupler + margin, crank - offset > coupler + margin
    turning = (abs(offset) + crank) < coupler - margin
    sine = (np.conj(slide) * (b - a)).real / coupler[:, None]
    # a crank that is limited on both sides keeps its side of the normal of the slide
    side = (np.conj(slide) * (a - o[:, None])).real
    circuit = np.where(turning[:, None], sine, np.where((low & high)[:, None], side, 1.0)) > 0.0
    # angles from the normal on which both limits are symmetric
    normal = np.angle(way_of_slide) - np.pi / 2.0
    angle = np.angle(a - o[:, None])
    order, forward = _order(angle, turning, normal, (low, high), way)
    places = np.stack(
        [
            _first(circuit != circuit[:, :1]),
            _first((sine > 0.0) != (sine[:, :1] > 0.0)),
            _first(np.abs(sine) < _DEAD),
            order,
        ]
    )
    places[1] = np.where(places[0] >= 0, -1, places[1])
    places[3] = np.where((places[:2] >= 0).any(axis=0), -1, places[3])
    far = (abs(offset) + crank) / coupler
    least = np.where(turning, np.pi / 2.0 - np.arcsin(np.clip(far, 0.0, 1.0)), 0.0)
    here = np.arcsin(np.clip(np.abs(sine), 0.0, 1.0)).min(axis=1)
    lengths = np.column_stack([crank, coupler, np.full_like(crank, np.inf), abs(offset)])
    return Judged(lengths, places, turning, turning, least, here, forward)


def cross(x: Complexes, y: Complexes) -> Floats:
    """The third component of the cross product."""
    return np.asarray((np.conj(x) * y).imag)


def _first(flags: Flags) -> NDArray[np.int64]:
    return np.where(flags.any(axis=1), flags.argmax(axis=1), -1)


def _over_turn(lengths: Floats) -> Floats:
    """The least transmission angle of a crank that turns fully: A is nearest or farthest to D."""
    crank, coupler, rocker, ground = lengths.T
    found = np.full(len(lengths), np.pi / 2.0)
    with np.errstate(all="ignore"):
        for far in (abs(crank - ground), crank + ground):
            cosine = (coupler**2 + rocker**2 - far**2) / (2.0 * coupler * rocker)
            found = np.minimum(found, np.pi / 2.0 - np.arcsin(np.clip(np.abs(cosine), 0.0, 1.0)))
    return found


def _order(
    angle: Floats, turning: Flags, ground: Floats, limits: tuple[Flags, Flags], way: int
) -> tuple[NDArray[np.int64], Flags]:
    """The first position out of order, or -1, and whether the crank turns counter-clockwise."""
    if angle.shape[1] < 2:
        return np.full(len(angle), -1), np.full(len(angle), way >= 0)
    low, high = limits
    # a crank between limits: angles from the middle of its range
    at_o = np.sin(angle[:, 0] - ground)
    middle = ground + np.where(low & high, np.copysign(np.pi / 2.0, at_o), np.where(low, np.pi, 0))
    inside = (angle - middle[:, None] + np.pi) % (2.0 * np.pi)
    cyclic = np.diff(angle, axis=1) % (2.0 * np.pi)
    straight = np.diff(inside, axis=1)
    found, wrong = [], []
    for sign in (1, -1):
        steps = cyclic if sign > 0 else (2.0 * np.pi - cyclic)
        late = np.where(turning[:, None], steps.cumsum(axis=1) >= 2.0 * np.pi, sign * straight <= 0)
        place = _first(late)
        found.append(np.where(place >= 0, place + 1, -1))
        wrong.append(late.sum(axis=1) + (1000 if way == -sign else 0))
    span = cyclic.sum(axis=1)
    tie = np.where(turning, span <= np.pi * angle.shape[1] - np.pi, True)
    forward = (wrong[0] < wrong[1]) | ((wrong[0] == wrong[1]) & tie)
    return np.where(forward, found[0], found[1]), forward
