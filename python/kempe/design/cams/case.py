"""The case of a cam with its follower."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from kempe.design.cams.curves import CamCurves, plane
from kempe.design.cams.shape import Complexes
from kempe.design.cams.sizes import refuse_undercut
from kempe.model.model import Model

if TYPE_CHECKING:
    from kempe.case import Case

#: Density × thickness of the cam, a disc of steel of the base radius, 10 mm thick, kg/m².
_SURFACE = 78.5
#: Number of outputs of a turn.
_OUTPUTS = 360


def case_of(cam: CamCurves) -> Case:
    """The case; see ``Cam.case``.

    Raises:
        ModelError: the profile is undercut.
    """
    from kempe.case import Case

    refuse_undercut(cam)
    of, drive = cam.follower, cam.drive
    numbers = {"speed": drive.speed, "mass": drive.mass}
    numbers |= dict(zip(("stiffness", "force"), drive.spring, strict=True))
    kind = "oscillating" if of.arm is not None else "translating"
    m = Model(f"cam, {kind} {of.kind} follower", gravity=(0.0, -drive.gravity), parameters=numbers)
    disc = {"type": "disc", "radius": of.base, "mass": _SURFACE * pi * of.base**2}
    m.body("cam", shapes=[disc], points={"O": (0.0, 0.0)}, curves=_curves(cam))
    guess = _translating(m, cam) if of.arm is None else _oscillating(m, cam)
    m.revolute("shaft", "ground.O", "cam.O")
    _contact(m, cam)
    m.coordinate_driver("drive", "cam.angle", value="-speed*t" if cam.clockwise else "speed*t")
    turn = {
        "type": "inverse_dynamics",
        "t_end": "2*pi/speed",
        "output_step": f"2*pi/speed/{_OUTPUTS}",
    }
    start = {"guess": {"cam.angle": 0.0, **guess, "contact.u": 0.0}}
    return Case(m, start, analyses={"turn": turn})


def _curves(cam: CamCurves) -> dict[str, dict[str, Any]]:
    """The curves of the body: all profiles, and the pitch curve if the follower runs on it."""
    found = {"rim": cam.shape.profile}
    if cam.closure == "groove":
        found["outer"] = cam.shape.beside(2.0 * cam.follower.roller)
    if cam.second is not None:
        found["second"] = cam.second.profile
    if _both_ways(cam) and cam.follower.kind == "roller":
        found["pitch"] = cam.shape.pitch
    return {name: _through(curve) for name, curve in found.items()}


def _through(curve: Complexes) -> dict[str, Any]:
    return {"points": plane(curve).tolist(), "periodic": True}


def _both_ways(cam: CamCurves) -> bool:
    """Whether the cam pushes and pulls the follower."""
    return cam.closure != "force"


def _translating(m: Model, cam: CamCurves) -> dict[str, float]:
    """A follower in a vertical guide, with its spring above; guesses for its coordinates."""
    of, side = cam.follower, -1.0 if cam.clockwise else 1.0
    x, low = side * of.offset, of.start
    long = cam.programme.size + of.base + of.roller
    m.ground.points(O=(0.0, 0.0), G=(x, 0.0), S=(x, low + 3.0 * long))
    m.body("follower", mass="mass", inertia=0.0, points={"P": (0.0, 0.0), "T": (0.0, long)})
    m.translational("guide", "ground.G", "follower.P", axes=("90 deg", "90 deg"))
    if any(cam.drive.spring):
        m.spring_damper(
            "spring",
            "ground.S",
            "follower.T",
            stiffness="stiffness",
            free_length=2.0 * long,
            preload="-force",
        )
    return {"follower.x": x, "follower.y": low, "follower.angle": 0.0}


def _oscillating(m: Model, cam: CamCurves) -> dict[str, float]:
    """A bar on a pivot with a torsion spring; guesses for its coordinates."""
    of = cam.follower
    assert of.arm is not None
    angle, sense, x = float(of.direction(0.0)), of.sense, of.pivot.real
    if cam.clockwise:  # the mirror image
        angle, sense, x = float(np.pi - angle), -sense, -x
    angle = float((angle + pi) % (2.0 * pi) - pi)
    m.ground.points(O=(0.0, 0.0), M=(x, of.pivot.imag))
    face = {"F": (0.0, -sense * of.face)} if of.kind == "flat" else {}
    m.bar("follower", mass="mass", length=of.arm, ends=("M", "P"), points=face)
    m.revolute("pivot", "ground.M", "follower.M")
    if any(cam.drive.spring):
        preload = "force" if sense > 0.0 else "-force"
        m.torsion_spring(
            "spring", "ground", "follower", stiffness="stiffness", free_angle=angle, preload=preload
        )
    middle = complex(x, of.pivot.imag) + of.arm / 2.0 * np.exp(1j * angle)
    at = {"follower.x": float(middle.real), "follower.y": float(middle.imag)}
    return {**at, "follower.angle": angle}


def _contact(m: Model, cam: CamCurves) -> None:
    """The joint between follower and cam; the measure ``press`` where it has no ``normal``."""
    of = cam.follower
    if of.kind == "roller" and not _both_ways(cam):
        side: Literal["right", "left"] = "right" if cam.clockwise else "left"
        m.roller_on_curve("contact", "follower.P", "cam.rim", radius=of.roller, side=side)
    elif of.kind == "flat":
        point = "follower.P" if of.arm is None else "follower.F"
        m.flat_on_curve("contact", point, "cam.rim")
    else:
        m.point_on_curve("contact", "follower.P", "cam.pitch" if of.roller else "cam.rim")
        if of.arm is None:
            m.measures(press="-contact.fy")
        else:
            sense = -of.sense if cam.clockwise else of.sense
            along = "contact.fx*sin(follower.angle) - contact.fy*cos(follower.angle)"
            m.measures(press=along if sense > 0.0 else f"-({along})")
