"""Assembly: a state in which all joints are closed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import numpy as np

from kempe import _core
from kempe.analyses.record import AssemblyWarning, check, released
from kempe.analyses.request_cache import encode
from kempe.base.arguments import explained
from kempe.base.names import one_of
from kempe.base.warn import warn
from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel
from kempe.model.model import Model, Redundancy, compiled_model
from kempe.model.values import number, numbers
from kempe.results.assembly_report import AssemblyReport
from kempe.results.origin import Origin
from kempe.results.state import State

Coordinates: TypeAlias = "Mapping[str, float | str]"


@explained
def assemble(
    model: Model | CompiledModel,
    set: Coordinates | None = None,  # noqa: A002
    guess: Coordinates | None = None,
    t: float | None = None,
    *,
    from_state: State | None = None,
    redundancy: Redundancy | None = None,
    from_guess: bool = False,
) -> State:
    """Assemble a mechanism.

    Args:
        model: the mechanism.
        set: prescribed coordinates and rates, m, rad, per s: ``{"crank.angle": "70*deg"}``.
        guess: starting values of coordinates and rates; can be incomplete.
        t: time, s; None means the time of ``from_state``, or 0.
        from_state: a state of the same bodies, for example with other parameters or with joints
            that drifted. The mechanism moves from it as little as possible. ``set`` and ``guess``
            have priority over it. Drivers that were released in this state remain released.
        redundancy: "allow" accepts redundant constraints in the assembly and in simulations that
            start from the state; None uses the setting of the model.
        from_guess: start the Newton iteration from the guess with open loops, without closing
            dyads first. This is the classical iteration; see ``state.report.iterations``.

    Returns:
        The state, with ``report``.

    Raises:
        AssemblyError: the mechanism does not close; the message names the open joint.
        RedundancyError: constraints are redundant.
        ModelError: the model is invalid, or ``set`` or ``guess`` contains an unknown name.
    """
    compiled = allowing(compiled_model(model), redundancy)
    held = encode(numbers(set, "set"))
    q = v = z = None
    if isinstance(guess, State):
        raise ModelError("guess: a State", hint="pass it as from_state=")
    hint = encode(numbers(guess, "guess"))
    if from_state is not None:
        check(compiled, from_state, "from_state")
        compiled = compiled.variant(([], released(compiled, from_state), []))
        t = float(from_state.t) if t is None else t
        q, v, z = (np.array(part) for part in (from_state.q, from_state.v, from_state.z))
        z = z if len(z) == compiled.n_z else np.zeros(compiled.n_z)
    t_found, q_found, v_found, z_found, text = _core.assemble(
        compiled.core, held, hint, _time(0.0 if t is None else t), q, v, z, from_guess
    )
    report = AssemblyReport.from_json(text)
    for warning in report.warnings:
        warn(warning, AssemblyWarning)
    state = State(compiled, t_found, q_found, v_found, report, z=z_found)
    if from_state is None and not from_guess and not t:
        state.origin = Origin(dict(set or {}), dict(guess or {}))
    return state


def allowing(model: CompiledModel, redundancy: str | None) -> CompiledModel:
    """The model with redundant constraints accepted, if redundancy is "allow"."""
    if redundancy is None or one_of("redundancy", redundancy, ("refuse", "allow")) == "refuse":
        return model
    return model.allowing_redundancy()


def _time(t: float) -> float:
    value = number(t, "t")
    if isinstance(value, str):
        raise ModelError(f"t: {value!r} is not a number")
    return float(value)
