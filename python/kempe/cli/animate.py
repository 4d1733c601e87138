"""``kempe animate`` makes a page, a video, a GIF or a picture of a case or a stored solution."""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.text import Text

from kempe.cli.arguments import (
    AbsoluteTolerance,
    Changes,
    EndTime,
    MethodName,
    RelativeTolerance,
    Settings,
    Step,
    Units,
    shown_in,
)
from kempe.cli.clock import counting
from kempe.cli.console import answers
from kempe.cli.solved import CaseOrSolution, motions, results_folder
from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.draw.pixels import Pixels
    from kempe.results.solution import Solution

STEM, PICTURE = "animation", "still.png"

EXAMPLES = """Examples:

  kempe animate four_bar.toml

  kempe animate out/four_bar/solution.npz --format mp4 --fps 30 --speed 0.5

  kempe animate four_bar.toml -o linkage.gif --set k=2e5 --size 480x270 --from 0 --to 2

  kempe animate four_bar.toml --at 0.25 -o quarter.png --no-labels
"""


class Form(str, Enum):
    """Formats of animations; must agree with ``kempe.draw.animate.FORMATS``."""

    html = "html"
    mp4 = "mp4"
    gif = "gif"


Output = Annotated[
    Path | None,
    typer.Option("--output", "-o", help="The file; by default animation.* beside the results."),
]
FormOption = Annotated[
    Form | None, typer.Option("--format", help="Format; by default that of the ending of the file.")
]
FramesPerSecond = Annotated[
    float | None, typer.Option("--fps", help="Pictures per second of a video or GIF.")
]
Speed = Annotated[float, typer.Option("--speed", help="2 plays twice as fast, 0.1 in slow motion.")]
Size = Annotated[
    str | None,
    typer.Option(
        "--size", metavar="WIDTHxHEIGHT", help="Pixels of a video, GIF or picture: 1280x720."
    ),
]
Begin = Annotated[
    float | None,
    typer.Option("--from", metavar="SECONDS", help="First time that is shown, s."),
]
End = Annotated[
    float | None, typer.Option("--to", metavar="SECONDS", help="Last time that is shown, s.")
]
At = Annotated[
    float | None,
    typer.Option("--at", metavar="SECONDS", help="Write a picture (PNG) of this time only, s."),
]
Labels = Annotated[
    bool, typer.Option("--labels/--no-labels", help="Show numbers of bodies and names.")
]


def animate(  # noqa: PLR0917 - typer distinguishes options by their annotations
    file: CaseOrSolution,
    output: Output = None,
    form: FormOption = None,
    fps: FramesPerSecond = None,
    speed: Speed = 1.0,
    size: Size = None,
    begin: Begin = None,
    end: End = None,
    at: At = None,
    labels: Labels = True,
    units: Units = None,
    settings: Settings = None,
    t_end: EndTime = None,
    method: MethodName = None,
    rtol: RelativeTolerance = None,
    atol: AbsoluteTolerance = None,
    step: Step = None,
) -> None:
    """Animate a case, which is simulated first, or a solution that was saved."""
    from kempe.draw import animate as write
    from kempe.draw import still

    pixels = _pixels(size)
    look: dict[str, Any] = {"labels": labels} | ({} if pixels is None else {"size": pixels})
    if at is not None and (begin is not None or end is not None or form is not None):
        raise ModelError("--at is one time", hint="leave --from, --to and --format out")
    console = answers()
    found = motions(file, Changes(settings, t_end, method, rtol, atol, step))
    for name, solution, (first, last) in _parts(found, *((begin, end) if at is None else (at, at))):
        with shown_in(units):
            if at is not None:
                path = still(solution, _picture(file, output, name), at, **look)
            else:
                path = _path(file, output, form, name)
                look |= {"fps": fps, "speed": speed, "begin": first, "end": last}
                with counting(path.name) as progress:
                    write(solution, path, progress=progress, **look)
        console.print(Text(str(path)))


def _parts(
    found: list[tuple[str, Solution]], begin: float | None, end: float | None
) -> Iterator[tuple[str, Solution, tuple[float, float]]]:
    """The analyses in a range of time, each with its part of the range.

    Raises:
        ModelError: the range extends beyond the times of the analyses.
    """
    first, last = float(found[0][1].t[0]), float(found[-1][1].t[-1])
    wanted = first if begin is None else begin, last if end is None else end
    if not first <= wanted[0] <= wanted[1] <= last:
        asked = f"{wanted[0]:g} to {wanted[1]:g} s" if begin != end else f"{wanted[0]:g} s"
        raise ModelError(f"{asked}: the analyses reach from {first:g} to {last:g} s")
    for name, solution in found:
        low, high = max(wanted[0], float(solution.t[0])), min(wanted[1], float(solution.t[-1]))
        if low < high or (low == high and begin == end) or first == last:
            yield name, solution, (low, high)
            if begin == end and begin is not None:
                return


def _pixels(text: str | None) -> Pixels | None:
    """``1280x720`` → (1280, 720).

    Raises:
        ModelError: it is not a size.
    """
    if text is None:
        return None
    found = re.fullmatch(r"(\d{1,9})[x×](\d{1,9})", text.strip())
    if found is None:
        raise ModelError(f"--size {text}: must be WIDTHxHEIGHT, such as --size 1280x720")
    return int(found[1]), int(found[2])


def _path(file: Path, output: Path | None, form: Form | None, analysis: str) -> Path:
    """The file of the animation of an analysis; ``--format`` has priority over the ending."""
    if output is None:
        return results_folder(file) / analysis / f"{STEM}.{(form or Form.html).value}"
    named = _named(output, analysis)
    if form is None or named.suffix.lower() == f".{form.value}":
        return named
    return named.with_name(f"{named.name}.{form.value}")


def _picture(file: Path, output: Path | None, analysis: str) -> Path:
    """The file of the picture of an analysis."""
    if output is None:
        return results_folder(file) / analysis / PICTURE
    return _named(output, analysis)


def _named(output: Path, analysis: str) -> Path:
    """The given file, with the name of the analysis if there are several."""
    return output.with_name(f"{output.stem}_{analysis}{output.suffix}") if analysis else output
