"""``kempe animate`` makes a page, a video or a GIF of a case or of a stored solution."""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from kempe.cli.arguments import Settings
from kempe.cli.clock import drawing
from kempe.cli.console import answers
from kempe.cli.solved import CaseOrSolution, results_folder, solved

STEM = "animation"

EXAMPLES = """Examples:

  kempe animate four_bar.toml

  kempe animate out/four_bar/solution.npz --format mp4 --fps 30 --speed 0.5

  kempe animate four_bar.toml -o linkage.gif --set k=2e5
"""


class Form(str, Enum):
    """What an animation can be; must agree with ``kempe.draw.animate.FORMATS``."""

    html = "html"
    mp4 = "mp4"
    gif = "gif"


def animate(  # noqa: PLR0917 - typer distinguishes options by their annotations
    file: CaseOrSolution,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The file; by default animation.* beside the results."),
    ] = None,
    form: Annotated[
        Form | None, typer.Option("--format", help="By default, from the ending of the file.")
    ] = None,
    fps: Annotated[
        float | None, typer.Option("--fps", help="Pictures per second of a video or GIF.")
    ] = None,
    speed: Annotated[
        float, typer.Option("--speed", help="2 plays twice as fast, 0.1 in slow motion.")
    ] = 1.0,
    settings: Settings = None,
) -> None:
    """Animate a case, which is simulated first, or a solution that was saved."""
    from kempe.draw import animate as write

    console = answers()
    for name, solution in solved(file, settings):
        path = _path(file, output, form, name)
        with drawing(path.name) as progress:
            write(solution, path, fps=fps, speed=speed, progress=progress)
        console.print(Text(str(path)))


def _path(file: Path, output: Path | None, form: Form | None, analysis: str) -> Path:
    """The file of the animation of an analysis; ``--format`` has priority over the ending."""
    if output is None:
        return results_folder(file) / analysis / f"{STEM}.{(form or Form.html).value}"
    named = output.with_name(f"{output.stem}_{analysis}{output.suffix}") if analysis else output
    if form is None or named.suffix.lower() == f".{form.value}":
        return named
    return named.with_name(f"{named.name}.{form.value}")
