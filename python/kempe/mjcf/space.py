"""Places in space: rotations, and the plane in which a model moves."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from kempe.base.arrays import Floats

#: Difference of directions and places that counts as rounding of a file.
TOLERANCE = 1e-6


def of_quaternion(q: Floats) -> Floats:
    """The rotation matrix of a quaternion (w, x, y, z)."""
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def of_axis(axis: Floats, angle: float) -> Floats:
    """The rotation about an axis."""
    unit = axis / np.linalg.norm(axis)
    return of_quaternion(np.array([math.cos(angle / 2), *(math.sin(angle / 2) * unit)]))


def of_euler(angles: Floats, sequence: str) -> Floats:
    """The rotation of three angles; lower-case letters turn about the axes of the body."""
    found = np.eye(3)
    for letter, angle in zip(sequence, angles, strict=True):
        turn = of_axis(np.eye(3)["xyz".index(letter.lower())], float(angle))
        found = found @ turn if letter.islower() else turn @ found
    return found


@dataclass(frozen=True)
class Plane:
    """The plane of a motion: x and y of kempe as directions in space, and the axis of angles."""

    x: Floats
    y: Floats

    @property
    def normal(self) -> Floats:
        """The axis of angles."""
        return np.cross(self.x, self.y)

    @staticmethod
    def across(normal: Floats) -> Plane | None:
        """The plane normal to an axis of the file; None for another direction.

        A vertical plane has y upwards. The horizontal one keeps x and y.
        """
        x, y, z = np.eye(3)
        for axis, plane in ((y, Plane(x, z)), (x, Plane(y, z)), (z, Plane(x, y))):
            if abs(abs(float(normal @ axis)) - 1) < TOLERANCE:
                return plane
        return None

    def point(self, place: Floats) -> list[float]:
        """The coordinates of a place in the plane."""
        return [float(place @ self.x), float(place @ self.y)]

    def contains(self, direction: Floats) -> bool:
        """Whether a direction is in the plane; its length does not matter."""
        return abs(float(direction @ self.normal)) <= TOLERANCE * float(np.linalg.norm(direction))

    def sense(self, axis: Floats) -> int:
        """1 or -1 for an axis along or against the normal, 0 for another one."""
        along = float(axis @ self.normal)
        return round(along) if abs(abs(along) - 1) < TOLERANCE else 0
