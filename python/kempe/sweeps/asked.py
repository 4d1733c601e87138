"""The request for a sweep: arguments, or the section ``[sweep]`` of a case, with all checks.

Requests for gradients share its parts.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from kempe.base.arguments import is_given
from kempe.errors import ModelError
from kempe.model.values import instance
from kempe.sweeps import design as designs
from kempe.sweeps.doubts import warn_of_degrees
from kempe.sweeps.plan import Plan, chosen, without_later
from kempe.sweeps.variables import Variable, read_variables
from kempe.sweeps.wanted import read_wanted

if TYPE_CHECKING:
    from kempe.case import Case

#: The arguments that the section ``[sweep]`` can have too.
_NAMES = ("variables", "measures", "design", "n", "seed", "analysis")
#: The place in a section with which a message begins; sections of problems have more keys.
_OTHERS = "minimize maximize target subject_to loads starts method t shift columns sigma parameters"
_PLACE = re.compile(rf"({'|'.join((*_NAMES, *_OTHERS.split(), 'robust'))})(\.[^:]+)?(?=: )")


def asked_of(case: Case, *given: Any) -> dict[str, Any]:
    """The arguments, or the table ``[sweep]`` of the case in their place."""
    from kempe.case import Case

    instance(case, Case, "a case, as kp.load(path) returns")
    asked = dict(zip(_NAMES, given, strict=True))
    if not case.sweep:
        return complete("sweep", asked)
    if is_given(asked["variables"]):  # a design belongs to its variables
        kept = {"measures": case.sweep.get("measures"), "analysis": case.sweep.get("analysis")}
    else:
        kept = dict(case.sweep)
    return {key: asked[key] if is_given(asked[key]) else kept.get(key) for key in _NAMES}


def complete(section: str, asked: dict[str, Any]) -> dict[str, Any]:
    """The request, which must have variables and measures.

    Raises:
        ModelError: there are none.
    """
    for key in ("variables", "measures"):
        if not is_given(asked[key]):
            raise ModelError(f"{section}: no {key}", hint=_remedy(section, key))
    return asked


def design_of(asked: Mapping[str, Any]) -> tuple[str, int | None, int | None]:
    """The design, its number of variants and its seed."""
    return asked["design"] or "grid", asked["n"], asked["seed"]


def planned(case: Case, asked: Mapping[str, Any]) -> tuple[Plan, list[Variable]]:
    """The plan and the variables; everything is checked, and no variant is computed.

    Raises:
        ModelError: a variable, a measure or the design is invalid.
    """
    known = read_variables(case, asked["variables"])
    plan = plan_of(case, asked, (one.name for one in known))
    designs.count_of(known, *design_of(asked))
    warn_of_degrees(plan, known)
    return plan, known


def plan_of(case: Case, asked: Mapping[str, Any], names: Iterable[str]) -> Plan:
    """The plan for the measures and the analysis of a request, with these names of variables.

    Raises:
        ModelError: the analysis, a measure or a coordinate is invalid.
    """
    name = chosen(case, asked["analysis"])
    case = without_later(case, name)
    wanted = read_wanted(case.model.compile(), case.analyses[name], asked["measures"])
    plan = Plan(case, name, tuple(names), tuple(wanted))
    plan.check()
    return plan


def check(case: Case) -> tuple[int, list[str]]:
    """Check the section ``[sweep]`` of a case as ``kp.sweep`` does.

    Returns:
        The number of its variants, and the names of its variables.

    Raises:
        ModelError: a variable, a measure or the design is invalid. The message has the file and the
            line.
    """
    try:
        asked = asked_of(case, None, (), None, None, None, None)
        _, known = planned(case, asked)
        return designs.count_of(known, *design_of(asked)), [one.name for one in known]
    except ModelError as error:
        error.args = (located(case, "sweep", str(error.args[0])), *error.args[1:])
        raise


def located(case: Case, section: str, message: str) -> str:
    """A message with its place in a section, and in the file if there is one."""
    match = _PLACE.match(message)
    text = f"{section}.{message}" if match else f"{section}: {message}"
    source = case.model._source
    where = f"{section}.{match[0]}" if match else section
    found = source and (source[0].place(where) or source[0].place(section))
    if not found:
        return text
    file, line, column = found
    return f"{file}: {text} (line {line}, column {column})"


def _remedy(section: str, key: str) -> str:
    """Where variables or measures are given: in Python, on the command line or in the file."""
    option = {"variables": "--over", "measures": "--measure"}[key]
    return f"pass {key}=, give {option} on the command line, or declare [{section}]"
