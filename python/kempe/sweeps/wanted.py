"""The numbers of a sweep: statistics of measures such as ``pin.max``, or numbers of a result."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.errors import ModelError
from kempe.measures import STATISTICS, Measure, MeasureInfo, measure_info
from kempe.names import unknown
from kempe.solution import Solution
from kempe.values import refuse, texts

if TYPE_CHECKING:
    from kempe.compiled import CompiledModel
    from kempe.result import Result

#: Every statistic of a measure, by the last part of a text such as ``pin.max``.
ALL = (*STATISTICS, "t_max", "t_min")
#: Analyses whose results are motions.
MOTIONS = ("dynamics", "kinematics", "inverse_dynamics")
#: A number of another result, such as ``lower`` or ``frequency[0]``.
_ATTRIBUTE = re.compile(r"([A-Za-z]\w*)(?:\[(-?\d+)\])?")


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

    def value(self, found: Solution | Result) -> float:
        """The number in the result of a single run.

        Raises:
            KempeError: it has no value.
        """
        if isinstance(found, Solution):
            return float(getattr(Measure(found, self._info(found.compiled)), self.statistic))
        return _number(found, self.text)

    def _info(self, model: CompiledModel) -> MeasureInfo:
        return measure_info(model, self.expression)


def read_wanted(model: CompiledModel, kind: str, measures: Sequence[str]) -> list[Wanted]:
    """The wanted numbers of an analysis, checked.

    Raises:
        ModelError: a text does not end with a statistic of a measure or quantity.
    """
    found = [_wanted(model, kind, text) for text in texts(measures, "measures")]
    if not found:
        raise ModelError("measures: there are none", hint='give one: measures=["C.force.max"]')
    if len({one.text for one in found}) < len(found):
        refuse("measures", "one of them is given twice")
    return found


def _wanted(model: CompiledModel, kind: str, text: str) -> Wanted:
    if kind not in MOTIONS:
        if not _ATTRIBUTE.fullmatch(text):
            refuse(
                "measures",
                f"{text!r} does not name a number of the result of {kind}, as 'lower' does",
            )
        return Wanted(text, text, "")
    name, _, statistic = text.rpartition(".")
    if statistic not in ALL:
        raise unknown(f"statistic in measures ({text!r})", statistic, ALL)
    known = model.measures.get(name)
    info = known or measure_info(model, name)
    timed = {"t_max": "s", "t_min": "s", "settling": "s", "frequency": "Hz"}
    return Wanted(text, info.expression, statistic, timed.get(statistic, info.unit), info.is_of_run)


def _number(found: Any, text: str) -> float:
    match = _ATTRIBUTE.fullmatch(text)
    assert match is not None  # checked before
    name, place = match.groups()
    value = None if name.startswith("_") else getattr(found, name, None)
    if value is None:
        raise ModelError(f"the result of {found.kind} has no number {name}")
    try:
        value = value if place is None else value[int(place)]
        return float(np.real_if_close(value))
    except (TypeError, ValueError, IndexError) as error:
        raise ModelError(f"{text} is not one real number: {error}") from error
