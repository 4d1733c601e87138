"""The solutions that commands draw: of a case, simulated first, or one that was stored."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kempe.cli.arguments import assembled, read_case
from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.solution import Solution

CaseOrSolution = Annotated[
    Path, typer.Argument(metavar="FILE", help="A case (TOML, JSON) or a solution (npz).")
]


def results_folder(file: Path) -> Path:
    """Where the results of a case are, or the folder of a stored solution."""
    return file.parent if _is_stored(file) else Path("out") / file.stem


def solved(file: Path, settings: list[str] | None) -> Iterator[tuple[str, Solution]]:
    """The solutions, each with the name of its analysis, which is empty if there is only one.

    Raises:
        ModelError: a case that asks for no analysis, or settings for a stored solution.
    """
    if _is_stored(file):
        from kempe.archive import load_solution

        if settings:
            raise ModelError("--set changes a case; a solution stays as it was computed")
        yield "", load_solution(file)
        return
    case = read_case(file, settings)
    if not case.analyses:
        raise ModelError(f"{file} asks for no analysis", hint="add one, as [analyses.release]")
    apart = len(case.analyses) > 1
    for name, solution in case.each(start=assembled(case)):
        yield name if apart else "", solution


def _is_stored(file: Path) -> bool:
    return file.suffix.lower() == ".npz"
