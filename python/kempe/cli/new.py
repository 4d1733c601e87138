"""``kempe new``: write a commented case to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from kempe.cli.console import answers
from kempe.errors import FileError

EXAMPLES = """Examples:

  kempe new four_bar

  kempe new slider_crank my/engine.toml
"""


def _names() -> list[str]:
    from kempe.templates import NAMES

    return list(NAMES)


def new(
    name: Annotated[
        str,
        typer.Argument(
            metavar="NAME",
            help="four_bar, slider_crank or pendulum.",
            autocompletion=_names,
            show_default=False,
        ),
    ],
    path: Annotated[
        Path | None,
        typer.Argument(
            metavar="[PATH]", help="File or folder; default NAME.toml.", show_default=False
        ),
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", "-f", help="Overwrite an existing file.")
    ] = False,
) -> None:
    """Write a commented example case to start from."""
    from kempe import files
    from kempe.templates import template

    text = template(name)
    target = Path(f"{name}.toml") if path is None else path
    if target.is_dir():
        target /= f"{name}.toml"
    if target.suffix.lower() != ".toml":
        raise FileError(f"cannot write {target}: the name must end in .toml", name=str(target))
    if not force and (target.exists() or target.is_symlink()):
        raise FileError(f"{target} exists", name=str(target), hint="--force overwrites it")
    files.write_text(target, text)
    answers().print(Text(f"{target} written; next: kempe run {target}"))
