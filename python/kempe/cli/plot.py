"""``kempe plot`` draws the figures of a case or of a stored solution, all or some."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.text import Text

from kempe.cli import figures
from kempe.cli.arguments import Settings, assembled, read_case
from kempe.cli.console import answers
from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.plot import Page
    from kempe.solution import Solution


def plot(  # noqa: PLR0917 - typer tells options from arguments by their annotations
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="A case (TOML, JSON) or a solution (npz).")
    ],
    names: Annotated[
        list[str] | None,
        typer.Option(
            "--figure", metavar="NAME", help="Only this, such as reactions_C; repeatable."
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Folder for figures; beside the results if absent."),
    ] = None,
    index_base: figures.IndexBase = 1,
    form: Annotated[
        str, typer.Option("--format", help="Some of png, svg, pdf, with commas between.")
    ] = "png,svg",
    settings: Settings = None,
) -> None:
    """Draw figures of a case, which is simulated first, or of a solution that was saved."""
    from kempe.plot import pages, save

    wanted = figures.formats(form)
    console = answers()
    for folder, solution in list(_solutions(file, settings, output)):
        chosen = _chosen(solution, pages(solution, index_base), names or [])
        for path in save(chosen, folder, wanted):
            console.print(Text(str(path)))


def _solutions(
    file: Path, settings: list[str] | None, output: Path | None
) -> Iterator[tuple[Path, Solution]]:
    """Solutions with the folders for their figures, which are those of ``kempe run``."""
    if file.suffix.lower() == ".npz":
        from kempe.archive import load_solution

        if settings:
            raise ModelError("--set changes a case; a solution stays as it was computed")
        yield output or file.parent / "figures", load_solution(file)
        return
    case = read_case(file, settings)
    if not case.analyses:
        raise ModelError(f"{file} asks for no analysis", hint="add one, as [analyses.release]")
    apart = len(case.analyses) > 1
    for name, solution in case.each(start=assembled(case)):
        if output is None:
            folder = Path("out") / file.stem
            yield (folder / name if apart else folder) / "figures", solution
        else:
            yield output / name if apart else output, solution


def _chosen(solution: Solution, known: list[Page], names: list[str]) -> list[Page]:
    """The pages asked for; of a figure named after a joint or a force, the name is told apart.

    Raises:
        ModelError: there is no such figure, joint or force.
    """
    from kempe.plot import select

    told = {word for page in known for word in (page.name, page.about, page.stem)}
    for name in names:
        for family, look_up in (
            ("reactions_", solution.constraint),
            ("torque_", solution.force),
        ):
            if name.startswith(family) and name not in told:
                look_up(name.removeprefix(family))
    return select(known, names)
