"""The Newton–Euler equations of each body and internal coordinate, with the reported reactions.

For a body with mass m, moment of inertia J and mass centre C, Σ F - m a_C and
Σ (T + (P - C) × F) - J α are zero. Each force F acts at the reported point P, with the torque T
about P. The sums use the reported forces, not the equations that the analysis has solved. An
internal coordinate u, such as the place on the curve of a joint, has no mass: the effort of the
reaction along it, Σ λ ∂Φ/∂u, is zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kempe.base.arrays import Floats, fixed

#: A scale is at least this fraction of the largest force or moment in the mechanism. Smaller forces
#: and moments on a body are rounding errors of the larger ones.
RESOLVED = 1e-4
#: Numbers for each body, and for each internal coordinate, from the core.
WIDTH, COORDINATE_WIDTH = 5, 3


@dataclass(frozen=True, repr=False)
class NewtonEuler:
    """Residuals of the balance of each moving body and internal coordinate, with time first.

    Attributes:
        bodies: the moving bodies, in the order of the columns.
        coordinates: the internal coordinates, such as ``follower.u``.
        force: |Σ F - m a|, (n_t, n_bodies), N.
        moment: |Σ M - J α| about the mass centre, (n_t, n_bodies), N·m; zero for a point mass.
        force_scale: the largest single force on each body in the motion, (n_bodies,), N.
        moment_scale: the largest moment of a single force or torque, (n_bodies,), N·m.
        effort: |Σ λ ∂Φ/∂u|, (n_t, n_coordinates), N·m per unit of u.
        effort_scale: the largest term of this sum in the motion, (n_coordinates,).
    """

    bodies: tuple[str, ...]
    coordinates: tuple[str, ...]
    force: Floats
    moment: Floats
    force_scale: Floats
    moment_scale: Floats
    effort: Floats
    effort_scale: Floats

    @property
    def relative(self) -> Floats:
        """The relative residuals, (n_t, n_bodies + n_coordinates).

        That of a body is the larger one of force and moment. The coordinates follow the bodies.
        """
        force = _share(self.force, self.force_scale)
        bodies = np.maximum(force, _share(self.moment, self.moment_scale))
        return fixed(np.hstack([bodies, _share(self.effort, self.effort_scale)]))

    @property
    def balance(self) -> Floats:
        """The largest relative residual of all bodies and internal coordinates, (n_t,)."""
        return fixed(self.relative.max(axis=1, initial=0.0))

    @property
    def largest(self) -> float:
        """The largest relative residual in the motion."""
        return float(self.balance.max(initial=0.0))

    def __repr__(self) -> str:
        return f"<NewtonEuler of {len(self.bodies)} bodies: up to {self.largest:.3g}>"


def _share(residual: Floats, scale: Floats) -> Floats:
    return residual / np.where(scale > 0.0, scale, 1.0)


def newton_euler(
    bodies: tuple[str, ...], coordinates: tuple[str, ...], rows: Floats
) -> NewtonEuler:
    """The residuals from the rows of the core, (n_t, 5 n_bodies + 3 n_coordinates).

    A force on a body can be a rounding error of other forces, for example on a wheel that turns
    about its mass centre. Each scale is therefore at least 1e-4 of the largest scale in the
    mechanism. The largest lever arm converts forces to moments and moments to forces, and the
    largest |∂Φ/∂u| converts forces to efforts.
    """
    of = rows[:, : WIDTH * len(bodies)].reshape(len(rows), len(bodies), WIDTH)
    own = rows[:, WIDTH * len(bodies) :].reshape(len(rows), len(coordinates), COORDINATE_WIDTH)
    effort, efforts, slopes = np.moveaxis(own, -1, 0)
    slope, effort_scale = (each.max(axis=0, initial=0.0) for each in (slopes, efforts))
    force, moment, forces, moments, levers = np.moveaxis(of, -1, 0)
    force_scale, moment_scale = (each.max(axis=0, initial=0.0) for each in (forces, moments))
    lever = float(levers.max(initial=0.0))
    most_force = float(force_scale.max(initial=0.0))
    most_moment = float(moment_scale.max(initial=0.0))
    if lever > 0.0:
        most_force, most_moment = (
            max(most_force, most_moment / lever),
            max(most_moment, most_force * lever),
        )
    return NewtonEuler(
        bodies,
        coordinates,
        fixed(force),
        fixed(moment),
        fixed(np.maximum(force_scale, RESOLVED * most_force)),
        fixed(np.maximum(moment_scale, RESOLVED * most_moment)),
        fixed(effort),
        fixed(np.maximum(effort_scale, RESOLVED * most_force * slope)),
    )
