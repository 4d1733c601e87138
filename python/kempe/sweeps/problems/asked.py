"""The request for an optimisation: arguments, or the section ``[optimize]``, with all checks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.names import one_of
from kempe.errors import ModelError
from kempe.model.values import instance, mapping, refuse
from kempe.sweeps.asked import located
from kempe.sweeps.numbers import NUMBERS
from kempe.sweeps.plan import Plan, chosen, without_later
from kempe.sweeps.problems.formulas import (
    Formula,
    Limit,
    Parameters,
    Units,
    read_formula,
    read_limit,
    with_unit,
)
from kempe.sweeps.problems.path import Path
from kempe.sweeps.problems.problem import Bound, Problem, Targets
from kempe.sweeps.variables import check_names
from kempe.sweeps.wanted import MOTIONS, read_wanted

if TYPE_CHECKING:
    from kempe.case import Case

#: The methods, by their names in files.
METHODS = ("slsqp", "trust-constr", "least-squares", "differential-evolution")
#: The aims, of which there is one.
AIMS = ("minimize", "maximize", "target")
#: The arguments that the section can have too.
_NAMES = ("variables", *AIMS, "subject_to", "starts", "seed", "method", "analysis")
#: Largest number of starts.
MOST_STARTS = 10_000


def asked_of(case: Case, *arguments: Any) -> dict[str, Any]:
    """The arguments; the section of the case replaces those that are missing.

    Raises:
        ModelError: variables or an aim are missing, or there are several aims.
    """
    from kempe.case import Case

    instance(case, Case, "a case, as kp.load(path) returns")
    section, given = dict(case.optimize), dict(zip(_NAMES, arguments, strict=True))
    if any(given[aim] is not None for aim in AIMS):
        section = {key: of for key, of in section.items() if key not in (*AIMS, "subject_to")}
    asked = {key: section.get(key) if of is None or of == () else of for key, of in given.items()}
    if not asked["variables"]:
        hint = "pass variables={'L2': (20, 30)}, or declare [optimize]"
        raise ModelError("optimize: no variables", hint=hint)
    aims = [aim for aim in AIMS if asked[aim] is not None]
    if len(aims) != 1:
        told = f"optimize: {' and '.join(aims)} at once" if aims else "optimize: no objective"
        raise ModelError(told, hint="pass one of minimize=, maximize= and target=")
    return asked


def problem_of(case: Case, asked: Mapping[str, Any]) -> Problem:
    """The problem; everything is checked, and nothing is computed.

    Raises:
        ModelError: a variable, a formula, a unit or the analysis is invalid.
    """
    bounds = [_bound(name, of) for name, of in _table(asked["variables"], "variables").items()]
    check_names(case, [bound.name for bound in bounds], "{'L2': (20, 30)}")
    analysis = chosen(case, asked["analysis"])
    own = without_later(case, analysis)
    model, entry = own.model.compile(), own.analyses[analysis]
    columns = () if entry["type"] in MOTIONS else tuple(NUMBERS[entry["type"]])
    aim = next(aim for aim in AIMS if asked[aim] is not None)
    objective = _objective(case, aim, asked[aim], columns)
    limits = limits_of(case, asked["subject_to"] or (), asked["analysis"])
    plan = Plan(own, analysis, tuple(bound.name for bound in bounds), ())
    draft = Problem(case, plan, tuple(bounds), aim, objective, tuple(limits), Parameters(plan))
    wanted = dict.fromkeys(
        name for of in draft.formulas for name in of.names if name not in model.parameters
    )
    read = read_wanted(model, entry, list(wanted)) if wanted else []
    plan = replace(plan, wanted=tuple(read))
    plan.check()
    return _with_units(replace(draft, plan=plan, parameters=Parameters(plan)))


def limits_of(case: Case, texts: str | Sequence[str], analysis: str | None) -> list[Limit]:
    """Limits in formulas of columns and parameters; their units are not known yet.

    Raises:
        ModelError: one is invalid.
    """
    name = chosen(case, analysis)
    entry, model = case.analyses[name], case.model.compile()
    columns = () if entry["type"] in MOTIONS else tuple(NUMBERS[entry["type"]])
    given = [texts] if isinstance(texts, str) else texts
    return [read_limit(model, text, columns) for text in given]


def units_of(plan: Plan) -> Units:
    """The units of the columns and parameters of a plan, by their names."""
    known, parameters = {one.text: one.unit for one in plan.wanted}, Parameters(plan)
    return lambda name: known[name] if name in known else parameters.unit(name)


def with_units(limits: Sequence[Limit], plan: Plan) -> tuple[Limit, ...]:
    """Limits with the units of their formulas, which must fit each other.

    Raises:
        ModelError: they do not.
    """
    unit = units_of(plan)

    def of_limit(limit: Limit) -> Limit:
        small, large = (with_unit(side, unit) for side in limit.sides)
        room, known = with_unit(limit.room, unit), {of.text: of.unit for of in (large, small)}
        if not (small.names and large.names):  # a number with a unit
            whole = " - ".join(f"`{text}`" for text in known)
            with_unit(replace(limit.room, of=whole, names=tuple(known)), known.__getitem__)
        return Limit(limit.text, room, (small, large))

    return tuple(map(of_limit, limits))


def _with_units(problem: Problem) -> Problem:
    """The problem with the units of its formulas, which must fit each other."""
    unit, limits = units_of(problem.plan), with_units(problem.limits, problem.plan)
    objective = problem.objective
    if isinstance(objective, Formula):
        objective = with_unit(objective, unit)
    elif isinstance(objective, Targets):
        columns = tuple(with_unit(column, unit) for column in objective.columns)
        objective = Targets(columns, objective.values)
    elif (
        objective.angles is not None
        and problem.plan.case.analyses[problem.plan.analysis].get("type") not in MOTIONS
    ):
        raise ModelError(f"{objective.of}: a path needs a motion", hint="choose another analysis")
    return replace(problem, objective=objective, limits=limits)


def _objective(case: Case, aim: str, given: Any, columns: Sequence[str]) -> Any:
    model = case.model.compile()
    if aim == "target":
        pairs = _table(given, "target")
        values = [_number(x, f"target.{name}") for name, x in pairs.items()]
        if not pairs:
            refuse("target", "there are none; give one: {'slide.x.max': 0.3}")
        read = tuple(read_formula(model, name, columns) for name in pairs)
        return Targets(read, tuple(values))
    if isinstance(given, Mapping):
        given = Path.read(given)
    if isinstance(given, Path):
        if aim == "maximize":
            refuse("maximize", "a path is a distance; minimize it")
        point = case.model.compile()
        body, _, name = given.of.rpartition(".")
        one_of("body", body, point.bodies)
        one_of(f"point of {body}", name, point.bodies[body].points)
        return given
    if isinstance(given, list | tuple):
        raise ModelError(
            f"{aim}: {len(given)} objectives; kempe optimises one",
            hint="weigh them in a formula, or keep all but one below limits with subject_to=",
        )
    formula = read_formula(model, given, columns)
    if not formula.names:
        refuse(aim, f"{given!r} has no column and no parameter")
    return formula


def _table(given: Any, key: str) -> Mapping[str, Any]:
    form = "{'slide.x.max': 0.3}" if key == "target" else "{'L2': (20, 30)}"
    return mapping(given, key, form)


def _bound(name: str, given: Any) -> Bound:
    path = f"variables.{name}"
    form = "must be (least, largest) or (least, largest, 'log')"
    if not isinstance(given, list | tuple) or len(given) not in (2, 3):
        refuse(path, f"{given!r}; {form}")
    least, largest = (_number(x, path) for x in given[:2])
    scale = given[2] if len(given) > 2 else "linear"
    if scale not in ("linear", "log"):
        refuse(path, f"{scale!r} is neither 'linear' nor 'log'")
    if not least < largest:
        refuse(path, f"from {least:g} to {largest:g}; the second must be larger")
    if scale == "log" and not least * largest > 0.0:
        refuse(path, f"a logarithmic range from {least:g} to {largest:g}; both must have one sign")
    return Bound(name, least, largest, scale == "log")


def _number(given: Any, path: str) -> float:
    try:
        found = float(given)
    except (TypeError, ValueError):
        refuse(path, f"{given!r} is not a number; numbers are in SI units and rad")
    if not np.isfinite(found):
        refuse(path, f"{found} is not finite")
    return found


def whole(value: Any, path: str, least: int, most: int) -> int:
    """A whole number between two numbers."""
    if not isinstance(value, int | np.integer) or isinstance(value, bool):
        refuse(path, f"{value!r}; must be a whole number from {least} to {most}")
    if not least <= value <= most:
        refuse(path, f"{value}; must be from {least} to {most}")
    return int(value)


def check(case: Case) -> Problem:
    """Check the section ``[optimize]`` of a case as ``kp.optimize`` does.

    Returns:
        The problem.

    Raises:
        ModelError: something is invalid. The message has the file and the line.
    """
    try:
        asked = asked_of(case, *(None for _ in _NAMES))
        problem = problem_of(case, asked)
        check_method(problem, asked["method"])
    except ModelError as error:
        error.args = (located(case, "optimize", str(error.args[0])), *error.args[1:])
        raise
    return problem


def check_method(problem: Problem, method: str | None) -> None:
    """Refuse a method that cannot solve a problem.

    Raises:
        ModelError: there is no such method, or it does not fit.
    """
    if method is None:
        return
    one_of("method", method, METHODS)
    if method == "least-squares" and (isinstance(problem.objective, Formula) or problem.limits):
        raise ModelError(
            "method: least-squares solves paths and targets without limits",
            hint="leave method out, or choose 'slsqp'",
        )
