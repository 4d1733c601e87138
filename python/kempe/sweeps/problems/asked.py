"""The request for an optimisation: arguments, or the section ``[optimize]``, with all checks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arguments import is_given
from kempe.base.names import one_of
from kempe.errors import ModelError
from kempe.model.values import instance, mapping, refuse
from kempe.sweeps.asked import located
from kempe.sweeps.numbers import NUMBERS
from kempe.sweeps.plan import Plan, chosen, without_later
from kempe.sweeps.problems.columns import Columns, Part
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
from kempe.sweeps.variables import changed, check_names
from kempe.sweeps.wanted import MOTIONS, read_wanted

if TYPE_CHECKING:
    from kempe.case import Case

#: The methods, by their names in files.
METHODS = ("slsqp", "trust-constr", "least-squares", "differential-evolution")
#: The aims, of which there is one.
AIMS = ("minimize", "maximize", "target")
#: The arguments that the section can have too.
_NAMES = ("variables", *AIMS, "subject_to", "loads", "starts", "seed", "method", "analysis")
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
        section = {
            key: of for key, of in section.items() if key not in (*AIMS, "subject_to", "loads")
        }
    own = {key: of for key, of in given.items() if is_given(of) or (key in AIMS and of is not None)}
    asked = {**dict.fromkeys(_NAMES), **section, **own}
    if not is_given(asked["variables"]):
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
    check_names(case, [bound.name for bound in bounds])
    names = tuple(bound.name for bound in bounds)
    analysis = chosen(case, asked["analysis"])
    plan = Plan(without_later(case, analysis), analysis, names, ())
    plan.check()
    cases = [case, *_loads(case, asked["loads"], names)]
    aim = next(aim for aim in AIMS if asked[aim] is not None)
    objective, *others = _objectives(case, aim, asked[aim], plan)
    given = asked["subject_to"]
    limits = tuple(limits_of(case, given if is_given(given) else (), asked["analysis"]))
    parameters = tuple(Parameters(replace(plan, case=one)) for one in cases)
    empty = Columns(())
    draft = Problem(
        case, plan, empty, tuple(bounds), aim, objective, limits, parameters, tuple(others)
    )
    draft = replace(draft, columns=_columns(draft, cases))
    return _with_units(draft)


def _loads(case: Case, given: Any, variables: Sequence[str]) -> list[Case]:
    """The case with the settings of each load case.

    Raises:
        ModelError: a setting is invalid, or a variable.
    """
    form = "must be a list of settings: [{'mass': 2}, {'mass': 5}]"
    if given is not None and (not isinstance(given, list | tuple) or not given):
        refuse("loads", f"{given!r}; {form}")
    found = []
    for k, one in enumerate(given or ()):
        settings = mapping(one, f"loads.{k}", "{'mass': 2}")
        for name in (name for name in settings if name in variables):
            raise ModelError(
                f"loads.{k}: it sets {name}, which is a variable",
                hint=f"leave {name} out of the load case, or out of the variables",
            )
        found.append(changed(case, settings))
    return found


def _columns(problem: Problem, cases: Sequence[Case]) -> Columns:
    """The columns of all formulas, by load case and analysis.

    Raises:
        ModelError: an analysis or a column is unknown, or ``worst`` has no load cases.
    """
    wanted: dict[tuple[int, str], dict[str, None]] = {}
    for formula in problem.formulas:
        if formula.worst and len(cases) < 2:
            raise ModelError(
                f"{next(iter(formula.worst))}: there are no load cases",
                hint="add loads=[{'mass': 2}, {'mass': 5}], or the list loads in [optimize]",
            )
        loads = range(1, len(cases))
        of_loads = ((load, one) for one in formula.worst.values() for load in loads)
        for load, one in ((0, formula), *of_loads):
            for name in one.names:
                if name not in problem.plan.case.model.parameters and name not in one.worst:
                    prefix = name.partition(":")[0] + ":" if ":" in name else ""
                    wanted.setdefault((load, prefix), {})[name] = None
    parts = []
    for (load, prefix), texts in sorted(wanted.items()):
        own, analysis = cases[load], prefix[:-1] or problem.plan.analysis
        one_of("analysis", analysis, own.analyses)
        own = without_later(own, analysis)
        bare = [text.removeprefix(prefix) for text in texts]
        read = read_wanted(own.model.compile(), own.analyses[analysis], bare)
        plan = Plan(own, analysis, problem.plan.names, tuple(read))
        parts.append(Part(plan, tuple(texts), prefix, load))
    return Columns(tuple(parts))


def limits_of(case: Case, texts: str | Sequence[str], analysis: str | None) -> list[Limit]:
    """Limits in formulas of columns and parameters; their units are not known yet.

    Raises:
        ModelError: one is invalid.
    """
    model, columns = case.model.compile(), _plain_columns(case, chosen(case, analysis))
    given = [texts] if isinstance(texts, str) else texts
    return [read_limit(model, text, columns) for text in given]


def _plain_columns(case: Case, analysis: str) -> tuple[str, ...]:
    """The columns of an analysis whose names have no point, such as ``lower``."""
    kind = case.analyses[analysis]["type"]
    return () if kind in MOTIONS else tuple(NUMBERS[kind])


def with_units(limits: Sequence[Limit], unit: Units) -> tuple[Limit, ...]:
    """Limits with the units of their formulas, which must fit each other.

    Raises:
        ModelError: they do not.
    """

    def of_limit(limit: Limit) -> Limit:
        small, large = (with_unit(side, unit) for side in limit.sides)
        room, known = with_unit(limit.room, unit), {of.text: of.unit for of in (large, small)}
        if not (small.names and large.names):  # a number with a unit
            whole = " - ".join(f"`{text}`" for text in known)
            with_unit(Formula(limit.text, whole, tuple(known), ""), known.__getitem__)
        return Limit(limit.text, room, (small, large))

    return tuple(map(of_limit, limits))


def units_of(parts: Sequence[Part], parameters: Parameters) -> Units:
    """The units of columns and parameters by their names."""
    known: dict[str, str] = {}
    for part in parts:
        known |= {text: one.unit for text, one in zip(part.texts, part.plan.wanted, strict=True)}
    return lambda name: known[name] if name in known else parameters.unit(name)


def _with_units(problem: Problem) -> Problem:
    """The problem with the units of its formulas, which must fit each other."""
    unit = units_of(problem.columns.parts, problem.parameters[0])
    limits = with_units(problem.limits, unit)
    objective = problem.objective
    if isinstance(objective, Targets):
        columns = tuple(with_unit(column, unit) for column in objective.columns)
        return replace(problem, objective=Targets(columns, objective.values), limits=limits)
    own = (objective, *problem.others)
    objective, *others = (with_unit(of, unit) if isinstance(of, Formula) else of for of in own)
    return replace(problem, objective=objective, others=tuple(others), limits=limits)


def _objectives(case: Case, aim: str, given: Any, plan: Plan) -> list[Any]:
    """The objectives, checked; several for a Pareto front."""
    model, columns = case.model.compile(), _plain_columns(case, plan.analysis)
    if aim == "target":
        pairs = _table(given, "target")
        values = [_number(x, f"target.{name}") for name, x in pairs.items()]
        if not pairs:
            refuse("target", "there are none; give one: {'slide.x.max': 0.3}")
        read = tuple(read_formula(model, name, columns) for name in pairs)
        for formula in read:
            if formula.worst:
                told = f"target: {formula.text!r}: a target has no worst load case"
                raise ModelError(told, hint="write limits: subject_to=['worst(x) <= 3']")
        return [Targets(read, tuple(values))]
    found = [
        _objective(case, aim, one, plan)
        for one in (given if isinstance(given, list | tuple) else [given])
    ]
    if not found:
        refuse(aim, "there are none; give a column such as 'C.force.max'")
    if len({of.text if isinstance(of, Formula) else id(of) for of in found}) < len(found):
        refuse(aim, "an objective is given twice")
    if sum(isinstance(of, Path) for of in found) > 1:
        refuse(aim, "there are several paths; there may be one")
    return found


def _objective(case: Case, aim: str, given: Any, plan: Plan) -> Formula | Path:
    """An objective, checked."""
    model = case.model.compile()
    if isinstance(given, Mapping):
        given = Path.read(given)
    if isinstance(given, Path):
        if aim == "maximize":
            refuse("maximize", "a path is a distance; minimize it")
        body, _, name = given.of.rpartition(".")
        one_of("body", body, model.bodies)
        one_of(f"point of {body}", name, model.bodies[body].points)
        if given.angles is not None and plan.case.analyses[plan.analysis]["type"] not in MOTIONS:
            raise ModelError(f"{given.of}: a path needs a motion", hint="choose another analysis")
        return given
    formula = read_formula(model, given, _plain_columns(case, plan.analysis))
    if not formula.names:
        refuse(aim, f"{given!r} has no column and no parameter")
    return formula


def _table(given: Any, key: str) -> Mapping[str, Any]:
    form = "{'slide.x.max': 0.3}" if key == "target" else "{'L2': (20, 30)}"
    return mapping(given, key, form)


def _bound(name: str, given: Any) -> Bound:
    path = f"variables.{name}"
    form = "must be (least, largest) or (least, largest, 'log')"
    if not isinstance(given, list | tuple | np.ndarray) or len(given) not in (2, 3):
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
    if problem.others:
        raise ModelError(
            f"method: {method} has one objective, and there are {1 + len(problem.others)}",
            hint="leave method out, or keep all objectives but one below limits",
        )
    if method == "least-squares" and (isinstance(problem.objective, Formula) or problem.limits):
        raise ModelError(
            "method: least-squares solves paths and targets without limits",
            hint="leave method out, or choose 'slsqp'",
        )
