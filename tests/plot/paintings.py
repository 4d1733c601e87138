"""What of a display list is painted on axes, and where."""

from typing import Any

import numpy as np
from kempe.draw.items import BODY
from kempe.draw.painter import Painting
from kempe.draw.placing import place
from matplotlib.axes import Axes


def painting(axes: Axes) -> Painting:
    return next(artist for artist in axes.get_children() if isinstance(artist, Painting))


def links(axes: Axes) -> list[tuple[dict[str, Any], np.ndarray]]:
    """The lines of bodies with their corners in pixels, (n, 2)."""
    return lines_of(painting(axes))


def lines_of(found: Painting) -> list[tuple[dict[str, Any], np.ndarray]]:
    """The lines of bodies in a painting with their corners in pixels, (n, 2)."""
    dots = found.figure.dpi / 72.0
    return [
        (item, place(item, found.poses, found.view()) * dots)
        for item in found.items
        if (item["kind"], item["layer"]) == ("line", BODY)
    ]
