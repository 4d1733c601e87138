"""The drawings that ``kempe run`` writes beside its results."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from kempe.cli.animate import STEM, Form
from kempe.cli.clock import drawing

if TYPE_CHECKING:
    from kempe.solution import Solution

FIRST, LAST = "first_frame.png", "last_frame.png"


def write_drawings(solution: Solution, folder: Path, video: Form | None) -> list[Path]:
    """The page that plays the motion, its first and last frame, and a video if requested.

    Raises:
        FileError: a file cannot be written, or there is no ffmpeg for an MP4.
    """
    from kempe.draw import animate, player, scene
    from kempe.draw.frame import Frame

    frame = Frame(scene(solution))
    written = [player(solution, folder / f"{STEM}.html"), folder / FIRST, folder / LAST]
    frame.save(0, folder / FIRST)
    frame.save(-1, folder / LAST)
    if video is not None and video is not Form.html:
        path = folder / f"{STEM}.{video.value}"
        with drawing(path.name) as progress:
            written.append(animate(solution, path, progress=progress))
    return written


def refuse_impossible(video: Form | None) -> None:
    """Report before a simulation, not after it, that a video cannot be made.

    Raises:
        FileError: there is no ffmpeg for an MP4.
    """
    if video is Form.mp4:
        from kempe.draw.mp4 import find_ffmpeg

        find_ffmpeg()
