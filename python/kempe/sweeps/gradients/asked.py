"""The request for a gradient: arguments, or the section ``[gradient]``, with all checks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kempe.base.arguments import is_given
from kempe.errors import ModelError
from kempe.model.functions import refuse_derivatives
from kempe.model.values import instance, refuse, texts
from kempe.sweeps.asked import complete, located, plan_of
from kempe.sweeps.variables import check_names

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.sweeps.plan import Plan

#: The arguments that the section can have too.
_NAMES = ("measures", "variables", "analysis")


def planned(case: Case, *given: Any) -> Plan:
    """The plan of a gradient; everything is checked, and nothing is computed.

    Args:
        case: the case.
        *given: the measures, the variables and the analysis; the section of the case replaces each
            that is missing.

    Raises:
        ModelError: a variable, a measure or the analysis is invalid, or a law is a Python function.
    """
    from kempe.case import Case

    instance(case, Case, "a case, as kp.load(path) returns")
    own = {key: of for key, of in zip(_NAMES, given, strict=True) if is_given(of)}
    asked = complete("gradient", {**dict.fromkeys(_NAMES), **case.gradient, **own})
    names = texts(asked["variables"], "variables")
    check_names(case, names)
    if len(set(names)) < len(names):
        refuse("variables", "one of them is given twice")
    refuse_derivatives(case.model.compile().functions)
    return plan_of(case, asked, names)


def check(case: Case) -> Plan:
    """Check the section ``[gradient]`` of a case as ``kp.gradient`` does.

    Returns:
        The plan.

    Raises:
        ModelError: a variable, a measure or the analysis is invalid. The message has the file and
            the line.
    """
    try:
        return planned(case, (), (), None)
    except ModelError as error:
        error.args = (located(case, "gradient", str(error.args[0])), *error.args[1:])
        raise
