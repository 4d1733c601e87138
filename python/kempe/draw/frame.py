"""One frame of a scene as a picture: still pictures, and the frames of videos."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base import files
from kempe.base.arrays import Floats
from kempe.draw import palette
from kempe.draw.display import display
from kempe.draw.geometry import placed, smooth
from kempe.draw.items import Item
from kempe.draw.numbers import round_below
from kempe.draw.palette import one_line, verbatim
from kempe.draw.placing import View, view_around
from kempe.draw.scene import Scene
from kempe.model.drawing import measured

if TYPE_CHECKING:
    from matplotlib.artist import Artist

#: RGBA, (height, width, 4).
Picture: TypeAlias = NDArray[np.uint8]

#: Inches, width and height.
Size: TypeAlias = tuple[float, float]
#: The size for which the page, and frames without another size, are laid out.
SIZE: Size = (7.2, 4.05)
#: Dots for each inch of a still picture, which is then 1440 × 810.
DOTS_PER_INCH = 200.0
#: Number of pieces of a path between two frames.
_PIECES = 4
#: Left edge of the title, as a share of the width; height of captions and width of the time,
#: points.
_INSET, _CAPTION, _CLOCK = 0.015, 22.0, 78.0


def frame_view(scene: Scene, size: Size = SIZE) -> View:
    """The visible area of a frame: everything, with a margin."""
    return view_around(scene["bounds"], (72.0 * size[0], 72.0 * size[1]))


def frame_items(scene: Scene, size: Size = SIZE, *, labels: bool = True) -> list[Item]:
    """The display list of the frames and of the page.

    Args:
        scene: the scene.
        size: of the frame, inches.
        labels: whether to write numbers and names.
    """
    view = frame_view(scene, size)
    return display(scene, view, labels=labels, taken=_captions(scene, view))


def _captions(scene: Scene, view: View) -> Floats:
    """The boxes of title, time and scale, (3, 4), points of print."""
    (wide, high), title = view.size, one_line(scene["title"], round(view.size[0] / 6.5))
    below = high - _CAPTION
    end = _INSET * wide + measured(title, 9.0)[0]
    return np.array(
        [
            [0.0, below, end, high],
            [wide - _CLOCK, below, wide, high],
            [0.0, 0.0, _scale_bar(view)[1] * view.scale + 8.0, _CAPTION],
        ]
    )


def _scale_bar(view: View) -> tuple[float, float]:
    """A round length for the scale bar, and the length of the bar with its inset, m."""
    length = round_below(float(view.size[1]) / view.scale / 6.0)
    return length, length + 8.0 / view.scale


class Frame:
    """A picture whose moving parts can be placed as in any frame of a scene.

    Args:
        scene: the scene.
        dpi: dots for each inch of a picture.
        size: size of a picture, inches.
        labels: whether to write the numbers of bodies and the names of joints and elements.
    """

    def __init__(
        self,
        scene: Scene,
        dpi: float = DOTS_PER_INCH,
        size: Size = SIZE,
        *,
        labels: bool = True,
    ) -> None:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        from kempe.draw.painter import Painting

        self._scene, self._size = scene, size
        self._poses = np.array(
            [[[0.0] * 3, *poses] for poses in scene["frames"]["poses"]], dtype=np.float64
        )
        self.figure = Figure(figsize=size, dpi=dpi)
        self._canvas: Any = FigureCanvasAgg(self.figure)  # matplotlib leaves it untyped
        self.axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set_axis_off()
        view = frame_view(scene, size)
        (left, right), (bottom, top) = zip(view.low, view.plane(view.size), strict=True)
        self.axes.set_xlim(left, right)
        self.axes.set_ylim(bottom, top)
        self._draw_still()
        self._labels = labels
        items = frame_items(scene, size, labels=labels)
        self.painting = Painting(self.axes, items, self._poses[0])
        self._clock = self.axes.text(
            0.985, 0.975, "", transform=self.axes.transAxes, ha="right", va="top", fontsize=9
        )
        self._background: Any = None

    def _draw_still(self) -> None:
        """Title, paths and the length of a step."""
        title = verbatim(one_line(self._scene["title"], round(80 * self._size[0] / SIZE[0])))
        self.axes.text(_INSET, 0.975, title, transform=self.axes.transAxes, va="top", fontsize=9)
        for trace in self._scene["traces"]:
            path = placed(self._path(trace["body"]), trace["point"])
            colour = palette.colour(trace["body"])
            self.axes.plot(*path.T, color=colour, linewidth=0.8, alpha=0.5, zorder=1)
        (left, right), (bottom, top) = self.axes.get_xlim(), self.axes.get_ylim()
        length, point = round_below((top - bottom) / 6.0), (right - left) / (72.0 * self._size[0])
        x, y = left + 8.0 * point, bottom + 8.0 * point
        corners = [[x, x, x + length, x + length], [y + 3.0 * point, y, y, y + 3.0 * point]]
        self.axes.plot(*corners, color=palette.GROUND, linewidth=0.8)
        unit = self._scene["length"]
        told = f"{length / unit['metres']:g} {unit['unit']}"
        middle = x + length / 2.0
        self.axes.text(middle, y + 3.0 * point, told, ha="center", va="bottom", fontsize=8)

    def _path(self, number: int) -> Floats:
        """Poses of a body, also between the frames where the scene allows this."""
        poses, frames = self._poses[:, number], self._scene["frames"]
        if self._scene["interpolation"] != "cubic":
            return poses
        rates = np.array([one[number - 1] for one in frames["rates"]], dtype=np.float64)
        return smooth(poses, rates, np.array(frames["t"]), _PIECES)

    def put(self, k: int) -> None:
        """Move all parts to their places at frame k."""
        self.painting.poses = self._poses[k]
        of = self._scene["variable"]
        gap = "" if of["shown"] == "°" else " "
        value = self._scene["frames"]["t"][k] / of["divisor"]
        self._clock.set_text(verbatim(f"{of['name']} = {value:.3f}{gap}{of['shown']}"))

    def save(self, k: int, path: Path | str) -> None:
        """Write frame k as PNG, whole or not at all; its names are laid out as in a figure.

        Raises:
            FileError: the file cannot be written.
        """
        from kempe.draw.painter import any_character

        self.put(k)
        with self._laid_out_at(k), files.writing(path) as file, any_character():
            self.figure.savefig(file, format="png")

    @contextmanager
    def _laid_out_at(self, k: int) -> Iterator[None]:
        """Names in places for frame k alone, while those for the whole motion are hidden."""
        from kempe.draw.painter import Painting

        alone = {**self._scene["frames"], "poses": [self._scene["frames"]["poses"][k]]}
        shown = {**self._scene, "frames": alone}
        items = frame_items(shown, self._size, labels=self._labels)
        painting = Painting(self.axes, items, self._poses[k])
        self.painting.show(visible=False)
        try:
            yield
        finally:
            painting.remove_all()
            self.painting.show(visible=True)

    def pixels(self, k: int) -> Picture:
        """Frame k as RGBA, (height, width, 4), valid until the next one is drawn.

        The parts that do not move are drawn once and copied.
        """
        from kempe.draw.painter import any_character

        self.put(k)
        moving: Sequence[Artist] = [
            self.painting,
            *(artist for _, artist in self.painting.texts),
            self._clock,
        ]
        with any_character():
            if self._background is None:
                self._background = self._still(moving)
            self._canvas.restore_region(self._background)
            for artist in moving:
                self.axes.draw_artist(artist)
        return np.asarray(self._canvas.buffer_rgba())

    def _still(self, moving: Sequence[Artist]) -> Any:
        for artist in moving:
            artist.set_visible(False)
        self._canvas.draw()
        for artist in moving:
            artist.set_visible(True)
        return self._canvas.copy_from_bbox(self.figure.bbox)
