"""Paints a display list on the axes of matplotlib: figures, and the frames of videos."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from matplotlib.artist import Artist, allow_rasterization
from matplotlib.axes import Axes
from matplotlib.path import Path
from matplotlib.patheffects import withStroke
from matplotlib.text import Text
from matplotlib.transforms import IdentityTransform

from kempe.base.arrays import Floats
from kempe.draw.items import Item
from kempe.draw.palette import rgb, verbatim
from kempe.draw.placing import HATCH_WIDTH, View, direction, hatching, place


class Painting(Artist):
    """The items of a display list on axes, at the poses of one instant.

    Lengths of print do not depend on the limits and the resolution of the axes.

    Args:
        axes: the axes, with limits that are set.
        found: items of a display list.
        poses: x, y and angle of each body, ground first, (n_bodies, 3).
        metres: unit of the axes.
    """

    def __init__(
        self, axes: Axes, found: Sequence[Item], poses: Floats, metres: float = 1.0
    ) -> None:
        super().__init__()
        self.set_figure(axes.figure)
        self.items, self.poses = list(found), poses
        self._on, self._metres = axes, metres
        self._shapes = [_ready(item) for item in found if item["kind"] != "text"]
        self.texts = [(_ready(item), _text(item)) for item in found if item["kind"] == "text"]
        self.set_zorder(3.0)
        self.set_in_layout(False)
        axes.add_artist(self)
        for _, artist in self.texts:
            axes.add_artist(artist)

    def view(self) -> View:
        """The visible area, in points of print from the lower left corner of the figure."""
        return view_on(self._on, self._metres)

    def show(self, *, visible: bool) -> None:
        """Show or hide everything."""
        for artist in (self, *(artist for _, artist in self.texts)):
            artist.set_visible(visible)

    def remove_all(self) -> None:
        """Take everything from the axes."""
        for artist in (self, *(artist for _, artist in self.texts)):
            artist.remove()

    @allow_rasterization  # type: ignore[untyped-decorator]
    def draw(self, renderer: Any) -> None:
        """Paint lines and fills, and place the texts, which are painted next."""
        if not self.get_visible():
            return
        view, dots = self.view(), renderer.points_to_pixels(1.0)
        for item in self._shapes:
            _paint(renderer, item, place(item, self.poses, view), dots)
        for item, artist in self.texts:
            centre = place(item, self.poses, view)[0] + item["offset"]
            artist.set_position(tuple(centre * dots))
            if item["turned"]:
                artist.set_rotation(_readable(np.degrees(direction(item, self.poses, view))))
        self.stale = False


def view_on(axes: Axes, metres: float = 1.0) -> View:
    """The area of axes, in points of print from the lower left corner of their figure."""
    corners = axes.transData.transform([(0.0, 0.0), (1.0, 1.0)]) * 72.0 / axes.figure.dpi
    scale = float(corners[1, 0] - corners[0, 0]) / metres
    size = np.array(axes.figure.bbox.size) * 72.0 / axes.figure.dpi
    return View(-corners[0] / scale, scale, size)


def _ready(item: Item) -> Item:
    return {**item, "points": np.array(item["points"], dtype=np.float64).reshape(-1, 4)}


def _text(item: Item) -> Text:
    artist = Text(
        0.0,
        0.0,
        verbatim(item["text"]),
        ha="center",
        va="center_baseline" if item["role"] == "number" else "center",
        fontsize=item["size"],
        fontweight=item["weight"],
        fontstyle="italic" if item["slanted"] else "normal",
        color=rgb(item["colour"]),
        rotation_mode="anchor",
        zorder=4.0,
    )
    artist.set_transform(IdentityTransform())
    if item["role"] != "number":
        artist.set_path_effects([withStroke(linewidth=2.0, foreground="white")])
    artist.set_in_layout(False)
    if item["turned"]:
        artist.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 1.0})
    return artist


def _readable(angle: float) -> float:
    """The same direction of a line of text, from the left or from below, degrees."""
    return 90.0 - (90.0 - angle + 1e-6) % 180.0


def _paint(renderer: Any, item: Item, points: Floats, dots: float) -> None:
    if not np.isfinite(points).all():
        return
    colour = rgb(item["colour"], item["tint"])
    brush = renderer.new_gc()
    brush.set_capstyle("round")
    brush.set_joinstyle("round")
    if item["kind"] == "fill":
        brush.set_linewidth(0.0)
        brush.set_foreground(colour)
        path = Path(np.vstack([points, points[:1]]) * dots, closed=True)
        renderer.draw_path(brush, path, IdentityTransform(), colour)
    else:
        brush.set_linewidth(item["width"])
        brush.set_foreground(colour)
        corners = np.vstack([points, points[:1]]) if item["closed"] else points
        path = Path(corners * dots, closed=item["closed"])
        renderer.draw_path(brush, path, IdentityTransform(), None)
        if item["hatch"]:
            strokes = hatching(points, item["hatch"])
            brush.set_linewidth(HATCH_WIDTH)
            codes = np.tile([Path.MOVETO, Path.LINETO], len(strokes)).astype(np.uint8)
            path = Path(strokes.reshape(-1, 2) * dots, codes)
            renderer.draw_path(brush, path, IdentityTransform(), None)
    brush.restore()


@contextmanager
def any_character() -> Iterator[None]:
    """Draw a character that the font does not contain as a box, without a warning."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=r"(?s)Glyph .* missing", category=UserWarning)
        yield
