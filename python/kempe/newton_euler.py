"""The Newton–Euler equations of each body, with the reactions that a motion reports.

For a body with mass m, moment of inertia J and mass centre C, Σ F - m a_C and
Σ (T + (P - C) × F) - J α are zero. Each force F acts at the reported point P, with the torque T
about P. The sums use the reported forces, not the equations that the analysis has solved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kempe.arrays import Floats, fixed

#: A scale is at least this fraction of the largest force or moment in the mechanism. Smaller forces
#: and moments on a body are rounding errors of the larger ones.
RESOLVED = 1e-4
#: Numbers for each body from the core.
WIDTH = 5


@dataclass(frozen=True, repr=False)
class NewtonEuler:
    """Residuals of the balance of each moving body, with time as first axis.

    Attributes:
        bodies: the moving bodies, in the order of the columns.
        force: |Σ F - m a|, (n_t, n_bodies), N.
        moment: |Σ M - J α| about the mass centre, (n_t, n_bodies), N·m; zero for a point mass.
        force_scale: the largest single force on each body in the motion, (n_bodies,), N.
        moment_scale: the largest moment of a single force or torque, (n_bodies,), N·m.
    """

    bodies: tuple[str, ...]
    force: Floats
    moment: Floats
    force_scale: Floats
    moment_scale: Floats

    @property
    def relative(self) -> Floats:
        """The larger of the two relative residuals, (n_t, n_bodies)."""
        parts = (self.force, self.force_scale), (self.moment, self.moment_scale)
        shares = [of / np.where(scale > 0.0, scale, 1.0) for of, scale in parts]
        return fixed(np.maximum(*shares))

    @property
    def balance(self) -> Floats:
        """The largest relative residual of all bodies, (n_t,)."""
        return fixed(self.relative.max(axis=1, initial=0.0))

    @property
    def largest(self) -> float:
        """The largest relative residual in the motion."""
        return float(self.balance.max(initial=0.0))

    def __repr__(self) -> str:
        return f"<NewtonEuler of {len(self.bodies)} bodies: up to {self.largest:.3g}>"


def newton_euler(bodies: tuple[str, ...], rows: Floats) -> NewtonEuler:
    """The residuals from the rows of the core, (n_t, 5 n_bodies).

    A force on a body can be a rounding error of other forces, for example on a wheel that turns
    about its mass centre. Each scale is therefore at least 1e-4 of the largest scale in the
    mechanism. The largest lever arm converts forces to moments and moments to forces.
    """
    of = rows.reshape(len(rows), len(bodies), WIDTH)
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
        fixed(force),
        fixed(moment),
        fixed(np.maximum(force_scale, RESOLVED * most_force)),
        fixed(np.maximum(moment_scale, RESOLVED * most_moment)),
    )
