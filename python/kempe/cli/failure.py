"""Errors on their way out: messages for people, JSON for programs, exit codes for shells."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, replace
from typing import Any

from rich.text import Text

from kempe import errors
from kempe.base import files
from kempe.cli import exit_codes
from kempe.cli.console import remarks

#: The first match counts, so a class comes before its base class.
_CODES: tuple[tuple[type[errors.KempeError], int], ...] = (
    (errors.ModelError, exit_codes.BAD_INPUT),
    (errors.FileError, exit_codes.FILE),
    (errors.InternalError, exit_codes.INTERNAL),
    (errors.KempeError, exit_codes.MECHANICS),
)


def exit_code(error: errors.KempeError) -> int:
    """The exit code of an error.

    A file that can be read but is invalid is bad input: its error has ``problems``.
    """
    if isinstance(error, errors.FileError) and error.problems:
        return exit_codes.BAD_INPUT
    return next(code for kind, code in _CODES if isinstance(error, kind))


def print_error(error: errors.KempeError) -> None:
    """Print an error on stderr, without a traceback."""
    console = remarks()
    message = str(error)
    console.print(Text.assemble(("error: ", "bold red"), message))
    for problem in error.problems:
        # messages of the core contain them, with lines or without their path
        bare = problem.message.removeprefix(f"{problem.path}: ")
        if bare not in message:
            console.print(Text(f"  {replace(problem, message=bare)}"))


@contextmanager
def document(as_json: bool) -> Iterator[dict[str, Any]]:
    """The JSON document of a command, printed when the block ends.

    An error is part of the document, under ``error``, and is raised again.

    Args:
        as_json: whether to print it.

    Yields:
        The document, to be filled.
    """
    found: dict[str, Any] = {}
    try:
        yield found
    except errors.KempeError as error:
        found["error"] = error_tree(error)
        raise
    finally:
        if as_json:
            print_json(found)


def print_json(content: dict[str, Any]) -> None:
    """Print plain data as JSON; numbers that are not finite become null."""
    print(files.json_text(content))


def error_tree(error: errors.KempeError) -> dict[str, Any]:
    """An error as plain data."""
    return {
        "type": next(
            kind.__name__ for kind in type(error).__mro__ if kind.__module__ == errors.__name__
        ),
        "message": str(error.args[0]),
        "hint": error.hint,
        "name": error.name or None,
        "t": error.t,
        "problems": [asdict(problem) for problem in error.problems],
        "exit_code": exit_code(error),
    }
