"""A follower and the geometry of its cam, as complex numbers in the plane.

The cam turns counter-clockwise about the origin; a cam that turns clockwise is the mirror image.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats

Complexes: TypeAlias = NDArray[np.complex128]


@dataclass(frozen=True)
class Follower:
    """A follower beside a cam that turns counter-clockwise.

    Attributes:
        kind: "roller", "knife" or "flat".
        base: radius of the base circle, m.
        roller: radius of the roller, m; 0 for the others.
        offset: of the line of travel to the right of the shaft, m.
        arm: of an oscillating follower, m; None if it translates.
        pivot: of an oscillating follower.
        face: distance of a flat face from the pivot towards the cam, m.
    """

    kind: str
    base: float
    roller: float = 0.0
    offset: float = 0.0
    arm: float | None = None
    pivot: complex = 0j
    face: float = 0.0

    @property
    def sense(self) -> float:
        """1 if a lift turns an oscillating follower counter-clockwise, -1 if clockwise."""
        return -1.0 if self.pivot.real >= 0.0 else 1.0


@dataclass(frozen=True)
class Shape:
    """A cam at some angles, in its frame; all have the shape (n,).

    Attributes:
        pitch: the centre of the roller, or the contact of a flat face.
        normal: unit normal out of the cam at the contact.
        profile: the contact.
        bend: curvature of the pitch curve, positive where convex, 1/m; of a flat face 0.
        room: 1 - roller × bend, or the radius of curvature over the base radius of a flat face; the
            profile is undercut where it is not positive.
        radius: radius of curvature of the profile, m, positive where convex.
        pressure: angle from the velocity of the follower to the normal, rad.
        touch: place of the contact along a flat face, m.
    """

    pitch: Complexes
    normal: Complexes
    profile: Complexes
    bend: Floats
    room: Floats
    radius: Floats
    pressure: Floats
    touch: Floats

    def beside(self, distance: float) -> Complexes:
        """The curve at a distance outside of the profile."""
        return np.asarray(self.profile + distance * self.normal)
