"""Numbers of results that are not motions, such as ``lower`` of limits, with their units."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.analyses.record import driven_by
from kempe.base.names import few, unknown
from kempe.errors import ModelError
from kempe.model.catalogue import declared
from kempe.model.measure_infos import measure_info
from kempe.model.values import refuse
from kempe.results.measures import STATISTICS
from kempe.results.quantities import values_of
from kempe.results.state import State
from kempe.results.variable import Variable

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel

#: Attributes that are lists, of which the number of entries counts.
_COUNTED = ("redundant", "singular", "locked", "loose", "undetermined")
#: The numbers of each type of analysis with their SI units; "over" is the unit of the quantity.
NUMBERS: Mapping[str, Mapping[str, str]] = {
    kind: dict(analysis.get("numbers", ())) for kind, analysis in declared("analyses").items()
}
#: The numbers in place of None; any other one is NaN.
_ABSENT = {"lower": -np.inf, "upper": np.inf, "span": np.inf}
#: The way to measure the result of another analysis.
_ANOTHER = 'name another analysis: analysis="NAME", or kempe sweep --analysis NAME'
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
            error.hint = f"{kind} has the numbers {few(known)}; for others, {_ANOTHER}"
        raise error
    if name.startswith(_EFFORT):
        return _unit_of_effort(model, entry, name.removeprefix(_EFFORT))
    quantity, _, last = name.rpartition(".")
    if last in STATISTICS and quantity:
        raise ModelError(
            f"measures: {text!r} is a statistic of a motion, and an equilibrium is one instant",
            hint=f"write {quantity}, or {_ANOTHER}",
        )
    info = measure_info(model, _expression(model, name))
    if info.is_of_run:
        refuse("measures", f"{text!r} is a quantity of a whole run, which an equilibrium has not")
    return info.unit


def over_of(model: CompiledModel, entry: Mapping[str, Any]) -> Variable:
    """The quantity over which an analysis follows a motion, with its unit."""
    return driven_model(model, entry.get("over"))[1]


def driven_model(model: CompiledModel, over: str | None) -> tuple[CompiledModel, Variable]:
    """The model in which a quantity is driven, and this quantity; by default the only driver.

    Raises:
        ModelError: there is no such quantity, or several drivers determine the motion already.
    """
    rest = (np.zeros(model.n_q), np.zeros(model.n_q))  # names and units need no position
    return driven_by(model, over, State(model, 0.0, *rest, z=np.zeros(model.n_z)))[:2]


def number(found: Any, text: str) -> float:
    """A number of a result; of limits without an end, an infinite one.

    Raises:
        KempeError: it has no value.
    """
    name, place = _parts(text)
    value = _value(found, name)
    if value is None:
        return float(_ABSENT.get(name, np.nan))
    values = np.asarray(value)
    if values.ndim and place is None and values.size != 1:
        raise ModelError(f"{name} has {len(values)} values; name one of them, such as {name}[0]")
    if place is not None:
        count = len(values) if values.ndim else 0
        if not -count <= place < count:
            raise ModelError(f"{text}: the result has {count} values of {name}")
        values = values[place]
    real = np.real_if_close(values)
    if real.size != 1 or np.iscomplexobj(real):
        raise ModelError(f"{text} is not one real number")
    return float(real.item())


def _value(found: Any, name: str) -> Any:
    """A number, or numbers, of a result."""
    if name in NUMBERS[found.kind]:
        if name == "count":
            return len(found)
        value = getattr(found, name)
        return len(value) if name in _COUNTED else value
    if name.startswith(_EFFORT):
        return found.effort[name.removeprefix(_EFFORT)]
    texts = (_expression(state.compiled, name) for state in found.states)
    pairs = zip(found.states, texts, strict=True)
    return [float(values_of(s, measure_info(s.compiled, text))[0]) for s, text in pairs]


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
