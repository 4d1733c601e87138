"""A simulation that a host program advances step by step: a controller, a game, another program."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from kempe import _core
from kempe.analyses.dynamics import AccuracyWarning, Acting
from kempe.analyses.event import Action, with_actions
from kempe.analyses.option import core_options
from kempe.analyses.options import Dynamics, Projection
from kempe.analyses.record import check, released
from kempe.analyses.request_cache import encode
from kempe.base.arguments import explain_methods
from kempe.base.names import one_of
from kempe.base.warn import warn
from kempe.case import Case
from kempe.errors import AssemblyError, KempeError, ModelError
from kempe.model.functions import FunctionWarning, memory
from kempe.model.measure_infos import MeasureInfo, measure_info
from kempe.model.model import Model
from kempe.model.values import refuse
from kempe.results.energy import Energy
from kempe.results.measures import is_continuous
from kempe.results.quantities import values_of
from kempe.results.solution import Solution
from kempe.results.state import State

if TYPE_CHECKING:
    from kempe.results.events import EventTimes


@dataclass(frozen=True)
class SavedStep:
    """A state of a ``Stepper`` with all that its next steps need, from ``save``.

    Attributes:
        t: its time, s.
    """

    t: float
    _run: _core.SavedRun
    #: The model and the options of its stepper.
    _of: tuple[_core.Model, str]
    #: The memories of its controllers.
    _memories: tuple[bytes, ...]

    def __repr__(self) -> str:
        return f"<SavedStep at t = {self.t:g} s>"


@explain_methods
class Stepper:
    """A simulation that advances by steps, with inputs that may change between them.

    ``stepper["crank.angle"]`` is a quantity at the present time, and ``stepper["crank"]`` a body,
    joint or force. A step is a run of ``kp.dynamics`` that ends exactly ``dt`` later: it takes as
    many steps of the method as its tolerances need, and locates the events inside.

    Args:
        case: the case, or a model, which starts as ``kp.assemble`` assembles it.
        analysis: the analysis of type dynamics whose options are used: its name, or a
            ``kp.Dynamics``, which starts where the case starts. By default the first one of the
            case; without one, the options of ``kp.dynamics``. Its end and its output do not matter.

    Raises:
        AssemblyError: the mechanism does not close.
        ModelError: there is no such analysis, or an option is invalid.
    """

    def __init__(self, case: Case | Model, analysis: str | Dynamics | None = None) -> None:
        case = Case(case) if isinstance(case, Model) else case
        if not isinstance(case, Case):
            raise ModelError(f"{case!r} is not a case", hint="kp.load(…) reads one")
        entry, self._actions, self._start = _request(case, analysis)
        stabilization = entry.get("stabilization", {"type": Projection.kind})
        self._passing = stabilization["type"] == Projection.kind
        self._text = encode(core_options(entry))
        self._model = case.model.compile().with_analyses({Dynamics.name: entry})
        self._functions = ExitStack()
        self._begin(self._start)

    def _begin(self, start: State) -> None:
        check(self._model, start)
        self._functions.close()
        for remark in self._functions.enter_context(self._model.run()):
            warn(remark, FunctionWarning)
        self._controllers = [law for law in self._model.functions if law.sampling is not None]
        self._runs = [law.runs for law in self._controllers]
        actions = self._actions
        acting = (list(actions), Acting(self._model, start, actions)) if actions else None
        at = float(start.t), start.q, start.v, start.z
        before = released(self._model, start)
        self._run = _core.SteppedRun(self._model.core, self._text, at, before, acting)
        self._variant, self._setting = self._model, self._model.core.setting
        self._doubted: set[str] = set()
        self._moved()

    def _moved(self) -> None:
        self._state: State | None = None
        self._events: Mapping[str, EventTimes] | None = None

    @property
    def t(self) -> float:
        """The time reached, s."""
        return self._run.t

    @property
    def state(self) -> State:
        """The present state."""
        if self._state is None:
            t, q, v, z = self._run.state
            if (setting := self._run.setting) != self._setting:
                self._variant, self._setting = self._model.variant(setting), setting
            self._state = State(self._variant, t, q, v, z=z)
            self._state._passing = self._passing
        return self._state

    def __getitem__(self, name: str) -> Any:
        info = self._model.measures.get(name)
        if name.startswith("energy.") or (info is not None and info.is_of_run):
            return self._energetic(info or measure_info(self._model, name))
        return self.state[name]

    def _energetic(self, info: MeasureInfo) -> float:
        """A quantity that depends on the works since the start."""
        if not is_continuous(info):
            raise ModelError(
                f"{info.name}: a balance, or the loss of one element, belongs to a whole run",
                hint="kp.dynamics gives it; energy.dissipated is the loss of all elements",
            )
        rows = self._run.works[None]
        (found,) = self.state._asked(lambda states, works: [states.energies(works)], rows)
        return float(values_of(self.state, info, Energy(found))[0])

    @property
    def parameters(self) -> Mapping[str, float]:
        """The values of the parameters at present."""
        return self.state.compiled.parameters

    @property
    def events(self) -> Mapping[str, EventTimes]:
        """The events since the last step, as in a solution: all by name, most of them empty."""
        if self._events is None:
            solution = Solution(self._model, self._run.last_part(), "stepper")
            self._events = solution.events
        return self._events

    @property
    def stopped_by(self) -> str | None:
        """The event that stopped the run inside the last step; ``t`` is its time."""
        return self._run.stopped_by

    def set(self, parameter: str, value: float) -> None:
        """Give a parameter another value, which holds from now on.

        The value may change loads, laws of forces, masses or voltages. Positions and velocities
        stay, so a value that opens a joint or contradicts a driver is refused.

        Args:
            parameter: its name.
            value: its value, in SI units and rad.

        Raises:
            ModelError: there is no such parameter, or the value is impossible.
            AssemblyError: a joint or driver would not be closed any more; ``name`` is its name.
        """
        one_of("parameter", parameter, self._model.parameters)
        number = _number(value, parameter)
        try:
            self._run.set([(parameter, number)])
        except KempeError as error:
            error.args = (f"{parameter} = {number:g}: {error.args[0]}", *error.args[1:])
            if isinstance(error, AssemblyError):
                error.hint = (
                    "positions and velocities stay when an input changes; a new stepper of case."
                    f"with_parameters({{'{parameter}': {number:g}}}) is assembled with this value"
                )
            raise
        self._moved()

    def step(self, dt: float) -> None:
        """Advance by ``dt``, or to the event that stops the run.

        After an error, the stepper is in the state before the step.

        Args:
            dt: the duration, s.

        Raises:
            IntegrationError: the method cannot continue, or the result exceeds a limit.
            SingularityError: the motion is not unique in a singular position.
            ModelError: ``dt`` is not positive, or an event has stopped the run.
        """
        if self._controllers:
            self._look_at_controllers()
        doubts = self._run.step(dt if type(dt) is float else _number(dt, "dt"))
        self._state = self._events = None
        for doubt in doubts:
            # the words before the first number say what kind it is
            kind = re.split(r"\d", doubt, maxsplit=1)[0]
            if kind not in self._doubted:
                self._doubted.add(kind)
                warn(doubt, AccuracyWarning)

    def _look_at_controllers(self) -> None:
        """Warn if another run has begun with the controllers of this one."""
        for k, law in enumerate(self._controllers):
            if law.runs != self._runs[k]:
                self._runs[k] = law.runs
                message = (
                    f"{law.path}: another run has used the controller {law!r}, so that its memory "
                    "is no longer that of this stepper; give each of them a model with its own one"
                )
                warn(message, FunctionWarning)

    def save(self) -> SavedStep:
        """The present state with all that the next steps need; ``restore`` continues from it.

        The memory of Python functions is not part of it.
        """
        memories = tuple(memory(law.f) for law in self._controllers)
        return SavedStep(self.t, self._run.save(), (self._model.core, self._text), memories)

    def restore(self, saved: SavedStep) -> None:
        """Continue from a saved state; the next steps are equal to the last bit.

        A ``FunctionWarning`` names each controller whose memory has changed since then.

        Args:
            saved: a state from ``save``, of this stepper or of another one of the same model and
                options.

        Raises:
            ModelError: it is not such a state.
        """
        if not isinstance(saved, SavedStep):
            raise ModelError(f"saved: {saved!r} is not a saved state", hint="save() returns one")
        if saved._of[0] is not self._model.core or saved._of[1] != self._text:
            hint = "restore states of this stepper, or of one with the same model and analysis"
            raise ModelError("saved: it is the state of another model or analysis", hint=hint)
        self._run.restore(saved._run)
        self._moved()
        for law, before in zip(self._controllers, saved._memories, strict=True):
            if memory(law.f) != before:
                message = (
                    f"{law.path}: the controller {law!r} keeps its present memory, which is not "
                    f"that of t = {saved.t:g} s, so that the next steps may differ"
                )
                warn(message, FunctionWarning)

    def reset(self, start: State | None = None) -> None:
        """Begin again, with the inputs of the case.

        Args:
            start: another state from which to begin, now and in later resets.

        Raises:
            AssemblyError: ``start`` violates the constraints.
        """
        if start is not None:
            check(self._model, start)
        self._begin(self._start if start is None else start)
        self._start = self._start if start is None else start

    def __repr__(self) -> str:
        return f"<Stepper of {self._model.title!r} at t = {self.t:g} s>"


def _number(value: object, path: str) -> float:
    """A finite number.

    Raises:
        ModelError: it is not one.
    """
    try:
        found = math.nan if isinstance(value, bool | str) else float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        found = math.nan
    if not math.isfinite(found):
        refuse(path, f"{value!r}; must be a finite number, in SI units and rad")
    return found


def _request(
    case: Case, analysis: str | Dynamics | None
) -> tuple[Mapping[str, Any], Mapping[str, Action], State]:
    """The options of an analysis as in a file, its actions, and the state in which it starts."""
    if isinstance(analysis, Dynamics):
        plain, actions = with_actions(analysis.events)
        return replace(analysis, events=plain or None).tree(), actions, case.start()  # type: ignore[arg-type]
    entries = case.analyses
    of_type = [name for name, entry in entries.items() if entry["type"] == Dynamics.kind]
    if analysis is None:
        analysis = next(iter(of_type), None)
        if analysis is None:
            return Dynamics(0.0).tree(), {}, case.start()
    one_of("analysis of type dynamics", analysis, of_type)
    return entries[analysis], {}, _start_of(case, analysis)


def _start_of(case: Case, name: str) -> State:
    """The state in which an analysis starts. Earlier ones are run if it starts at their end."""
    names, (_, after) = list(case.analyses), case._core().analyses()
    chain: list[str] = []
    at = after[names.index(name)]
    while at is not None:
        chain.insert(0, names[at])
        at = after[at]
    if not chain:
        return case.start()
    before = case._with(analyses={name: case.analyses[name] for name in chain})
    state: State = list(before.run().values())[-1].final
    return state
