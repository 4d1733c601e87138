"""Cases and solutions of the commands that take both."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kempe.cli.arguments import Changes, assembled, read_case, stem
from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.results.result import Result
    from kempe.results.solution import Solution

CaseOrSolution = Annotated[
    Path,
    typer.Argument(
        metavar="FILE",
        help="A case (TOML, JSON; - reads standard input) or a solution (npz).",
    ),
]


def results_folder(file: Path) -> Path:
    """The folder of the results of a case, or the folder of a stored solution."""
    return file.parent if is_stored(file) else Path("out") / stem(file)


def motions(file: Path, changes: Changes) -> list[tuple[str, Solution]]:
    """The solutions alone, as ``solved``.

    Raises:
        ModelError: the case contains no analysis of a motion.
    """
    from kempe.results.solution import Solution

    found = [each for each in solved(file, changes) if isinstance(each[1], Solution)]
    if not found:
        raise ModelError(f"{file} contains no analysis of a motion", hint="add one, as dynamics")
    return found  # type: ignore[return-value]  # filtered


def solved(file: Path, changes: Changes) -> Iterator[tuple[str, Solution | Result]]:
    """The results with the names of their analyses; the name is empty for a single analysis.

    Raises:
        ModelError: the case contains no analysis, or a stored solution is to be changed.
    """
    if is_stored(file):
        yield "", stored(file, changes)
        return
    case = read_case(file, changes)
    refuse_without_analysis(case, file)
    apart = len(case.analyses) > 1
    for name, solution in case.each(start=assembled(case)):
        yield name if apart else "", solution


def stored(file: Path, changes: Changes) -> Solution:
    """A stored solution.

    Raises:
        ModelError: it is to be changed.
    """
    from kempe.results.archive import load_solution

    if changes:
        raise ModelError(
            "--set, --t-end, --method, --rtol, --atol and --step apply to a case, not to a stored "
            "solution",
            hint="name the file of the case",
        )
    return load_solution(file)


def refuse_without_analysis(case: Case, file: Path) -> None:
    """Refuse a case without an analysis.

    Raises:
        ModelError: it has none.
    """
    if not case.analyses:
        raise ModelError(f"{file} contains no analysis", hint="add one, as [analyses.release]")


def is_stored(file: Path) -> bool:
    """Whether the name is that of a stored solution."""
    return file.suffix.lower() == ".npz"
