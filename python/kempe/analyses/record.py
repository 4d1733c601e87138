"""Running an analysis in the core, and what it found."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from kempe import _core
from kempe.analyses.option import core_options
from kempe.analyses.request_cache import encode
from kempe.base.arrays import Floats
from kempe.base.warn import warn
from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel
from kempe.results.solution import Solution
from kempe.results.state import State
from kempe.results.variable import TIME, Variable

Progress: TypeAlias = "Callable[[float], None]"
#: Names of events, and the function that acts at them.
Acting: TypeAlias = "tuple[list[str], Callable[..., object]]"
#: Sections in which a mechanism over a driven value differs.
_DRIVEN = ("joints", "drivers", "measures")
#: Sections of a case that are not its mechanism.
_OTHERS = ("start", "analyses", "sweep", "gradient", "optimize", "fit")


class AssemblyWarning(UserWarning):
    """The mechanism can be assembled, but the result may be unexpected."""


@dataclass(frozen=True)
class Record:
    """What an analysis found.

    Attributes:
        entry: the analysis, as in a file.
        initial: the state in which it started.
        model: the model of its states: without the drivers that were released before the start, or
            with the driver of a quantity that replaces the time.
        variable: this quantity; otherwise the time.
        value: the value of this quantity at the start.
        run: the motion; None if the result is not one.
        numbers: other numbers by name, (n, width).
        findings: the other findings by name.
        number: a number of a result that is not a motion by its name, as sweeps read it.
    """

    entry: Mapping[str, Any]
    initial: State
    model: CompiledModel
    variable: Variable
    value: float
    run: _core.Run | None
    numbers: Mapping[str, Floats]
    findings: Mapping[str, Any]
    number: Callable[[str], float]

    @property
    def at_start(self) -> State:
        """The state at the start, without the drivers that were released before."""
        start = self.initial
        return State(self.model, start.t, start.q, start.v, start.report, z=start.z)


def run_analysis(
    model: CompiledModel,
    start: State,
    entry: Mapping[str, Any],
    progress: Progress | None = None,
    *,
    after: str | None = None,
    text: str | None = None,
    t_end: float | None = None,
    acting: Acting | None = None,
) -> Record:
    """Run an analysis from a state.

    Args:
        model: the mechanism.
        start: the state.
        entry: the analysis, as in a file.
        progress: called repeatedly with the time or value reached, or the number of steps.
        after: its name in a case if it starts at the end of another analysis. If joints drifted
            there, it starts from the nearest state that satisfies the constraints, with an
            ``AssemblyWarning``.
        text: the entry as JSON, if it is known.
        t_end: an end time that replaces that of the entry.
        acting: acts at events.

    Raises:
        KempeError: the analysis failed. ``record`` of the error contains the motion so far.
    """
    check(model, start)
    if progress is not None and not callable(progress):
        raise ModelError(f"progress: {progress!r} is not a function")
    text = encode(core_options(entry)) if text is None else text
    before = released(model, start)
    at = float(start.t), start.q, start.v, start.z
    try:
        found = _core.run_analysis(
            model.core, text, at, before, progress, after is not None, t_end, acting
        )
    except BaseException as error:  # including interruptions and exceptions of progress
        partial = vars(error).pop("record", None)  # which cannot be pickled with the error
        if partial is not None:
            error.record = _record(model, start, entry, before, partial)  # type: ignore[attr-defined]
        raise
    for remark in found.remarks:
        told = remark if after is None else f"{after}: {remark}"
        warn(told, AssemblyWarning)
    return _record(model, start, entry, before, found)


def _record(
    model: CompiledModel,
    start: State,
    entry: Mapping[str, Any],
    before: Sequence[str],
    found: _core.Record,
) -> Record:
    variable, value = TIME, float(start.t)
    if found.driven is not None:
        model, variable, value = _driven(model, found.driven)
    elif found.run is None:
        model = model.variant(([], list(before), []))
    findings = {} if found.run is not None else json.loads(found.findings)
    read = found.number
    return Record(entry, start, model, variable, value, found.run, found.numbers, findings, read)


def solution_of(record: Record, method: str) -> Solution:
    """The motion that an analysis found."""
    assert record.run is not None
    return Solution(record.model, record.run, method, record.variable)


def keep_solution(error: BaseException, method: str) -> None:
    """Add the motion so far to an error as ``solution``, if it has a state."""
    partial: Record | None = vars(error).pop("record", None)
    if partial is not None and partial.run is not None and len(partial.run.t):
        error.solution = solution_of(partial, method)  # type: ignore[attr-defined]


def driven_by(
    model: CompiledModel, over: str | None, start: State
) -> tuple[CompiledModel, Variable, float]:
    """The model with ``over`` driven by t, the quantity in t, and its value at the start.

    By default, ``over`` is the only driver.

    Raises:
        ModelError: there is no such driver or position quantity, or several drivers determine the
            motion already.
    """
    at = float(start.t), start.q, start.v, start.z
    return _driven(model, _core.driven_by(model.core, over, at, released(model, start)))


def _driven(model: CompiledModel, driven: _core.Driven) -> tuple[CompiledModel, Variable, float]:
    core, text, quantity, unit, value, rests = driven
    written = json.loads(text)
    changed = {section: written.get(section, {}) for section in _DRIVEN}
    return model.replaced(core, changed, _OTHERS), Variable(quantity, unit, rests), value


def released(model: CompiledModel, state: State) -> list[str]:
    """The drivers of a model that were released before a state."""
    return [name for name in state.compiled.released if name in model.drivers]


def check(model: CompiledModel, start: State, name: str = "start") -> None:
    """Refuse what is not a state, and a state with other bodies.

    The core refuses states that violate the constraints.
    """
    if not isinstance(start, State):
        raise ModelError(f"{name}: {start!r} is not a State", hint="kp.assemble(model) returns one")
    if list(start.compiled.bodies) != list(model.bodies):
        raise ModelError(
            f"the state has the bodies {', '.join(start.compiled.bodies)}; "
            f"the model has the bodies {', '.join(model.bodies)}",
            hint="assemble this model",
        )
