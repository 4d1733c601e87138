"""The commands, and the conversion of errors to messages and exit codes."""

from __future__ import annotations

import sys
import warnings
from typing import Any

import typer
from rich.console import Console
from rich.text import Text
from typer.core import TyperGroup

from kempe import errors
from kempe._version import __version__
from kempe.cli import exit_codes
from kempe.cli.animate import EXAMPLES as ANIMATE_EXAMPLES
from kempe.cli.animate import animate as animate_command
from kempe.cli.cam import EXAMPLES as CAM_EXAMPLES
from kempe.cli.cam import cam as cam_command
from kempe.cli.check import EXAMPLES as CHECK_EXAMPLES
from kempe.cli.check import check as check_command
from kempe.cli.convert import EXAMPLES as CONVERT_EXAMPLES
from kempe.cli.convert import convert as convert_command
from kempe.cli.exercise import EXAMPLES as EXERCISE_EXAMPLES
from kempe.cli.exercise import exercise as exercise_command
from kempe.cli.failure import exit_code, print_error, print_json
from kempe.cli.fit import EXAMPLES as FIT_EXAMPLES
from kempe.cli.fit import fit as fit_command
from kempe.cli.gradient import EXAMPLES as GRADIENT_EXAMPLES
from kempe.cli.gradient import gradient as gradient_command
from kempe.cli.new import EXAMPLES as NEW_EXAMPLES
from kempe.cli.new import new as new_command
from kempe.cli.optimize import EXAMPLES as OPTIMIZE_EXAMPLES
from kempe.cli.optimize import optimize as optimize_command
from kempe.cli.plot import EXAMPLES as PLOT_EXAMPLES
from kempe.cli.plot import plot as plot_command
from kempe.cli.report import EXAMPLES as REPORT_EXAMPLES
from kempe.cli.report import report as report_command
from kempe.cli.run import EXAMPLES as RUN_EXAMPLES
from kempe.cli.run import run as run_command
from kempe.cli.schema import EXAMPLES as SCHEMA_EXAMPLES
from kempe.cli.schema import schema as schema_command
from kempe.cli.show import EXAMPLES as SHOW_EXAMPLES
from kempe.cli.show import show as show_command
from kempe.cli.studio import EXAMPLES as STUDIO_EXAMPLES
from kempe.cli.studio import studio as studio_command
from kempe.cli.study import EXAMPLES as STUDY_EXAMPLES
from kempe.cli.study import study as study_command
from kempe.cli.sweep import EXAMPLES as SWEEP_EXAMPLES
from kempe.cli.sweep import sweep as sweep_command
from kempe.cli.synthesis import EXAMPLES as SYNTHESIS_EXAMPLES
from kempe.cli.synthesis import synthesis as synthesis_command

#: Commands that run the analyses of one type, and the analyses that these start from.
ANALYSES = {
    "dynamics": "Simulate the motion under the forces of a case.",
    "kinematics": "Compute the motion that the drivers of a case determine.",
    "inverse_dynamics": "Compute a driven motion, the efforts of its drivers and all reactions.",
    "equilibrium": "Find where a mechanism rests, and whether it is stable there.",
    "modes": "Compute frequencies, damping and shapes of small motions.",
    "limits": "Find how far a mechanism can move, and whether a crank turns fully.",
    "reachable": "Find the region that a point reaches while two quantities vary.",
    "configurations": "List all positions in which a mechanism can be assembled.",
    "mobility": "Count freedoms, and find redundant joints and singular positions.",
}


class _Commands(TyperGroup):
    """The commands; messages on their options begin with the fault."""

    def invoke(self, ctx: Any) -> Any:
        """Run a command without the words that pydantic puts before a message."""
        try:
            return super().invoke(ctx)
        except typer.BadParameter as error:
            error.message = error.message.removeprefix("Value error, ")
            raise


app = typer.Typer(
    name="kempe",
    cls=_Commands,
    help="Planar multibody mechanics: assembly, kinematics, dynamics and joint reactions.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
)
app.command("run", epilog=RUN_EXAMPLES)(run_command)
for _type, _about in ANALYSES.items():
    app.command(_type, help=_about)(run_command)
app.command("check", epilog=CHECK_EXAMPLES)(check_command)
app.command("show", epilog=SHOW_EXAMPLES)(show_command)
app.command("plot", epilog=PLOT_EXAMPLES)(plot_command)
app.command("animate", epilog=ANIMATE_EXAMPLES)(animate_command)
app.command("report", epilog=REPORT_EXAMPLES)(report_command)
app.command("study", epilog=STUDY_EXAMPLES)(study_command)
app.command("sweep", epilog=SWEEP_EXAMPLES)(sweep_command)
app.command("gradient", epilog=GRADIENT_EXAMPLES)(gradient_command)
app.command("optimize", epilog=OPTIMIZE_EXAMPLES)(optimize_command)
app.command("fit", epilog=FIT_EXAMPLES)(fit_command)
app.command("synthesis", epilog=SYNTHESIS_EXAMPLES)(synthesis_command)
app.command("cam", epilog=CAM_EXAMPLES)(cam_command)
app.command("exercise", epilog=EXERCISE_EXAMPLES)(exercise_command)
app.command("studio", epilog=STUDIO_EXAMPLES)(studio_command)
app.command("convert", epilog=CONVERT_EXAMPLES)(convert_command)
app.command("new", epilog=NEW_EXAMPLES)(new_command)
app.command("schema", epilog=SCHEMA_EXAMPLES)(schema_command)


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


def run(words: list[str]) -> int:
    """Run one command line and return its exit code; an error of kempe is printed on stderr."""
    as_json = "--json" in words
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _print_warning
            code = app(args=words, prog_name="kempe", standalone_mode=not as_json)
    except SystemExit as end:
        code = end.code
    except errors.KempeError as error:
        print_error(error)
        return exit_code(error)
    except Exception as error:
        if not as_json or not hasattr(error, "format_message"):
            raise
        return _refuse_words(error)
    return code if isinstance(code, int) else exit_codes.OK


def _print_warning(message: Warning | str, *_: object, **__: object) -> None:
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    console.print(Text.assemble(("warning: ", "bold yellow"), str(message)))


def _refuse_words(error: Any) -> int:
    """Report wrong arguments as JSON and as a message; the class of the error is not public."""
    message = error.format_message()
    tree = {"type": "UsageError", "message": message, "exit_code": exit_codes.BAD_INPUT}
    print_json({"error": tree})
    print(f"error: {message}", file=sys.stderr)
    return exit_codes.BAD_INPUT
