"""Dynamics: the motion from a state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, Literal

from kempe._upwards import CALLS
from kempe.analyses.assembly import allowing
from kempe.analyses.event import Action, Events, with_actions
from kempe.analyses.option import Option, core_options
from kempe.analyses.options import Auto, Dynamics, Projection
from kempe.analyses.record import (
    Progress,
    keep_solution,
    run_analysis,
    solution_of,
)
from kempe.analyses.request_cache import Request, encode, request
from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.base.names import unknown
from kempe.base.warn import warn
from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel
from kempe.model.functions import FunctionWarning
from kempe.model.infos import Setting
from kempe.model.model import Model, Redundancy, compiled_model
from kempe.model.values import Number, numbers
from kempe.results.events import EventWarning, true_at_start, warnings_of
from kempe.results.solution import Solution
from kempe.results.state import State


class AccuracyWarning(UserWarning):
    """A result exceeds a limit of accuracy, by an error that belongs to the chosen method."""


@explained
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
    redundancy: Redundancy | None = None,
    singularity: Literal["stop", "pass"] = "stop",
    events: Events | None = None,
    stop: str | None = None,
    release: Sequence[str] = (),
    parameters: Mapping[str, Number] | None = None,
    slopes: Sequence[str] = (),
    progress: Progress | None = None,
    **limits: Number,
) -> Solution:
    """Simulate the motion from a state.

    Args:
        model: the mechanism.
        start: the initial state, from ``assemble``; joints closed to 1e-9 of the mechanism's size.
        t_end: end time, s.
        output_step: time between outputs, s; None stores an output after every step.
        method: the integrator.
        stabilization: stabilization of the constraints; None for no stabilization.
        max_steps: largest number of steps; see ``kp.Dynamics`` for None and for rejected steps.
        dense_output: keep the interpolant for ``sol(t)``.
        redundancy: "allow" accepts redundant constraints; by default the setting of ``start``.
        singularity: "stop" with an error where the velocity does not determine the branch, "pass".
        events: conditions such as ``"rocker.angle > 270*deg"``, or ``kp.Event``, by name.
        stop: condition at which the run ends, the event ``stop``.
        release: drivers that no longer act, in this run and in runs that start from its states.
        parameters: other values of parameters; the start must satisfy the constraints with them.
        slopes: variables whose slopes are kept, such as ``["k", "L2"]``; see ``Solution.slope``.
        progress: function of the time reached, s; an exception ends the run.
        limits: other fields of ``kp.Dynamics``: ``impacts``, ``restitution_law``, ``force_limit``.

    Raises:
        AssemblyError: the start violates the constraints; see ``from_state`` of ``assemble``.
        IntegrationError: the integrator cannot continue, or the result exceeds a limit. Its
            ``solution`` is the motion up to that time, as in the others and in KeyboardInterrupt.
        SingularityError: the motion is not unique in a singular position.
        ModelError: an option is invalid.
    """
    inherited = start.compiled.redundancy if isinstance(start, State) else None
    compiled = allowing(compiled_model(model), redundancy if redundancy is not None else inherited)
    fields = (t_end, output_step, method, stabilization, max_steps)
    plain, actions = with_actions(events)
    given = {"events": plain, "stop": stop, "release": release, "parameters": parameters}
    given = {name: value for name, value in given.items() if value} | limits
    wanted = request(fields, dense_output, singularity, given)
    model = compiled.with_analyses({Dynamics.name: wanted.entry})
    along = slopes_along(compiled, start, wanted.entry, slopes, actions)
    solution = _simulate(model, start, wanted, progress, actions=actions)
    solution._slopes = along
    return solution


def slopes_along(
    model: CompiledModel,
    start: State,
    entry: Mapping[str, Any],
    variables: Sequence[str],
    actions: Mapping[str, Action] = MappingProxyType({}),
) -> Any:
    """The slopes of a run by some variables; None without variables.

    Raises:
        ModelError: a variable is invalid, or the slopes are not known.
    """
    if not variables:
        return None
    if actions:
        raise ModelError("slopes: not together with actions of events, whose slopes are not known")
    return CALLS["slopes"](model, start, entry, variables)


def simulate(
    model: CompiledModel,
    start: State,
    entry: Mapping[str, Any],
    progress: Progress | None = None,
    after: str | None = None,
) -> Solution:
    """Simulate with the options of an entry of a case; see ``dynamics``."""
    return _simulate(
        model, start, Request(entry, encode(core_options(entry))), progress, after=after
    )


def _simulate(
    model: CompiledModel,
    start: State,
    wanted: Request,
    progress: Progress | None,
    *,
    after: str | None = None,
    actions: Mapping[str, Action] = MappingProxyType({}),
) -> Solution:
    entry, method = wanted.entry, _method(wanted.entry)
    acting = (list(actions), Acting(model, start, actions)) if actions else None
    text, t_end = wanted.text, wanted.t_end
    try:
        with model.run() as remembered:
            for remark in remembered:
                warn(remark, FunctionWarning)
            record = run_analysis(
                model, start, entry, progress, after=after, text=text, t_end=t_end, acting=acting
            )
    except BaseException as error:  # including interruptions and exceptions of progress
        keep_solution(error, method)
        raise
    solution = solution_of(record, method)
    run = record.run
    assert run is not None
    for doubt in run.doubts:
        warn(doubt, AccuracyWarning)
    declared = any(any(info.events) for info in model.constraints.values())
    if declared or run.events:
        for warning in [*warnings_of(solution), *true_at_start(solution, entry)]:
            warn(warning, EventWarning)
    return solution


class Acting:
    """Calls the actions of events.

    Args:
        model: the model of the run.
        start: first state of the run.
        actions: the actions by the name of their event.
    """

    def __init__(self, model: CompiledModel, start: State, actions: Mapping[str, Action]) -> None:
        self._model, self._passing, self._actions = model, start._passing, actions

    def __call__(
        self, name: str, setting: Setting, t: float, *at: Floats
    ) -> tuple[list[tuple[str, float]], tuple[Floats, Floats, Floats] | None]:
        """The parameters and the state that an action changes."""
        q, v, z = at
        state = State(self._model.variant(setting), t, q, v, z=z)
        state._passing = self._passing
        answer = self._actions[name](state)
        if answer is None:
            return [], None
        if isinstance(answer, State):
            return [], _state_after(name, t, answer)
        if not isinstance(answer, Mapping):
            raise ModelError(
                f"the action of {name} returned {answer!r}",
                name=name,
                hint="it must return None, a mapping of parameters to values, or a State",
            )
        known = self._model.parameters
        for parameter in answer:
            if parameter not in known:
                raise unknown(f"parameter in the action of {name}", parameter, known)
        found = numbers(answer, f"events.{name}.action")
        if texts := [text for text in found.values() if isinstance(text, str)]:
            raise ModelError(f"the action of {name} returned {texts[0]!r}; must be a number")
        return [(parameter, float(value)) for parameter, value in found.items()], None


def _state_after(name: str, t: float, state: State) -> tuple[Floats, Floats, Floats]:
    if float(state.t) != t:
        raise ModelError(
            f"the action of {name} returned a state at t = {state.t:g} s; must be at {t:g} s",
            name=name,
        )
    return state.q, state.v, state.z


def _method(entry: Mapping[str, Any]) -> str:
    """The type of the method in an entry of ``[analyses]``."""
    method = entry.get("method", Auto.kind)
    return str(method["type"] if isinstance(method, Mapping) else method)
