"""All forces on a body with their points of application, and their balance with inertia.

The balance is that of the Newton–Euler equations: Σ F + m g = m a with the acceleration a of the
mass centre, and Σ M = J α with moments about the mass centre. Joints, drivers and force elements
exert the forces F.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.design.places import mass_and_inertia
from kempe.model.compiled import ConstraintInfo, ForceInfo
from kempe.results.motion import Motion
from kempe.results.state import State


@dataclass(frozen=True, repr=False)
class Load:
    """Force and moment of one element on a body.

    Attributes:
        name: the joint, driver or force element; "gravity" for the weight.
        kind: "joint", "driver", "element" or "gravity".
        force: (n_t, 2), N, global.
        moment: moment about ``place``, (n_t,), N·m.
        place: point of application, (n_t, 2), m, global.
    """

    name: str
    kind: str
    force: Floats
    moment: Floats
    place: Floats

    def about(self, place: Floats) -> Floats:
        """Moment about another point, (n_t,), N·m."""
        arm = self.place - place
        return np.asarray(self.moment + cross(arm, self.force))

    def __repr__(self) -> str:
        return f"<Load of {self.name}>"


def cross(a: Floats, b: Floats) -> Floats:
    """Z component of the cross product of plane vectors, (…)."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def loads(motion: Motion, body: str, *, gravity: bool = True) -> list[Load]:
    """All forces on a body, joints first, including forces that are always zero.

    Raises:
        ModelError: there is no such body.
        SingularityError: reactions are not unique.
    """
    info = motion.compiled.body(body)
    model = motion.compiled
    found = [_of_joint(motion, c, body) for c in model.constraints.values() if body in c.bodies]
    found += [_of_element(motion, f, body) for f in model.forces.values() if body in f.bodies]
    if gravity and info.number:
        mass = mass_and_inertia(motion, body)[0]
        weight = mass[..., None] * np.array(motion.compiled.gravity)
        centre = motion.body(body).at(info.center).position
        found.append(Load("gravity", "gravity", fixed(weight), np.zeros(np.shape(mass)), centre))
    return found


def _of_joint(motion: Motion, info: ConstraintInfo, body: str) -> Load:
    """The reaction of a joint at its point on the body, or at the origin of the body's frame."""
    view = motion.constraint(info.name)
    force, moment = view.force(on=body), np.asarray(view.torque(on=body))
    kind = info.group.rstrip("s")
    if info.coordinates and body in (info.i, info.j):
        place = motion.body(info.i).at(info.point_i).position
        moment = _by_multipliers(motion, info, body, force, place)
        return Load(info.name, kind, force, moment, place)
    at = {info.j: info.point_j, info.i: info.point_i}.get(body, (0.0, 0.0))
    return Load(info.name, kind, force, moment, motion.body(body).at(at).position)


def _of_element(motion: Motion, info: ForceInfo, body: str) -> Load:
    """The action of an element at its point on the body, or at the origin of the body's frame."""
    view = motion.force(info.name)
    moment = fixed(np.asarray(view.torque(on=body)))
    return Load(info.name, "element", view.force(on=body), moment, view.place(on=body))


def _by_multipliers(
    motion: Motion, info: ConstraintInfo, body: str, force: Floats, place: Floats
) -> Floats:
    """Moment about a point of a joint on a curve, whose point of contact moves, (n_t,).

    It follows from -Φ_qᵀ λ, which contains the force and the moment about the origin of the frame
    of the body.
    """
    about = motion.compiled.all_bodies[body]
    if not about.number:
        other = next(name for name in info.bodies if name != body)
        away = motion.constraint(info.name).force(on=other)
        return -_by_multipliers(motion, info, other, away, place)
    lam = np.atleast_2d(motion.lam)[:, info.rows]
    rows = (np.atleast_1d(motion.t), *map(np.atleast_2d, (motion.q, motion.v, motion.z)))
    found = np.empty(len(lam))
    for k, (t, q, v, z) in enumerate(zip(*rows, strict=True)):
        jacobian = State(motion.compiled, float(t), q, v, z=z).matrices().Phi_q
        block = np.asarray(jacobian)[info.rows, about.columns]
        found[k] = -(block.T @ lam[k])[2] if about.count == 3 else 0.0
    moment = found.reshape(np.shape(motion.t))
    return np.asarray(moment - cross(place - motion.body(body).r, force))


@dataclass(frozen=True, repr=False)
class Inertia:
    """Mass times acceleration of a body.

    Attributes:
        force: m a of the mass centre, (n_t, 2), N.
        moment: J α, (n_t,), N·m.
        centre: the mass centre, (n_t, 2), m.
        acceleration: of the mass centre, (n_t, 2), m/s².
    """

    force: Floats
    moment: Floats
    centre: Floats
    acceleration: Floats


def inertia(motion: Motion, body: str) -> Inertia:
    """M a and J α of a body."""
    info, view = motion.compiled.body(body), motion.body(body)
    mass, about = mass_and_inertia(motion, body)
    centre = view.at(info.center)
    return Inertia(
        fixed(mass[..., None] * centre.acceleration),
        fixed(about * view.alpha),
        centre.position,
        centre.acceleration,
    )


def imbalance(found: list[Load], of: Inertia) -> float:
    """Largest relative error of the Newton–Euler equations of a body.

    The error is relative to the largest single force at all instants; the error of the moments is
    relative to the largest single moment about the mass centre.
    """
    force = sum((one.force for one in found), -of.force)
    moments = [one.about(of.centre) for one in found]
    moment = sum(moments, -of.moment)
    arms = [np.hypot(*np.moveaxis(one.force, -1, 0)) for one in found]
    inertial = np.hypot(*np.moveaxis(of.force, -1, 0))
    most = max(float(np.max(a)) for a in [*arms, inertial])
    # a moment by a force at a place has the rounding error of its parts
    turning = [np.abs(m) for m in [*moments, of.moment]]
    turning += [
        np.hypot(*np.moveaxis(one.place - of.centre, -1, 0)) * size
        for one, size in zip(found, arms, strict=True)
    ]
    largest = max(float(np.max(m)) for m in turning)
    shares = [
        float(np.abs(error).max()) / scale
        for error, scale in ((force, most), (moment, largest))
        if scale > 0.0
    ]
    return max(shares, default=0.0)
