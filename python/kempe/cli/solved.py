"""Solutions for the drawing commands: from a case, which is simulated, or from a file."""

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
    """The folder of the results of a case, or the folder of a stored solution."""
    return file.parent if _is_stored(file) else Path("out") / file.stem


def solved(file: Path, settings: list[str] | None) -> Iterator[tuple[str, Solution]]:
    """The solutions with the names of their analyses; the name is empty for a single analysis.

    Raises:
        ModelError: the case contains no analysis, or settings are given for a stored solution.
    """
    if _is_stored(file):
        from kempe.archive import load_solution

        if settings:
            raise ModelError("--set applies to a case, not to a stored solution")
        yield "", load_solution(file)
        return
    case = read_case(file, settings)
    if not case.analyses:
        raise ModelError(f"{file} contains no analysis", hint="add one, as [analyses.release]")
    apart = len(case.analyses) > 1
    for name, solution in case.each(start=assembled(case)):
        yield name if apart else "", solution


def _is_stored(file: Path) -> bool:
    return file.suffix.lower() == ".npz"
