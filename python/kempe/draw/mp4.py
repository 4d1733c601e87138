"""MP4 (H.264) by the ffmpeg of the system or of the package imageio-ffmpeg."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import IO

from kempe.base import files
from kempe.draw.frame import Picture
from kempe.errors import FileError

_REMEDY = "install ffmpeg (Debian, Ubuntu: apt install ffmpeg), or pip install 'kempe[video]'"


def find_ffmpeg() -> str:
    """The path of ffmpeg.

    Raises:
        FileError: ffmpeg is neither installed in the system nor as imageio-ffmpeg.
    """
    found = shutil.which("ffmpeg")
    if found is not None:
        return found
    try:
        import imageio_ffmpeg

        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except (ImportError, RuntimeError) as error:
        raise FileError("an MP4 needs ffmpeg, which was not found", hint=_REMEDY) from error


def write_mp4(path: Path | str, pictures: Iterable[Picture], fps: float) -> None:
    """Write RGBA pictures of the same even size as a video, whole or not at all.

    Raises:
        FileError: there is no ffmpeg, it fails, or the file cannot be written.
    """
    ffmpeg = find_ffmpeg()
    each = iter(pictures)
    first = next(each)
    height, width = first.shape[:2]
    with files.writing(path) as file, tempfile.TemporaryFile() as told:
        command = [ffmpeg, *_arguments(width, height, fps, _encoder(ffmpeg)), "-y", str(file.name)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=told, stderr=told) as process:
            assert process.stdin is not None
            broken = _feed(process.stdin, _with_first(first, each))
        if broken or process.returncode:
            raise FileError(f"cannot write {path}: ffmpeg failed: {_last_words(told)}")


def _with_first(first: Picture, others: Iterator[Picture]) -> Iterator[Picture]:
    yield first
    yield from others


def _feed(pipe: IO[bytes], pictures: Iterable[Picture]) -> bool:
    """Write the pictures to ffmpeg; return whether ffmpeg closed its input early."""
    try:
        for picture in pictures:
            pipe.write(picture.data)
        pipe.close()
    except BrokenPipeError:
        return True
    return False


def _encoder(ffmpeg: str) -> list[str]:
    """H.264 if this ffmpeg contains it; MPEG-4 otherwise, as in some distributions."""
    asked = subprocess.run(
        [ffmpeg, "-hide_banner", "-encoders"], capture_output=True, text=True, check=False
    )
    if "libx264" in asked.stdout:
        return ["-c:v", "libx264", "-crf", "18", "-preset", "fast"]
    return ["-c:v", "mpeg4", "-q:v", "3"]


def _arguments(width: int, height: int, fps: float, encoder: list[str]) -> list[str]:
    raw = ["-f", "rawvideo", "-pix_fmt", "rgba", "-s", f"{width}x{height}", "-r", f"{fps:g}"]
    made = ["-an", *encoder, "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"]
    return ["-hide_banner", "-loglevel", "error", *raw, "-i", "-", *made]


def _last_words(told: IO[bytes]) -> str:
    told.seek(0)
    lines = told.read().decode("utf-8", errors="replace").strip().splitlines()
    return lines[-1] if lines else "it said nothing"
