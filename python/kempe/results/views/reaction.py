"""The reaction of a joint or driver on one body, with its point, its frame and its sign."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats, pairs, rotated, scalar
from kempe.base.names import entry
from kempe.errors import ModelError
from kempe.results.remarks import remark

if TYPE_CHECKING:
    from kempe.model.compiled import ConstraintInfo
    from kempe.results.motion import Motion

#: A lever arm below this fraction of the largest coordinate of its ends has no direction.
_SHORT = 1e-12


@dataclass(frozen=True, repr=False)
class Reaction:
    """Force and torque that a joint or driver exerts on a body; arrays have time first.

    The opposite force and torque act on the other bodies of the joint. If the joint connects two
    bodies, they act on the other body at the same point.

    Attributes:
        joint: the joint or driver.
        body: the body on which force and torque act.
        frame: the frame of the components: "global", "body", "joint", "i", "j" or "radial".
        point: the point at which the force acts, (n_t, 2), global, m.
        axis: angle of the first axis of the frame from the global x axis, (n_t,), rad.
        force: components along the first axis and the axis to its left, (n_t, 2), N.
        torque: torque about the point, counter-clockwise, (n_t,), N·m.
        choice: empty if the values are unique. ``minimum norm`` where redundant constraints leave
            them open: they then follow from the smallest multipliers that carry the loads.
            ``second-order load left out`` where the joint keeps a coordinate only to second order,
            ``middle of friction at rest`` where drivers hold friction at rest, and ``one way to
            share the load`` where contacts and friction at rest share it.
    """

    joint: str
    body: str
    frame: str
    point: Floats
    axis: Any
    force: Floats
    torque: Any
    choice: str

    @property
    def unique(self) -> bool:
        """Whether the reaction is unique."""
        return not self.choice

    def __repr__(self) -> str:
        axes = f"{self.frame} axes{remark(self.choice)}"
        return f"<Reaction of {self.joint!r} on {self.body!r}, {axes}>"


def axis_of(motion: Motion, info: ConstraintInfo, on: str, frame: str, about: str | None) -> Floats:
    """The angle of the first axis of a frame, (n_t,), rad; see ``ConstraintView.reaction``."""
    zero = np.zeros(np.shape(motion.t))
    if frame == "global":
        return zero
    if frame == "radial":
        lever = motion.place(info.name, on) - origin(motion, info, on, about)
        return np.arctan2(lever[..., 1], lever[..., 0])
    body = {"i": info.i, "j": info.j}.get(frame, on)
    axis = 0.0
    if frame == "joint":
        axis = {info.i: info.axis_i, info.j: info.axis_j}.get(on, 0.0)
    return zero + motion.body(body).angle + axis


def origin(motion: Motion, info: ConstraintInfo, on: str, about: str | None) -> Floats:
    """The point of a body from which the radial direction leads to the joint, (n_t, 2), m.

    It is the point ``about``. Otherwise it is the other joint of a body with two joints, and the
    mass centre of any other body.

    Raises:
        ModelError: the body has no such point, or the joint lies at this point.
    """
    body = motion.compiled.body(on)
    if about is not None:
        s = entry(f"point of {on}", about, body.points)
        found = motion.body(on).at(s).position
    else:
        others = _other_joints(motion, info, on)
        if len(others) == 1:
            found = motion.place(others[0], on)
        else:
            found = motion.body(on).at(body.center).position
    lever = motion.place(info.name, on) - found
    if not (np.abs(lever).max(axis=-1) > _SHORT * (1.0 + np.abs(found).max())).all():
        raise ModelError(
            f"{info.name} lies at the origin of the radial direction on {on}",
            name=info.name,
            hint="name another point of the body: about=",
        )
    return found


def _other_joints(motion: Motion, info: ConstraintInfo, on: str) -> list[str]:
    """The other joints of a body."""
    joints = motion.compiled.joints.values()
    return [other.name for other in joints if on in other.bodies and other.name != info.name]


def turned(force: Floats, axis: Floats) -> Floats:
    """Global components of a force in axes at an angle, (…, 2)."""
    return pairs(*rotated(-axis, (force[..., 0], force[..., 1])))


def read(motion: Motion, info: ConstraintInfo, on: str, frame: str, about: str | None) -> Reaction:
    """The reaction of a joint on a body in a frame; see ``ConstraintView.reaction``."""
    values = motion.reaction(info.name, on, "global")
    axis = axis_of(motion, info, on, frame, about)
    return Reaction(
        joint=info.name,
        body=on,
        frame=frame,
        point=motion.place(info.name, on),
        axis=scalar(axis),
        force=turned(values[..., :2], axis),
        torque=scalar(values[..., 2]),
        choice=motion.choices.get(info.name, ""),
    )
