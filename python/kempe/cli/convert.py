"""``kempe convert``: a file of another tool as a case, or a case for another tool."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from kempe.cli.console import answers
from kempe.errors import FileError, ModelError

EXAMPLES = """Examples:

  kempe convert engine.asmt engine.toml

  kempe convert engine.asmt engine.toml --partial

  kempe convert crank.txt crank.json --from asmt

  kempe convert four_bar.toml plates.dxf

  kempe convert four_bar.toml four_bar.xml

  kempe convert hoecken.toml hoecken.asmt

  kempe convert motor_press.toml press.fmu --input stall --output ram.y --fmi 3.0
"""

#: Options of FMUs.
Inputs = Annotated[
    list[str] | None,
    typer.Option("--input", metavar="NAME", help="FMU: a parameter that changes in steps."),
]
Outputs = Annotated[
    list[str] | None,
    typer.Option(
        "--output",
        metavar="NAME",
        help="FMU: a quantity or measure; by default coordinates, rates and all measures.",
    ),
]
Version = Annotated[
    str | None, typer.Option("--fmi", metavar="VERSION", help="FMU: 2.0 (default) or 3.0.")
]
AnalysisName = Annotated[
    str | None,
    typer.Option(
        "--analysis", metavar="NAME", help="FMU: its analysis; by default the first dynamics."
    ),
]


def convert(  # noqa: PLR0917 - typer distinguishes options by their annotations
    file: Annotated[Path, typer.Argument(metavar="IN", help="The file to read.")],
    output: Annotated[Path, typer.Argument(metavar="OUT", help="The file to write.")],
    form: Annotated[
        str | None,
        typer.Option("--from", metavar="FORMAT", help="Format of IN; by default its ending."),
    ] = None,
    to: Annotated[
        str | None,
        typer.Option("--to", metavar="FORMAT", help="Format of OUT; by default its ending."),
    ] = None,
    partial: Annotated[
        bool, typer.Option("--partial", help="Leave out what OUT cannot contain, and list it.")
    ] = False,
    force: Annotated[
        bool, typer.Option("--force", "-f", help="Overwrite an existing file.")
    ] = False,
    inputs: Inputs = None,
    outputs: Outputs = None,
    fmi: Version = None,
    analysis: AnalysisName = None,
) -> None:
    """Convert a file of another tool to a case of kempe, or a case to another format."""
    from kempe.loading import convert as convert_file

    if not force and (output.exists() or output.is_symlink()):
        raise FileError(f"{output} exists", name=str(output), hint="--force overwrites it")
    chosen = to or output.suffix.lower().removeprefix(".")
    chosen = "mjcf" if chosen == "xml" else chosen
    _refuse_options(chosen, {"input": inputs, "output": outputs, "fmi": fmi, "analysis": analysis})
    if chosen in ("asmt", "dxf", "fmu", "mjcf"):
        from kempe.asmt.writer import write_asmt
        from kempe.draw.dxf import write_dxf
        from kempe.fmu.export import export_fmu
        from kempe.loading import load
        from kempe.mjcf.writer import write_mjcf

        case = load(file, partial=partial, form=form)
        unread = case.unread
        if chosen == "asmt":
            unread += write_asmt(case, output, partial=partial)
        elif chosen == "dxf":
            write_dxf(case.start(), output)
        elif chosen == "mjcf":
            write_mjcf(case.start(), output)
        else:
            export_fmu(case, output, inputs or (), outputs, version=fmi or "2.0", analysis=analysis)
    else:
        unread = convert_file(file, output, form, to, partial=partial)
    console = answers()
    for line in unread:
        console.print(Text(f"left out: {line}"))
    console.print(Text(f"{output} written"))


def _refuse_options(form: str, options: Mapping[str, object]) -> None:
    """Raise an error if options of FMUs are given for another format."""
    given = [name for name, value in options.items() if value]
    if given and form != "fmu":
        raise ModelError(
            f"--{given[0]} belongs to FMUs, not to the format {form}",
            hint="the name of an FMU ends with .fmu",
        )
