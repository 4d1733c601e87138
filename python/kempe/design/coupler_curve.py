"""The path of a point of a body: its length, its area, its cusps.

The length is ∫ |v| dt. The area is ½ ∫ (x ẏ - y ẋ) dt by Green's theorem, positive if the path
runs counter-clockwise. A cusp is an instant at which the velocity of the point is zero and reverses
its direction (Hunt, *Kinematic Geometry of Mechanisms*, 1978, ch. 7).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.design.locate import instants, integral, interpolated, zeros
from kempe.design.places import Place, located, point_of
from kempe.errors import ModelError
from kempe.results.motion import Motion
from kempe.results.solution import Solution
from kempe.results.variable import Variable

#: A path is closed if the distance of its ends is less than this fraction of its size.
_CLOSED = 1e-9
#: A path smaller than this fraction of the mechanism is a rounding error.
_NOTHING = 1e-12
#: A speed below this fraction of the largest speed counts as zero.
_STILL = 1e-7


@dataclass(frozen=True, repr=False)
class CouplerCurve:
    """The path of a point over a whole motion.

    Attributes:
        point: name of the point.
        variable: the quantity in ``t``.
        t: instants close enough for a smooth curve, (n,), s.
        position: the path at these instants, (n, 2), m.
        length: length of the path, m, with a relative error of about 1e-12 for smooth paths.
        closed: whether the path ends where it begins, to 1e-9 of its size.
        area: the enclosed area, m², positive if the path runs counter-clockwise, negative if
            clockwise; parts of a path that crosses itself count with their signs. None for a path
            that is not closed.
        cusps: instants of the cusps, (n_cusps,), s.
        cusp_positions: positions of the cusps, (n_cusps, 2), m.
    """

    point: str
    variable: Variable
    t: Floats
    position: Floats
    length: float
    closed: bool
    area: float | None
    cusps: Floats
    cusp_positions: Floats

    def __repr__(self) -> str:
        area = "open" if self.area is None else f"area {self.area:.6g} m²"
        return f"<CouplerCurve of {self.point}: {self.length:.6g} m long, {area}>"


def coupler_curve(solution: Solution, point: Place) -> CouplerCurve:
    """The path of a point of a body.

    Args:
        solution: the motion, such as a turn of the crank.
        point: a named point, such as "coupler.P", or a body with coordinates in its frame, such as
            ``("coupler", (0.1, 0.2))``, m.

    Raises:
        ModelError: there is no such point, the point does not move, or the solution has no
            interpolant.
    """
    t = instants(solution)
    path = point_of(solution(t), point)
    position, speed = path.position, np.hypot(*path.velocity.T)
    size = float(np.ptp(position, axis=0).max())
    name = located(solution.compiled, point)[2]
    arm = float(np.abs(solution(t[:1]).q).max()) + float(np.hypot(*path.s))
    if size <= _NOTHING * arm or not speed.any():
        raise ModelError(f"{name} does not move", name=name, hint="name a point of a moving body")
    cusps = _cusps(solution, point, float(speed.max()))
    first, last = (point_of(solution(t[[k]]), point) for k in (0, -1))
    closed = bool(np.abs(first.position - last.position).max() <= _CLOSED * size)
    ends = [float(t[0]), *cusps[(cusps != t[0]) & (cusps != t[-1])], float(t[-1])]

    def rate(motion: Motion) -> Floats:
        found: Floats = np.hypot(*point_of(motion, point).velocity.T)
        return found

    origin = position.mean(axis=0)

    def swept(motion: Motion) -> Floats:
        at = point_of(motion, point)
        (x, y), (vx, vy) = (at.position - origin).T, at.velocity.T
        return 0.5 * np.asarray(x * vy - y * vx)

    length = abs(float(integral(solution, rate, ends).sum()))
    around = integral(solution, swept, [ends[0], ends[-1]])
    return CouplerCurve(
        name,
        solution.variable,
        fixed(t),
        fixed(position),
        length,
        closed,
        float(around.sum()) if closed else None,
        fixed(cusps),
        fixed(point_of(solution(cusps), point).position if len(cusps) else np.zeros((0, 2))),
    )


def _cusps(solution: Solution, point: Place, fastest: float) -> Floats:
    """Zeros of v·a, the minima of the speed, at which the speed is zero."""
    interpolated(solution)

    def slowing(motion: Motion) -> Floats:
        at = point_of(motion, point)
        return np.asarray((at.velocity * at.acceleration).sum(axis=-1))

    found = zeros(solution, slowing)
    if not len(found):
        return found
    speed = np.hypot(*point_of(solution(found), point).velocity.T)
    still = found[speed <= _STILL * fastest]
    first, last = sorted((float(solution.t[0]), float(solution.t[-1])))
    inside: Floats = still[(still > first) & (still < last)]
    return inside
