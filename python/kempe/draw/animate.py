"""A motion as a file that moves: a page, a video or a GIF."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from kempe import files
from kempe.draw.frame import SIZE, Frame, Picture
from kempe.draw.player import player
from kempe.draw.sampling import FRAMES_PER_SECOND
from kempe.draw.scene import playback_rate, scene
from kempe.errors import ModelError
from kempe.solution import Solution

FORMATS = ("html", "mp4", "gif")
#: Called with the frames drawn and the frames there are.
Progress = Callable[[int, int], None]

_MOST_PICTURES = 20_000


@dataclass(frozen=True)
class Film:
    """How a format is drawn: dots per inch of the frame, frames per second."""

    dpi: float
    fps: float


#: 1280 × 720 and 640 × 360; a GIF counts time in hundredths of a second.
_FILMS = {"mp4": Film(1280 / SIZE[0], 30.0), "gif": Film(640 / SIZE[0], 20.0)}


def animate(
    solution: Solution,
    path: Path | str,
    *,
    fps: float | None = None,
    speed: float = 1.0,
    progress: Progress | None = None,
) -> Path:
    """Write a motion as a page, a video or a GIF, chosen by the ending of the path.

    Args:
        solution: the motion.
        path: ending in ``.html``, ``.mp4`` or ``.gif``.
        fps: pictures per second, 30 for MP4 and 20 for GIF by default; a page has no use for it.
        speed: 2 plays twice as fast. 1 is real time, except for motions shorter than 2 s or longer
            than a minute; those are slowed down or sped up by a round factor.
        progress: called with the number of pictures drawn and of all pictures.

    Returns:
        The path.

    Raises:
        ModelError: an unknown ending, or ``fps`` or ``speed`` is not positive or too large.
        FileError: the file cannot be written, or there is no ffmpeg for an MP4.
    """
    kind = files.checked_path(path, "write").suffix.lstrip(".").lower()
    if kind not in FORMATS:
        raise ModelError(f"{path}: the format is unknown", hint="end it in .html, .mp4 or .gif")
    _refuse_wrong(fps=fps, speed=speed)
    if kind == "html":
        return player(solution, path, speed=speed)
    film = _FILMS[kind]
    if kind == "mp4":
        from kempe.draw.mp4 import find_ffmpeg
        from kempe.draw.mp4 import write_mp4 as write

        find_ffmpeg()  # before anything is drawn in vain
    else:
        from kempe.draw.gif import write_gif as write

    rate = fps or film.fps
    write(path, _pictures(solution, film, rate, speed, progress), rate)
    return Path(path)


def _pieces(count: int, each: float) -> int:
    """How many frames of the scene there are for a picture, so that paths are smooth."""
    wished = math.ceil(each * FRAMES_PER_SECOND)
    return max(1, min(wished, _MOST_PICTURES // count))


def _refuse_wrong(**numbers: float | None) -> None:
    for name, value in numbers.items():
        if value is not None and not (math.isfinite(value) and 0.0 < value <= 1000.0):
            raise ModelError(f"{name}={value:g}: must be more than 0 and at most 1000")


def _pictures(
    solution: Solution, film: Film, fps: float, speed: float, progress: Progress | None
) -> Iterator[Picture]:
    """RGBA pictures, (height, width, 4), each valid until the next."""
    begin, end = sorted((float(solution.t[0]), float(solution.t[-1])))
    each = playback_rate(end - begin) * speed / fps
    count = max(1, math.ceil((end - begin) / each - 1e-9) + 1)
    if count > _MOST_PICTURES:
        raise ModelError(f"{count} pictures are too many", hint="raise speed= or lower fps=")
    shown = scene(solution, frames=(count - 1) * _pieces(count, each) + 1)
    frame = Frame(shown, film.dpi)
    times = np.array(shown["frames"]["t"])
    for done, t in enumerate(np.linspace(begin, end, count), start=1):
        yield frame.pixels(int(np.abs(times - t).argmin()))
        if progress is not None:
            progress(done, count)
