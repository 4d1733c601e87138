"""One instant of a motion as a picture."""

from __future__ import annotations

from pathlib import Path

from kempe.base.arguments import explained
from kempe.draw.frame import Frame
from kempe.draw.pixels import Pixels, format_of
from kempe.draw.scene import scene
from kempe.errors import ModelError
from kempe.results.solution import Solution
from kempe.results.state import State

#: Default size of a picture, pixels.
USUAL: Pixels = (1440, 810)


@explained
def still(
    drawn: Solution | State,
    path: Path | str,
    t: float | None = None,
    *,
    size: Pixels = USUAL,
    labels: bool = True,
) -> Path:
    """Write one instant of a motion as PNG.

    Args:
        drawn: the motion, or a state.
        path: ending in ``.png``.
        t: the instant, s; the start when None. Not allowed for a state.
        size: width and height, pixels.
        labels: whether to write the numbers of bodies and the names of joints and elements.

    Returns:
        The path.

    Raises:
        ModelError: an unknown ending, an impossible size, or a time outside the motion.
        FileError: the file cannot be written.
    """
    if Path(path).suffix.lower() != ".png":
        raise ModelError(f"{path}: the format is unknown", hint="end it in .png")
    wanted = format_of(size)
    if isinstance(drawn, State):
        if t is not None:
            raise ModelError("t: a state is one instant", hint="leave t out, or give the solution")
        shown = scene(drawn)
    else:
        at = float(drawn.t[0]) if t is None else float(t)
        shown = scene(drawn, span=(at, at))
    Frame(shown, wanted.dpi, wanted.size, labels=labels).save(0, path)
    return Path(path)
