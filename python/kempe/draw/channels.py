"""The quantities that can be plotted beside a drawing and do not follow from its frames."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.numbers import plain
from kempe.model.compiled import CompiledModel
from kempe.results.energy import Energy
from kempe.results.motion import Motion

#: Torques and forces below this share of the largest one of an element are rounding errors.
_NOTHING = 1e-9
#: Word for the kind of a residual, by its unit.
_KINDS = {"m": "length", "rad": "angle"}
_ENERGIES = ("kinetic", "potential", "dissipated", "work", "total")
_COMPONENTS = ("force", "force_x", "force_y")


@dataclass(frozen=True)
class _Channel:
    """One quantity at all frames.

    Attributes:
        group: kind of the quantity, such as "forces".
        of: name of the element; empty for quantities of the whole mechanism.
        quantity: such as "torque".
        unit: SI unit.
        values: (n_t,).
    """

    group: str
    of: str
    quantity: str
    unit: str
    values: Floats

    @property
    def name(self) -> str:
        """Such as ``spring.torque``."""
        return f"{self.of}.{self.quantity}" if self.of else self.quantity


def channels(
    motion: Motion, energy: Energy | None = None, *, solved: bool = True
) -> list[dict[str, Any]]:
    """States, forces, reactions, energies and the residual at the frames.

    Coordinates, rates, accelerations and the forces of joints are in the frames themselves.

    Args:
        motion: the motion at the frames.
        energy: its energies.
        solved: whether the multipliers are known; forces that depend on them are left out if not.

    Returns:
        ``{"name", "group", "of", "quantity", "unit", "values"}`` for each. Quantities that an
        element does not have by its nature are left out.
    """
    return [
        {
            "name": one.name,
            "group": one.group,
            "of": one.of,
            "quantity": one.quantity,
            "unit": motion.variable.rate(one.unit),
            "values": plain(one.values),
        }
        for one in _all(motion, energy, solved=solved)
    ]


def numbers_per_frame(model: CompiledModel) -> int:
    """Approximate count of the numbers of a frame: poses, rates, accelerations and channels."""
    others = len(model.constraints) + len(model.forces)
    return 9 * len(model.bodies) + 3 * others + len(_ENERGIES) + 2


def _all(motion: Motion, energy: Energy | None, *, solved: bool) -> Iterator[_Channel]:
    yield from _coordinates(motion)
    for name, info in motion.compiled.forces.items():
        if info.reads_multipliers and not solved:
            continue
        element = motion.force(name)
        yield from _acting(
            "forces", name, element.force(on=info.j), element.torque(on=info.j), whole=True
        )
    for name, joint in motion.compiled.constraints.items() if solved else ():
        view, driver = motion.constraint(name), joint.group == "drivers"
        yield from _acting(
            "reactions", name, view.force(on=joint.j), view.torque(on=joint.j), whole=driver
        )
    if energy is not None:
        for name in _ENERGIES:
            yield _Channel("energy", "", f"energy.{name}", "J", getattr(energy, name))
    if motion.compiled.n_rows:
        residual = np.abs(motion.residuals[0])
        units = np.array(motion.compiled.row_units())
        for unit in dict.fromkeys(units):
            largest = residual[:, units == unit].max(axis=1)
            yield _Channel("accuracy", "", f"residual.{_KINDS.get(unit, unit)}", unit, largest)


def _coordinates(motion: Motion) -> Iterator[_Channel]:
    """First-order states of forces and internal coordinates of joints."""
    for info in motion.compiled.forces.values():
        for (name, unit), values in zip(info.states, motion.z[:, info.places].T, strict=True):
            yield _Channel("states", info.name, name, unit, values)
    for joint in motion.compiled.constraints.values():
        for (name, unit), k in zip(
            joint.coordinates, range(motion.compiled.n_q)[joint.columns], strict=True
        ):
            yield _Channel("coordinates", joint.name, name, unit, motion.q[:, k])
            yield _Channel("coordinates", joint.name, f"{name}_rate", f"{unit}/s", motion.v[:, k])


def _acting(
    group: str, name: str, force: Floats, torque: Floats, *, whole: bool
) -> Iterator[_Channel]:
    """The torque, and the force if ``whole``, if the element has them."""
    magnitude = np.hypot(force[:, 0], force[:, 1])
    most = max(float(magnitude.max(initial=0.0)), float(np.abs(torque).max(initial=0.0)))
    if np.abs(torque).max(initial=0.0) > _NOTHING * most:
        yield _Channel(group, name, "torque", "N·m", torque)
    if whole and (magnitude.max(initial=0.0) > _NOTHING * most or most == 0.0):
        for quantity, values in zip(_COMPONENTS, (magnitude, *force.T), strict=True):
            yield _Channel(group, name, quantity, "N", values)
