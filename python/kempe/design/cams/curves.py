"""The curves of a cam: profile, pressure angle, curvature, undercut, lift-off."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import pi
from typing import Any

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.base.exports import needed
from kempe.design.cams.laws import Programme
from kempe.design.cams.shape import Complexes, Follower, Shape, shape
from kempe.errors import ModelError

#: Steps of the angle: the largest, and the least beside ends of pieces, where derivatives jump; and
#: the growth of the steps with the distance from these. Larger steps in dwells are worse: the
#: parameter of a spline through points is their chord length.
_STEP, _FINE, _GROWTH = pi / 360.0, 3e-5, 0.25


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
        starts = np.array([piece.start for piece in self.programme.pieces])
        made = []
        for piece in self.programme.pieces:
            half = (piece.end - piece.start) / 2.0
            steps, place = [0.0], 0.0
            while place < half:
                place += min(_FINE + _GROWTH * place, _STEP)
                steps.append(place)
            side = np.array(steps) * half / place
            made += [piece.start + side[:-1], piece.end - side[:0:-1]]
        return fixed(np.unique(np.concatenate([starts, *made])))

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
        at = np.asarray(angle, dtype=np.float64)
        rows = np.stack([self.programme.at(at, order) for order in range(4)])
        return self._shape(at, rows, second=second)

    def _shape(self, angle: Floats, rows: Floats, *, second: bool) -> Shape:
        of = self.follower
        if second:
            of = replace(of, opposite=True)
            rows = np.stack([self.programme.size - rows[0], *-rows[1:]])
        found = shape(of, angle, rows)
        return found.mirrored() if self.clockwise else found

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
        of = self.follower
        if of.kind != "flat":
            raise ModelError("the follower has no flat face", hint="give follower='flat'")
        side = -1.0 if self.clockwise else 1.0
        at = self.shape.profile * np.exp(1j * side * self.angle)
        if of.arm is None:
            return fixed(at.real - side * of.offset)
        far = np.abs(at - complex(side * of.pivot.real, of.pivot.imag))
        return fixed(np.sqrt(np.maximum(far**2 - of.face**2, 0.0)))

    @cached_property
    def largest_pressure_angle(self) -> float:
        """The largest magnitude of the pressure angle, rad, of both cams if there are two."""
        return max(-self._least(lambda of: -np.abs(of.pressure), second=k) for k in self._sides)

    @cached_property
    def least_radius_of_curvature(self) -> float:
        """The least radius of curvature, m, where the roller or face needs one; ≤ 0 if undercut.

        It is that of convex parts of the profiles, and of hollows of the outer wall of a groove.
        """
        found = [self._least(_convex, second=k) for k in self._sides]
        if self.closure == "groove":
            found.append(self._least(self._hollow))
        return min(found)

    def _hollow(self, of: Shape) -> Floats:
        """Radius of curvature of the outer wall where the roller's path is concave."""
        with np.errstate(divide="ignore"):
            return np.where(of.bend < 0.0, -1.0 / of.bend - self.follower.roller, np.inf)

    @property
    def _sides(self) -> tuple[bool, ...]:
        return (False, True) if self.closure == "conjugate" else (False,)

    def _least(self, of: Callable[[Shape], Floats], *, second: bool = False) -> float:
        """The least value over a turn, also between and on both sides of the ends of pieces."""
        minimize = needed("scipy.optimize", "design", "kp.design.cam").minimize_scalar
        angle, rows = self.programme.sampled()
        values = of(self._shape(angle, rows, second=second))
        k = int(np.argmin(values))
        near = 1e-9 * float(np.abs(rows[2]).max())
        piece = next(
            one
            for one in self.programme.pieces
            if one.start <= angle[k] <= one.end and abs(one.at(angle[k], 2) - rows[2, k]) <= near
        )
        low, high = angle[max(k - 1, 0)], angle[min(k + 1, len(angle) - 1)]
        low, high = max(float(low), piece.start), min(float(high), piece.end)

        def value_at(x: float) -> float:
            own = np.array([[piece.at(x, order)] for order in range(4)])
            return float(of(self._shape(np.array([x]), own, second=second))[0])

        best = float(values[k])
        if high > low:
            options = {"xatol": 1e-10}
            found = minimize(value_at, bounds=(low, high), method="bounded", options=options)
            best = min(best, float(found.fun))
        return best

    @cached_property
    def undercut(self) -> tuple[tuple[float, float], ...]:
        """Intervals of the cam's angle, rad, in which a profile is undercut; empty if none is.

        There the roller, or the face, does not touch the curve that it envelops: the profile cannot
        be made, or does not move the follower as asked.
        """
        angle = self.angle
        bad = np.zeros(len(angle), dtype=bool)
        for of in filter(None, (self.shape, self.second)):
            bad |= ~(of.room > 0.0)
            if self.follower.kind == "roller":
                bad |= _crossed(of.profile, of.pitch, self.follower.roller)
            if self.closure == "groove":
                bad |= ~(1.0 + self.follower.roller * of.bend > 0.0)
                bad |= _crossed(
                    of.beside(2.0 * self.follower.roller), of.pitch, self.follower.roller
                )
        if not bad.any() and self.least_radius_of_curvature <= 0.0:  # between two angles
            bad[int(np.argmin(self.shape.room))] = True
        return _intervals(angle, bad)

    @cached_property
    def lift_off_speed(self) -> float:
        """Speed at which the follower leaves the cam, rad/s: where the normal force falls to zero.

        Infinite with a groove or a conjugate cam, and where nothing decelerates the follower; 0 if
        it is not pressed onto the cam even at rest.
        """
        if self.closure != "force":
            return float("inf")
        _, rows = self.programme.sampled(pi / 14400.0)
        inertia, press = self._inertia, self._pressing(rows[0])
        if (press <= 0.0).any():
            return 0.0
        slowed = rows[2] < 0.0
        if not slowed.any() or inertia == 0.0:
            return float("inf")
        return float(np.sqrt((press[slowed] / (-rows[2][slowed] * inertia)).min()))

    @property
    def _inertia(self) -> float:
        """Mass, or moment of inertia about the pivot."""
        arm = self.follower.arm
        return self.drive.mass * (1.0 if arm is None else arm**2 / 3.0)

    def _pressing(self, s: Floats) -> Floats:
        """Force, or torque about the pivot, of spring and weight towards the cam at rest."""
        stiffness, force = self.drive.spring
        weight: Any = self.drive.mass * self.drive.gravity
        of = self.follower
        if of.arm is not None:
            weight = weight * of.sense * of.arm / 2.0 * np.cos(of.direction(s))
        return np.asarray(stiffness * s + force + weight)


def plane(z: Complexes) -> Floats:
    """Complex numbers as places, (n, 2)."""
    return fixed(np.column_stack([z.real, z.imag]))


def _convex(of: Shape) -> Floats:
    """The radius of curvature where the pitch curve is convex; infinite elsewhere."""
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.where((of.bend > 0.0) | (of.room <= 0.0), of.radius, np.inf)
    flat = not of.bend.any()
    return of.radius if flat else found


def _crossed(profile: Complexes, pitch: Complexes, roller: float) -> Any:
    """Whether points of a profile are nearer to the pitch curve than the radius of the roller."""
    near = np.array([np.abs(pitch - point).min() for point in profile])
    return near < roller * (1.0 - 1e-6)


def _intervals(angle: Floats, bad: Any) -> tuple[tuple[float, float], ...]:
    places = np.flatnonzero(bad)
    if not len(places):
        return ()
    parts = np.split(places, np.flatnonzero(np.diff(places) > 1) + 1)
    return tuple((float(angle[part[0]]), float(angle[part[-1]])) for part in parts)
