"""Files of other tools, a part of the interface ``kempe._core``."""

import numpy as np
from numpy.typing import NDArray

_F = NDArray[np.float64]

def exchange_formats() -> list[str]:
    """The formats of other tools that are read."""

def exchange_format(text: str) -> str | None:
    """The format whose files begin like a text."""

def exchange_read(
    text: str,
    format: str,  # noqa: A002
) -> tuple[str | None, list[tuple[int, str, bool]], list[tuple[str, _F]]]:
    """The case as JSON, what it lacks, and the results that the text carries."""

def exchange_dxf(
    unit: float,
    lines: list[tuple[str, bool, list[tuple[float, float]], list[float]]],
    circles: list[tuple[str, tuple[float, float], float]],
    texts: list[tuple[str, tuple[float, float], float, str]],
) -> str:
    """A drawing as the text of a DXF file; lengths in metres, ``unit`` that of the drawing."""
