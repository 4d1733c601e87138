"""The size of pictures in pixels."""

from __future__ import annotations

import math
from dataclasses import dataclass

from kempe.draw.frame import SIZE, Size
from kempe.errors import ModelError

#: Width and height.
Pixels = tuple[int, int]
LEAST, MOST = 64, 8192


@dataclass(frozen=True)
class Format:
    """The size and resolution of a picture.

    Attributes:
        dpi: dots for each inch.
        size: width and height, inches.
    """

    dpi: float
    size: Size


def format_of(size: Pixels) -> Format:
    """The format of a picture of this many pixels; its area is the usual one, as is its text size.

    Raises:
        ModelError: the size is impossible.
    """
    for name, count in zip(("width", "height"), size, strict=True):
        if not (isinstance(count, int) and LEAST <= count <= MOST):
            raise ModelError(
                f"size: the {name} is {count!r}; must be a whole number of pixels from {LEAST} "
                f"to {MOST}"
            )
    width, height = size
    dpi = math.sqrt(width * height / (SIZE[0] * SIZE[1]))
    return Format(dpi, (width / dpi, height / dpi))
