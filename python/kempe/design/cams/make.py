"""Cams from a programme of the follower and its dimensions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from kempe import _core
from kempe.base.names import one_of
from kempe.design.cams.cam import Cam
from kempe.design.cams.curves import Drive
from kempe.design.cams.laws import TURN, programme_of
from kempe.design.cams.shape import Follower
from kempe.model.given import value
from kempe.model.values import Number, refuse

_SIZES = ("base_radius", "roller_radius", "offset", "face")


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

    A translating follower moves upwards along x = ``offset``. The arm of an oscillating one reaches
    over the cam: a lift turns it clockwise if the pivot is at the right, else counter-clockwise.

    Args:
        follower: "roller", "knife" or "flat".
        programme: segments ``("rise", angle, lift, law)``, ``("dwell", angle)``, and ``("return",
            angle, law)`` or ``("return", angle, drop, law)``, together a turn. Angles of the cam,
            rad or "120 deg"; lifts in m, or rad of an arm. ``cams.Programme`` has laws.
        base_radius: radius of the cam at no lift, m.
        roller_radius: of a roller, m.
        offset: of the line of travel to the right of the shaft, m; there it lowers the pressure
            angle of the rise if the cam turns counter-clockwise.
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
        ModelError: the programme does not close, the speed jumps, or dimensions do not assemble.
    """
    one_of("closure", closure, ("force", "groove", "conjugate"))
    one_of("direction", direction, ("ccw", "cw"))
    one_of("follower", follower, ("roller", "knife", "flat"))
    sizes = zip(_SIZES, (base_radius, roller_radius, offset, face), strict=True)
    base, roller, aside, below = (value(x, name, "m") for name, x in sizes)
    of = Follower(follower, base, roller, aside, *_pivoted(arm, pivot), below)
    cw, unit = direction == "cw", "m" if of.arm is None else "rad"
    if cw:  # the mirror image
        of = replace(of, offset=-of.offset, pivot=-of.pivot.conjugate())
    drive = _drive(speed, mass, spring, gravity, unit == "m")
    result = Cam(programme_of(programme, unit), of, cw, closure, drive)
    _core.cam_check(result)
    return result


def _pivoted(arm: Number | None, pivot: Sequence[Number] | None) -> tuple[float | None, complex]:
    """The arm and the pivot of an oscillating follower."""
    if (arm is None) != (pivot is None):
        missing = "arm" if arm is None else "pivot"
        refuse(missing, "an oscillating follower needs arm and pivot; give both or neither")
    if arm is None or pivot is None:
        return None, 0j
    if isinstance(pivot, str) or not hasattr(pivot, "__len__") or len(pivot) != 2:
        refuse("pivot", f"{pivot!r}; must be (x, y)")
    x, y = (value(part, "pivot", "m") for part in pivot)
    return value(arm, "arm", "m"), complex(x, y)


def _drive(
    speed: Number, mass: Number, spring: Sequence[Number], gravity: Number, translating: bool
) -> Drive:
    """Speed, mass and spring as numbers."""
    turned = value(speed, "speed", "s^-1")
    heavy = value(mass, "mass", "kg")
    if isinstance(spring, str) or not hasattr(spring, "__len__") or len(spring) != 2:
        refuse("spring", f"{spring!r}; must be (stiffness, force at no lift)")
    units = ("N/m", "N") if translating else ("N*m", "N*m")
    pairs = zip(("spring[1]", "spring[2]"), spring, units, strict=True)
    stiffness, force = (value(x, path, unit) for path, x, unit in pairs)
    return Drive(turned, heavy, (stiffness, force), value(gravity, "gravity", "m*s^-2"))
