"""The lift of a cam's follower over the angle of the cam, from segments with motion laws."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.model.given import value
from kempe.model.values import refuse

if TYPE_CHECKING:
    from kempe._core import CamSegment

TURN = 2.0 * pi
#: The named laws of a segment.
LAWS = tuple(_core.cam_laws())


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
    amplitude: float
    frequency: float
    phase: float


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
        angles = np.asarray(angle, dtype=np.float64)
        return _core.cam_lift(self, angles.ravel(), order).reshape(angles.shape)

    def sampled(self, step: float = pi / 360.0) -> tuple[Floats, Floats]:
        """Angles and the lift with three derivatives, (n,) and (4, n).

        The ends of all pieces are among them, once for each of the two pieces that meet there.
        """
        angles, rows = _core.cam_sampled(self, step)
        return angles, rows.reshape(-1, 4).T


def programme_of(given: Any, unit: str) -> Programme:
    """The programme of a list of segments; ``kp.design.cam`` describes them.

    Raises:
        ModelError: the segments do not make a turn, do not return, or the speed jumps.
    """
    if isinstance(given, str | bytes | Mapping) or not hasattr(given, "__iter__"):
        refuse("programme", f"{given!r}; must be a list of segments such as {_FORMS['dwell']}")
    segments = [_segment(one, f"programme[{k}]", unit) for k, one in enumerate(given, 1)]
    pieces, size, least, jumps = _core.cam_programme(segments, unit == "rad")
    return Programme(
        tuple(Piece(start, end, tuple(powers), *wave) for start, end, powers, *wave in pieces),
        unit,
        size,
        least,
        tuple(jumps),
    )


_FORMS = {
    "rise": "('rise', '120 deg', 0.01, 'cycloidal')",
    "return": "('return', '120 deg', 'cycloidal')",
    "dwell": "('dwell', '60 deg')",
}


def _segment(given: Any, path: str, unit: str) -> CamSegment:
    """What it does, its angle, change of the lift, and law."""
    parts = list(given) if isinstance(given, Sequence) and not isinstance(given, str) else []
    kind = parts[0] if parts else None
    if not isinstance(kind, str) or kind not in _FORMS:
        refuse(path, f"{given!r}; must be such as {', '.join(_FORMS.values())}")
    count = {"dwell": (2,), "rise": (4,), "return": (3, 4)}[kind]
    if len(parts) not in count:
        refuse(path, f"{given!r} has {len(parts)} parts; must be such as {_FORMS[kind]}")
    length = value(parts[1], f"{path} angle", "rad")
    if kind == "dwell":
        return kind, length, None, "linear", ([], []), None
    height = value(parts[2], f"{path} lift", unit) if len(parts) == 4 else None
    return kind, length, height, *_law(parts[-1], path, unit)


def _law(
    law: Any, path: str, unit: str
) -> tuple[str | None, tuple[list[float], list[float]], list[tuple[float, float]] | None]:
    """The name of a law, derivatives at its ends, and points of a spline."""
    if isinstance(law, str):
        return law, ([], []), None
    if not isinstance(law, Mapping) or law.get("type") not in ("polynomial", "spline"):
        form = "{'type': 'polynomial', 'start': [0, 0], 'end': [0, 0]}"
        refuse(f"{path} law", f"{law!r}; must be a name or a mapping such as {form}")
    known = {"type", "start", "end"} | ({"points"} if law["type"] == "spline" else set())
    for key in law:
        if key not in known:
            refuse(f"{path} law", f"unknown key {key!r}; must be {', '.join(sorted(known))}")
    start, end = (_end(law.get(key, [0, 0]), f"{path} {key}", unit) for key in ("start", "end"))
    if law["type"] == "polynomial":
        return None, (start, end), None
    points = []
    for k, point in enumerate(law.get("points", []), 1):
        place = f"{path} points[{k}]"
        if isinstance(point, str) or not hasattr(point, "__len__") or len(point) != 2:
            refuse(place, f"{point!r}; must be [angle, lift]")
        points.append((value(point[0], place, "rad"), value(point[1], place, unit)))
    return None, (start, end), points


def _end(given: Any, path: str, unit: str) -> list[float]:
    """Speed, acceleration … by the angle at an end."""
    if isinstance(given, str | bytes) or not hasattr(given, "__iter__"):
        refuse(path, f"{given!r}; must be [speed, acceleration], in {unit}/rad and {unit}/rad^2")
    found = list(given)
    if len(found) > 4:
        refuse(path, f"{len(found)} derivatives; must be at most four")
    return [value(x, f"{path}[{k}]", "m" if unit == "m" else "") for k, x in enumerate(found, 1)]
