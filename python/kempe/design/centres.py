"""Instantaneous centres of velocity of two bodies.

Seen from body i, body j turns about the point P at which both have the same velocity. Let
u = ṙ - φ̇ B r be the velocity of a body at the global origin, with the rotation B by 90°, and let
Δu and Δφ̇ be the differences between j and i. Then Δu + Δφ̇ B P = 0, so P = B Δu / Δφ̇ (Bottema
and Roth, *Theoretical Kinematics*, 1979, ch. VIII). The centres of three bodies are on one line
(Aronhold and Kennedy).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats, fixed
from kempe.errors import ModelError
from kempe.results.motion import Motion

#: A centre is at infinity if its distance exceeds the size of the mechanism by this factor.
_FAR = 1e12
#: Bodies are relatively at rest below this fraction of the speed of the fastest body.
_STILL = 1e-13


@dataclass(frozen=True, repr=False)
class InstantCentre:
    """The instantaneous centre of body j seen from body i.

    Attributes:
        i, j: the bodies.
        t: (n_t,), s; without a time axis in a state.
        position: global position, (n_t, 2), m; infinite where the relative motion is a translation.
        at_infinity: whether the relative motion of the bodies is a translation, (n_t,).
        direction: unit vector from the middle of the mechanism towards the centre, (n_t, 2); for a
            centre at infinity, the opposite direction is equivalent.
        omega: rate of body j seen from body i, (n_t,), rad/s.
    """

    i: str
    j: str
    t: Floats
    position: Floats
    at_infinity: NDArray[np.bool_]
    direction: Floats
    omega: Floats
    _motion: Motion

    def seen_from(self, body: str) -> Floats:
        """The path of the centre in the frame of a body, (n_t, 2), m.

        On body i this path is the fixed centrode, on body j the moving centrode. The moving
        centrode rolls on the fixed centrode.

        Raises:
            ModelError: there is no such body.
        """
        view = self._motion.body(body)
        apart = self.position - view.r
        cos, sin = np.cos(view.angle), np.sin(view.angle)
        with np.errstate(invalid="ignore"):
            x = cos * apart[..., 0] + sin * apart[..., 1]
            y = cos * apart[..., 1] - sin * apart[..., 0]
        far = self.at_infinity
        return fixed(np.stack([np.where(far, np.inf, x), np.where(far, np.inf, y)], axis=-1))

    def __repr__(self) -> str:
        return f"<InstantCentre of {self.j} seen from {self.i}>"


def instant_centre(motion: Motion, i: str, j: str) -> InstantCentre:
    """The instantaneous centre of velocity of two bodies.

    Args:
        motion: a solution, the motion at some times, or a state.
        i: the body from which the motion is seen, such as "ground".
        j: the other body.

    Raises:
        ModelError: there is no such body, both names are the same, or the bodies are relatively at
            rest at an instant.
    """
    if motion.body(i).info.number == motion.body(j).info.number:
        raise ModelError(f"instant_centre: {i} has none against itself", name=i)
    middle, size = _extent(motion)
    (u_i, w_i), (u_j, w_j) = (_at(motion, name, middle) for name in (i, j))
    u, w = u_j - u_i, w_j - w_i
    speed = np.hypot(u[..., 0], u[..., 1])
    fastest = _fastest(motion, middle, size)
    rests = (speed <= _STILL * fastest) & (np.abs(w) * size <= _STILL * fastest)
    if np.any(rests):
        t = float(np.atleast_1d(motion.t)[int(np.atleast_1d(rests).argmax())])
        of = motion.variable
        raise ModelError(
            f"{i} and {j} are at rest against each other at {of.name} = {t:g} {of.unit}",
            hint="compute the motion over a value, with over= and range=, where the rate is 1",
        )
    far = np.abs(w) * _FAR * size <= speed
    turned = np.stack([-u[..., 1], u[..., 0]], axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        offset = turned / np.where(far, np.nan, w)[..., None]
        length = np.hypot(turned[..., 0], turned[..., 1])[..., None]
        direction = np.where(length > 0.0, turned / length, [1.0, 0.0])
    direction = np.where((w < 0.0)[..., None], -direction, direction)
    position = np.where(far[..., None], np.inf, middle + offset)
    return InstantCentre(i, j, motion.t, fixed(position), far, fixed(direction), fixed(w), motion)


def _extent(motion: Motion) -> tuple[Floats, float]:
    """The middle of the mechanism and its size over the motion, m."""
    places = [
        motion.body(name).at(s).position
        for name, info in motion.compiled.all_bodies.items()
        for s in ((0.0, 0.0), *info.points.values())
        if info.number or s != (0.0, 0.0) or not info.points
    ]
    rows = np.concatenate([np.reshape(place, (-1, 2)) for place in places])
    low, high = rows.min(axis=0), rows.max(axis=0)
    return (low + high) / 2.0, float((high - low).max()) or 1.0


def _at(motion: Motion, name: str, place: Floats) -> tuple[Floats, Floats]:
    """Velocity of a body at a global place, (n_t, 2), and its angular velocity, (n_t,)."""
    view = motion.body(name)
    omega = np.asarray(view.omega, dtype=np.float64)
    x, y = place[0] - view.x, place[1] - view.y
    return np.stack([view.vx - omega * y, view.vy + omega * x], axis=-1), omega


def _fastest(motion: Motion, middle: Floats, size: float) -> Floats:
    """The speed of the fastest body at each time, (n_t,), m/s."""
    found = np.zeros(np.shape(motion.t))
    for name in motion.compiled.bodies:
        u, omega = _at(motion, name, middle)
        found = np.maximum(found, np.hypot(u[..., 0], u[..., 1]) + np.abs(omega) * size)
    return found
