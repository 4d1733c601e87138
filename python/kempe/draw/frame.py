"""Draws one frame of a scene with matplotlib: still pictures, and the frames of videos."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe import files
from kempe.arrays import Floats
from kempe.draw.geometry import limits, placed, smooth, spiral, support, turned
from kempe.draw.numbers import round_below
from kempe.draw.scene import Scene
from kempe.plot import style
from kempe.plot.symbols import spring_damper

if TYPE_CHECKING:
    from matplotlib.artist import Artist

#: RGBA, (height, width, 4).
Picture: TypeAlias = NDArray[np.uint8]

#: Inches; with DOTS_PER_INCH a picture of 1440 × 810.
SIZE = (9.6, 5.4)
DOTS_PER_INCH = 150.0
#: Most characters of a name in a picture.
_LONGEST_NAME = 24
_MOST_NUMBERED = 40
#: In how many pieces a path is drawn between two frames.
_PIECES = 4


class Frame:
    """A picture whose moving parts can be put at any frame of a scene.

    Args:
        scene: what is drawn.
        size: width and height, inches.
        dpi: dots per inch.
    """

    def __init__(
        self, scene: Scene, size: tuple[float, float] = SIZE, dpi: float = DOTS_PER_INCH
    ) -> None:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        self._scene = scene
        self._poses = np.array(
            [[[0.0] * 3, *poses] for poses in scene["frames"]["poses"]], dtype=np.float64
        )
        self.figure = Figure(figsize=size, dpi=dpi)
        self._canvas: Any = FigureCanvasAgg(self.figure)  # matplotlib leaves it untyped
        self.axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set_axis_off()
        self._limits = limits(scene["bounds"], size[0] / size[1])
        self.axes.set_xlim(self._limits[0], self._limits[2])
        self.axes.set_ylim(self._limits[1], self._limits[3])
        self._unit = (self._limits[3] - self._limits[1]) / 100.0
        self._draw_still()
        self._moving = list(self._moving_parts())
        self._background: Any = None

    # --- what stands still ------------------------------------------------------------------------

    def _draw_still(self) -> None:
        title = shortened(self._scene["title"], 80)
        self.axes.text(0.015, 0.975, title, transform=self.axes.transAxes, va="top", fontsize=12)
        for trace in self._scene["traces"]:
            path = placed(self._path(trace["body"]), trace["point"])
            colour = style.colour(trace["body"])
            self.axes.plot(*path.T, color=colour, linewidth=1.0, alpha=0.5, zorder=1)
        self._draw_length_scale()
        for joint in self._scene["joints"]:
            if joint["slide"] is not None:
                continue
            for body, point in zip(joint["bodies"], joint["points"], strict=True):
                if body == 0:
                    self._draw_support(np.array(point))

    def _path(self, number: int) -> Floats:
        """Poses of a body, also between the frames where the scene says that this may be."""
        poses, frames = self._poses[:, number], self._scene["frames"]
        if self._scene["interpolation"] != "cubic":
            return poses
        rates = np.array([one[number - 1] for one in frames["rates"]], dtype=np.float64)
        return smooth(poses, rates, np.array(frames["t"]), _PIECES)

    def _draw_length_scale(self) -> None:
        left, bottom, _, top = self._limits
        length = round_below((top - bottom) / 6.0)
        x, y = left + 2.5 * self._unit, bottom + 3.0 * self._unit
        corners = [[x, x, x + length, x + length], [y + self._unit, y, y, y + self._unit]]
        self.axes.plot(*corners, color=style.GROUND, linewidth=1.0)
        told = f"{length:g} m"
        self.axes.text(x + length / 2.0, y + self._unit, told, ha="center", va="bottom", fontsize=9)

    def _draw_support(self, at: Floats) -> None:
        triangle, lines = support(at, 2.2 * self._unit)
        self.axes.fill(*triangle.T, facecolor="white", edgecolor=style.GROUND, zorder=2)
        for line in lines:
            self.axes.plot(*line.T, color=style.GROUND, linewidth=1.0, zorder=2)

    # --- what moves -------------------------------------------------------------------------------

    def _moving_parts(self) -> Iterator[tuple[Artist, Any]]:
        """Artists, each with what puts it at the poses of a frame."""
        for body in self._scene["bodies"][1:]:
            yield from self._body(body)
        for joint in self._scene["joints"]:
            if joint["slide"] is not None:
                yield from self._slider(joint)
            elif joint["type"] == "distance":
                yield self._rod(joint)
        for force in self._scene["forces"]:
            yield self._force(force)
        yield self._pins()
        if len(self._scene["bodies"]) <= _MOST_NUMBERED:
            yield from map(self._number, self._scene["bodies"][1:])
        yield from map(self._name, range(len(self._scene["joints"])))

    def _body(self, body: dict[str, Any]) -> Iterator[tuple[Artist, Any]]:
        number, corners = body["number"], np.array(body["outline"])
        closed = np.vstack([corners, corners[:1]]) if len(corners) > 2 else corners
        colour = style.colour(number)
        rims = [(5.0, colour), (3.2, _tinted(colour))]
        if len(corners) > 2:
            (plate,) = self.axes.fill(*closed.T, facecolor=colour, alpha=0.2, zorder=3)
            yield plate, lambda poses, _: plate.set_xy(placed(poses[number], closed))
        for width, shade in rims:
            yield self._line(number, closed, width, shade)

    def _line(self, number: int, corners: Floats, width: float, colour: Any) -> tuple[Artist, Any]:
        (line,) = self.axes.plot([], [], color=colour, linewidth=width, zorder=3)
        line.set_solid_capstyle("round")
        line.set_solid_joinstyle("round")
        if len(corners) == 1:
            line.set_marker("o")
        return line, lambda poses, _: line.set_data(*placed(poses[number], corners).T)

    def _rod(self, joint: dict[str, Any]) -> tuple[Artist, Any]:
        """A massless rod between its two pins."""
        (i, j), points = joint["bodies"], joint["points"]
        (line,) = self.axes.plot([], [], "o-", color=style.GROUND, linewidth=2.0, zorder=5)
        line.set_markerfacecolor("white")
        line.set_markersize(7)

        def put(poses: Floats, _: Floats) -> None:
            ends = [placed(poses[i], points[0]), placed(poses[j], points[1])]
            line.set_data(*np.array(ends).T)

        return line, put

    def _slider(self, joint: dict[str, Any]) -> Iterator[tuple[Artist, Any]]:
        """A block of body j between two rails of body i."""
        (i, j), points, axes = joint["bodies"], np.array(joint["points"]), joint["axes"]
        half = np.array([3.0, 1.7]) * self._unit
        low, high = joint["slide"][0] - 1.6 * half[0], joint["slide"][1] + 1.6 * half[0]
        gap = 1.15 * half[1]
        lines = np.array([[low, gap], [high, gap], [np.nan, np.nan], [low, -gap], [high, -gap]])
        lines = points[0] + turned(lines, axes[0])
        corners = points[1] + turned(half * [[-1, -1], [1, -1], [1, 1], [-1, 1]], axes[1])
        colour = style.colour(j)
        shade = style.colour(i) if i else style.GROUND
        (rails,) = self.axes.plot([], [], color=shade, linewidth=1.0, zorder=2)
        yield rails, lambda poses, _: rails.set_data(*placed(poses[i], lines).T)
        look: dict[str, Any] = {
            "facecolor": _tinted(colour),
            "edgecolor": colour,
            "linewidth": 1.4,
            "zorder": 4,
        }
        (block,) = self.axes.fill(*corners.T, **look)
        yield block, lambda poses, _: block.set_xy(placed(poses[j], corners))

    def _force(self, force: dict[str, Any]) -> tuple[Artist, Any]:
        (line,) = self.axes.plot([], [], color="#7A3DB8", linewidth=1.6, zorder=5)
        (i, j), point = force["bodies"], np.array(force["point"])
        rest = self._poses[0, j, 2] - self._poses[0, i, 2]

        def put(poses: Floats, _: Floats) -> None:
            at = placed(poses[j], point)
            if force["type"] == "spring_damper":
                begin, end = (
                    placed(poses[b], p) for b, p in zip((i, j), force["points"], strict=True)
                )
                line.set_data(*spring_damper(begin, end, 1.8 * self._unit).T)
            elif force["type"] == "torsion_spring":
                turn = 4.0 * np.pi + poses[j, 2] - poses[i, 2] - rest
                line.set_data(*spiral(at, 3.6 * self._unit, poses[i, 2], turn).T)
            else:
                diamond = np.array([[0, 1], [1, 0], [0, -1], [-1, 0], [0, 1]])
                line.set_data(*(at + 1.4 * self._unit * diamond).T)

        return line, put

    def _pins(self) -> tuple[Artist, Any]:
        (pins,) = self.axes.plot([], [], "o", color="black", markersize=7, zorder=6)
        pins.set_markerfacecolor("white")
        turning = [joint["slide"] is None for joint in self._scene["joints"]]
        return pins, lambda _, places: pins.set_data(*places[turning].T)

    def _number(self, body: dict[str, Any]) -> tuple[Artist, Any]:
        number, middle = body["number"], np.mean(body["outline"], axis=0)
        rim = {"boxstyle": "circle,pad=0.25", "fc": "white", "ec": style.colour(number)}
        text = self.axes.text(0, 0, str(number), ha="center", va="center", zorder=7, bbox=rim)
        text.set_fontsize(8)
        # Not over the pin of a body that is a spot.
        above = np.array([0.0, 0.0 if len(body["outline"]) > 1 else 4.6 * self._unit])
        return text, lambda poses, _: text.set_position(
            tuple(placed(poses[number], middle) + above)
        )

    def _name(self, k: int) -> tuple[Artist, Any]:
        joint = self._scene["joints"][k]
        text = self.axes.text(0, 0, shortened(joint["name"]), va="center", fontsize=11, zorder=8)
        springs = [one["bodies"] for one in self._scene["forces"] if one["points"] is None]
        sliders = [one["bodies"][1] for one in self._scene["joints"] if one["slide"] is not None]
        far = joint["bodies"] in springs or set(sliders) & set(joint["bodies"])
        room = (5.2 if far else 2.6) * self._unit

        def put(_: Floats, places: Floats) -> None:
            away = places[k] - places.mean(axis=0)
            if 0 in joint["bodies"]:
                away = np.array([-1.0 if away[0] < 0.0 else 1.0, -0.3])
            if joint["slide"] is not None:
                away = np.array([0.0, -0.9])
            else:
                away /= np.hypot(*away) or 1.0
            text.set_position(tuple(places[k] + room * away))
            text.set_horizontalalignment(
                "right" if away[0] < -0.3 else "left" if away[0] > 0.3 else "center"
            )

        return text, put

    # --- pictures ---------------------------------------------------------------------------------

    def put(self, k: int) -> None:
        """Move everything to where it is at frame k."""
        poses, places = self._poses[k], self.pins(k)
        for _, put in self._moving:
            put(poses, places)

    def pins(self, k: int) -> Floats:
        """Where the joints are at frame k: their points on body j, (n, 2), m."""
        joints = self._scene["joints"]
        found = [placed(self._poses[k, j["bodies"][1]], np.array(j["points"][1])) for j in joints]
        return np.array(found).reshape(-1, 2)

    def save(self, k: int, path: Path | str) -> None:
        """Write frame k as PNG, whole or not at all.

        Raises:
            FileError: the file cannot be written.
        """
        self.put(k)
        clock = self._clock(k)
        with files.writing(path) as file, _any_character():
            self.figure.savefig(file, format="png")
        clock.remove()

    def _clock(self, k: int) -> Artist:
        told = f"t = {self._scene['frames']['t'][k]:.3f} s"
        return self.axes.text(
            0.985, 0.975, told, transform=self.axes.transAxes, ha="right", va="top", fontsize=12
        )

    def pixels(self, k: int) -> Picture:
        """Frame k as RGBA, (height, width, 4), valid until the next one is drawn.

        What stands still is drawn once and copied.
        """
        self.put(k)
        with _any_character():
            if self._background is None:
                self._background = self._still()
            self._canvas.restore_region(self._background)
            clock = self._clock(k)
            for artist in (*(artist for artist, _ in self._moving), clock):
                self.axes.draw_artist(artist)
            clock.remove()
        return np.asarray(self._canvas.buffer_rgba())

    def _still(self) -> Any:
        for artist, _ in self._moving:
            artist.set_visible(False)
        self._canvas.draw()
        for artist, _ in self._moving:
            artist.set_visible(True)
        return self._canvas.copy_from_bbox(self.figure.bbox)


def shortened(name: str, most: int = _LONGEST_NAME) -> str:
    """A name that fits into a picture, for matplotlib to show as it is."""
    return style.verbatim(name if len(name) <= most else f"{name[: most - 1]}…")


def _tinted(colour: str) -> tuple[float, ...]:
    from matplotlib.colors import to_rgb

    return tuple(0.45 * part + 0.55 for part in to_rgb(colour))


@contextmanager
def _any_character() -> Iterator[None]:
    """A character that the font does not have is drawn as a box, which is no reason to warn."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=r"(?s)Glyph .* missing", category=UserWarning)
        yield
