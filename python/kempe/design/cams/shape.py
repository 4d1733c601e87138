"""The geometry of a cam and its follower: envelopes in the plane, as complex numbers.

The cam turns counter-clockwise about the origin; a cam that turns clockwise is the mirror image.
At the angle φ of the cam, z in the ground frame is z e^{-iφ} in the frame of the cam. Curves of
roller and knife followers are those of the roller's centre, the pitch curve; a flat face is a line
with the support h along its normal e^{iν}, and its envelope is (h + i dh/dν) e^{iν} with the radius
of curvature h + d²h/dν².
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.model.values import refuse

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
        opposite: whether it is the follower of a conjugate cam, on the other side of the shaft.
    """

    kind: str
    base: float
    roller: float = 0.0
    offset: float = 0.0
    arm: float | None = None
    pivot: complex = 0j
    face: float = 0.0
    opposite: bool = False

    @property
    def prime(self) -> float:
        """The distance of the pitch curve from the shaft at no lift, m."""
        return self.base + self.roller

    @property
    def sense(self) -> float:
        """1 if a lift turns an oscillating follower counter-clockwise, -1 if clockwise."""
        return -1.0 if (self.pivot.real >= 0.0) != self.opposite else 1.0

    @property
    def start(self) -> float:
        """At no lift: height of the roller's centre or face; angle from pivot-shaft to the arm."""
        if self.arm is None:
            return (
                self.base if self.kind == "flat" else float(np.sqrt(self.prime**2 - self.offset**2))
            )
        far = abs(self.pivot)
        if self.kind == "flat":
            return float(np.arcsin((self.base + self.face) / far))
        cosine = (far**2 + self.arm**2 - self.prime**2) / (2.0 * far * self.arm)
        return float(np.arccos(cosine))

    def direction(self, s: Floats | float) -> Floats:
        """The angle of an oscillating follower from its pivot to its end, rad."""
        return np.asarray(np.angle(-self.pivot) + self.sense * (self.start + s))

    def check(self, size: float) -> None:
        """Refuse dimensions that do not assemble within a lift.

        Raises:
            ModelError: they do not.
        """
        if self.arm is None:
            if self.kind != "flat" and abs(self.offset) >= self.prime:
                told = (
                    f"{self.offset:g} m; the line of travel must meet the prime circle of radius "
                )
                refuse("offset", f"{told}{self.prime:g} m: take a smaller offset or a larger base")
            return
        far = abs(self.pivot)
        if self.kind == "flat":
            if not 0.0 < self.base + self.face < far * (1.0 - 1e-9):
                told = f"{self.base:g} m; with face it must lie between 0 and {far:g} m"
                refuse("base_radius", f"{told}, the distance of the pivot")
        else:
            low, high = abs(far - self.arm), far + self.arm
            if not low < self.prime < high:
                told = (
                    f"{self.base:g} m; the roller's centre at the radius {self.prime:g} m is not "
                )
                told += f"within {low:g} m to {high:g} m, the reach of the arm: change arm or pivot"
                refuse("base_radius", told)
        limit = np.pi / 2.0 if self.kind == "flat" else np.pi
        if self.start + size >= limit:
            told = f"a lift of {size:g} rad turns the follower beyond the line of pivot and shaft"
            refuse("programme", f"{told}; lessen the lift, or move the pivot farther away")


@dataclass(frozen=True)
class Shape:
    """A cam at some angles, in its frame.

    Attributes:
        pitch: the centre of the roller, or the contact of a flat face.
        normal: unit normal out of the cam at the contact.
        profile: the contact.
        bend: curvature of the pitch curve, positive where convex, 1/m; of a flat face 0.
        room: 1 - roller × bend, or the radius of curvature over the base radius of a flat face; the
            profile is undercut where it is not positive.
        radius: radius of curvature of the profile, m, positive where convex.
        pressure: angle from the velocity of the follower to the normal, rad.
    """

    pitch: Complexes
    normal: Complexes
    profile: Complexes
    bend: Floats
    room: Floats
    radius: Floats
    pressure: Floats

    def beside(self, distance: float) -> Complexes:
        """The curve at a distance outside of the profile."""
        return np.asarray(self.profile + distance * self.normal)

    def mirrored(self) -> Shape:
        """The mirror image about the y axis."""
        pitch, normal, profile = (-np.conj(z) for z in (self.pitch, self.normal, self.profile))
        return replace(self, pitch=pitch, normal=normal, profile=profile)


def shape(of: Follower, angle: Floats, rows: Floats) -> Shape:
    """The cam of a follower at angles whose lift and three derivatives are ``rows``, (4, n)."""
    made = _flat if of.kind == "flat" else _round
    if of.opposite and of.arm is None:  # the picture turned by 180°
        found = made(replace(of, offset=-of.offset), angle, rows)
        return replace(found, pitch=-found.pitch, normal=-found.normal, profile=-found.profile)
    return made(of, angle, rows)


def _round(of: Follower, angle: Floats, rows: Floats) -> Shape:
    """The envelope of a circle around the end of the follower."""
    s, first, second = rows[:3]
    if of.arm is None:
        at, rate, bend = of.offset + 1j * (of.start + s), 1j * first, 1j * second
        velocity = np.full(s.shape, 1j)
    else:
        arm = of.arm * np.exp(1j * of.direction(s))
        turn = 1j * of.sense
        at, rate = of.pivot + arm, turn * first * arm
        bend = turn * second * arm - first**2 * arm
        velocity = turn * arm / of.arm
    turned = np.exp(-1j * angle)
    tangent = rate - 1j * at  # of the pitch curve in the frame of the cam, times e^{iφ}
    change = bend - 2j * rate - at
    speed = np.abs(tangent)
    with np.errstate(divide="ignore", invalid="ignore"):
        out = 1j * tangent / speed
        curved = -(np.conj(tangent) * change).imag / speed**3
        room = 1.0 - of.roller * curved
        radius = room / curved
    pitch = at * turned
    normal = out * turned
    profile = pitch - of.roller * normal
    return Shape(pitch, normal, profile, curved, room, radius, np.angle(out * np.conj(velocity)))


def _flat(of: Follower, angle: Floats, rows: Floats) -> Shape:
    """The envelope of a line."""
    s, first, second = rows[:3]
    if of.arm is None:
        support, slope, bend = of.base + s, first, second
        rate, faster = np.full(s.shape, -1.0), np.zeros(s.shape)
        facing = np.full(s.shape, np.pi / 2.0)
    else:
        far, swing = abs(of.pivot), of.start + s
        sine, cosine = np.sin(swing), np.cos(swing)
        support, slope = far * sine - of.face, far * cosine * first
        bend = far * (cosine * second - sine * first**2)
        rate, faster = of.sense * first - 1.0, of.sense * second
        facing = of.direction(s) + of.sense * np.pi / 2.0
        if (rate >= 0.0).any():
            told = "the follower turns as fast as the cam, so that the face would touch everywhere"
            refuse("programme", f"{told}; lessen the lift, or lengthen its segment")
    moved = slope / rate
    radius = support + (bend - moved * faster) / rate**2
    out = np.exp(1j * facing)
    contact = (support + 1j * moved) * out
    if of.arm is None:
        velocity = np.full(s.shape, 1j)
    else:
        arm = contact - of.pivot
        velocity = 1j * of.sense * arm / np.abs(arm)
    turned = np.exp(-1j * angle)
    return Shape(
        contact * turned,
        out * turned,
        contact * turned,
        np.zeros(s.shape),
        radius / of.base,
        radius,
        np.angle(out * np.conj(velocity)),
    )
