"""A motion as a file that moves: a page, a video or a GIF."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import overload

import numpy as np

from kempe.analyses.mode_shape import ModeShape
from kempe.base import files
from kempe.base.arguments import explained
from kempe.draw.frame import Frame, Picture
from kempe.draw.inline import InlinePlayer
from kempe.draw.oscillation import pictures as pictures_of_mode
from kempe.draw.pixels import Pixels, format_of
from kempe.draw.player import page, player
from kempe.draw.sampling import FRAMES_PER_SECOND, Span
from kempe.draw.scene import playback_rate, scene
from kempe.errors import ModelError
from kempe.model.values import instance
from kempe.results.solution import Solution

FORMATS = ("html", "mp4", "gif")
#: A function that is called with the number of drawn frames and the number of all frames.
Progress = Callable[[int, int], None]

_MOST_PICTURES = 20_000


@dataclass(frozen=True)
class Film:
    """How a format is drawn.

    Attributes:
        size: width and height, pixels.
        fps: pictures per second.
        speed: 2 plays twice as fast.
        span: first and last time, s.
        labels: whether to write numbers and names.
    """

    size: Pixels
    fps: float
    speed: float = 1.0
    span: Span = (0.0, 0.0)
    labels: bool = True


#: A GIF counts time in hundredths of a second.
_FILMS = {"mp4": Film((1280, 720), 30.0), "gif": Film((640, 360), 20.0)}


@overload
def animate(
    solution: Solution, path: None = None, *, speed: float = ..., labels: bool = ...
) -> InlinePlayer: ...


@overload
def animate(
    solution: Solution | ModeShape,
    path: Path | str,
    *,
    fps: float | None = ...,
    speed: float = ...,
    size: Pixels | None = ...,
    begin: float | None = ...,
    end: float | None = ...,
    labels: bool = ...,
    progress: Progress | None = ...,
) -> Path: ...


@explained
def animate(
    solution: Solution | ModeShape,
    path: Path | str | None = None,
    *,
    fps: float | None = None,
    speed: float = 1.0,
    size: Pixels | None = None,
    begin: float | None = None,
    end: float | None = None,
    labels: bool = True,
    progress: Progress | None = None,
) -> Path | InlinePlayer:
    """Write a motion as a page, a video or a GIF, chosen by the ending of the path.

    Without a path, the result is the player, which a notebook shows below the cell.

    Args:
        solution: the motion, or a mode such as ``modes.shape(0)``. An MP4 or GIF of a mode shows
            one slow period.
        path: ending in ``.html``, ``.mp4`` or ``.gif``; None for the player in a notebook.
        fps: pictures per second, 30 for MP4 and 20 for GIF by default; not used for a page.
        speed: 2 plays twice as fast. 1 is real time, except for motions shorter than 2 s or longer
            than a minute; those are slowed down or sped up by a round factor.
        size: width and height, pixels; 1280 × 720 for MP4 and 640 × 360 for GIF by default. A page
            adapts to its window and has no size.
        begin: first time that is shown, s; the start of the motion when None.
        end: last time that is shown, s; the end of the motion when None.
        labels: whether to write the numbers of bodies and the names of joints and elements.
        progress: called with the number of drawn pictures and the number of all pictures.

    Returns:
        The path, or the player.

    Raises:
        ModelError: an unknown ending, or ``fps`` or ``speed`` is not positive or too large, the
            size is impossible, or the times are not within the motion.
        FileError: the file cannot be written, or there is no ffmpeg for an MP4.
    """
    if path is None:
        return inline(solution, speed=speed, labels=labels)
    kind = files.checked_path(path, "write").suffix.lstrip(".").lower()
    if kind not in FORMATS:
        raise ModelError(f"{path}: the format is unknown", hint="end it in .html, .mp4 or .gif")
    _refuse_wrong(fps=fps, speed=speed)
    instance(solution, (Solution, ModeShape), "a solution, or a mode such as modes.shape(0)")
    if isinstance(solution, ModeShape):
        return _animate_mode(solution, Path(path), kind, size, fps, labels=labels)
    first, last = float(solution.t[0]), float(solution.t[-1])
    span = first if begin is None else float(begin), last if end is None else float(end)
    if kind == "html":
        if size is not None:
            raise ModelError("size: a page fits its window", hint="leave the size out")
        return player(solution, path, speed=speed, span=span, labels=labels)
    usual = _FILMS[kind]
    film = Film(size or usual.size, fps or usual.fps, speed, span, labels)
    _write(kind, Path(path), film, lambda: _pictures(solution, film, progress))
    return Path(path)


def inline(
    solution: Solution | ModeShape, *, speed: float = 1.0, labels: bool = True
) -> InlinePlayer:
    """The player of a motion for a notebook."""
    if isinstance(solution, ModeShape):
        raise ModelError("a page cannot show a mode", hint='give a path that ends in ".gif"')
    _refuse_wrong(speed=speed)
    shown = scene(solution)
    shown["playback"]["rate"] *= speed
    return InlinePlayer(page(shown, labels=labels), solution.compiled.title or "Linkage")


def _animate_mode(
    shape: ModeShape,
    path: Path,
    kind: str,
    size: Pixels | None,
    fps: float | None,
    *,
    labels: bool,
) -> Path:
    if kind == "html":
        raise ModelError(f"{path}: a page cannot show a mode", hint="end it in .gif or .mp4")
    usual = _FILMS[kind]
    film = Film(size or usual.size, fps or usual.fps, labels=labels)
    _write(kind, path, film, lambda: pictures_of_mode(shape, film.size, film.fps, labels=labels))
    return path


def _write(kind: str, path: Path, film: Film, pictures: Callable[[], Iterator[Picture]]) -> None:
    if kind == "mp4" and any(count % 2 for count in film.size):
        raise ModelError("size: an MP4 needs an even width and an even height")
    if kind == "mp4":
        from kempe.draw.mp4 import find_ffmpeg
        from kempe.draw.mp4 import write_mp4 as write

        find_ffmpeg()  # before anything is drawn in vain
    else:
        from kempe.draw.gif import write_gif as write

    write(path, pictures(), film.fps)


def _pieces(count: int, each: float) -> int:
    """Number of frames of the scene for each picture, so that paths are smooth."""
    wished = math.ceil(each * FRAMES_PER_SECOND)
    return max(1, min(wished, _MOST_PICTURES // count))


def _refuse_wrong(**numbers: float | None) -> None:
    for name, value in numbers.items():
        if value is not None and not (math.isfinite(value) and 0.0 < value <= 1000.0):
            raise ModelError(f"{name}={value:g}: must be more than 0 and at most 1000")


def _pictures(solution: Solution, film: Film, progress: Progress | None) -> Iterator[Picture]:
    """RGBA pictures, (height, width, 4), each valid until the next."""
    begin, end = film.span
    each = playback_rate(end - begin) * film.speed / film.fps
    count = max(1, math.ceil((end - begin) / each - 1e-9) + 1)
    if count > _MOST_PICTURES:
        raise ModelError(f"{count} pictures are too many", hint="raise speed= or lower fps=")
    wanted = format_of(film.size)
    shown = scene(solution, frames=(count - 1) * _pieces(count, each) + 1, span=film.span)
    frame = Frame(shown, wanted.dpi, wanted.size, labels=film.labels)
    times = np.array(shown["frames"]["t"])
    for done, t in enumerate(np.linspace(begin, end, count), start=1):
        yield frame.pixels(int(np.abs(times - t).argmin()))
        if progress is not None:
            progress(done, count)
