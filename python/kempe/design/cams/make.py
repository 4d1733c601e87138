"""Cams from a programme of the follower and its dimensions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from kempe.base.names import one_of
from kempe.design.cams.cam import Cam
from kempe.design.cams.curves import Drive
from kempe.design.cams.laws import TURN, programme_of
from kempe.design.cams.shape import Follower
from kempe.model.given import value
from kempe.model.values import Number, refuse


def cam(
    follower: str,
    programme: Sequence[Any],
    *,
    base_radius: Number,
    roller_radius: Number = 0.0,
    offset: Number = 0.0,
    arm: Number | None = None,
    pivot: Sequence[Number] | None = None,
    face: Number = 0.0,
    closure: str = "force",
    direction: str = "ccw",
    speed: Number = TURN,
    mass: Number = 1.0,
    spring: Sequence[Number] = (0.0, 0.0),
    gravity: Number = 9.81,
) -> Cam:
    """A cam whose shaft is at the origin, for a follower that moves by a programme.

    A translating follower moves upwards along the line x = ``offset``. An oscillating one has an
    ``arm`` and a ``pivot``; its arm reaches over the cam, so that a lift turns it clockwise if the
    pivot is at the right, and counter-clockwise if it is at the left.

    Segments of the programme, with angles of the cam in rad or as "120 deg", and lifts in m, or in
    rad for an oscillating follower:

    * ``("rise", angle, lift, law)``
    * ``("dwell", angle)``
    * ``("return", angle, law)`` back to no lift, or ``("return", angle, drop, law)``

    A law is "cycloidal", "harmonic", "modified_sine", "modified_trapezoid", "poly345", "poly4567"
    or "linear"; ``{"type": "polynomial", "start": [speed, acceleration, …], "end": […]}``, the
    polynomial of least degree with these derivatives by the angle at its ends, up to four; or
    ``{"type": "spline", "points": [(angle, lift), …], "start": […], "end": […]}``, the quintic
    spline through points, with angles from the beginning of the segment.

    Args:
        follower: "roller", "knife" or "flat".
        programme: the segments; together a turn.
        base_radius: radius of the cam at no lift, m.
        roller_radius: of a roller, m.
        offset: of the line of travel to the right of the shaft, m. On the side that lowers the
            pressure angle of the rise: to the right if the cam turns counter-clockwise.
        arm: length from the pivot to the roller's centre, or of the bar with a flat face, m.
        pivot: place of the pivot, m.
        face: distance of a flat face of an oscillating follower from its pivot, towards the cam, m.
        closure: "force": spring or weight; "groove": the roller runs between two walls;
            "conjugate": a second cam on the shaft moves a second roller or face of the follower.
        direction: "ccw" or "cw", in which the cam turns.
        speed: of the cam, rad/s.
        mass: of the follower, kg; an oscillating one is a uniform bar of the length ``arm``.
        spring: stiffness, and force towards the cam at no lift: N/m and N; N·m/rad and N·m.
        gravity: downwards, m/s².

    Raises:
        ModelError: the programme does not close, the speed of the follower jumps, dimensions are
            missing, contradictory or do not assemble.

    Source: Norton, Cam Design and Manufacturing Handbook, 2nd edition, 2009, chapters 2 to 8.
    """
    one_of("follower", follower, ("roller", "knife", "flat"))
    one_of("closure", closure, ("force", "groove", "conjugate"))
    one_of("direction", direction, ("ccw", "cw"))
    lengths = {"base_radius": base_radius, "roller_radius": roller_radius, "offset": offset}
    found = {name: value(x, name, "m") for name, x in lengths.items()}
    _dimensions(follower, closure, found, arm is None)
    cw = direction == "cw"
    far, place = _pivoted(arm, pivot)
    sign = -1.0 if cw else 1.0
    of = Follower(
        follower,
        found["base_radius"],
        found["roller_radius"],
        sign * found["offset"],
        far,
        complex(sign * place.real, place.imag),
        value(face, "face", "m"),
    )
    if of.face and (follower != "flat" or far is None):
        refuse("face", "only an oscillating flat follower has it; leave it out")
    made = programme_of(programme, "m" if far is None else "rad")
    of.check(made.size)
    drive = _drive(speed, mass, spring, gravity, far is None)
    result = Cam(made, of, cw, closure, drive)
    result.at(np.zeros(1))
    return result


def _dimensions(follower: str, closure: str, of: dict[str, float], translating: bool) -> None:
    """Refuse radii and offsets that do not belong to the follower."""
    if not 0.0 < of["base_radius"] < np.inf:
        refuse("base_radius", f"{of['base_radius']:g} m; must be > 0")
    roller = of["roller_radius"]
    if follower == "roller" and not 0.0 < roller < np.inf:
        refuse("roller_radius", f"{roller:g} m; must be > 0, or choose follower='knife'")
    if follower != "roller" and roller != 0.0:
        refuse("roller_radius", f"a {follower} has no roller; choose follower='roller'")
    if closure == "groove" and follower != "roller":
        refuse("closure", "a groove needs follower='roller'")
    if of["offset"] != 0.0 and not translating:
        refuse("offset", "an oscillating follower has a pivot in place of an offset; leave it out")


def _pivoted(arm: Number | None, pivot: Sequence[Number] | None) -> tuple[float | None, complex]:
    """The arm and the pivot of an oscillating follower."""
    if (arm is None) != (pivot is None):
        missing = "arm" if arm is None else "pivot"
        refuse(missing, "an oscillating follower needs arm and pivot; give both or neither")
    if arm is None or pivot is None:
        return None, 0j
    far = value(arm, "arm", "m")
    if not 0.0 < far < np.inf:
        refuse("arm", f"{far:g} m; must be > 0")
    if isinstance(pivot, str) or not hasattr(pivot, "__len__") or len(pivot) != 2:
        refuse("pivot", f"{pivot!r}; must be (x, y)")
    x, y = (value(part, "pivot", "m") for part in pivot)
    if not 0.0 < np.hypot(x, y) < np.inf:
        refuse("pivot", "must not be at the shaft, (0, 0)")
    return far, complex(x, y)


def _drive(
    speed: Number, mass: Number, spring: Sequence[Number], gravity: Number, translating: bool
) -> Drive:
    """Speed, mass and spring as numbers."""
    turned = value(speed, "speed", "s^-1")
    heavy = value(mass, "mass", "kg")
    if not 0.0 < turned < np.inf:
        refuse("speed", f"{turned:g} rad/s; must be > 0; direction='cw' turns the other way")
    if not 0.0 <= heavy < np.inf:
        refuse("mass", f"{heavy:g} kg; must not be negative")
    if isinstance(spring, str) or not hasattr(spring, "__len__") or len(spring) != 2:
        refuse("spring", f"{spring!r}; must be (stiffness, force at no lift)")
    units = ("N/m", "N") if translating else ("N*m", "N*m")
    pairs = zip(("spring[1]", "spring[2]"), spring, units, strict=True)
    stiffness, force = (value(x, path, unit) for path, x, unit in pairs)
    if stiffness < 0.0:
        refuse("spring", f"{stiffness:g}; the stiffness must not be negative")
    return Drive(turned, heavy, (stiffness, force), value(gravity, "gravity", "m*s^-2"))
