"""Quantities by name, such as ``crank.angle``; names are equal in files, tables and Python.

The first part of a name is a body, a point of a body, a joint, driver or force element, ``energy``
or ``drift``. The last part is the quantity. The name of a measure has only one part. Coordinates of
a joint or force element describe body j as seen from body i; its force or torque acts on body j.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats, fixed, scalar
from kempe.base.names import entry, owner_of, unknown
from kempe.model.compiled import (
    ACCELERATIONS,
    COORDINATES,
    RATES,
    BodyInfo,
    ConstraintInfo,
    ForceInfo,
    Vector,
)
from kempe.results.views import beam
from kempe.results.views.frames import FRAMES

if TYPE_CHECKING:
    from kempe.model.measure_infos import MeasureInfo
    from kempe.results.energy import Energy
    from kempe.results.motion import Motion

UNITS = (("m", "m", "rad"), ("m/s", "m/s", "rad/s"), ("m/s^2", "m/s^2", "rad/s^2"))
ENERGIES = ("kinetic", "potential", "dissipated", "work", "total")
#: A force times its coordinate, or a multiplier times its residual, is an energy. The unit of the
#: force or multiplier is therefore J per unit of the coordinate or residual.
FORCE_UNITS = {"m": "N", "rad": "N*m"}


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
    """A quantity by name; in a motion over a driven quantity, rates are derivatives by it.

    Raises:
        ModelError: there is no such quantity; the error is also a ``KeyError``.
    """
    found = _named(motion, name)
    return replace(found, unit=motion.variable.rate(found.unit))


def _named(motion: Motion, name: str) -> Quantity:
    if name in motion.compiled.measures:
        return _measure_of(motion, name)
    owner, quantity = owner_of(name)
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
    yield from motion.compiled.measures


def _measure_of(motion: Motion, name: str) -> Quantity:
    """A measure as a quantity."""
    unit = motion.compiled.measures[name].unit
    return Quantity(unit, lambda: _one(motion, measure_values(motion, name)))


def measure_values(motion: Motion, name: str) -> Floats:
    """Values of a measure at the times of a motion, (n_t,).

    Raises:
        ModelError: there is no such measure, the motion lacks one of its quantities, or the
            expression has no value at one of the times.
        SingularityError: a reaction or acceleration is not unique at one of the times.
    """
    return values_of(motion, entry("measure", name, motion.compiled.measures))


def values_of(motion: Motion, info: MeasureInfo, energy: Energy | None = None) -> Floats:
    """Values of an expression of quantities, as ``measure_values``.

    Args:
        motion: the motion.
        info: the expression.
        energy: its energies, if it is not a solution.
    """
    t = np.atleast_1d(motion.t)
    if not info.is_of_run and motion.compiled.redundancy == "refuse":
        a, lam = (motion.a, motion.lam) if info.solves else (None, None)
        (found,) = motion._asked(lambda states: [states.measure(info.expression)], a=a, lam=lam)
        return fixed(found)
    columns = [
        getattr(energy, one.removeprefix("energy."))
        if energy is not None and one.startswith("energy.")
        else np.atleast_1d(_named(motion, one).read())
        for one in info.quantities
    ]
    given = np.column_stack(columns) if columns else np.empty((len(t), 0))
    (found,) = motion._by_phase(
        lambda core, *of: (_core.measure_values(core, info.expression, *of),),
        t,
        np.ascontiguousarray(given),
    )
    return fixed(found)


def _owners(motion: Motion) -> Iterator[str]:
    compiled = motion.compiled
    for name, info in compiled.all_bodies.items():
        if not info.is_shown:
            continue
        yield name
        for point in info.points:
            yield f"{name}.{point}"
    yield from compiled.constraints
    yield from compiled.shown_forces
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
        of_frame = of_body(motion, info) if info.type == "beam" else {}
        return {**of_frame, **of_point(motion, body, point)}
    return _of_run(motion, owner)


def of_body(motion: Motion, info: BodyInfo) -> Family:
    """Position, velocity and acceleration of the frame of a body."""
    view = motion.body(info.name)
    count = info.count if info.number else len(COORDINATES)
    families = zip((COORDINATES, RATES, ACCELERATIONS), UNITS, strict=True)
    own = of_beam(motion, info.name) if info.type == "beam" else {}
    found = {
        name: Quantity(unit, partial(getattr, view, name))
        for known, units in families
        for name, unit in zip(known[:count], units[:count], strict=True)
    }
    return {**found, **own}


def of_beam(motion: Motion, name: str) -> Family:
    """The largest stress and bending moment along a beam, and its strain energy."""
    return {
        quantity: Quantity(unit, partial(_of_beam, motion, name, quantity))
        for quantity, unit, _ in beam.WHOLE
        if quantity != "stress" or beam.has_stress(motion.compiled, name)
    }


def _of_beam(motion: Motion, name: str, quantity: str) -> Any:
    return scalar(beam.whole(motion, name, quantity))


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
    """A joint or driver: free motion, reaction on body j, multipliers, coordinates."""
    view = motion.constraint(info.name)
    found = _measured(motion, info) | _tension(motion, info) | _driving(motion, info)
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
    if info.may_slip and getattr(motion, "dense", None) is not None:
        found["dissipated"] = Quantity("J", partial(motion.dissipated, info.name))
    for k, (name, unit) in enumerate(info.equations):
        of = FORCE_UNITS.get(unit, f"J/{unit}")
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


def _measured(motion: Motion, info: ConstraintInfo | ForceInfo) -> dict[str, Quantity]:
    """The position quantities of an element, with their rates and accelerations."""
    found = {}
    for k, of in enumerate(info.measured):
        for order, (name, unit) in enumerate(zip(of.names, of.units, strict=True)):
            if name:
                found[name] = Quantity(unit, partial(_measure, motion, info.name, k, order))
    return found


def _measure(motion: Motion, name: str, k: int, order: int) -> Any:
    return scalar(motion.measured(name, k, order))


def _tension(motion: Motion, info: ConstraintInfo) -> dict[str, Quantity]:
    """The tension of a joint that fixes a length."""
    if [name for name, _ in info.equations] != ["length"]:
        return {}
    reaction = partial(motion.constraint(info.name).force, on=info.i)
    ends = (info.i, info.point_i), (info.j, info.point_j)
    return {"tension": Quantity("N", lambda: scalar(_along(motion, ends, reaction())))}


def _along(motion: Motion, ends: tuple[tuple[str, Vector], ...], vectors: Floats) -> Floats:
    """Components of vectors from the first point to the second; zero where the points coincide."""
    first, second = (motion.body(body).at(point).position for body, point in ends)
    line = second - first
    length = np.hypot(line[..., 0], line[..., 1])
    return np.asarray((line * vectors).sum(axis=-1) / np.where(length > 0.0, length, np.inf))


def _driving(motion: Motion, info: ConstraintInfo) -> dict[str, Quantity]:
    """Effort of a driver, which increases its coordinate if positive, its power and its limit."""
    driver = motion.compiled.tree.get("drivers", {}).get(info.name, {})
    if info.group != "drivers" or "coordinate" not in driver:
        return {}
    owner, _, name = driver["coordinate"].rpartition(".")
    view = motion.constraint(info.name)

    def effort() -> Any:
        limited = motion.force_results(info.name)[..., 0] if info.is_limited else 0.0
        return scalar(limited - view.lam[..., 0])

    def power() -> Any:
        return scalar(effort() * named(motion, f"{owner}.{_rate_name(motion, owner, name)}").read())

    unit = "N" if info.equations[0][1] == "m" else "N*m"
    found = {"effort": Quantity(unit, effort), "power": Quantity("W", power)}
    if info.is_limited:
        found["limit"] = Quantity(
            unit, partial(_column, partial(motion.force_results, info.name), 2)
        )
    return found


def _rate_name(motion: Motion, owner: str, position: str) -> str:
    """The name of the rate of a position quantity."""
    compiled = motion.compiled
    element = compiled.constraints.get(owner) or compiled.forces.get(owner)
    of_body = dict(zip(COORDINATES, RATES, strict=True))
    measured = element.measured if element is not None else ()
    own = element.coordinates if isinstance(element, ConstraintInfo) else ()
    places = {name: f"{name}_rate" for name, _ in own}
    return {**of_body, **{of.names[0]: of.names[1] for of in measured}, **places}[position]


def of_force(motion: Motion, info: ForceInfo) -> Family:
    """Length or angle of a force element, its force or torque on body j, energies and states."""
    view = motion.force(info.name)
    found = _acting(partial(view.force, on=info.j), partial(view.torque, on=info.j))
    found |= _measured(motion, info)
    if info.points is not None:
        found |= _pushing(motion, info)
    found["power"] = Quantity("W", partial(getattr, view, "power"))
    found["energy"] = Quantity("J", partial(getattr, view, "energy"))
    if getattr(motion, "dense", None) is not None:
        found["dissipated"] = Quantity("J", partial(getattr, view, "dissipated"))
    for name, unit in info.states:
        found[name] = Quantity(unit, partial(view.state, name))
    results = partial(motion.force_results, info.name)
    for k, (name, unit) in enumerate(info.results):
        found[name] = Quantity(unit, partial(_column, results, k))
    for body in dict.fromkeys(info.bodies):
        found[f"torque_on_{body}"] = Quantity("N*m", partial(view.torque, on=body))
    return found


def _pushing(motion: Motion, info: ForceInfo) -> dict[str, Quantity]:
    """A force along the line of two points, which pushes them apart if positive."""
    at_i, at_j = info.points or ((0.0, 0.0), (0.0, 0.0))
    ends = (info.i, at_i), (info.j, at_j)
    view = motion.force(info.name)

    def force() -> Any:
        return scalar(_along(motion, ends, view.force(on=info.j)))

    return {"force": Quantity("N", force)}


def _acting(force: Callable[[], Floats], torque: Callable[[], Any]) -> dict[str, Quantity]:
    """Components of a force, and a torque."""
    found = {name: Quantity("N", partial(_column, force, k)) for k, name in enumerate(("fx", "fy"))}
    return {**found, "torque": Quantity("N*m", torque)}


def _column(values: Callable[[], Floats], k: int) -> Any:
    return scalar(values()[..., k])


def _size(vectors: Floats) -> Any:
    return scalar(np.hypot(vectors[..., 0], vectors[..., 1]))


def _of_run(motion: Motion, owner: str) -> Family | None:
    """Energies, which only a solution has, and drift."""
    if owner == "energy" and hasattr(type(motion), "energy"):
        found = {name: Quantity("J", partial(_energy, motion, name)) for name in ENERGIES}
        return {**found, "balance": Quantity("1", partial(_energy, motion, "balance"))}
    if owner == "drift":
        return {
            "position": Quantity("m or rad", lambda: _largest(motion.residuals[0])),
            "velocity": Quantity("m/s or rad/s", lambda: _largest(motion.residuals[1])),
            "balance": Quantity("1", lambda: _one(motion, motion.newton_euler.balance)),
        }
    return None


def _energy(motion: Motion, name: str) -> Any:
    return getattr(motion.energy, name)  # type: ignore[attr-defined]


def _one(motion: Motion, rows: Floats) -> Any:
    """Rows of a motion; the only one of a state."""
    return rows if motion.q.ndim > 1 else float(rows[0])


def _largest(residuals: Floats) -> Any:
    return scalar(np.abs(residuals).max(axis=-1, initial=0.0))
