"""Shaking force and shaking moment, which the moving masses exert on the foundation.

The force of all joints, drivers and force elements on ground is Σ m g - Σ m a. Without the weight,
it is the shaking force -Σ m a = -dp/dt, with the momentum p. The shaking moment about the point r₀
of ground is -Σ ((r - r₀) × m a + J α) (Norton, *Design of Machinery*, section 11.8). A force
element between ground and a body, such as a gas force, acts on ground too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.design.locate import instants
from kempe.design.places import mass_and_inertia
from kempe.design.wrenches import cross, loads
from kempe.errors import ModelError
from kempe.model.values import vector
from kempe.results.motion import Motion
from kempe.results.solution import Solution
from kempe.results.variable import Variable


@dataclass(frozen=True, repr=False)
class Shaking:
    """The forces of a mechanism on ground.

    Attributes:
        about: the point of ground to which moments refer, m.
        variable: the quantity in ``t``.
        t: the instants, (n,), s.
        force: shaking force, (n, 2), N.
        moment: shaking moment about the point, (n,), N·m.
        weight: force on ground by the weight of all bodies, (n, 2), N.
        weight_moment: moment of this weight about the point, (n,), N·m.
    """

    about: tuple[float, float]
    variable: Variable
    t: Floats
    force: Floats
    moment: Floats
    weight: Floats
    weight_moment: Floats

    @property
    def on_ground(self) -> Floats:
        """Force of the whole mechanism on ground, including weight, (n, 2), N."""
        return fixed(self.force + self.weight)

    @property
    def moment_on_ground(self) -> Floats:
        """Moment of the whole mechanism on ground, including weight, (n,), N·m."""
        return fixed(self.moment + self.weight_moment)

    def __repr__(self) -> str:
        most = float(np.hypot(*self.force.T).max(initial=0.0))
        return f"<Shaking: force up to {most:.6g} N>"


def shaking(
    motion: Motion, about: str | tuple[float, float] = (0.0, 0.0), *, fine: bool = True
) -> Shaking:
    """Shaking force and moment of a mechanism on ground.

    Both are sums over all forces on ground, so that they include all reactions.

    Args:
        motion: a solution, or the motion at some times.
        about: a point of ground, "ground.O", or its coordinates, m.
        fine: whether to evaluate a solution between its outputs too, for smooth curves.

    Raises:
        ModelError: there is no such point.
        SingularityError: reactions are not unique.
    """
    if fine and isinstance(motion, Solution) and motion.dense is not None:
        motion = motion(instants(motion))
    place = _place(motion, about)
    acting = loads(motion, "ground")
    count = np.shape(motion.t)
    force = sum((one.force for one in acting), np.zeros((*count, 2)))
    moment = sum((one.about(np.array(place)) for one in acting), np.zeros(count))
    weight, turning = np.zeros((*count, 2)), np.zeros(count)
    for name, info in motion.compiled.bodies.items():
        own = mass_and_inertia(motion, name)[0][..., None] * np.array(motion.compiled.gravity)
        weight = weight + own
        turning = turning + cross(motion.body(name).at(info.center).position - place, own)
    return Shaking(
        place,
        motion.variable,
        motion.t,
        fixed(force - weight),
        fixed(moment - turning),
        fixed(weight),
        fixed(turning),
    )


def _place(motion: Motion, about: str | tuple[float, float]) -> tuple[float, float]:
    if not isinstance(about, str):
        return vector(about, "about")
    body, _, point = about.rpartition(".")
    if body != "ground":
        raise ModelError(
            f"about: {about!r} is not a point of ground", hint='write "ground.O" or (x, y)'
        )
    return motion.body(body).point(point).s
