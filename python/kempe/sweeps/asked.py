"""The request for a sweep: arguments, or the section ``[sweep]`` of a case, with all checks."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

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
#: The place in the section with which a message begins.
_PLACE = re.compile(rf"({'|'.join(_NAMES)})(\.[^:]+)?(?=: )")


def asked_of(case: Case, *given: Any) -> dict[str, Any]:
    """The arguments, or the table ``[sweep]`` of the case in their place."""
    from kempe.case import Case

    instance(case, Case, "a case, as kp.load(path) returns")
    asked = dict(zip(_NAMES, given, strict=True))
    if not case.sweep:
        for key in ("variables", "measures"):
            if not asked[key]:
                raise ModelError(f"sweep: no {key}", hint=f"pass {key}=, or declare [sweep]")
        return asked
    if asked["variables"]:  # a design belongs to its variables
        kept = {"measures": case.sweep.get("measures"), "analysis": case.sweep.get("analysis")}
    else:
        kept = dict(case.sweep)
    return {key: asked[key] or kept.get(key) for key in _NAMES} | {
        key: asked[key] if asked[key] is not None else kept.get(key) for key in ("n", "seed")
    }


def design_of(asked: Mapping[str, Any]) -> tuple[str, int | None, int | None]:
    """The design, its number of variants and its seed."""
    return asked["design"] or "grid", asked["n"], asked["seed"]


def planned(case: Case, asked: Mapping[str, Any]) -> tuple[Plan, list[Variable]]:
    """The plan and the variables; everything is checked, and no variant is computed.

    Raises:
        ModelError: a variable, a measure or the design is invalid.
    """
    name = chosen(case, asked["analysis"])
    case = without_later(case, name)
    known = read_variables(case, asked["variables"])
    wanted = read_wanted(case.model.compile(), case.analyses[name], asked["measures"])
    designs.count_of(known, *design_of(asked))
    plan = Plan(case, name, tuple(v.name for v in known), tuple(wanted))
    plan.check()
    warn_of_degrees(plan, known)
    return plan, known


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
        error.args = (_located(case, str(error.args[0])), *error.args[1:])
        raise


def _located(case: Case, message: str) -> str:
    """A message with its place in the section, and in the file if there is one."""
    match = _PLACE.match(message)
    text = f"sweep.{message}" if match else f"sweep: {message}"
    source = case.model._source
    where = f"sweep.{match[0]}" if match else "sweep"
    found = source and (source[0].place(where) or source[0].place("sweep"))
    if not found:
        return text
    file, line, column = found
    return f"{file}: {text} (line {line}, column {column})"
