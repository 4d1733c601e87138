"""``kempe show``: the matrices and equations of a mechanism, with names."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.text import Text

from kempe.cli.arguments import File, Settings, assembled, read_case
from kempe.cli.console import answers, figure
from kempe.errors import FileError, ModelError
from kempe.names import one_of

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.state import State

#: Endings of the name of an output file, and the format of each.
FORMATS = {"text": ".txt", "csv": ".csv", "latex": ".tex"}

EXAMPLES = """Examples:

  kempe show four_bar.toml --jacobian --assembly

  kempe show four_bar.toml --kkt --t 0.25 --format csv -o kkt.csv

  kempe show four_bar.toml --iterations

  kempe show four_bar.toml --symbolic --format latex
"""


def _flag(name: str, told: str) -> Any:
    return typer.Option(f"--{name}", help=told)


def show(  # noqa: PLR0917 - typer distinguishes options by their annotations
    file: File,
    jacobian: Annotated[bool, _flag("jacobian", "Φ_q; what is shown if nothing is named.")] = False,
    mass: Annotated[bool, _flag("mass", "The mass matrix M.")] = False,
    kkt: Annotated[bool, _flag("kkt", "The augmented matrix [M Φ_qᵀ; Φ_q 0].")] = False,
    gamma: Annotated[bool, _flag("gamma", "γ, right side of the accelerations.")] = False,
    forces: Annotated[bool, _flag("forces", "The generalized forces Q.")] = False,
    residual: Annotated[bool, _flag("residual", "Φ.")] = False,
    nu: Annotated[bool, _flag("nu", "ν = -Φ_t, right side of the velocities.")] = False,
    multipliers: Annotated[bool, _flag("multipliers", "The multipliers λ.")] = False,
    iterations: Annotated[
        bool, _flag("iterations", "Newton–Raphson from the unchanged guess.")
    ] = False,
    symbolic: Annotated[bool, _flag("symbolic", "Φ, Φ_q and γ of each joint as formulas.")] = False,
    assembly: Annotated[
        bool, _flag("assembly", "With the driver rows of what the start sets.")
    ] = False,
    t: Annotated[
        float | None, typer.Option("--t", help="Time of the simulation, s; else its start.")
    ] = None,
    form: Annotated[
        str | None, typer.Option("--format", help="text, csv or latex; else by the name of -o.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="A file in place of the terminal.")
    ] = None,
    settings: Settings = None,
) -> None:
    """Show matrices and equations with the names of joints and bodies."""
    chosen = _format(form, output)
    flags = {
        "Phi_q": jacobian,
        "M": mass,
        "kkt": kkt,
        "gamma": gamma,
        "Q": forces,
        "Phi": residual,
        "nu": nu,
        "lam": multipliers,
    }
    wanted = [name for name, flag in flags.items() if flag]
    if not (wanted or iterations or symbolic):
        wanted = ["Phi_q"]
    case = read_case(file, settings)
    pieces = list(_matrices(case, wanted, chosen, assembly=assembly, t=t)) if wanted else []
    pieces += [_iterations(case, chosen)] if iterations else []
    pieces += [_symbolic(case, chosen)] if symbolic else []
    _put("\n".join(piece.rstrip("\n") + "\n" for piece in pieces), output)


def _format(form: str | None, output: Path | None) -> str:
    if form is not None:
        return one_of("format", form, FORMATS)
    endings = {ending: name for name, ending in FORMATS.items()}
    return endings.get(output.suffix.lower(), "text") if output else "text"


def _put(text: str, output: Path | None) -> None:
    from kempe import files

    if output is None:
        answers().print(Text(text.rstrip("\n")))
        return
    if not output.name:
        raise FileError(f"cannot write {output}: it is a folder", hint="name a file in it")
    files.write_text(output, text)


def _matrices(
    case: Case, wanted: list[str], form: str, *, assembly: bool, t: float | None
) -> Iterator[str]:
    from kempe.matrices import show as labelled

    state = _state(case, t)
    held = case.held if assembly else {}
    positions = {name: value for name, value in held.items() if name in state.model.column_names()}
    for name in wanted:
        rows = None if name == "lam" else positions
        shown = labelled(case.model, state, name, assembly=rows)
        if form == "text":
            yield f"{shown.title}, t = {figure(float(state.t))} s\n{shown.text()}"
        else:
            yield shown.csv() if form == "csv" else shown.latex()


def _state(case: Case, t: float | None) -> State:
    """The assembled mechanism, or where the simulation brings it by ``t``."""
    start = assembled(case)
    if t is None or t == float(start.t):
        return start
    reached = float(start.t)
    for _, solution in case.each(start=start):
        reached = float(solution.t[-1])
        if float(solution.t[0]) <= t <= reached:
            found: State = solution(t)  # type: ignore[assignment]  # one time gives a State
            return found
    span = f"{figure(float(start.t))} to {figure(reached)} s"
    raise ModelError(f"--t {figure(t)}: the analyses reach from {span}")


def _iterations(case: Case, form: str) -> str:
    from kempe.iterations import iterations

    course = iterations(case)
    if form == "csv":
        return course.csv()
    return course.latex() if form == "latex" else course.text()


def _symbolic(case: Case, form: str) -> str:
    from kempe.symbolic import equations

    if form == "csv":
        raise ModelError("--symbolic has no CSV", hint="use --format text or latex")
    return "\n".join(e.latex() if form == "latex" else e.text() for e in equations(case.model))
