"""``kempe gradient``: which variable moves a measure, and by how much."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

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
from kempe.cli.console import answers, figure, list_files, table
from kempe.cli.failure import document

if TYPE_CHECKING:
    from rich.console import Console

    from kempe.sweeps import Gradient

EXAMPLES = """Examples:

  kempe gradient four_bar.toml --measure C.force.max --over k --over L2

  kempe gradient press.toml --units mm,kN -o out/press
"""


def gradient(  # noqa: PLR0917 - typer uses the annotations of options and arguments
    file: File,
    measures: Annotated[
        list[str] | None,
        typer.Option(
            "--measure",
            metavar="TEXT",
            help="A measure, such as C.force.max, in place of \\[gradient]; can be repeated.",
        ),
    ] = None,
    over: Annotated[
        list[str] | None,
        typer.Option(
            "--over",
            metavar="NAME",
            help="A parameter or a value at the start, in place of \\[gradient]; can be repeated.",
        ),
    ] = None,
    analysis: Annotated[
        str | None,
        typer.Option("--analysis", metavar="NAME", help="The analysis; the last one by default."),
    ] = None,
    output: Folder = None,
    settings: Settings = None,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Compute the derivatives of measures with respect to variables; write a table and a figure."""
    from kempe.base import files
    from kempe.plot import save
    from kempe.plot.gradients import gradient_pages
    from kempe.sweeps import gradient as compute

    with document(as_json) as content, shown_in(units):
        case = read_case(file, Changes(settings))
        folder = files.checked_path(output or Path("out") / stem(file) / "gradient", "write")
        found = compute(case, measures or (), over or (), analysis=analysis)
        console = answers(silent=as_json)
        _show(console, found)
        found.to_csv(folder / "gradient.csv")
        written = [folder / "gradient.csv", *save(gradient_pages(found), folder / "figures")]
        content.update({**_summary(found), "files": [str(path) for path in written]})
        list_files(console, written)


def _show(console: Console, found: Gradient) -> None:
    """Print the slopes of each measure, the largest relative ones first, and the remarks."""
    from kempe.base.display_units import display

    for k, (measure, value) in enumerate(found.measures.items()):
        unit = display(found.units[measure])
        title = f"{measure} = {figure(value / unit.divisor)} {unit.symbol}".rstrip()
        if k:
            console.print()
        console.print(Text(title, style="bold"))
        own = found.ranked(measure)
        rows = [
            [
                f"{one.variable} *" if one.remark else one.variable,
                _figure(one.value),
                one.unit.symbol,
                _figure(one.relative),
            ]
            for one in own
        ]
        table(console, ["variable", "slope", "unit", "relative"], rows)
        for one in own:
            if one.remark:
                console.print(Text(f"  * {one.variable}: {one.remark}"))


def _figure(value: float) -> str:
    return figure(value) if value == value else "–"  # noqa: PLR0124 - not NaN


def _summary(found: Gradient) -> dict[str, Any]:
    """The numbers in SI units and rad."""
    columns = list(found.variables)
    return {
        "measures": dict(found.measures),
        "variables": dict(found.variables),
        "gradient": {
            measure: dict(zip(columns, row, strict=True))
            for measure, row in zip(found.measures, found.jacobian.tolist(), strict=True)
        },
        "remarks": [
            {"measure": measure, "variable": variable, "remark": text}
            for (measure, variable), text in found.remarks.items()
        ],
    }
