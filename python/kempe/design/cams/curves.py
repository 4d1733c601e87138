"""The curves of a cam: profile, pressure angle, curvature, undercut, lift-off."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats, fixed
from kempe.design.cams.laws import Programme
from kempe.design.cams.shape import Complexes, Follower, Shape
from kempe.errors import ModelError


@dataclass(frozen=True)
class Drive:
    """What moves and presses the follower.

    Attributes:
        speed: of the cam, rad/s, > 0.
        mass: of the follower, kg; an oscillating one is a uniform bar.
        spring: stiffness and force, or torque, at no lift; N/m and N, or N·m/rad and N·m.
        gravity: downwards, m/s².
    """

    speed: float
    mass: float
    spring: tuple[float, float]
    gravity: float


@dataclass(frozen=True, eq=False, repr=False)
class CamCurves:
    """A cam with its follower: geometry.

    Attributes:
        programme: the lift over the angle of the cam.
        clockwise: whether the cam turns clockwise.
        closure: "force", "groove" or "conjugate".
        drive: speed of the cam, mass of the follower and spring.
    """

    programme: Programme
    follower: Follower
    clockwise: bool
    closure: str
    drive: Drive

    @cached_property
    def angle(self) -> Floats:
        """Angles of the cam, rad, (n,), from 0 to below 2π: dense where derivatives jump."""
        return fixed(_core.cam_angles(self))

    @cached_property
    def shape(self) -> Shape:
        """The geometry at ``angle``, as complex numbers in the frame of the cam."""
        return self.at(self.angle)

    @cached_property
    def second(self) -> Shape | None:
        """The geometry of the conjugate cam; None for other closures."""
        return self.at(self.angle, second=True) if self.closure == "conjugate" else None

    def at(self, angle: Floats, *, second: bool = False) -> Shape:
        """The geometry at angles of the cam, rad, (n,), in the frame of the cam.

        Args:
            angle: the angles.
            second: whether it is that of the conjugate cam.
        """
        curves, rows = _core.cam_shape(self, np.asarray(angle, dtype=np.float64), second)
        return Shape(*curves, *rows)

    @property
    def lift(self) -> Floats:
        """Lift and its first three derivatives by the angle, (4, n), in m or rad."""
        return fixed(np.stack([self.programme.at(self.angle, order) for order in range(4)]))

    @property
    def pitch(self) -> Floats:
        """Path of the roller's centre in the frame of the cam, (n, 2), m; the profile of a face."""
        return plane(self.shape.pitch)

    @property
    def profile(self) -> Floats:
        """The profile in the frame of the cam, (n, 2), m; of a groove its inner wall."""
        return plane(self.shape.profile)

    @property
    def outer(self) -> Floats:
        """The outer wall of a groove, (n, 2), m.

        Raises:
            ModelError: the cam has no groove.
        """
        if self.closure != "groove":
            raise ModelError("the cam has no outer wall", hint="give closure='groove'")
        return plane(self.shape.beside(2.0 * self.follower.roller))

    @property
    def conjugate(self) -> Floats:
        """The profile of the conjugate cam, on the same shaft, (n, 2), m.

        Raises:
            ModelError: there is none.
        """
        if self.second is None:
            raise ModelError("there is no conjugate cam", hint="give closure='conjugate'")
        return plane(self.second.profile)

    @property
    def pressure_angle(self) -> Floats:
        """Angle from the velocity of a lift to the normal at the contact, rad, (n,)."""
        return fixed(self.shape.pressure)

    @property
    def radius_of_curvature(self) -> Floats:
        """Of the profile, m, (n,): positive where convex, infinite where straight."""
        return fixed(self.shape.radius)

    @property
    def curvature(self) -> Floats:
        """Of the profile, 1/m, (n,): positive where convex."""
        with np.errstate(divide="ignore"):
            return fixed(1.0 / self.shape.radius)

    @property
    def contact(self) -> Floats:
        """Place of the contact on a flat face, m, (n,): how wide the face must be.

        It is measured along the face, from the line of travel to the right, or from the pivot.

        Raises:
            ModelError: the follower has no flat face.
        """
        if self.follower.kind != "flat":
            raise ModelError("the follower has no flat face", hint="give follower='flat'")
        return fixed(self.shape.touch)

    @cached_property
    def _limits(self) -> tuple[float, float, float, list[tuple[float, float]]]:
        return _core.cam_limits(self)

    @property
    def largest_pressure_angle(self) -> float:
        """The largest magnitude of the pressure angle, rad, of both cams if there are two."""
        return self._limits[0]

    @property
    def least_radius_of_curvature(self) -> float:
        """The least radius of curvature, m, where the roller or face needs one; ≤ 0 if undercut.

        It is that of convex parts of the profiles, and of hollows of the outer wall of a groove.
        """
        return self._limits[1]

    @property
    def lift_off_speed(self) -> float:
        """Speed at which the follower leaves the cam, rad/s: where the normal force falls to zero.

        Infinite with a groove or a conjugate cam, and where nothing decelerates the follower; 0 if
        it is not pressed onto the cam even at rest.
        """
        return self._limits[2]

    @property
    def undercut(self) -> tuple[tuple[float, float], ...]:
        """Intervals of the cam's angle, rad, in which a profile is undercut; empty if none is.

        There the roller, or the face, does not touch the curve that it envelops: the profile cannot
        be made, or does not move the follower as asked.
        """
        return tuple(self._limits[3])


def plane(z: Complexes) -> Floats:
    """Complex numbers as places, (n, 2)."""
    return fixed(np.column_stack([z.real, z.imag]))
