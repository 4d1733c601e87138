"""What a user asks for: functions of a model, a state and options."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np

from kempe import _core
from kempe.compiled import CompiledModel
from kempe.errors import ModelError
from kempe.model import Model
from kempe.names import one_of
from kempe.option import Option, core_options
from kempe.options import Auto, Dynamics, Projection
from kempe.request_cache import Request, encode, request
from kempe.solution import Solution
from kempe.state import AssemblyReport, State
from kempe.values import Number, number, numbers

Progress: TypeAlias = "Callable[[float], None]"
Coordinates: TypeAlias = "Mapping[str, float | str]"


class AssemblyWarning(UserWarning):
    """A mechanism went together, but not as one would expect."""


def assemble(
    model: Model | CompiledModel,
    set: Coordinates | None = None,  # noqa: A002
    guess: Coordinates | State | None = None,
    t: float = 0.0,
    *,
    redundancy: str | None = None,
    from_guess: bool = False,
) -> State:
    """Put a mechanism together.

    Args:
        model: the mechanism.
        set: coordinates and rates that are to hold: ``{"crank.angle": "70*deg"}``, m, rad, per s.
        guess: the same for those that may move; may be partial, absent, or a whole state.
        t: time, s.
        redundancy: "allow" accepts constraints that repeat others, here and in what starts from
            the state; as the model says when None.
        from_guess: whether Newton–Raphson starts from the guess as it stands, bodies hung by their
            joints and loops open: the classical iteration, for ``state.report.iterations`` to be
            looked at. By default bodies are placed so that loops close before it starts.

    Returns:
        The state, with ``report``.

    Raises:
        AssemblyError: the mechanism does not close; the message tells where it stays open.
        RedundancyError: a joint repeats another.
        ModelError: the model is wrong, or ``set`` or ``guess`` names what it does not have.
    """
    compiled = _allowing(compiled_model(model), redundancy)
    held = encode(numbers(set or {}, "set"))
    q = v = None
    if isinstance(guess, State):
        _refuse_foreign(compiled, guess)
        q, v, hint = np.array(guess.q), np.array(guess.v), "{}"
    else:
        hint = encode(numbers(guess or {}, "guess"))
    t_found, q_found, v_found, told = _core.assemble(
        compiled.core, held, hint, _time(t), q, v, from_guess
    )
    report = AssemblyReport.from_json(told)
    for text in report.warnings:
        warnings.warn(text, AssemblyWarning, stacklevel=2)
    return State(compiled, t_found, q_found, v_found, report)


def dynamics(
    model: Model | CompiledModel,
    start: State,
    *,
    t_end: Number,
    output_step: Number | None = None,
    method: Option = Auto(),  # noqa: B008 - frozen
    stabilization: Option | None = Projection(),  # noqa: B008 - frozen
    max_steps: int | None = None,
    dense_output: bool = True,
    redundancy: str | None = None,
    singularity: str = "stop",
    progress: Progress | None = None,
) -> Solution:
    """Simulate the motion from a state.

    Args:
        model: the mechanism.
        start: where it starts; ``assemble`` gives one.
        t_end: time at which it ends, s.
        output_step: time between outputs, s; every step when None.
        method: the integrator.
        stabilization: of the constraints; none at all when None.
        max_steps: it gives up after that many steps; 1 000 000 over the number
            of moving bodies when None, at least 50 000. So it does after half as many
            rejected ones, if they are over 10 000.
        dense_output: whether to keep the interpolant between the steps, for ``sol(t)``.
        redundancy: "allow" accepts constraints that repeat others; as the start was assembled
            when None.
        singularity: at a singular position where the motion does not decide how it goes on: "stop"
            with a SingularityError, or "pass" on.
        progress: called now and then with the time reached, s; what it raises ends the simulation.

    Raises:
        IntegrationError: it cannot go on; ``solution`` holds what was computed before. So it is
            with a SingularityError, and with an interruption (``KeyboardInterrupt``).
        ModelError: an option is wrong.
    """
    inherited = start.model.redundancy if isinstance(start, State) else None
    compiled = _allowing(compiled_model(model), redundancy or inherited)
    asked = (t_end, output_step, method, stabilization, max_steps)
    wanted = request(asked, dense_output, singularity)
    return _simulate(compiled.with_analyses({Dynamics.name: wanted.entry}), start, wanted, progress)


def simulate(
    model: CompiledModel, start: State, entry: Mapping[str, Any], progress: Progress | None
) -> Solution:
    """Simulate by an entry of a case, as ``dynamics`` does by arguments."""
    wanted = Request(entry, encode(core_options(entry)))
    return _simulate(model, start, wanted, progress)


def _simulate(
    model: CompiledModel, start: State, wanted: Request, progress: Progress | None
) -> Solution:
    if not isinstance(start, State):
        raise ModelError(f"start: {start!r} is not a State", hint="kp.assemble(model) gives one")
    _refuse_foreign(model, start)
    t, text = float(start.t), wanted.text
    try:
        run = _core.dynamics(model.core, t, start.q, start.v, text, progress, wanted.t_end)
    except BaseException as error:  # an interruption, and what progress raises, keep it too
        partial = getattr(error, "run", None)
        if partial is not None and len(partial.t):
            error.solution = Solution(model, partial)  # type: ignore[attr-defined]
        raise
    return Solution(model, run)


def compiled_model(model: Model | CompiledModel) -> CompiledModel:
    """The model in numbers."""
    if isinstance(model, CompiledModel):
        return model
    if isinstance(model, Model):
        return model.compile()
    raise ModelError(f"{model!r} is not a model", hint="kp.Model(…) makes one")


def _allowing(model: CompiledModel, redundancy: str | None) -> CompiledModel:
    if redundancy is None or one_of("redundancy", redundancy, ("refuse", "allow")) == "refuse":
        return model
    return model.allowing_redundancy()


def _time(t: float) -> float:
    value = number(t, "t")
    if isinstance(value, str):
        raise ModelError(f"t: {value!r} is not a number")
    return float(value)


def _refuse_foreign(model: CompiledModel, state: State) -> None:
    """A state of the same bodies serves, whatever the numbers in the model."""
    if list(state.model.bodies) != list(model.bodies):
        raise ModelError(
            f"the state is of bodies {', '.join(state.model.bodies)}; "
            f"the model has {', '.join(model.bodies)}",
            hint="assemble this model",
        )
