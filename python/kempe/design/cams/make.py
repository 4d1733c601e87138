"""Cams from a programme of the follower and its dimensions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
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
    lengths = {"base_radius": base_radius, "roller_radius": roller_radius, "offset": offset}
    found = {name: value(x, name, "m") for name, x in lengths.items()}
    of = _follower(follower, closure, found | {"face": value(face, "face", "m")}, arm, pivot)
    cw, unit = direction == "cw", "m" if of.arm is None else "rad"
    if cw:  # the mirror image
        of = replace(of, offset=-of.offset, pivot=-of.pivot.conjugate())
    made = programme_of(programme, unit)
    of.check(made.size)
    result = Cam(made, of, cw, closure, _drive(speed, mass, spring, gravity, unit == "m"))
    result.at(np.zeros(1))
    return result


def _follower(
    kind: str,
    closure: str,
    of: Mapping[str, float],
    arm: Number | None,
    pivot: Sequence[Number] | None,
) -> Follower:
    """The follower with its dimensions."""
    one_of("follower", kind, ("roller", "knife", "flat"))
    _dimensions(kind, closure, of, arm is None)
    far, place = _pivoted(arm, pivot)
    if of["face"] and (kind != "flat" or far is None):
        refuse("face", "only an oscillating flat follower has it; leave it out")
    sizes = of["base_radius"], of["roller_radius"], of["offset"]
    return Follower(kind, *sizes, far, place, of["face"])


def _dimensions(follower: str, closure: str, of: Mapping[str, float], translating: bool) -> None:
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
