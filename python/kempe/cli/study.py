"""``kempe study``: the effect of stabilization, scheme and tolerance on a simulation."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.text import Text

from kempe.cli.arguments import (
    AsJson,
    Changes,
    File,
    Folder,
    Settings,
    Units,
    read_case,
    shown_in,
    stem,
)
from kempe.cli.console import answers, heading, list_files, remarks, table
from kempe.cli.failure import document

if TYPE_CHECKING:
    from rich.console import Console

    from kempe.case import Case
    from kempe.sweeps.studies import Study

EXAMPLES = """Examples:

  kempe study four_bar.toml

  kempe study four_bar.toml --analysis release -o out/study --set c=2e4

  kempe study four_bar.toml --json | jq .findings
"""


def study(  # noqa: PLR0917 - typer distinguishes options by their annotations
    file: File,
    analysis: Annotated[
        str | None, typer.Option("--analysis", help="Name of the analysis; by default the first.")
    ] = None,
    output: Folder = None,
    settings: Settings = None,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Compare stabilizations, methods and tolerances on one analysis."""
    from kempe.plot import study_figures
    from kempe.sweeps.studies.table import json_text

    with document(as_json) as content, shown_in(units):
        case = read_case(file, Changes(settings))
        found = computed(case, analysis)
        console = answers(silent=as_json)
        _show(console, found)
        folder = output or Path("out") / stem(file) / "study"
        written = [*found.save(folder), *study_figures.write(found, folder / "figures")]
        files = [str(path) for path in written]
        content.update({**json.loads(json_text(found)), "files": files})
    list_files(console, written)


def computed(case: Case, analysis: str | None = None) -> Study:
    """The study of an analysis; a terminal shows the variant that is computed."""
    import warnings

    from kempe.analyses.record import AssemblyWarning
    from kempe.results.events import EventWarning
    from kempe.sweeps.studies import study as compute

    silent = not remarks().is_terminal
    with warnings.catch_warnings(), remarks().status("", spinner="line") as status:
        warnings.simplefilter("ignore", AssemblyWarning)
        warnings.simplefilter("ignore", EventWarning)
        return compute(case, analysis, progress=None if silent else status.update)


def _show(console: Console, found: Study) -> None:
    from kempe.sweeps.studies.table import cells, fate, header
    from kempe.sweeps.studies.variants import GROUPS

    console.print(Text(f"{found.title}: study of {found.analysis}", style="bold"))
    for group, title in GROUPS.items():
        outcomes = found.group(group)
        if not outcomes:
            continue
        heading(console, title[0].upper() + title[1:])
        good = [cells(outcome) for outcome in outcomes if not outcome.diverged]
        table(console, header(), good)
        for outcome in outcomes:
            if outcome.diverged:
                told = f"  {outcome.variant.name}  {fate(outcome)}"
                console.print(Text(told, style="red"))
    heading(console, "Findings")
    for told in found.findings():
        console.print(Text(f"  {told}"))
