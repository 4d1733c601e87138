"""The quantities that can be plotted beside a drawing."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from kempe.arrays import Floats
from kempe.compiled import CompiledModel
from kempe.draw.numbers import plain
from kempe.motion import Motion

#: Torques and forces below this share of the largest reaction are zero except for rounding.
_NOTHING = 1e-9


def channels(motion: Motion) -> list[dict[str, Any]]:
    """Angles, angular velocities, states, forces, reactions and the residual at the frames.

    Returns:
        ``{"name", "group", "unit", "values"}`` for each; those that stay at zero are left out where
        an element has none by its nature.
    """
    return [
        {"name": name, "group": group, "unit": unit, "values": plain(values)}
        for name, group, unit, values in _all(motion)
    ]


def numbers_per_frame(model: CompiledModel) -> int:
    """Approximate count of the numbers of a frame: poses, rates, reactions and channels."""
    return 8 * len(model.bodies) + 4 * len(model.constraints) + 2 * len(model.forces) + 2


def _all(motion: Motion) -> Iterator[tuple[str, str, str, Floats]]:
    model = motion.compiled
    turning = [name for name, info in model.bodies.items() if info.turns]
    for name in turning:
        yield f"{name}.angle", "angles", "rad", motion.body(name).angle
    for name in turning:
        yield f"{name}.omega", "angular velocities", "rad/s", motion.body(name).omega
    states = zip(model.state_names(), model.state_units(), strict=True)
    for k, (name, unit) in enumerate(states):
        yield name, "states", unit, motion.z[:, k]
    for name, info in model.forces.items():
        element = motion.force(name)
        yield from _acting(name, "forces", element.force(on=info.j), element.torque(on=info.j))
    for name, joint in model.constraints.items():
        view = motion.constraint(name)
        yield from _acting(name, "reactions", view.force(on=joint.j), view.torque(on=joint.j))
    if model.n_rows:
        residual = np.abs(motion.residuals[0]).max(axis=1)
        yield "residual", "accuracy", "m, rad", residual


def _acting(
    name: str, group: str, force: Floats, torque: Floats
) -> Iterator[tuple[str, str, str, Floats]]:
    """Magnitude of a force and the torque, where there is such a thing."""
    magnitude = np.hypot(force[:, 0], force[:, 1])
    most = max(float(magnitude.max(initial=0.0)), float(np.abs(torque).max(initial=0.0)))
    if np.abs(torque).max(initial=0.0) > _NOTHING * most:
        yield f"{name}.torque", group, "N·m", torque
    if magnitude.max(initial=0.0) > _NOTHING * most or most == 0.0:
        yield f"{name}.force", group, "N", magnitude
