"""The numbers of a sweep: statistics of measures such as ``pin.max``, or numbers of a result."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from kempe.base.names import unknown
from kempe.errors import ModelError
from kempe.model.catalogue import declared
from kempe.model.measure_infos import MeasureInfo, measure_info
from kempe.model.values import refuse, texts
from kempe.results.measures import STATISTICS, Measure
from kempe.results.solution import Solution
from kempe.results.variable import TIME, Variable
from kempe.sweeps.numbers import ANOTHER, driven_model, kinds_with, unit_of
from kempe.sweeps.remarked import mark_of_measure, mark_of_number

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel
    from kempe.results.result import Result

#: Reads a number of a result that is not a motion, by its text.
Number: TypeAlias = "Callable[[str], float]"
#: Every statistic of a measure, by the last part of a text such as ``pin.max``.
ALL = (*STATISTICS, "t_max", "t_min")
#: Analyses whose results are motions.
MOTIONS = tuple(kind for kind, of in declared("analyses").items() if "motion" in of)


@dataclass(frozen=True)
class Wanted:
    """A number of each variant.

    Attributes:
        text: as the user wrote it, such as ``pin.max``; the name of its column.
        expression: the measure, such as ``C.force``; for other results the text.
        statistic: its statistic; empty for a number of another result.
        unit: SI unit; empty if it is not known.
        of_run: whether the measure uses quantities of a whole run.
    """

    text: str
    expression: str
    statistic: str
    unit: str = ""
    of_run: bool = False

    def read(self, found: Solution | Result, number: Number) -> tuple[float, int]:
        """The number in the result of a single run, and its mark; ``number`` reads the result.

        Raises:
            KempeError: it has no value.
        """
        if isinstance(found, Solution):
            measure = Measure(found, self._info(found.compiled))
            value = float(getattr(measure, self.statistic))
            return value, mark_of_measure(measure, found, self.statistic)
        return number(self.text), mark_of_number(found, self.text)

    def _info(self, model: CompiledModel) -> MeasureInfo:
        return measure_info(model, self.expression)


def read_wanted(
    model: CompiledModel, entry: Mapping[str, Any], measures: Sequence[str]
) -> list[Wanted]:
    """The wanted numbers of an analysis, checked.

    Args:
        model: the model.
        entry: the analysis, as in a file.
        measures: the texts.

    Raises:
        ModelError: a text does not end with a statistic of a measure or quantity, or the result has
            no such number.
    """
    variable, is_motion = TIME, entry["type"] in MOTIONS
    if is_motion and entry.get("over") is not None:  # the motion has the driver `over`
        model, variable = driven_model(model, entry["over"])
    found = [
        _statistic(model, text, variable)
        if is_motion
        else Wanted(text, text, "", unit_of(model, entry, text))
        for text in texts(measures, "measures")
    ]
    if len({one.text for one in found}) < len(found):
        refuse("measures", "one of them is given twice")
    return found


def _not_a_statistic(model: CompiledModel, text: str) -> ModelError:
    """The error for a text that does not end with a statistic."""
    if kinds := kinds_with(text):
        hint = f"{ANOTHER}, of type {' or '.join(kinds)}"
        return ModelError(f"measures: {text!r} is not a number of a motion", name=text, hint=hint)
    quantity, _, word = text.rpartition(".")
    if not quantity or text in model.measures or _is_read(model, text):
        of = "crank.omega" if word in ALL else text
        hint = f"write {of}.max or another statistic: {', '.join(ALL)}"
        return ModelError(f"measures: {text!r} is not QUANTITY.STATISTIC", name=text, hint=hint)
    return unknown(f"statistic in measures ({text!r})", word, ALL)


def _is_read(model: CompiledModel, text: str) -> bool:
    try:
        return bool(measure_info(model, text))
    except ModelError:
        return False


def _not_a_measure(model: CompiledModel, name: str) -> ModelError:
    error = unknown("measure", name, model.measures)
    error.hint = f"{error.hint}; a quantity has a name such as crank.angle or C.force"
    return error


#: A statistic as a function, such as ``max(C.force)``.
_CALLED = re.compile(rf"({'|'.join(ALL)})(?:\s*\(|\s)\s*([^()]+?)\s*\)?")


def _statistic(model: CompiledModel, text: str, variable: Variable) -> Wanted:
    """A statistic of a measure over a variable."""
    name, _, statistic = text.rpartition(".")
    if called := _CALLED.fullmatch(text):
        hint = f"write {called[2]}.{called[1]}"
        raise ModelError(f"measures: {text!r} is not QUANTITY.STATISTIC", name=text, hint=hint)
    if not name or statistic not in ALL:
        raise _not_a_statistic(model, text)
    if name.isidentifier() and name not in {*model.measures, *model.parameters, "t"}:
        raise _not_a_measure(model, name)
    info = model.measures.get(name) or measure_info(model, name)
    timed = dict.fromkeys(("t_max", "t_min", "settling"), variable.unit)
    timed["frequency"] = "Hz" if variable.is_time else f"1/{variable.unit}"
    timed["integral"] = variable.integral(variable.rate(info.unit))
    return Wanted(text, info.expression, statistic, timed.get(statistic, info.unit), info.is_of_run)
