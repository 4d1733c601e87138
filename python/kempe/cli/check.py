"""``kempe check``: read a case and assemble its mechanism."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from rich.text import Text

from kempe.analyses.sequence import of_type
from kempe.cli.arguments import (
    STDIN,
    AbsoluteTolerance,
    AsJson,
    Changes,
    EndTime,
    File,
    MethodName,
    RelativeTolerance,
    Settings,
    Step,
    Units,
    assembled,
    read_case,
    shown_in,
)
from kempe.cli.console import answers, heading
from kempe.cli.failure import document
from kempe.errors import SingularityError

if TYPE_CHECKING:
    from kempe.analyses.mobility import MobilityResult
    from kempe.case import Case
    from kempe.results.assembly_report import AssemblyReport
    from kempe.results.state import State

EXAMPLES = """Examples:

  kempe check four_bar.toml --set L2=27

  kempe check four_bar.toml --json | jq .assembly.alternatives
"""


def check(  # noqa: PLR0917 - typer distinguishes options by their annotations
    file: File,
    settings: Settings = None,
    t_end: EndTime = None,
    method: MethodName = None,
    rtol: RelativeTolerance = None,
    atol: AbsoluteTolerance = None,
    step: Step = None,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Read a case, assemble its mechanism and show the configuration, without a simulation."""
    from kempe import mobility
    from kempe.cli.beginnings import check_beginnings
    from kempe.cli.mechanism import show_configuration, show_mechanism

    with document(as_json) as found, shown_in(units):
        case = read_case(file, Changes(settings, t_end, method, rtol, atol, step))
        state = assembled(case)
        freedom = mobility(state.compiled, state)
        found.update(_content(case, state), mobility=freedom.summary())
        console = answers(silent=as_json)
        show_mechanism(console, state)
        show_configuration(console, state)
        heading(console, "Mobility")
        for line in freedom.report():
            console.print(Text(f"  {line}"))
        _refuse_undetermined(case, state, freedom)
        check_beginnings(case, state)
        asked = _sweep(case, found) + _gradient(case, found)
        asked += _optimize(case, found) + _fit(case, found)
    analyses = ", ".join(f"{name} ({entry['type']})" for name, entry in case.analyses.items())
    console.print()
    name = "standard input" if str(file) == STDIN else file
    console.print(Text(f"{name}: OK; analyses: {analyses or 'none'}{asked}"))


def _sweep(case: Case, found: dict[str, Any]) -> str:
    """The sweep of a case, checked, as a part of the last line; empty if it has none."""
    if not case.sweep:
        return ""
    from kempe.sweeps.asked import check as check_sweep

    count, names = check_sweep(case)
    found["sweep"] = {"variants": count, "variables": names}
    return f"; sweep: {count} variants over {', '.join(names)}"


def _gradient(case: Case, found: dict[str, Any]) -> str:
    """The gradient of a case, checked, as ``_sweep``."""
    if not case.gradient:
        return ""
    from kempe.sweeps.gradients.asked import check as check_gradient

    plan = check_gradient(case)
    measures = [one.text for one in plan.wanted]
    found["gradient"] = {"measures": measures, "variables": list(plan.names)}
    return f"; gradient: {', '.join(measures)} over {', '.join(plan.names)}"


def _optimize(case: Case, found: dict[str, Any]) -> str:
    """The optimisation of a case, checked, as ``_sweep``."""
    if not case.optimize:
        return ""
    from kempe.sweeps.problems.asked import check as check_problem

    problem = check_problem(case)
    objective, names = f"{problem.aim} {problem.label}", list(problem.plan.names)
    found["optimize"] = {
        "objective": objective,
        "variables": names,
        "subject_to": [limit.text for limit in problem.limits],
    }
    return f"; optimize: {objective} over {', '.join(names)}"


def _fit(case: Case, found: dict[str, Any]) -> str:
    """The fit of a case, checked without data, as ``_sweep``."""
    if not case.fit:
        return ""
    from kempe.sweeps.fits.run import check as check_fit

    told = check_fit(case)
    found["fit"] = {"parameters": list(case.fit["parameters"]), "columns": case.fit["columns"]}
    return f"; fit: {told}"


def _refuse_undetermined(case: Case, state: State, freedom: MobilityResult) -> None:
    """Refuse a case that a run would refuse before its first step.

    Raises:
        SingularityError: dynamics starts with a massless body whose motion is not determined.
    """
    runs = any(
        entry["type"] == "dynamics" and entry["from"] == "start"
        for entry in of_type(case.analyses, "dynamics").values()
    )
    if runs and freedom.undetermined:
        name, message = next(iter(freedom.undetermined.items()))
        raise SingularityError(message, name=name, t=float(state.t))


def _report(report: AssemblyReport) -> dict[str, Any]:
    return asdict(report) | {"alternatives": report.alternatives}


def _content(case: Case, state: State) -> dict[str, Any]:
    """The mechanism, its configuration and the report of its assembly; units: m, rad, kg, s."""
    from kempe.results.summary import mechanism

    return {
        "title": state.model.title,
        "mechanism": mechanism(state),
        "t": float(state.t),
        "start": state.coordinates(),
        "assembly": None if state.report is None else _report(state.report),
        "analyses": [{"name": name, "type": e["type"]} for name, e in case.analyses.items()],
    }
