"""``kempe show``: the matrices and equations of a mechanism, with names."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.text import Text

from kempe.cli.arguments import (
    AsJson,
    Changes,
    Settings,
    Units,
    assembled,
    read_case,
    shown_in,
)
from kempe.cli.console import answers, figure
from kempe.cli.failure import document
from kempe.cli.solved import CaseOrSolution, is_stored, stored
from kempe.errors import FileError, ModelError

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.results.matrices.labelled import Labelled
    from kempe.results.solution import Solution
    from kempe.results.state import State


class Form(str, Enum):
    """The formats of matrices and equations."""

    text = "text"
    csv = "csv"
    latex = "latex"


#: Endings of the name of an output file, and the format of each.
ENDINGS = {".txt": Form.text, ".csv": Form.csv, ".tex": Form.latex}

EXAMPLES = """Examples:

  kempe show four_bar.toml --jacobian --assembly

  kempe show four_bar.toml --kkt --t 0.25 --format csv -o kkt.csv

  kempe show out/four_bar/solution.npz --multipliers --t 1.5

  kempe show four_bar.toml --iterations

  kempe show four_bar.toml --symbolic --format latex
"""


def _flag(name: str, told: str) -> Any:
    return typer.Option(f"--{name}", help=told)


Time = Annotated[
    float | None,
    typer.Option("--t", metavar="SECONDS", help="Time of the simulation, s; by default its start."),
]
FormOption = Annotated[
    Form | None,
    typer.Option("--format", help="Format; by default that of the ending of -o, or text."),
]
Output = Annotated[
    Path | None, typer.Option("--output", "-o", help="A file in place of the terminal.")
]


def show(  # noqa: PLR0917 - typer distinguishes options by their annotations
    file: CaseOrSolution,
    jacobian: Annotated[
        bool, _flag("jacobian", "The Jacobian Φ_q; shown if no matrix is named.")
    ] = False,
    mass: Annotated[bool, _flag("mass", "The mass matrix M.")] = False,
    kkt: Annotated[bool, _flag("kkt", "The augmented matrix [M Φ_qᵀ; Φ_q 0].")] = False,
    rhs: Annotated[bool, _flag("rhs", "[Q; γ], right side of the augmented equations.")] = False,
    gamma: Annotated[bool, _flag("gamma", "γ, right side of the accelerations.")] = False,
    forces: Annotated[bool, _flag("forces", "The generalized forces Q.")] = False,
    residual: Annotated[bool, _flag("residual", "The residual Φ of the constraints.")] = False,
    nu: Annotated[bool, _flag("nu", "ν = -Φ_t, right side of the velocities.")] = False,
    accelerations: Annotated[bool, _flag("accelerations", "The accelerations q̈.")] = False,
    multipliers: Annotated[bool, _flag("multipliers", "The multipliers λ.")] = False,
    iterations: Annotated[
        bool, _flag("iterations", "Newton–Raphson iterations from the unchanged guess.")
    ] = False,
    symbolic: Annotated[bool, _flag("symbolic", "Φ, Φ_q and γ of each joint as formulas.")] = False,
    assembly: Annotated[
        bool, _flag("assembly", "Add rows for the coordinates that the start sets.")
    ] = False,
    t: Time = None,
    form: FormOption = None,
    output: Output = None,
    settings: Settings = None,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Show matrices and equations of a case or of a solution, with names of joints and bodies."""
    flags = {
        "Phi_q": jacobian,
        "M": mass,
        "kkt": kkt,
        "rhs": rhs,
        "gamma": gamma,
        "Q": forces,
        "Phi": residual,
        "nu": nu,
        "a": accelerations,
        "lam": multipliers,
    }
    wanted = [name for name, flag in flags.items() if flag]
    if not (wanted or iterations or symbolic):
        wanted = ["Phi_q"]
    chosen = form or ENDINGS.get(output.suffix.lower() if output else "", Form.text)
    with document(as_json) as found, shown_in(units):
        if as_json and (form or output):
            raise ModelError("--json prints to the terminal", hint="leave --format and -o out")
        case, solution = _read(file, Changes(settings))
        state = _state(case, solution, t) if wanted else None
        matrices = [] if state is None else list(_matrices(case, state, wanted, assembly))
        if as_json:
            found.update(_content(case, state, matrices, iterations=iterations, symbolic=symbolic))
            return
        pieces = [] if state is None else [_written(one, state, chosen) for one in matrices]
        pieces += [_iterations(case, chosen)] if iterations else []
        pieces += [_symbolic(case, chosen)] if symbolic else []
        _put("\n".join(piece.rstrip("\n") + "\n" for piece in pieces), output)


