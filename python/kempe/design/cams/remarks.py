"""What is wrong or doubtful about a cam, with remedies."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

import numpy as np

from kempe.design.cams.curves import CamCurves
from kempe.design.cams.sizes import remedies

#: Recommended largest pressure angles of translating and oscillating followers, rad (Norton).
_STEEP = {"m": pi / 6.0, "rad": 35.0 * pi / 180.0}


def remarks_of(cam: CamCurves) -> Iterator[str]:
    """Undercut, steep pressure angles, jumps of the acceleration, lift below the base circle."""
    if cam.undercut:
        parts = [f"{np.degrees(a):.4g}° to {np.degrees(b):.4g}°" for a, b in cam.undercut]
        yield f"the profile is undercut from {', '.join(parts)}: {remedies(cam)}"
    steep = _STEEP[cam.programme.unit]
    if cam.largest_pressure_angle > steep:
        told = f"pressure angle up to {np.degrees(cam.largest_pressure_angle):.3g}°, recommended "
        told += f"at most {np.degrees(steep):.3g}°"
        yield f"{told}: take a larger base radius, see least_base_radius"
    of = cam.follower
    if of.roller > of.base:
        told = f"the roller of {of.roller:g} m is larger than the base circle of {of.base:g} m"
        yield f"{told}: take a smaller roller_radius or a larger base_radius"
    if of.kind == "flat" and of.arm is not None and cam.contact.max() > of.arm:
        told = f"the face touches up to {cam.contact.max():.4g} m from the pivot"
        yield f"{told}, beyond its arm of {of.arm:g} m: lengthen the arm"
    for angle, jump in cam.programme.jumps:
        told = f"the acceleration jumps by {jump:.4g} {cam.programme.unit}/rad² at "
        yield f"{told}{np.degrees(angle):.4g}°: a law such as 'cycloidal' or 'poly345' has no jump"
    if cam.programme.least < -1e-9 * cam.programme.size:
        told = f"the lift falls to {cam.programme.least:.4g} {cam.programme.unit}"
        yield f"{told}, below the base circle: change the speeds at the ends of a segment"
