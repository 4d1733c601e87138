"""Arguments that the commands share: the case file and the values of its parameters."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.state import State

File = Annotated[Path, typer.Argument(metavar="FILE", help="Case file (TOML or JSON).")]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="Set a parameter; can be repeated."),
]


def read_case(file: Path, settings: list[str] | None) -> Case:
    """The case from a file, with the parameters from the command line."""
    from kempe.case import load

    return load(file, parameters=dict(map(setting, settings or [])))


def setting(text: str) -> tuple[str, float | str]:
    """``k=2e6`` → ("k", 2e6); a value that is not a number is a formula.

    Raises:
        ModelError: the name or the value is missing.
    """
    name, _, value = (part.strip() for part in text.partition("="))
    if not name or not value:
        raise ModelError(f"--set {text}: must be NAME=VALUE, such as --set k=2e6")
    return name, number_or_formula(value)


def number_or_formula(text: str) -> float | str:
    """The number in a word of the command line, or the word if it is not a number."""
    try:
        return float(text)
    except ValueError:
        return text


def assembled(case: Case) -> State:
    """The assembled mechanism; its warnings are printed with the report."""
    import warnings

    from kempe.analyses import AssemblyWarning

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AssemblyWarning)
        return case.start()
