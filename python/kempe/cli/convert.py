"""``kempe convert``: a file of another tool as a case, or a case for another tool."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from kempe.cli.console import answers
from kempe.errors import FileError

EXAMPLES = """Examples:

  kempe convert engine.asmt engine.toml

  kempe convert engine.asmt engine.toml --partial

  kempe convert crank.txt crank.json --from asmt

  kempe convert four_bar.toml plates.dxf
"""


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
        bool, typer.Option("--partial", help="Leave out what has no equal in kempe, and list it.")
    ] = False,
    force: Annotated[
        bool, typer.Option("--force", "-f", help="Overwrite an existing file.")
    ] = False,
) -> None:
    """Convert a file of another tool to a case of kempe, or a case to another format."""
    from kempe.loading import convert as convert_file

    if not force and (output.exists() or output.is_symlink()):
        raise FileError(f"{output} exists", name=str(output), hint="--force overwrites it")
    if (to or output.suffix.lower().removeprefix(".")) == "dxf":
        from kempe.draw.dxf import write_dxf
        from kempe.loading import load

        case = load(file, partial=partial, form=form)
        write_dxf(case.start(), output)
        unread = case.unread
    else:
        unread = convert_file(file, output, form, to, partial=partial)
    console = answers()
    for line in unread:
        console.print(Text(f"left out: {line}"))
    console.print(Text(f"{output} written"))
