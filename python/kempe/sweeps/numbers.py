"""Numbers of results that are not motions, such as ``lower`` of limits, with their units."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.analyses.record import driven_by
from kempe.base.names import few, unknown
from kempe.errors import ModelError
from kempe.model.catalogue import declared
from kempe.model.measure_infos import measure_info
from kempe.model.values import refuse
from kempe.results.measures import STATISTICS
from kempe.results.state import State
from kempe.results.variable import Variable

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel

#: The numbers of each type of analysis with their SI units; "over" is the unit of the quantity.
NUMBERS: Mapping[str, Mapping[str, str]] = {
    kind: dict(analysis.get("numbers", ())) for kind, analysis in declared("analyses").items()
}
#: The way to measure the result of another analysis.
ANOTHER = 'name another analysis: analysis="NAME", or --analysis NAME'
#: The force or torque of a holder or driver at rest, such as ``effort.crank.angle``.
_EFFORT = "effort."
_PLACED = re.compile(r"(.+?)(?:\[(-?\d+)\])?")


def unit_of(model: CompiledModel, entry: Mapping[str, Any], text: str) -> str:
    """The SI unit of a number, which is checked.

    Args:
        model: the model.
        entry: the analysis, as in a file.
        text: such as ``lower``, ``frequency[0]``, ``effort.crank.angle`` or ``rocker.angle``.

    Raises:
        ModelError: the result of the analysis has no such number.
    """
    kind = str(entry["type"])
    name, _ = _parts(text)
    known = NUMBERS[kind]
    if name in known:
        return over_of(model, entry).unit if known[name] == "over" else known[name]
    if name.startswith("effort["):
        raise ModelError(f"measures: {text!r} is unknown", hint="write effort.crank.angle")
    if kind != "equilibrium" or not ("." in name or name in model.measures):
        error = unknown(f"number of the result of {kind}", name, known)
        if "." in name:
            error.hint = f"{kind} has the numbers {few(known)}; for others, {ANOTHER}"
        raise error
    if name.startswith(_EFFORT):
        return _unit_of_effort(model, entry, name.removeprefix(_EFFORT))
    quantity, _, last = name.rpartition(".")
    if last in STATISTICS and quantity:
        raise ModelError(
            f"measures: {text!r} is a statistic of a motion, and an equilibrium is one instant",
            hint=f"write {quantity}, or {ANOTHER}",
        )
    info = measure_info(model, _expression(model, name))
    if info.is_of_run:
        refuse("measures", f"{text!r} is a quantity of a whole run, which an equilibrium has not")
    return info.unit


def kinds_with(text: str) -> list[str]:
    """The types of analyses whose results have a number."""
    name, _ = _parts(text)
    return [kind for kind, known in NUMBERS.items() if name in known]


def over_of(model: CompiledModel, entry: Mapping[str, Any]) -> Variable:
    """The quantity over which an analysis follows a motion, with its unit."""
    return driven_model(model, entry.get("over"))[1]


def reads_quantities(kind: str, texts: Iterable[str]) -> bool:
    """Whether some texts are not numbers that the result of a type of analysis has."""
    return any(_parts(text)[0] not in NUMBERS[kind] for text in texts)


def driven_model(model: CompiledModel, over: str | None) -> tuple[CompiledModel, Variable]:
    """The model in which a quantity is driven, and this quantity; by default the only driver.

    Raises:
        ModelError: there is no such quantity, or several drivers determine the motion already.
    """
    rest = (np.zeros(model.n_q), np.zeros(model.n_q))  # names and units need no position
    return driven_by(model, over, State(model, 0.0, *rest, z=np.zeros(model.n_z)))[:2]


def read_at(found: Any, text: str) -> tuple[State, tuple[str, ...]] | None:
    """The state in which a number at rest is read, and the quantities that it reads.

    None for a number that is not a quantity or an effort at rest, such as a frequency.
    """
    name, place = _parts(text)
    if found.kind != "equilibrium" or name in NUMBERS[found.kind]:
        return None
    state = found.states[place or 0]
    if name.startswith(_EFFORT):
        driver = name.removeprefix(_EFFORT)
        return state, (f"{driver}.effort",) if driver in state.compiled.drivers else ()
    return state, measure_info(state.compiled, _expression(state.compiled, name)).quantities


def _expression(model: CompiledModel, name: str) -> str:
    """The expression of a declared measure; any other text is an expression itself."""
    known = model.measures.get(name)
    return known.expression if known is not None else name


def _unit_of_effort(model: CompiledModel, entry: Mapping[str, Any], name: str) -> str:
    """N for a length, N*m for an angle."""
    held = [*model.drivers, *entry.get("hold", ())]
    if name not in held:
        raise unknown("effort", name, held)
    if name in model.drivers:
        return measure_info(model, f"{name}.effort").unit
    return "N*m" if measure_info(model, name).unit == "rad" else "N"


def _parts(text: str) -> tuple[str, int | None]:
    """``frequency[0]`` → ("frequency", 0)."""
    match = _PLACED.fullmatch(text.strip())
    name, place = match.groups() if match else (text, None)
    return name, None if place is None else int(place)
