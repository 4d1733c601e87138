"""``kp.gradient``: the derivatives of measures with respect to variables."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from kempe import _core
from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.errors import KempeError, ModelError
from kempe.sweeps.gradients.asked import planned
from kempe.sweeps.gradients.result import Gradient
from kempe.sweeps.plan import Plan
from kempe.sweeps.reasons import origin_of, reason
from kempe.sweeps.variables import present

if TYPE_CHECKING:
    from kempe.case import Case

#: Relative change of a variable for which the mechanism must exist.
_CHANGE = 1e-6
#: The remark on a number that the core does not differentiate.
_SINGLE = "kempe has no derivatives of this number yet"


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

    The derivatives are exact: equations of the motion's slopes are solved beside the motion, and no
    variable is changed. Without arguments, ``[gradient]`` of the case is computed.

    Args:
        case: the case.
        measures: statistics of measures and quantities, such as ``"pin.max"``, or numbers of a
            result that is not a motion, such as ``"frequency[0]"``; the columns of sweeps.
        variables: names of parameters (``"L2"``), or of coordinates and rates at the start
            (``"crank.angle"``); the variables of sweeps.
        analysis: name of the analysis; the last one of the case by default.
        second: whether second derivatives are computed too; they are not available yet.

    Raises:
        ModelError: a variable or a measure is invalid, a law is a Python function, or a variable
            can be changed neither up nor down.
        KempeError: the run fails.
    """
    if second:
        raise ModelError(
            "second derivatives are not available yet",
            hint="leave second out, or take differences of two gradients",
        )
    plan = planned(case, measures, variables, analysis)
    row = np.array(list(present(plan.case, plan.names).values()))
    for k in range(len(row)):
        _refuse_fixed(plan, row, k)
    return Gradient(plan, row, *_slopes(plan, row))


def _slopes(plan: Plan, row: Floats) -> tuple[Floats, Floats, dict[tuple[int, int], str]]:
    """The numbers, their derivatives, and remarks; see ``Plan.slopes``."""
    core = plan.case.model.compile().core
    known = [
        not one.of_run and _core.sweeps(core, [one.statistic] if one.statistic else [], False)
        for one in plan.wanted
    ]
    values = np.full(len(known), np.nan)
    slopes = np.full((len(known), len(row)), np.nan)
    remarks: dict[tuple[int, int], str] = {}
    places = np.flatnonzero(known)
    if len(places):
        wanted = tuple(plan.wanted[k] for k in places)
        values[places], slopes[places], told = replace(plan, wanted=wanted).slopes(row)
        remarks = {(int(places[k]), of): text for (k, of), text in told.items()}
    others = np.flatnonzero(~np.array(known))
    if len(others):
        single = replace(plan, wanted=tuple(plan.wanted[k] for k in others)).rows(row[None], 1)
        if single.reasons[0]:
            raise ModelError(f"the run fails: {single.reasons[0]}")
        values[others] = single.values[0]
        remarks |= {(int(k), of): _SINGLE for k in others for of in range(len(row))}
    return values, slopes, remarks


def _refuse_fixed(plan: Plan, row: Floats, k: int) -> None:
    """Refuse a variable that can be changed neither up nor down, such as a number of teeth.

    Raises:
        ModelError: the mechanism exists on neither side; the message has the reason.
    """
    faults = []
    for sign in (1.0, -1.0):
        changed = row.copy()
        changed[k] += sign * _CHANGE * (abs(row[k]) or 1.0)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                plan.variant(changed).start()
        except KempeError as error:
            faults.append(reason(str(error.args[0]), origin_of(plan.case.model)))
        else:
            return
    name = plan.names[k]
    raise ModelError(
        f"variables.{name}: it has no derivative, because it cannot be changed a little: "
        f"{faults[0]}",
        name=name,
        hint="leave this variable out, or sweep over the values that it can have",
    )
