"""The commands, and the conversion of errors to messages and exit codes."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import typer
from rich.console import Console
from rich.text import Text

from kempe import errors
from kempe._version import __version__
from kempe.cli import exit_codes
from kempe.cli.animate import EXAMPLES as ANIMATE_EXAMPLES
from kempe.cli.animate import animate as animate_command
from kempe.cli.check import EXAMPLES as CHECK_EXAMPLES
from kempe.cli.check import check as check_command
from kempe.cli.new import EXAMPLES as NEW_EXAMPLES
from kempe.cli.new import new as new_command
from kempe.cli.plot import EXAMPLES as PLOT_EXAMPLES
from kempe.cli.plot import plot as plot_command
from kempe.cli.run import EXAMPLES as RUN_EXAMPLES
from kempe.cli.run import run as run_command
from kempe.cli.schema import EXAMPLES as SCHEMA_EXAMPLES
from kempe.cli.schema import schema as schema_command
from kempe.cli.show import EXAMPLES as SHOW_EXAMPLES
from kempe.cli.show import show as show_command
from kempe.cli.study import EXAMPLES as STUDY_EXAMPLES
from kempe.cli.study import study as study_command

app = typer.Typer(
    name="kempe",
    help="Planar multibody mechanics: assembly, kinematics, dynamics and joint reactions.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
app.command("run", epilog=RUN_EXAMPLES)(run_command)
app.command("check", epilog=CHECK_EXAMPLES)(check_command)
app.command("show", epilog=SHOW_EXAMPLES)(show_command)
app.command("plot", epilog=PLOT_EXAMPLES)(plot_command)
app.command("animate", epilog=ANIMATE_EXAMPLES)(animate_command)
app.command("study", epilog=STUDY_EXAMPLES)(study_command)
app.command("new", epilog=NEW_EXAMPLES)(new_command)
app.command("schema", epilog=SCHEMA_EXAMPLES)(schema_command)

#: The first match counts, so a class comes before its base class.
_CODES: tuple[tuple[type[errors.KempeError], int], ...] = (
    (errors.ModelError, exit_codes.BAD_INPUT),
    (errors.FileError, exit_codes.FILE),
    (errors.InternalError, exit_codes.INTERNAL),
    (errors.KempeError, exit_codes.MECHANICS),
)


def _print_version(requested: bool) -> None:
    if requested:
        print(f"kempe {__version__}")
        raise typer.Exit(exit_codes.OK)


@app.callback()
def _options(
    version: bool = typer.Option(
        False, "--version", "-V", callback=_print_version, is_eager=True, help="Show the version."
    ),
) -> None:
    """Options before the command."""


def run(words: Sequence[str]) -> int:
    """Run one command line; an error of kempe is printed on stderr without a traceback."""
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _print_warning
            app(args=list(words), prog_name="kempe")
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else exit_codes.OK
    except errors.KempeError as error:
        _print_error(error)
        return exit_code(error)
    return exit_codes.OK


def exit_code(error: errors.KempeError) -> int:
    """The exit code of an error.

    A file that can be read but is invalid is bad input: its error has ``problems``.
    """
    if isinstance(error, errors.FileError) and error.problems:
        return exit_codes.BAD_INPUT
    return next(code for kind, code in _CODES if isinstance(error, kind))


def _print_warning(message: Warning | str, *_: object, **__: object) -> None:
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    console.print(Text.assemble(("warning: ", "bold yellow"), str(message)))


def _print_error(error: errors.KempeError) -> None:
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    message = str(error)
    console.print(Text.assemble(("error: ", "bold red"), message))
    for problem in error.problems:
        if problem.message not in message:  # messages of the core contain them, with lines
            console.print(Text(f"  {problem}"))
