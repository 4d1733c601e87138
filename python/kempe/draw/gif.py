"""GIF by Pillow, a dependency of matplotlib."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from kempe.base import files
from kempe.draw.frame import Picture

if TYPE_CHECKING:
    from PIL.Image import Image

#: All channels of a colour that is shown as white.
_NEARLY_WHITE = 245


def write_gif(path: Path | str, pictures: Iterable[Picture], fps: float) -> None:
    """Write RGBA pictures of the same size as a GIF that repeats, whole or not at all.

    A GIF counts time in hundredths of a second, and browsers play frames shorter than two
    hundredths more slowly.

    Raises:
        FileError: the file cannot be written.
    """
    hundredths = max(2, round(100.0 / fps))
    images = _with_one_palette(pictures)
    first = next(images)
    with files.writing(path) as file:
        first.save(
            file,
            format="GIF",
            save_all=True,
            append_images=images,
            duration=10 * hundredths,
            loop=0,
        )


def _with_one_palette(pictures: Iterable[Picture]) -> Iterator[Image]:
    """The pictures with the palette of the first picture, so that colours do not flicker."""
    from PIL import Image

    palette: Image.Image | None = None
    for picture in pictures:
        image = Image.fromarray(picture).convert("RGB")
        palette = palette or _quantized(image)
        yield image.quantize(palette=palette, dither=Image.Dither.NONE)


def _quantized(image: Image) -> Image:
    """The picture in a palette of 128 colours; colours that are nearly white become white.

    Pillow looks colours up with reduced precision and may take a near neighbour.
    """
    found = image.quantize(128)
    colours = np.array(found.getpalette(), dtype=np.uint8).reshape(-1, 3)
    colours[colours.min(axis=1) >= _NEARLY_WHITE] = 255
    found.putpalette(colours.tobytes())
    return found
