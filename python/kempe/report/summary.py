"""The summary of a solution as plain data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from kempe._version import __version__
from kempe.arrays import Floats
from kempe.report.settling import settling

if TYPE_CHECKING:
    from kempe.solution import Solution
    from kempe.state import State


def summary(solution: Solution) -> dict[str, Any]:
    """Mechanism, initial and final state, peak values, energy balance and settling times.

    The result can be written as JSON. Units: m, rad, N, N·m, J, s.
    """
    return {
        "kempe": __version__,
        "title": solution.model.title,
        "success": solution.success,
        "message": solution.message,
        "time": {
            "start": float(solution.t[0]),
            "end": float(solution.t[-1]),
            "outputs": len(solution.t),
        },
        "mechanism": mechanism(solution.initial),
        "start": solution.initial.coordinates(),
        "end": solution.final.coordinates(),
        "peaks": {
            "reactions": [reaction(solution, name) for name in solution.model.constraints],
            "forces": [force(solution, name) for name in solution.model.forces],
            "residual": residual(solution),
            "residual_rate": float(solution.drift.velocity.max(initial=0.0)),
        },
        "energy": energy(solution),
        "settling": [settling_of(solution, name) for name in solution.model.bodies],
        "statistics": dict(solution.statistics),
    }


def mechanism(state: State) -> dict[str, Any]:
    """Elements of the mechanism, and its degrees of freedom in a state."""
    model = state.model
    return {
        "bodies": list(model.bodies),
        "joints": list(model.joints),
        "drivers": list(model.drivers),
        "forces": list(model.forces),
        "coordinates": model.n_q,
        "equations": model.n_rows,
        "degrees_of_freedom": state.matrices().degrees_of_freedom,
    }


def reaction(solution: Solution, name: str) -> dict[str, Any]:
    """Largest reaction of a joint or driver on its body j, with its time."""
    joint = solution.constraint(name)
    on = joint.info.j
    force, force_at = _peak(solution.t, np.linalg.norm(joint.force(on=on), axis=1))
    torque, torque_at = _peak(solution.t, joint.torque(on=on))
    return {
        "joint": name,
        "on": on,
        "force": force,
        "force_at": force_at,
        "torque": torque,
        "torque_at": torque_at,
    }


def force(solution: Solution, name: str) -> dict[str, Any]:
    """Largest force and torque of a force element on its body j, with their times."""
    element = solution.force(name)
    on = element.info.j
    magnitude, at = _peak(solution.t, np.linalg.norm(element.force(on=on), axis=1))
    torque, torque_at = _peak(solution.t, element.torque(on=on))
    parts = {part: _peak(solution.t, element.torque(on=on, part=part))[0] for part in element.parts}
    return {
        "name": name,
        "on": on,
        "force": magnitude,
        "force_at": at,
        "torque": torque,
        "torque_at": torque_at,
        "torque_by_part": parts,
    }


def residual(solution: Solution) -> dict[str, Any] | None:
    """Largest constraint violation with its equation and time; None without constraints."""
    if not solution.model.n_rows:
        return None
    opening = np.abs(solution.residuals[0])
    k, row = np.unravel_index(int(opening.argmax()), opening.shape)
    return {
        "value": float(opening[k, row]),
        "equation": solution.model.row_names()[row],
        "unit": solution.model.row_units()[row],
        "at": float(solution.t[k]),
    }


def energy(solution: Solution) -> dict[str, float]:
    """Largest kinetic energy, dissipated energy, work, and largest error of the balance."""
    found = solution.energy
    return {
        "largest_kinetic": float(found.kinetic.max(initial=0.0)),
        "dissipated": float(found.dissipated[-1]),
        "work": float(found.work[-1]),
        "largest_imbalance": float(np.abs(found.balance).max(initial=0.0)),
    }


def settling_of(solution: Solution, name: str) -> dict[str, Any]:
    """Settling of the angle of a body; ``time`` is None if the angle does not settle."""
    angle = solution.body(name).angle
    found = settling(solution.t, angle)
    return {"body": name, "moves": found.moves, "time": found.time, "angle": float(angle[-1])}


def _peak(t: Floats, values: Floats) -> tuple[float, float]:
    """The value of largest magnitude, with its sign, and its time."""
    k = int(np.abs(values).argmax())
    return float(values[k]), float(t[k])
