"""Burmester's curves: the dyads of four poses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from kempe.base.arguments import explained
from kempe.base.arrays import Floats, fixed
from kempe.model.values import refuse
from kempe.synthesis import tasks
from kempe.synthesis.dyads import Conditions

#: Samples of a dyad on a curve.
_SAMPLES = 400


@dataclass(frozen=True)
class Burmester:
    """Points of both curves; row k of one belongs to row k of the other.

    Attributes:
        circle_points: points of the moving plane at the first pose, which lie on a circle at all
            four poses, (n, 2), m.
        centre_points: the centres of these circles, (n, 2), m.
        poses: the poses, (4, 3).
    """

    circle_points: Floats
    centre_points: Floats
    poses: Floats

    def level(self, kind: str, x: Floats, y: Floats) -> Floats:
        """A polynomial that is zero on a curve.

        Args:
            kind: "circle" or "centre".
            x: coordinates, m.
            y: coordinates, m, of the same shape.
        """
        conditions = Conditions(self.poses[:, 0] + 1j * self.poses[:, 1], self.poses[:, 2])
        at = (x + 1j * y - conditions.origin) / conditions.size
        r = conditions.rows.T.reshape(7, 3, *(1,) * np.ndim(x))
        own, other, sign = (1, 3, 1.0) if kind == "circle" else (3, 1, -1.0)
        columns = [
            r[other] + at.real * r[5] + sign * at.imag * r[6],
            r[other + 1] + at.imag * r[5] - sign * at.real * r[6],
            r[0] + at.real * r[own] + at.imag * r[own + 1],
        ]
        return np.asarray(np.linalg.det(np.moveaxis(np.stack(columns), (0, 1), (-1, -2))))


@explained
def burmester(poses: Sequence[tasks.Pose], *, n: int = _SAMPLES, seed: int = 0) -> Burmester:
    """The circle-point and the centre-point curve of four poses (Burmester 1888).

    Both are cubics. ``kp.plot.burmester`` draws them.

    Args:
        poses: four poses, as in ``motion``.
        n: number of straight lines that are cut with the curves.
        seed: of these lines.

    Raises:
        ModelError: there are not four poses, or two of them are the same.
    """
    places, angles = tasks.poses(poses)
    if len(places) != 4:
        refuse("poses", f"{len(places)}; Burmester's curves belong to four poses")
    found = Conditions(places, angles).all(n, seed).of("pin")
    pin, pivot = (np.column_stack([at.real, at.imag]) for at in (found.pin, found.pivot))
    return Burmester(
        fixed(pin), fixed(pivot), fixed(np.column_stack([places.real, places.imag, angles]))
    )
