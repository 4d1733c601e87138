"""``kempe new``: write a commented example to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from kempe.cli.console import answers, table
from kempe.errors import FileError
from kempe.templates import FILES, NAMES

EXAMPLES = """Examples:

  kempe new

  kempe new four_bar

  kempe new slider_crank my/engine.toml
"""


def _names() -> list[str]:
    return list(NAMES)


def new(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="NAME",
            help=f"{', '.join(NAMES[:-1])} or {NAMES[-1]}; without it, the examples are listed.",
            autocompletion=_names,
            show_default=False,
        ),
    ] = None,
    path: Annotated[
        Path | None,
        typer.Argument(
            metavar="PATH", help="File or folder; default NAME.toml.", show_default=False
        ),
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", "-f", help="Overwrite an existing file.")
    ] = False,
) -> None:
    """Write a commented example to start from, or list the examples."""
    from kempe.base import files
    from kempe.templates import template, title

    if name is None:
        table(answers(), ("name", "title"), [(name, title(name)) for name in NAMES], left=2)
        return
    text = template(name)
    usual = Path(FILES[name])
    target = usual if path is None else path
    if target.is_dir():
        target /= usual
    if target.suffix.lower() != usual.suffix:
        raise FileError(f"cannot write {target}: the name must end in {usual.suffix}")
    if not force and (target.exists() or target.is_symlink()):
        raise FileError(f"{target} exists", name=str(target), hint="--force overwrites it")
    files.write_text(target, text)
    next_command = "kempe run" if usual.suffix == ".toml" else "python"
    answers().print(Text(f"{target} written; next: {next_command} {target}"))
