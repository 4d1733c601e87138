"""Motion of body j as seen from body i: turning, sliding, and along the line of two points."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.arrays import Floats, pairs, rotated, scalar
from kempe.compiled import ConstraintInfo, Vector

if TYPE_CHECKING:
    from kempe.motion import Motion


def turning(motion: Motion, i: str, j: str, quantity: str) -> Any:
    """Angle of body j minus that of body i, continuous, rad; or its rate or acceleration."""
    return scalar(np.subtract(getattr(motion.body(j), quantity), getattr(motion.body(i), quantity)))


class Line:
    """The distance of two points, d = |P_j - P_i|, with its rate u·ḋ and acceleration.

    With u = d / |d| the acceleration is (ḋ·ḋ - rate²) / |d| + u·d̈.
    """

    def __init__(self, motion: Motion, i: str, j: str, at_i: Vector, at_j: Vector) -> None:
        self._i = motion.body(i).at(at_i)
        self._j = motion.body(j).at(at_j)

    @cached_property
    def _apart(self) -> Floats:
        return self._j.position - self._i.position

    @cached_property
    def _velocity(self) -> Floats:
        return self._j.velocity - self._i.velocity

    @property
    def position(self) -> Floats:
        """Distance, m."""
        return np.hypot(self._apart[..., 0], self._apart[..., 1])

    def along(self, vector: Floats) -> Floats:
        """Component of a vector from point i to point j; zero where the points coincide."""
        length = self.position
        return _dot(self._apart, vector) / np.where(length > 0.0, length, np.inf)

    @property
    def rate(self) -> Floats:
        """Rate of the distance, m/s."""
        return self.along(self._velocity)

    @property
    def acceleration(self) -> Floats:
        """Second derivative of the distance, m/s²."""
        length = self.position
        across = _dot(self._velocity, self._velocity) - self.rate**2
        curved = across / np.where(length > 0.0, length, np.inf)
        return curved + self.along(self._j.acceleration - self._i.acceleration)


class Slide:
    """The displacement u·d of point j along a line fixed in body i, with its derivatives.

    With n to the left of u: rate = u·ḋ + ω n·d, and
    acceleration = u·d̈ + 2 ω n·ḋ + α n·d - ω² u·d.
    """

    def __init__(self, motion: Motion, info: ConstraintInfo) -> None:
        self._body = motion.body(info.i)
        self._i = self._body.at(info.point_i)
        self._j = motion.body(info.j).at(info.point_j)
        self._axis = (float(np.cos(info.axis_i)), float(np.sin(info.axis_i)))

    @cached_property
    def _along(self) -> Floats:
        return pairs(*rotated(self._body.angle, self._axis))

    @cached_property
    def _left(self) -> Floats:
        u = self._along
        return pairs(-u[..., 1], u[..., 0])

    @cached_property
    def _apart(self) -> Floats:
        return self._j.position - self._i.position

    @cached_property
    def _velocity(self) -> Floats:
        return self._j.velocity - self._i.velocity

    @property
    def position(self) -> Floats:
        """Displacement, m."""
        return _dot(self._along, self._apart)

    @property
    def rate(self) -> Floats:
        """Rate of the displacement, m/s."""
        turned = self._body.omega * _dot(self._left, self._apart)
        return _dot(self._along, self._velocity) + turned

    @property
    def acceleration(self) -> Floats:
        """Second derivative of the displacement, m/s²."""
        omega = self._body.omega
        apart = self._j.acceleration - self._i.acceleration
        own = _dot(self._along, apart) + 2.0 * omega * _dot(self._left, self._velocity)
        turned = self._body.alpha * _dot(self._left, self._apart)
        return own + turned - omega**2 * self.position


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray((a * b).sum(axis=-1))
