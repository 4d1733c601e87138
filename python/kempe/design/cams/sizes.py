"""The least base circle of a cam within limits, and the remedies of an undercut profile."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.exports import needed
from kempe.design.cams.curves import CamCurves
from kempe.errors import ModelError

#: Base radii that a search tries, and its range.
_TRIES, _WIDEST = 121, 1e4
#: The room that a remedy leaves, and steps by which it grows until nothing is undercut.
_ROOM, _STEPS = 1.001, 40


def least_base(cam: CamCurves, steep: float | None, sharp: float) -> float | None:
    """The least base radius within limits; None if there is none.

    Args:
        cam: the cam, whose own base radius does not matter.
        steep: largest pressure angle, rad; or None.
        sharp: least convex radius of curvature of the profile, m.
    """

    def margin(base: float) -> float:
        try:
            other = _with_base(cam, base)
            room = (other.least_radius_of_curvature - sharp) / (base + abs(sharp))
            if steep is None:
                return room
            return min(room, steep - other.largest_pressure_angle)
        except ModelError:
            return -1.0

    return _first(margin, _bases(cam))


def refuse_undercut(cam: CamCurves) -> None:
    """Refuse a cam with an undercut profile.

    Raises:
        ModelError: it is undercut.
    """
    if cam.undercut:
        first, last = np.degrees(cam.undercut[0])
        told = f"the profile is undercut between {first:.4g}° and {last:.4g}°"
        raise ModelError(told, hint=remedies(cam))


def remedies(cam: CamCurves) -> str:
    """What removes an undercut: a larger base circle, or a smaller roller."""
    found = []
    base = least_base(cam, None, 0.0)
    if base is not None:
        base *= _ROOM
        for _ in range(_STEPS):
            try:
                if not _with_base(cam, base).undercut:
                    found.append(f"take a base_radius of at least {_up(base)} m")
                    break
            except ModelError:
                break
            base *= 1.1
    roller = cam.follower.roller
    for _ in range(_STEPS if roller else 0):
        roller *= 0.9
        kept = cam.follower.base + cam.follower.roller - roller  # the same pitch curve
        other = replace(cam, follower=replace(cam.follower, base=kept, roller=roller))
        if not other.undercut:
            told = f"with base_radius {kept:.6g} m, which keeps the path of its centre"
            found.append(f"take a roller_radius of at most {roller:.4g} m, {told}")
            break
    return "; or ".join(found) or "lengthen the segments, or lessen the lift"


def _with_base(cam: CamCurves, base: float) -> CamCurves:
    other = replace(cam, follower=replace(cam.follower, base=base))
    other.follower.check(cam.programme.size)
    return other


def _up(x: float) -> str:
    """Four digits, rounded up."""
    unit = 10.0 ** (np.floor(np.log10(x)) - 3)
    return f"{np.ceil(x / unit) * unit:.4g}"


def _bases(cam: CamCurves) -> Floats:
    """Base radii that a search tries, ascending."""
    of = cam.follower
    if of.arm is None:
        least = max(abs(of.offset) - of.roller, 0.0) if of.kind != "flat" else 0.0
        size = cam.programme.size + of.roller + abs(of.offset)
        return np.asarray(least + size * np.geomspace(1.0 / _WIDEST, _WIDEST, 2 * _TRIES))
    far = abs(of.pivot)
    low, high = (0.0, far) if of.kind == "flat" else (abs(far - of.arm), far + of.arm)
    shift = of.face if of.kind == "flat" else of.roller
    tries = np.linspace(low, high, _TRIES + 2)[1:-1] - shift
    return np.asarray(tries[tries > 0.0])


def _first(margin: Callable[[float], float], tries: Floats) -> float | None:
    """The least value at which a margin is not negative, refined; None if there is none."""
    root = needed("scipy.optimize", "design", "kp.design.cam").brentq
    before = None
    for base in tries.tolist():
        if margin(base) >= 0.0:
            if before is None:
                return float(base)
            return float(root(margin, before, base, xtol=1e-15, rtol=1e-12))
        before = base
    return None