def _read(file: Path, changes: Changes) -> tuple[Case, Solution | None]:
    """The case; also the solution, if it is stored."""
    if not is_stored(file):
        return read_case(file, changes), None
    from kempe.case import parsed

    solution = stored(file, changes)
    return parsed(solution.compiled.case, "json", str(file)), solution


def _put(text: str, output: Path | None) -> None:
    from kempe.base import files

    if output is None:
        answers().print(Text(text.rstrip("\n")))
        return
    if not output.name:
        raise FileError(f"cannot write {output}: it is a folder", hint="name a file in it")
    files.write_text(output, text)


def _matrices(case: Case, state: State, wanted: list[str], assembly: bool) -> Iterator[Labelled]:
    from kempe.results.matrices.labelled import show as labelled

    held = case.held if assembly else {}
    positions = {name: value for name, value in held.items() if name in state.model.column_names()}
    for name in wanted:
        rows = None if name in ("lam", "a") else positions
        yield labelled(case.model, state, name, assembly=rows)


def _written(shown: Labelled, state: State, form: Form) -> str:
    if form is Form.text:
        from kempe.base.display_units import display

        time = display("s")
        when = f"t = {figure(float(state.t) / time.divisor)} {time.symbol}"
        return f"{shown.title}, {when}\n{shown.text()}"
    return shown.csv() if form is Form.csv else shown.latex()


def _state(case: Case, solution: Solution | None, t: float | None) -> State:
    """The assembled mechanism, or the state of the simulation at ``t``."""
    from kempe.results.solution import Solution

    if solution is not None:
        solutions, start = iter([solution]), solution.initial
    else:
        start = assembled(case)
        each = (found for _, found in case.each(start=start))
        solutions = (found for found in each if isinstance(found, Solution))
    if t is None or t == float(start.t):
        return start
    reached = float(start.t)
    for found in solutions:
        reached = float(found.t[-1])
        if float(found.t[0]) <= t <= reached:
            state: State = found(t)  # type: ignore[assignment]  # one time gives a State
            return state
    span = f"{figure(float(start.t))} to {figure(reached)} s"
    raise ModelError(f"--t {figure(t)}: the analyses reach from {span}")


def _content(
    case: Case,
    state: State | None,
    matrices: list[Labelled],
    *,
    iterations: bool,
    symbolic: bool,
) -> dict[str, Any]:
    """Matrices, iterations and equations as plain data."""
    content: dict[str, Any] = {"title": case.model.title}
    if state is not None:
        content["t"] = float(state.t)
        content["matrices"] = [
            {
                "name": shown.name,
                "title": shown.title,
                "rows": shown.rows,
                "columns": shown.columns,
                "values": shown.values.tolist(),
            }
            for shown in matrices
        ]
    if iterations:
        from kempe.analyses.iterations import iterations as computed

        content["iterations"] = [asdict(row) for row in computed(case).rows]
    if symbolic:
        from kempe.results.matrices.equations import equations

        content["equations"] = [asdict(equation) for equation in equations(case.model)]
    return content


def _iterations(case: Case, form: Form) -> str:
    from kempe.analyses.iterations import iterations

    course = iterations(case)
    if form is Form.csv:
        return course.csv()
    return course.latex() if form is Form.latex else course.text()


def _symbolic(case: Case, form: Form) -> str:
    from kempe.results.matrices.equations import equations

    if form is Form.csv:
        raise ModelError("--symbolic has no CSV", hint="use --format text or latex")
    return "\n".join(e.latex() if form is Form.latex else e.text() for e in equations(case.model))
