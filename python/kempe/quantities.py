"""Quantities by name, such as ``crank.angle``: the same text in files, tables and Python.

The first part of a name is a body, a point of a body, a joint, driver or force element, ``energy``
or ``drift``; the last part is the quantity. Quantities of a joint or force element are those of
body j as seen from body i; a force or torque is that on body j.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from kempe.arrays import Floats, scalar
from kempe.compiled import ACCELERATIONS, COORDINATES, RATES, BodyInfo, ConstraintInfo, ForceInfo
from kempe.names import unknown
from kempe.relative import Line, Slide, turning
from kempe.views.frames import FRAMES

if TYPE_CHECKING:
    from kempe.motion import Motion

UNITS = (("m", "m", "rad"), ("m/s", "m/s", "rad/s"), ("m/s^2", "m/s^2", "rad/s^2"))
_LINE = (("length", "m"), ("rate", "m/s"), ("acceleration", "m/s^2"))
_SLIDE = (("displacement", "m"), ("rate", "m/s"), ("acceleration", "m/s^2"))
_TURN = (("angle", "rad"), ("omega", "rad/s"), ("alpha", "rad/s^2"))
ENERGIES = ("kinetic", "potential", "dissipated", "work", "total")
#: A multiplier times its residual is an energy, so its unit is J per unit of the residual.
_MULTIPLIER_UNITS = {"m": "N", "rad": "N*m"}


@dataclass(frozen=True)
class Quantity:
    """A quantity of a motion.

    Attributes:
        unit: in SI.
        read: computes the values, (n_t,), in a state a float.
    """

    unit: str
    read: Callable[[], Any]


#: The quantities of one owner by the last part of their names.
Family: TypeAlias = Mapping[str, Quantity]


def named(motion: Motion, name: str) -> Quantity:
    """A quantity by name.

    Raises:
        ModelError: there is no such quantity; it is also a ``KeyError``.
    """
    owner, _, quantity = name.rpartition(".")
    family = _family(motion, owner)
    if family is None:
        raise unknown("quantity", name, names(motion))
    if quantity not in family:
        raise unknown(f"quantity of {owner}", quantity, family)
    return family[quantity]


def names(motion: Motion) -> Iterator[str]:
    """Names of all quantities of a motion, bodies first."""
    for owner in _owners(motion):
        for quantity in _family(motion, owner) or ():
            yield f"{owner}.{quantity}"


def _owners(motion: Motion) -> Iterator[str]:
    compiled = motion.compiled
    for name, info in compiled.all_bodies.items():
        yield name
        for point in info.points:
            yield f"{name}.{point}"
    yield from compiled.constraints
    yield from compiled.forces
    yield from ("energy", "drift")


def _family(motion: Motion, owner: str) -> Family | None:
    compiled = motion.compiled
    if owner in compiled.all_bodies:
        return of_body(motion, compiled.all_bodies[owner])
    if owner in compiled.constraints:
        return of_constraint(motion, compiled.constraints[owner])
    if owner in compiled.forces:
        return of_force(motion, compiled.forces[owner])
    body, _, point = owner.rpartition(".")
    info = compiled.all_bodies.get(body)
    if info is not None and point in info.points:
        return of_point(motion, body, point)
    return _of_run(motion, owner)


def of_body(motion: Motion, info: BodyInfo) -> Family:
    """Position, velocity and acceleration of the frame of a body."""
    view = motion.body(info.name)
    count = info.count if info.number else len(COORDINATES)
    families = zip((COORDINATES, RATES, ACCELERATIONS), UNITS, strict=True)
    return {
        name: Quantity(unit, partial(getattr, view, name))
        for known, units in families
        for name, unit in zip(known[:count], units[:count], strict=True)
    }


def of_point(motion: Motion, body: str, point: str) -> Family:
    """Position, velocity and acceleration of a named point of a body."""
    view = motion.body(body).point(point)
    of = ("position", "velocity", "acceleration")
    return {
        name: Quantity(units[k], partial(_column, partial(getattr, view, what), k))
        for what, known, units in zip(of, (COORDINATES, RATES, ACCELERATIONS), UNITS, strict=True)
        for k, name in enumerate(known[:2])
    }


def of_constraint(motion: Motion, info: ConstraintInfo) -> Family:
    """What a joint or driver leaves free, its reaction on body j, multipliers, coordinates."""
    view = motion.constraint(info.name)
    found = _free(motion, info) if info.group == "joints" else _driving(motion, info)
    found |= _acting(partial(view.force, on=info.j), partial(view.torque, on=info.j))
    found["force"] = Quantity("N", lambda: _size(view.force(on=info.j)))
    for body in dict.fromkeys(info.bodies):
        found |= _reaction(motion, info.name, body)
    for k, (name, unit) in enumerate(info.coordinates, info.columns.start):
        found[name] = Quantity(unit, partial(_column, partial(getattr, motion, "q"), k))
        rate = partial(_column, partial(getattr, motion, "v"), k)
        found[f"{name}_rate"] = Quantity(f"{unit}/s", rate)
    for name, unit in info.results:
        found[name] = Quantity(unit, partial(getattr, view, name))
    for k, (name, unit) in enumerate(info.equations):
        of = _MULTIPLIER_UNITS.get(unit, f"J/{unit}")
        multiplier = partial(_column, partial(getattr, view, "lam"), k)
        found[f"lambda_{name}"] = Quantity(of, multiplier)
    return found


def reaction_name(joint: str, component: str, body: str, frame: str) -> str:
    """Name of a component of a reaction, such as ``C.fx_on_coupler`` or ``C.joint_fx_on_coupler``.

    Args:
        joint: the joint or driver.
        component: "fx", "fy" or "torque".
        body: the body on which it acts.
        frame: "global", "body" or "joint".
    """
    return f"{joint}.{'' if frame == FRAMES[0] else f'{frame}_'}{component}_on_{body}"


def _reaction(motion: Motion, joint: str, body: str) -> dict[str, Quantity]:
    """The reaction of a joint on one of its bodies, in each frame."""
    view = motion.constraint(joint)
    found = {}
    for frame in FRAMES:
        force = partial(view.force, on=body, frame=frame)
        for k, kind in enumerate(("fx", "fy")):
            name = reaction_name("", kind, body, frame)[1:]
            found[name] = Quantity("N", partial(_column, force, k))
    torque = reaction_name("", "torque", body, FRAMES[0])[1:]
    return {**found, torque: Quantity("N*m", partial(view.torque, on=body))}


def _free(motion: Motion, info: ConstraintInfo) -> dict[str, Quantity]:
    """The relative motion that the equations of a joint leave free, or the length that they fix."""
    equations = {name for name, _ in info.equations}
    if equations == {"x", "y"}:
        return _turn(motion, info.i, info.j)
    if "normal" in equations:
        return _three(_SLIDE, Slide(motion, info))
    if equations != {"length"}:
        return {}
    line = Line(motion, info.i, info.j, info.point_i, info.point_j)
    reaction = partial(motion.constraint(info.name).force, on=info.i)
    tension = Quantity("N", lambda: scalar(line.along(reaction())))
    return {**_three(_LINE, line), "tension": tension}


def _driving(motion: Motion, info: ConstraintInfo) -> dict[str, Quantity]:
    """Effort of a driver, which increases its coordinate if positive, and its power."""
    coordinate = motion.compiled.tree["drivers"][info.name].get("coordinate")
    if coordinate is None:
        return {}
    owner, _, name = coordinate.rpartition(".")
    rate = dict(zip(COORDINATES, RATES, strict=True))[name]
    view, body = motion.constraint(info.name), motion.body(owner)

    def effort() -> Any:
        return scalar(-view.lam[..., 0])

    return {
        "effort": Quantity("N*m" if name == "angle" else "N", effort),
        "power": Quantity("W", lambda: scalar(effort() * getattr(body, rate))),
    }


def of_force(motion: Motion, info: ForceInfo) -> Family:
    """Length or angle of a force element, its force or torque on body j, power and states."""
    view = motion.force(info.name)
    found = _acting(partial(view.force, on=info.j), partial(view.torque, on=info.j))
    if info.points is not None:
        found |= _pushing(motion, info)
    else:
        found |= _turn(motion, info.i, info.j)
        omega, torque = found["omega"].read, found["torque"].read
        found["power"] = Quantity("W", lambda: scalar(torque() * omega()))
    for name, unit in info.states:
        found[name] = Quantity(unit, partial(view.state, name))
    for body in dict.fromkeys(info.bodies):
        found[f"torque_on_{body}"] = Quantity("N*m", partial(view.torque, on=body))
    return found


def _pushing(motion: Motion, info: ForceInfo) -> dict[str, Quantity]:
    """A force along the line of two points, which pushes them apart if positive."""
    line = Line(motion, info.i, info.j, *(info.points or ()))
    view = motion.force(info.name)

    def force() -> Any:
        return scalar(line.along(view.force(on=info.j)))

    found = _three(_LINE, line)
    found["force"] = Quantity("N", force)
    found["power"] = Quantity("W", lambda: scalar(force() * line.rate))
    return found


def _acting(force: Callable[[], Floats], torque: Callable[[], Any]) -> dict[str, Quantity]:
    """Components of a force, and a torque."""
    found = {name: Quantity("N", partial(_column, force, k)) for k, name in enumerate(("fx", "fy"))}
    return {**found, "torque": Quantity("N*m", torque)}


def _turn(motion: Motion, i: str, j: str) -> dict[str, Quantity]:
    return {name: Quantity(unit, partial(turning, motion, i, j, name)) for name, unit in _TURN}


def _three(names: tuple[tuple[str, str], ...], of: Line | Slide) -> dict[str, Quantity]:
    """Position, rate and acceleration of a line or slide."""
    return {
        name: Quantity(unit, partial(_scalar_of, of, what))
        for (name, unit), what in zip(names, ("position", "rate", "acceleration"), strict=True)
    }


def _scalar_of(of: object, what: str) -> Any:
    return scalar(getattr(of, what))


def _column(values: Callable[[], Floats], k: int) -> Any:
    return scalar(values()[..., k])


def _size(vectors: Floats) -> Any:
    return scalar(np.hypot(vectors[..., 0], vectors[..., 1]))


def _of_run(motion: Motion, owner: str) -> Family | None:
    """Energies, which only a solution has, and drift."""
    if owner == "energy" and hasattr(type(motion), "energy"):
        return {name: Quantity("J", partial(_energy, motion, name)) for name in ENERGIES}
    if owner == "drift":
        return {
            "position": Quantity("m or rad", lambda: _largest(motion.residuals[0])),
            "velocity": Quantity("m/s or rad/s", lambda: _largest(motion.residuals[1])),
        }
    return None


def _energy(motion: Motion, name: str) -> Any:
    return getattr(motion.energy, name)  # type: ignore[attr-defined]


def _largest(residuals: Floats) -> Any:
    return scalar(np.abs(residuals).max(axis=-1, initial=0.0))
