"""``kempe report``: the report of an analysis as HTML or PDF."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from kempe.cli.arguments import (
    STDIN,
    AbsoluteTolerance,
    Changes,
    EndTime,
    MethodName,
    RelativeTolerance,
    Settings,
    Step,
    Units,
    read_case,
    shown_in,
)
from kempe.cli.console import answers
from kempe.cli.solved import (
    CaseOrSolution,
    is_stored,
    refuse_without_analysis,
    results_folder,
    stored,
)
from kempe.cli.study import computed
from kempe.errors import ModelError

EXAMPLES = """Examples:

  kempe report four_bar.toml -o report.html

  kempe report four_bar.toml --pdf --study

  kempe report out/four_bar/solution.npz -o report.pdf --units mm,deg
"""

STEM = "report"


def report(  # noqa: PLR0917 - typer distinguishes options by their annotations
    file: CaseOrSolution,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            help="The file, .html or .pdf; by default report.html beside the results.",
        ),
    ] = None,
    pdf: Annotated[
        bool, typer.Option("--pdf", help="Write a PDF too, printed by Chromium, Chrome or Edge.")
    ] = False,
    study: Annotated[
        bool, typer.Option("--study", help="Include the comparison of kempe study.")
    ] = False,
    units: Units = None,
    settings: Settings = None,
    t_end: EndTime = None,
    method: MethodName = None,
    rtol: RelativeTolerance = None,
    atol: AbsoluteTolerance = None,
    step: Step = None,
) -> None:
    """Write a report of a case, which is simulated first, or of a solution that was saved."""
    from kempe.lab_report.write import checked, page, store

    changes = Changes(settings, t_end, method, rtol, atol, step)
    target = results_folder(file) / f"{STEM}.html" if output is None else output
    wanted = [target, target.with_suffix(".pdf")] if pdf else [target]
    paths = [checked(path) for path in dict.fromkeys(wanted)]
    with shown_in(units):
        if is_stored(file):
            if study:
                raise ModelError("--study applies to a case", hint="name the file of the case")
            text = page(stored(file, changes), None, None)
        else:
            case = read_case(file, changes)
            refuse_without_analysis(case, file)
            text = page(case, computed(case) if study else None, _listing(file, changes))
        for path in paths:
            store(text, path)
            answers().print(Text(str(path)))


def _listing(file: Path, changes: Changes) -> str | None:
    """The text of a case file; None if the command line changes the case."""
    from kempe.base import files

    is_as_written = not changes and str(file) != STDIN
    return files.read_text(file) if is_as_written else None
