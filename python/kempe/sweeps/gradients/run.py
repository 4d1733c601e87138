"""``kp.gradient``: the derivatives of measures with respect to variables."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe import _core
from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.errors import IntegrationError, KempeError, ModelError
from kempe.sweeps.gradients.asked import planned
from kempe.sweeps.gradients.frequency import of_frequency
from kempe.sweeps.gradients.result import Gradient
from kempe.sweeps.gradients.second import hessian_of, refuse_second
from kempe.sweeps.numbers import reads_quantities
from kempe.sweeps.plan import Plan
from kempe.sweeps.reasons import origin_of, reason
from kempe.sweeps.variables import present
from kempe.sweeps.wanted import Wanted

if TYPE_CHECKING:
    from kempe.case import Case

#: Relative change of a variable for which the mechanism must exist.
_CHANGE = 1e-6
#: The remarks on numbers that the core does not differentiate.
_SINGLE = "kempe has no derivatives of this number yet"
#: A name in a formula.
_WORD = re.compile(r"[^\W\d]\w*")
#: The time and the quantities at which formulas without these are evaluated.
_AT, _NONE = np.zeros(1), np.zeros((1, 0))


@explained
def gradient(
    case: Case,
    measures: Sequence[str] = (),
    variables: Sequence[str] = (),
    *,
    analysis: str | None = None,
    second: bool = False,
) -> Gradient:
    """The derivative of each measure with respect to each variable, at the values of the case.

    The derivatives are exact: they follow from the equations, and not from differences of runs. All
    other variables are held, also if their formulas contain the variable. Without arguments,
    ``[gradient]`` of the case is computed.

    Args:
        case: the case.
        measures: statistics of measures and quantities, such as ``"pin.max"``, or numbers of a
            result that is not a motion, such as ``"frequency[0]"``; the columns of sweeps.
        variables: names of parameters (``"L2"``), or of coordinates and rates at the start
            (``"crank.angle"``); the variables of sweeps.
        analysis: name of the analysis; the last one of the case by default.
        second: whether second derivatives are computed too, for ``kinematics`` and ``equilibrium``.

    Raises:
        ModelError: a variable or a measure is invalid, a law is a Python function, or a variable
            can be changed neither up nor down.
        KempeError: the run fails.
    """
    plan = planned(case, measures, variables, analysis)
    if second:
        refuse_second(plan)
    row = np.array(list(present(plan.case, plan.names).values()))
    values, slopes, remarks = numbers_and_slopes(plan, row)
    for of, told in in_analyses(plan, row).items():
        slopes[:, of] = np.nan
        remarks |= {(k, of): told for k in range(len(values))}
    hessian = None
    if second:
        at = partial(numbers_and_slopes, plan)
        hessian, told_too = hessian_of(plan, at, (row, values, slopes))
        remarks = {**told_too, **remarks}
    return Gradient(plan, row, (values, slopes, hessian), remarks)


def in_analyses(plan: Plan, row: Floats) -> dict[int, str]:
    """Why there are no derivatives by variables in the formulas of an analysis, by their places.

    Raises:
        ModelError: a variable can be changed neither up nor down.
    """
    fields = _fields(plan.case)
    try:  # all at once, which is cheaper
        changed = _changed(plan, row, range(len(row)))
        if not fields or _fields(changed) == fields:
            return {}
    except ModelError:
        pass
    found = {}
    for of in range(len(row)):
        moved = sorted(fields.items() - _fields(_changed(plan, row, [of])).items())
        if moved:
            found[of] = f"{moved[0][0]} depends on it, and such slopes are not available yet"
    return found


def numbers_and_slopes(
    plan: Plan, row: Floats
) -> tuple[Floats, Floats, dict[tuple[int, int], str]]:
    """The numbers, their derivatives, and remarks; see ``Plan.slopes``.

    Raises:
        KempeError: the run fails.
    """
    left = {k: told for k, one in enumerate(plan.wanted) if (told := _left(plan, one))}
    values = np.full(len(plan.wanted), np.nan)
    slopes = np.full((len(values), len(row)), np.nan)
    remarks: dict[tuple[int, int], str] = {}
    for k, one in enumerate(plan.wanted):
        if one.statistic == "frequency" and k not in left:
            found_frequency = of_frequency(plan, one, row)
            if isinstance(found_frequency, str):
                left[k] = found_frequency
            else:
                values[k], slopes[k] = found_frequency
    places = [k for k in np.flatnonzero(np.isnan(values)).tolist() if k not in left]
    if places:
        try:
            values[places], slopes[places], found = _only(plan, places).slopes(row)
            remarks = {(places[k], of): text for (k, of), text in found.items()}
        except IntegrationError as error:
            # the run itself fails too, with a message that says more, or it has no derivatives
            left |= dict.fromkeys(places, str(error.args[0]))
    # the values of quantities of a run are those at its outputs, which a single run has
    single = [k for k, one in enumerate(plan.wanted) if k in left or one.of_run]
    if single:
        values[single] = [value for value, _ in _only(plan, single).read(row)]
        remarks |= {(k, of): text for k, text in left.items() for of in range(len(row))}
    return values, slopes, remarks


def _only(plan: Plan, places: Iterable[int]) -> Plan:
    """The plan with some of its numbers."""
    return replace(plan, wanted=tuple(plan.wanted[k] for k in places))


def _left(plan: Plan, one: Wanted) -> str:
    """Why a number is left to a single run; empty if the core differentiates it."""
    kind = plan.case.analyses[plan.analysis]["type"]
    known = one.statistic and one.statistic != "frequency"
    statistics, reads = [one.statistic] if known else [], reads_quantities(kind, [one.text])
    core = plan.case.model.compile().core
    return "" if _core.sweeps(core, statistics, reads, True) else _SINGLE


def _fields(case: Case) -> dict[str, float]:
    """The values of the formulas of parameters in the analyses, by their places.

    What an analysis gives for parameters themselves is left out.
    """
    model, found = case.model.compile(), dict[str, float]()
    core, parameters = model.core, set(model.parameters)
    ahead: list[tuple[str, Any]] = [
        (name, {key: entry for key, entry in of.items() if key != "parameters"})
        for name, of in case.analyses.items()
    ]
    while ahead:
        place, of = ahead.pop()
        if isinstance(of, Mapping):
            ahead += [(f"{place}.{key}", entry) for key, entry in of.items()]
        elif isinstance(of, list | tuple):
            ahead += [(f"{place}[{k}]", entry) for k, entry in enumerate(of)]
        elif isinstance(of, str) and not place.endswith(".over"):
            if parameters.isdisjoint(_WORD.findall(of)):
                continue
            with suppress(KempeError):  # a name, or a condition
                if not _core.measure(core, of)[0]:
                    (found[place],) = _core.measure_values(core, of, _AT, _NONE)
    return found


def _changed(plan: Plan, row: Floats, of: Sequence[int]) -> Case:
    """The case with a small change of some variables.

    Raises:
        ModelError: the mechanism exists neither above nor below, such as for a number of teeth; the
            message has the reason.
    """
    faults = []
    for sign in (1.0, -1.0):
        changed = row.copy()
        for k in of:
            # different parts, so that two changes do not cancel
            changed[k] += sign * _CHANGE * (1.0 + 0.37 * k) * (abs(row[k]) or 1.0)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                case = plan.variant(changed)
                case.start()
        except KempeError as error:
            faults.append(reason(str(error.args[0]), origin_of(plan.case.model)))
        else:
            return case
    name = plan.names[of[0]]
    raise ModelError(
        f"variables.{name}: it has no derivative, because it cannot be changed a little: "
        f"{faults[0]}",
        name=name,
        hint="leave this variable out, or sweep over the values that it can have",
    )
