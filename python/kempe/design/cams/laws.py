"""The lift of a cam's follower over the angle of the cam: segments, motion laws, their pieces.

A law is a list of pieces, each the sum of a polynomial and a sine. All derivatives are exact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import factorial, pi
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.exports import needed
from kempe.model.given import value
from kempe.model.values import refuse

TURN = 2.0 * pi
#: Numbers that differ by less, relative to the largest of them, are the same.
SAME = 1e-9
#: Accelerations of the laws that are joined sines: the end of each piece, and the constant, the
#: amplitude, the frequency and the phase at its beginning, as multiples of the factor of the law
#: (Norton, Cam Design and Manufacturing Handbook, chapters 2 and 3).
_JOINED: dict[str, tuple[float, list[tuple[float, float, float, float, float]]]] = {
    "cycloidal": (2.0 * pi, [(1.0, 0.0, 1.0, 2.0 * pi, 0.0)]),
    "harmonic": (pi**2 / 2.0, [(1.0, 0.0, 1.0, pi, pi / 2.0)]),
    "modified_sine": (
        4.0 * pi**2 / (4.0 + pi),
        [
            (0.125, 0.0, 1.0, 4.0 * pi, 0.0),
            (0.875, 0.0, 1.0, 4.0 * pi / 3.0, pi / 2.0),
            (1.0, 0.0, 1.0, 4.0 * pi, -pi / 2.0),
        ],
    ),
    "modified_trapezoid": (
        8.0 * pi / (2.0 + pi),
        [
            (0.125, 0.0, 1.0, 4.0 * pi, 0.0),
            (0.375, 1.0, 0.0, 1.0, 0.0),
            (0.625, 0.0, 1.0, 4.0 * pi, pi / 2.0),
            (0.875, -1.0, 0.0, 1.0, 0.0),
            (1.0, 0.0, 1.0, 4.0 * pi, -pi / 2.0),
        ],
    ),
}
_POWERS: dict[str, list[float]] = {
    "linear": [0.0, 1.0],
    "poly345": [0.0, 0.0, 0.0, 10.0, -15.0, 6.0],
    "poly4567": [0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0],
}
#: The named laws of a segment.
LAWS = (*_JOINED, *_POWERS)


@dataclass(frozen=True)
class Piece:
    """s = Σ powers[k] x^k + amplitude sin(frequency x + phase) for x = angle - start ≥ 0.

    Attributes:
        start, end: angles of the cam, rad.
        powers: of the polynomial.
        amplitude, frequency, phase: of the sine.
    """

    start: float
    end: float
    powers: tuple[float, ...]
    amplitude: float = 0.0
    frequency: float = 1.0
    phase: float = 0.0

    def at(self, angle: Any, order: int = 0) -> Any:
        """The derivative of an order at angles, also beyond the ends of the piece."""
        x = np.asarray(angle, dtype=np.float64) - self.start
        powers = self.powers[order:]
        found = np.zeros_like(x)
        for k in reversed(range(len(powers))):
            found = found * x + powers[k] * factorial(k + order) / factorial(k)
        if self.amplitude:
            turned = self.frequency * x + self.phase + order * pi / 2.0
            found = found + self.amplitude * self.frequency**order * np.sin(turned)
        return found

    def placed(self, start: float, length: float, base: float, height: float) -> Piece:
        """A piece of the unit law, stretched to a segment."""
        powers = [height * c / length**k for k, c in enumerate(self.powers)]
        powers[0] += base
        return Piece(
            start + length * self.start,
            start + length * self.end,
            tuple(powers),
            height * self.amplitude,
            self.frequency / length,
            self.phase,
        )


def unit_law(name: str) -> list[Piece]:
    """The pieces of a named law, which rises from 0 at 0 to 1 at 1."""
    if name in _POWERS:
        return [Piece(0.0, 1.0, tuple(_POWERS[name]))]
    factor, given = _JOINED[name]
    made: list[Piece] = []
    start, place, speed = 0.0, 0.0, 0.0
    for end, constant, amplitude, frequency, phase in given:
        size = -amplitude * factor / frequency**2
        own = (
            place - size * np.sin(phase),
            speed - size * frequency * np.cos(phase),
            constant * factor / 2.0,
        )
        made.append(Piece(start, end, own, size, frequency, phase))
        start = end
        place, speed = (float(made[-1].at(end, order)) for order in (0, 1))
    return made


@dataclass(frozen=True)
class Programme:
    """The lift over a turn of the cam, from segments with these laws.

    * "cycloidal", "harmonic", "modified_sine", "modified_trapezoid", "poly345", "poly4567", and
      "linear" with a constant speed;
    * ``{"type": "polynomial", "start": [speed, acceleration, …], "end": […]}``: the polynomial of
      least degree with these derivatives by the angle at its ends, up to four, [0, 0] if absent;
    * ``{"type": "spline", "points": [(angle, lift), …], "start": [speed, acceleration], "end":
      […]}``: the quintic spline through points, with angles from the beginning of the segment.

    Source: Norton, Cam Design and Manufacturing Handbook, 2nd edition, 2009, chapters 2 and 3.

    Attributes:
        pieces: from 0 to 2π.
        unit: "m", or "rad" for an oscillating follower.
        size: the largest lift.
        least: the smallest lift.
        jumps: angles at which the acceleration jumps, rad, and the jumps per rad².
    """

    pieces: tuple[Piece, ...]
    unit: str
    size: float
    least: float
    jumps: tuple[tuple[float, float], ...]

    def at(self, angle: Any, order: int = 0) -> Floats:
        """The lift, or its derivative of an order by the angle of the cam, at any angles, rad."""
        turned = np.asarray(angle, dtype=np.float64) % TURN
        starts = [piece.start for piece in self.pieces]
        place = np.clip(np.searchsorted(starts, turned, "right") - 1, 0, None)
        found = np.empty_like(turned)
        for k, piece in enumerate(self.pieces):
            own = place == k
            found[own] = piece.at(turned[own], order)
        return found

    def sampled(self, step: float = pi / 360.0) -> tuple[Floats, Floats]:
        """Angles and the lift with three derivatives, (n,) and (4, n).

        The ends of all pieces are among them, once for each of the two pieces that meet there.
        """
        angles, rows = [], []
        for piece in self.pieces:
            count = max(33, int(np.ceil((piece.end - piece.start) / step)))
            own = np.linspace(piece.start, piece.end, count)
            angles.append(own)
            rows.append(np.stack([piece.at(own, order) for order in range(4)]))
        return np.concatenate(angles), np.concatenate(rows, axis=1)


def programme_of(given: Any, unit: str) -> Programme:
    """The programme of a list of segments; ``kp.design.cam`` describes them.

    Raises:
        ModelError: the segments do not make a turn, do not return, or the speed jumps.
    """
    if isinstance(given, str | bytes | Mapping) or not hasattr(given, "__iter__"):
        refuse("programme", f"{given!r}; must be a list of segments such as {_FORMS['dwell']}")
    pieces: list[Piece] = []
    angle = lift = 0.0
    segments = list(given)
    for k, segment in enumerate(segments, 1):
        path = f"programme[{k}]"
        length, height, law = _segment(segment, path, unit, lift)
        pieces += _placed(law, path, unit, (angle, length, lift, height))
        angle, lift = angle + length, lift + height
    if not pieces:
        refuse("programme", "has no segments; add a rise and a return")
    _closed(angle, lift, pieces, unit)
    # rounding: the last piece ends at 2π, and a lift that has returned is 0
    pieces[-1] = Piece(**{**pieces[-1].__dict__, "end": TURN})
    heights = np.concatenate(
        [piece.at(np.linspace(piece.start, piece.end, 65)) for piece in pieces]
    )
    size = float(heights.max())
    if not size > 0.0:
        refuse("programme", "the follower does not move; add a rise and a return")
    jumps = _jumps(pieces, size, unit)
    return Programme(tuple(pieces), unit, size, float(heights.min()), jumps)


_FORMS = {
    "rise": "('rise', '120 deg', 0.01, 'cycloidal')",
    "return": "('return', '120 deg', 'cycloidal')",
    "dwell": "('dwell', '60 deg')",
}


def _segment(given: Any, path: str, unit: str, lift: float) -> tuple[float, float, Any]:
    """Its angle, change of the lift, and law."""
    parts = list(given) if isinstance(given, Sequence) and not isinstance(given, str) else []
    kind = parts[0] if parts else None
    if not isinstance(kind, str) or kind not in _FORMS:
        refuse(path, f"{given!r}; must be such as {', '.join(_FORMS.values())}")
    count = {"dwell": (2,), "rise": (4,), "return": (3, 4)}[kind]
    if len(parts) not in count:
        refuse(path, f"{given!r} has {len(parts)} parts; must be such as {_FORMS[kind]}")
    length = value(parts[1], f"{path} angle", "rad")
    if not 0.0 < length <= TURN * (1.0 + SAME):
        refuse(f"{path} angle", f"{parts[1]!r}; must be positive, at most 360 deg")
    if kind == "dwell":
        return length, 0.0, "linear"
    full = kind == "return" and len(parts) == 3
    height = lift if full else value(parts[2], f"{path} lift", unit)
    if not height > 0.0:
        told = "there is no lift from which to return; begin with a rise" if full else "must be > 0"
        refuse(f"{path} lift", f"{height:g}; {told}")
    if kind == "return" and abs(height - lift) <= SAME * lift:
        height = lift
    return length, height if kind == "rise" else -height, parts[-1]


def _placed(
    law: Any, path: str, unit: str, place: tuple[float, float, float, float]
) -> list[Piece]:
    """The pieces of a segment at (angle, length, lift, height)."""
    angle, length, lift, height = place
    if isinstance(law, str):
        if law not in LAWS:
            told = f"{law!r}; must be {', '.join(LAWS)}, or a polynomial or spline"
            refuse(f"{path} law", told)
        return [one.placed(angle, length, lift, height) for one in unit_law(law)]
    if not isinstance(law, Mapping) or law.get("type") not in ("polynomial", "spline"):
        form = "{'type': 'polynomial', 'start': [0, 0], 'end': [0, 0]}"
        refuse(f"{path} law", f"{law!r}; must be a name or a mapping such as {form}")
    known = {"type", "start", "end"} | ({"points"} if law["type"] == "spline" else set())
    for key in law:
        if key not in known:
            refuse(f"{path} law", f"unknown key {key!r}; must be {', '.join(sorted(known))}")
    ends = [_end(law.get(key, [0, 0]), f"{path} {key}", unit) for key in ("start", "end")]
    if law["type"] == "polynomial":
        return [_polynomial(ends, place)]
    return _spline(law.get("points", []), ends, f"{path} points", unit, place)


def _end(given: Any, path: str, unit: str) -> list[float]:
    """Speed, acceleration … by the angle at an end."""
    if isinstance(given, str | bytes) or not hasattr(given, "__iter__"):
        refuse(path, f"{given!r}; must be [speed, acceleration], in {unit}/rad and {unit}/rad^2")
    found = list(given)
    if len(found) > 4:
        refuse(path, f"{len(found)} derivatives; must be at most four")
    return [value(x, f"{path}[{k}]", "m" if unit == "m" else "") for k, x in enumerate(found, 1)]


def _polynomial(ends: list[list[float]], place: tuple[float, float, float, float]) -> Piece:
    """The polynomial of least degree with given derivatives at both ends."""
    angle, length, lift, height = place
    first, last = ([0.0, *ends[0]], [height, *ends[1]])
    count = len(first) + len(last)
    rows, right = [], []
    for x, known in ((0.0, first), (1.0, last)):
        for order, known_value in enumerate(known):
            row = np.zeros(count)
            for k in range(order, count):
                row[k] = factorial(k) / factorial(k - order) * (1.0 if k == order else x)
            rows.append(row)
            right.append(known_value * length**order)
    powers = np.linalg.solve(np.array(rows), np.array(right))
    unit = Piece(0.0, 1.0, tuple(powers.tolist()))
    return unit.placed(angle, length, lift, 1.0)


def _spline(
    given: Any,
    ends: list[list[float]],
    path: str,
    unit: str,
    place: tuple[float, float, float, float],
) -> list[Piece]:
    """The quintic spline through points: angle from the beginning of the segment, and lift."""
    of = needed("scipy.interpolate", "design", "a spline of a cam")
    angle, length, lift, height = place
    rows = [(0.0, 0.0)]
    for k, point in enumerate(given, 1):
        if isinstance(point, str) or not hasattr(point, "__len__") or len(point) != 2:
            refuse(f"{path}[{k}]", f"{point!r}; must be [angle, lift]")
        at, up = (value(x, f"{path}[{k}]", u) for x, u in zip(point, ("rad", unit), strict=True))
        rows.append((at / length, up - lift))
    rows.append((1.0, height))
    x, y = np.array(rows).T
    if not (np.diff(x) > SAME).all():
        refuse(path, "their angles must grow within the segment, and lie between its ends")
    if len(ends[0]) != 2 or len(ends[1]) != 2:
        refuse(path.replace("points", "law"), "start and end of a spline: [speed, acceleration]")
    conditions = [[(k, d * length**k) for k, d in enumerate(end, 1)] for end in ends]
    spline = of.make_interp_spline(x, y, k=5, bc_type=tuple(conditions))
    found = of.PPoly.from_spline(spline)
    made = []
    for (start, end), powers in zip(pairwise(found.x), found.c[::-1].T, strict=True):
        if end - start > 1e-12:
            unit_piece = Piece(float(start), float(end), tuple(powers.tolist()))
            made.append(unit_piece.placed(angle, length, lift, 1.0))
    return made


def _closed(angle: float, lift: float, pieces: list[Piece], unit: str) -> None:
    """Refuse a programme that is no turn, or does not return."""
    if abs(angle - TURN) > SAME * TURN:
        covered, missing = np.degrees(angle), np.degrees(TURN - angle)
        told = f"add ('dwell', '{missing:.6g} deg')" if missing > 0 else "shorten a segment"
        refuse("programme", f"its segments cover {covered:.6g}°, not 360°; {told}")
    top = max(abs(float(piece.at(piece.end))) for piece in pieces)
    if abs(lift) > SAME * top:
        told = f"ends {lift:.6g} {unit} above its start; add ('return', angle, law)"
        if lift < 0.0:
            told = f"ends {-lift:.6g} {unit} below its start; return less, or rise more"
        refuse("programme", f"the follower {told}")


def _jumps(pieces: list[Piece], size: float, unit: str) -> tuple[tuple[float, float], ...]:
    """The jumps of the acceleration; a jump of the speed is refused."""
    found = []
    for before, after in zip(pieces[-1:] + pieces[:-1], pieces, strict=True):
        speed, acceleration = (
            float(after.at(after.start, order) - before.at(before.end, order)) for order in (1, 2)
        )
        where = np.degrees(after.start)
        if abs(speed) > 1e-7 * size:
            told = f"the speed jumps by {speed:.6g} {unit}/rad at {where:.6g}°; "
            told += "choose a law that begins and ends at rest, such as 'cycloidal', or a "
            told += "polynomial whose start and end have the speed of its neighbours"
            refuse("programme", told)
        if abs(acceleration) > 1e-6 * size:
            found.append((after.start, acceleration))
    return tuple(found)
