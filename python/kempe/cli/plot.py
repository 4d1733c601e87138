"""``kempe plot`` draws the figures of a case or of a stored solution, all or some."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.text import Text

from kempe.cli import figures
from kempe.cli.arguments import (
    AbsoluteTolerance,
    Changes,
    EndTime,
    MethodName,
    RelativeTolerance,
    Settings,
    Step,
    Units,
    shown_in,
)
from kempe.cli.console import answers
from kempe.cli.solved import CaseOrSolution, results_folder, solved

if TYPE_CHECKING:
    from kempe.plot import Page
    from kempe.results.result import Result
    from kempe.results.solution import Solution

EXAMPLES = """Examples:

  kempe plot four_bar.toml

  kempe plot out/four_bar/solution.npz --figure reactions_C --format pdf

  kempe plot four_bar.toml --index-base 0 -o figures
"""


def plot(  # noqa: PLR0917 - typer distinguishes options by their annotations
    file: CaseOrSolution,
    names: Annotated[
        list[str] | None,
        typer.Option(
            "--figure",
            metavar="NAME",
            help="Only this figure, such as reactions_C; can be repeated. By default, all.",
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Folder for figures; by default beside the results."),
    ] = None,
    index_base: figures.IndexBase = 1,
    form: Annotated[
        str, typer.Option("--format", help="One or more of png, svg and pdf, separated by commas.")
    ] = "png,svg",
    time_axis: figures.TimeAxis = figures.Axis.linear,
    units: Units = None,
    settings: Settings = None,
    t_end: EndTime = None,
    method: MethodName = None,
    rtol: RelativeTolerance = None,
    atol: AbsoluteTolerance = None,
    step: Step = None,
) -> None:
    """Draw figures of a case, which is simulated first, or of a solution that was saved."""
    from kempe.plot import pages, save

    wanted = figures.formats(form)
    changes = Changes(settings, t_end, method, rtol, atol, step)
    compressed = time_axis is figures.Axis.compressed
    console = answers()
    with shown_in(units):
        for analysis, solution in list(solved(file, changes)):
            known = pages(solution, index_base, compressed=compressed)
            chosen = _chosen(solution, known, names or [])
            for path in save(chosen, _folder(file, output, analysis), wanted):
                console.print(Text(str(path)))


def _folder(file: Path, output: Path | None, analysis: str) -> Path:
    """The folder of the figures: the given one, or one beside the results of the analysis."""
    return results_folder(file) / analysis / "figures" if output is None else output / analysis


def _chosen(solution: Solution | Result, known: list[Page], names: list[str]) -> list[Page]:
    """The requested pages; an unknown joint or force in the name of a figure is reported as such.

    Raises:
        ModelError: there is no such figure, joint or force.
    """
    from kempe.plot import select
    from kempe.results.solution import Solution

    if not isinstance(solution, Solution):
        return select(known, names)
    told = {word for page in known for word in (page.name, page.about, page.stem)}
    for name in names:
        for family, look_up in (
            ("reactions_", solution.constraint),
            ("torque_", solution.force),
            ("measure_", solution.measure),
        ):
            if name.startswith(family) and name not in told:
                look_up(name.removeprefix(family))
    return select(known, names)
