"""Kinematics and inverse dynamics: the motion that drivers determine, and its efforts."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from kempe import _core
from kempe.analyses import Progress, refuse_foreign
from kempe.arrays import Floats
from kempe.compiled import CompiledModel
from kempe.errors import ModelError, SingularityError
from kempe.model import Model, compiled_model
from kempe.option import core_options
from kempe.options import InverseDynamics, Kinematics
from kempe.request_cache import encode
from kempe.solution import Solution
from kempe.state import State
from kempe.values import Number
from kempe.variable import TIME, Variable

#: Number of outputs over a range or over time, both ends included.
POINTS = 361
#: The method of a solution.
METHOD = "continuation"
#: Sections in which a mechanism over a driven value differs.
_DRIVEN = ("joints", "drivers", "measures")


def kinematics(
    model: Model | CompiledModel,
    start: State,
    *,
    t_end: Number | None = None,
    output_step: Number | None = None,
    over: str | None = None,
    range: tuple[Number, Number] | None = None,  # noqa: A002 - as in a file
    n: int = POINTS,
    progress: Progress | None = None,
) -> Solution:
    """Positions, velocities and accelerations of a mechanism whose drivers determine its motion.

    The motion is computed over time (``t_end``), or over the value of a driver or position quantity
    (``over`` and ``range``). In the second case, ``sol.t`` contains the values, and rates are
    derivatives with respect to the value. The law of the driver is not used, and the laws of other
    drivers keep their value at the start.

    The motion is followed by short steps, so that it stays on its branch. At each output, the
    constraints Φ(q, t) = 0, Φ_q v = ν and Φ_q a = γ are satisfied to rounding (Haug 3.6).

    Args:
        model: the mechanism.
        start: an assembled state.
        t_end: end time, s.
        output_step: time between outputs, s; 1/360 of the interval when None.
        over: name of a driver, or a position quantity such as ``"crank.angle"``.
        range: first and last value, in SI units and rad.
        n: number of values in the range, both ends included.
        progress: function that is called repeatedly with the time reached.

    Raises:
        SingularityError: the motion ends at a limit, such as a dead point. ``value`` is the time or
            value of the limit, ``solution`` the motion up to this limit.
        AssemblyError: the start does not satisfy the constraints.
        ModelError: the drivers leave a freedom, or an argument is invalid.
    """
    entry = Kinematics(t_end, output_step, over, range, n).tree()
    return follow(compiled_model(model), start, entry, progress)


def inverse_dynamics(
    model: Model | CompiledModel,
    start: State,
    *,
    t_end: Number | None = None,
    output_step: Number | None = None,
    over: str | None = None,
    range: tuple[Number, Number] | None = None,  # noqa: A002 - as in a file
    n: int = POINTS,
    static: bool = False,
    progress: Progress | None = None,
) -> Solution:
    """Efforts of the drivers and reactions of the joints for the motion that the drivers prescribe.

    ``kinematics`` computes the motion; its errors apply here too. The multipliers
    follow from M a + Φ_qᵀ λ = Q at each output. Work is the integral of power by adaptive
    quadrature.

    In a motion over a value instead of time, this value changes at unit rate: efforts and reactions
    contain inertia and damping at 1 rad/s or 1 m/s. With ``static``, the mechanism is at rest at
    each value, and rates, accelerations, and forces that depend on rates are zero: Φ_qᵀ λ = Q.

    Args:
        model: the mechanism.
        start: an assembled state.
        t_end: end time, s.
        output_step: time between outputs, s; 1/360 of the interval when None.
        over: name of a driver, or a position quantity such as ``"crank.angle"``.
        range: first and last value, in SI units and rad.
        n: number of values in the range, both ends included.
        static: whether the mechanism is at rest at each value; needs ``over``.
        progress: function that is called repeatedly with the time reached.

    Raises:
        ModelError: a force has first-order states, such as the current of a motor, which do not
            follow from the motion.
    """
    entry = InverseDynamics(t_end, output_step, over, range, n, static=static).tree()
    return follow_with_forces(compiled_model(model), start, entry, progress)


def follow(
    model: CompiledModel, start: State, entry: Mapping[str, Any], progress: Progress | None
) -> Solution:
    """The motion with the options of an entry of a case; see ``kinematics``."""
    if not isinstance(start, State):
        raise ModelError(f"start: {start!r} is not a State", hint="kp.assemble(model) returns one")
    if progress is not None and not callable(progress):
        raise ModelError(f"progress: {progress!r} is not a function")
    refuse_foreign(model, start)
    kept = model.with_analyses({str(entry["type"]): dict(entry)})
    inverse = entry["type"] == InverseDynamics.kind
    text = encode(core_options(entry))
    options = json.loads(_core.kinematics_options(model.core, text, inverse))
    over = options["over"]
    if over is None:
        return _through(kept, start, _times(start.t, options), progress)
    first, last = options["range"]
    driven, value, variable = driven_by(kept, over, start)
    at = State(driven, value, start.q, start.v, z=start.z)
    if first != value:
        at = _through(driven, at, np.array([first]), progress).final
    values = np.linspace(first, last, options["n"])
    variable = replace(variable, static=options["static"])
    return _through(driven, at, values, progress, variable)


def follow_with_forces(
    model: CompiledModel, start: State, entry: Mapping[str, Any], progress: Progress | None
) -> Solution:
    """The motion with reactions and efforts; see ``inverse_dynamics``."""
    names = [info.name for info in model.forces.values() if info.states]
    if names:
        raise ModelError(
            f"{', '.join(names)}: its states do not follow from the motion",
            hint="use dynamics, or leave out the inductance",
        )
    solution = follow(model, start, entry, progress)
    try:
        _ = solution.lam  # reactions that are not unique are an error here
    except KeyboardInterrupt as error:
        error.solution = solution  # type: ignore[attr-defined]
        raise
    return solution


def _through(
    model: CompiledModel,
    start: State,
    times: Floats,
    progress: Progress | None,
    variable: Variable = TIME,
) -> Solution:
    """The motion through given times, or values of a driven quantity."""
    try:
        state = start.t, start.q, start.v, start.z
        run = _core.kinematics(model.core, *state, times, progress, variable.static)
    except BaseException as error:  # including interruptions and exceptions of progress
        partial = vars(error).pop("run", None)
        if isinstance(error, SingularityError):
            error.value = error.t
        if partial is not None and len(partial.t):
            error.solution = Solution(model, partial, METHOD, variable)  # type: ignore[attr-defined]
        raise
    return Solution(model, run, METHOD, variable)


def _times(t: float, options: Mapping[str, Any]) -> Floats:
    """The times of the outputs, both ends included."""
    end, step = options["t_end"], options["output_step"]
    if end < t:
        raise ModelError(
            f"t_end: {end:g} s lies before {t:g} s, where the motion starts",
            hint="t_end is a time, not a duration",
        )
    if step is None:
        return np.linspace(t, end, POINTS)
    whole = t + step * np.arange(int((end - t) / step * (1 + 1e-12)) + 1)
    return whole if np.isclose(whole[-1], end, rtol=1e-12, atol=0) else np.append(whole, end)


def driven_by(
    model: CompiledModel, over: str, start: State
) -> tuple[CompiledModel, float, Variable]:
    """The model with ``over`` driven by t, its value at the start, and the quantity in t.

    Raises:
        ModelError: there is no such driver or position quantity, or several drivers determine the
            motion already.
    """
    case, at = model.model.core_case, (start.t, start.q, start.v, start.z)
    text, quantity, unit, value = case.over(model.core, over, *at)
    written: dict[str, Any] = json.loads(text)
    tree: dict[str, Any] = model.model.tree()
    tree |= {section: written.get(section, {}) for section in _DRIVEN}
    changed = Model.from_tree(model.model.with_points(tree))
    return changed.compile(), value, Variable(quantity, unit)
