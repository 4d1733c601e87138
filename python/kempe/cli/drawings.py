"""The drawings that ``kempe run`` writes beside its results."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from kempe.cli.animate import STEM, Form
from kempe.cli.clock import counting
from kempe.cli.figures import Drawing, Which

if TYPE_CHECKING:
    from kempe.results.result import Result
    from kempe.results.solution import Solution

FIRST, LAST = "first_frame.png", "last_frame.png"


def write_drawings(solution: Solution, folder: Path, drawing: Drawing) -> list[Path]:
    """The page that plays the motion, its first and last frame, and a video, if requested.

    Raises:
        FileError: a file cannot be written, or there is no ffmpeg for an MP4.
    """
    from kempe.draw import animate, player, scene
    from kempe.draw.frame import Frame

    written = []
    if drawing.which is not Which.none or drawing.video is Form.html:
        written.append(player(solution, folder / f"{STEM}.html"))
    if drawing.which is Which.all:
        frame = Frame(scene(solution))
        for k, name in ((0, FIRST), (-1, LAST)):
            frame.save(k, folder / name)
            written.append(folder / name)
    if drawing.video not in (None, Form.html):
        path = folder / f"{STEM}.{drawing.video.value}"
        with counting(path.name) as progress:
            written.append(animate(solution, path, progress=progress))
    return written


def write_figures(solution: Solution | Result, folder: Path, drawing: Drawing) -> list[Path]:
    """The wanted figures.

    Raises:
        FileError: a file cannot be written.
    """
    if drawing.which is Which.none:
        return []
    from kempe.plot import save

    return save(drawing.pages(solution), folder / "figures")


def refuse_impossible(video: Form | None) -> None:
    """Report before a simulation, not after it, that a video cannot be made.

    Raises:
        FileError: there is no ffmpeg for an MP4.
    """
    if video is Form.mp4:
        from kempe.draw.mp4 import find_ffmpeg

        find_ffmpeg()
