"""The summary of a solution as plain data."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from kempe._version import __version__
from kempe.base.arrays import Floats
from kempe.results.extremes import Sampled
from kempe.results.remarks import unbounded_at
from kempe.results.settling import settling
from kempe.results.singular import singular_positions
from kempe.results.sizes import size_of

if TYPE_CHECKING:
    from kempe.results.motion import Motion
    from kempe.results.solution import Solution
    from kempe.results.state import State

#: Angles below this are rounding errors, rad.
_NO_ANGLE = 1e-9
#: Part of the largest force times the size below which a torque is a rounding error: some hundred
#: units in the last place, as after a solution of the equations.
_NO_TORQUE = 1e-13
#: Largest number of coordinates of which the free ones are found.
_MOST = 300
#: Part of the largest singular value below which an equation depends on others.
_DEPENDENT = 1e-7


def summary(solution: Solution) -> dict[str, Any]:
    """The summary of a solution; see ``kempe.report.summary``."""
    sampled = Sampled(solution)
    compiled = solution.compiled
    return {
        "kempe": __version__,
        "title": compiled.title,
        "success": solution.success,
        "message": solution.message,
        "time": {
            "start": float(solution.t[0]),
            "end": float(solution.t[-1]),
            "outputs": len(solution.t),
        },
        "variable": {"name": solution.variable.name, "unit": solution.variable.unit},
        "static": solution.variable.static,
        "mechanism": mechanism(solution.initial),
        "start": solution.initial.coordinates(),
        "end": solution.final.coordinates(),
        "peaks": {
            "reactions": [reaction(sampled, name) for name in compiled.constraints],
            "forces": [force(sampled, name) for name in compiled.shown_forces],
            "residual": residual(sampled),
            "residual_rate": max(_largest_rate(solution), _largest_rate(sampled.steps)),
        },
        "singular": singular_positions(solution),
        "energy": energy(sampled),
        "newton_euler": solution.newton_euler.largest,
        "measures": [measure(solution, name) for name in compiled.measures],
        "events": {name: event.t.tolist() for name, event in solution.events.items()},
        "settling": [settling_of(sampled, name) for name in _may_settle(solution.final)],
        "statistics": {k: v for k, v in solution.statistics.items() if k != "singular"},
    }


def measure(solution: Solution, name: str) -> dict[str, Any]:
    """The statistics of a measure; None for statistics without a value.

    ``unbounded_at``, ``unique`` and ``choice`` are those of the reactions in it, as for a reaction.
    """
    found = solution.measure(name)
    about = {"name": name, "expression": found.info.expression, "unit": found.unit}
    about["integral_unit"] = found.integral_unit
    remarked = {
        "unbounded_at": list(found.unbounded_at),
        "unique": found.unique,
        "choice": found.choice,
    }
    return {**about, **found.statistics(), **remarked}


def mechanism(state: State) -> dict[str, Any]:
    """Elements of the mechanism, and its degrees of freedom in a state."""
    model = state.compiled
    return {
        "bodies": list(model.shown_bodies),
        "joints": list(model.joints),
        "drivers": list(model.drivers),
        "forces": list(model.shown_forces),
        "coordinates": model.n_q,
        "equations": model.n_rows,
        "degrees_of_freedom": state.matrices().degrees_of_freedom,
    }


def reaction(sampled: Sampled, name: str) -> dict[str, Any]:
    """Largest reaction of a joint or driver on its body j, with its time.

    ``unbounded_at`` are the times of singular positions beside which it has no bound. The peaks
    exclude the values there. ``unique`` is False if the reaction is not unique; ``choice`` then
    says which of the possible values is given.
    """
    on = sampled.solution.compiled.constraints[name].j
    read = partial(_force, name, on)
    force = sampled.peak(read)
    torque = sampled.peak(lambda motion: motion.constraint(name).torque(on=on))
    arm = size_of(sampled.solution.initial)
    has_torque = abs(torque.value) > _NO_TORQUE * force.value * arm
    choice = sampled.solution.constraint(name).choice
    return {
        "joint": name,
        "on": on,
        "force": force.value,
        "force_at": force.t,
        "torque": torque.value if has_torque else 0.0,
        "torque_at": torque.t if has_torque else float(sampled.solution.t[0]),
        "unbounded_at": list(unbounded_at(sampled.solution, name)),
        "unique": not choice,
        "choice": choice,
    }


def _force(name: str, on: str, motion: Motion) -> Floats:
    return _size(motion.constraint(name).force(on=on))


def force(sampled: Sampled, name: str) -> dict[str, Any]:
    """Largest force and torque of a force element on its body j, with their times."""
    info = sampled.solution.compiled.forces[name]
    on = info.j
    magnitude = sampled.peak(lambda motion: _size(motion.force(name).force(on=on)))
    torque = sampled.peak(lambda motion: motion.force(name).torque(on=on))
    parts = {}
    for part in info.parts:
        read = partial(_torque, name, on, part)
        parts[part] = sampled.peak(read).value
    return {
        "name": name,
        "on": on,
        "force": magnitude.value,
        "force_at": magnitude.t,
        "torque": torque.value,
        "torque_at": torque.t,
        "torque_by_part": parts,
        "unique": not (choice := sampled.solution.choices.get(name, "")),
        "choice": choice,
    }


def _torque(name: str, on: str, part: str, motion: Motion) -> Floats:
    return motion.force(name).torque(on=on, part=part)


def residual(sampled: Sampled) -> dict[str, Any] | None:
    """Largest constraint violation with its equation and time; None without constraints."""
    model = sampled.solution.compiled
    if not model.n_rows:
        return None
    worst = max(
        (sampled.solution, sampled.steps),
        key=lambda motion: float(np.abs(motion.residuals[0]).max()),
    )
    opening = np.abs(worst.residuals[0])
    k, row = np.unravel_index(int(opening.argmax()), opening.shape)
    return {
        "value": float(opening[k, row]),
        "equation": model.row_names()[row],
        "unit": model.row_units()[row],
        "at": float(worst.t[k]),
    }


def _largest_rate(motion: Motion) -> float:
    return float(np.abs(motion.residuals[1]).max(initial=0.0))


def energy(sampled: Sampled) -> dict[str, float]:
    """Largest kinetic energy, dissipated energy, work, and largest error of the balance.

    The error is relative to ``scale``, the largest energy of the run.
    """
    found = sampled.solution.energy
    largest = sampled.peak(kinetic_energy)
    return {
        "largest_kinetic": largest.value,
        "largest_kinetic_at": largest.t,
        "dissipated": float(found.dissipated[-1]),
        "work": float(found.work[-1]),
        "scale": found.scale,
        "largest_imbalance": float(np.abs(found.balance).max()),
    }


def kinetic_energy(motion: Motion) -> Floats:
    """Kinetic energy of all bodies, (n_t,), J."""
    total = np.zeros(len(motion.t))
    for name, info in motion.compiled.bodies.items():
        body = motion.body(name)
        velocity = body.at(info.center).velocity
        total += 0.5 * info.mass * (velocity**2).sum(axis=1)
        total += 0.5 * info.inertia * body.omega**2
    return total


def _may_settle(state: State) -> list[str]:
    """The bodies whose rest the drivers that act do not decide.

    Their angle is free, or joints alone hold it while the body may move.
    """
    model = state.compiled
    shown = list(model.shown_bodies)
    acting = set(model.drivers) - set(model.released)
    if not acting:
        return shown
    if model.n_q > _MOST:
        driven = model.redundancy == "refuse" and not model.released and model.n_rows == model.n_q
        return [] if driven else shown
    found = state.matrices()
    named = set(model.row_names())  # without friction that sticks and contacts at rest
    own = np.array([name in named for name in found.rows])
    of_joints = np.array([name.rpartition(".")[0] not in acting for name in found.rows])
    size = size_of(state) or 1.0
    of = [np.where(np.array(of) == "m", size, 1.0) for of in (model.column_units(), found.units)]
    phi_q = found.Phi_q * of[0] / of[1][:, None]
    free, undriven = _free(phi_q[own]), _free(phi_q[own & of_joints])
    places = {name: model.bodies[name].columns for name in shown}
    turns = {name: at.stop - 1 for name, at in places.items()}
    return [
        name
        for name in shown
        if free[turns[name]] or (free[places[name]].any() and not undriven[turns[name]])
    ]


def _free(phi_q: Floats) -> NDArray[np.bool_]:
    """Whether each coordinate may change while Φ_q v = 0, (n_q,)."""
    _, sizes, basis = np.linalg.svd(phi_q)
    free = basis[int((sizes > _DEPENDENT * sizes.max(initial=0.0)).sum()) :]
    return np.asarray(np.abs(free).max(axis=0, initial=0.0) > _DEPENDENT)


def settling_of(sampled: Sampled, name: str) -> dict[str, Any]:
    """Settling of the angle of a body; ``time`` is None if the angle does not settle."""
    motion, solution = sampled.motion, sampled.solution
    noise = max(_NO_ANGLE, _turning_by_violation(sampled))
    found = settling(
        motion.t,
        motion.body(name).angle,
        between=(lambda t: solution(t).body(name).angle) if sampled.is_continuous else None,
        noise=noise,
    )
    angle = float(solution.body(name).angle[-1])
    shown = 0.0 if abs(angle) <= noise and not found.moves else angle
    return {"body": name, "moves": found.moves, "time": found.time, "angle": shown}


def _turning_by_violation(sampled: Sampled) -> float:
    """An angle by which open joints may turn a body: twice the largest opening over the size."""
    model = sampled.solution.compiled
    points = [point for body in model.all_bodies.values() for point in body.points.values()]
    size = float(np.ptp(np.array([(0.0, 0.0), *points]), axis=0).max())
    opening = float(sampled.solution.drift.position.max())
    return 2.0 * opening / size if size > 0.0 else 0.0


def _size(vectors: Floats) -> Floats:
    return np.hypot(vectors[:, 0], vectors[:, 1])
