"""A scene on paper: links with their pins, ground, springs; and what room they leave for names.

Draws what ``kempe.draw.scene`` describes. Widths of links and sizes of symbols are those of print,
in points, whatever the size of the mechanism.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.arrays import Floats
from kempe.plot import style, symbols
from kempe.plot.labels import place_labels
from kempe.plot.units import Scale, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Room around the mechanism, as a share of its larger side.
_MARGIN = 0.17
#: A drawing is at least so high for its width, and so wide for its height.
_LEAST_SIDE = 0.45
_LINK, _EDGE, _PIN = 8.0, 1.0, 6.0
_WHITE = 0.72  # how much of it there is in the colour of a link


@dataclass
class Picture:
    """The first frame of a scene on axes.

    Attributes:
        axes: where it is drawn.
        scene: what is drawn.
        scale: unit of the axes.
        lines: segments that names must not lie on, (m, 2, 2), in points of print.
        boxes: places that are taken, in points of print.
    """

    axes: Axes
    scene: dict[str, Any]
    scale: Scale
    lines: list[Floats] = field(default_factory=list)
    boxes: list[Floats] = field(default_factory=list)

    def at(self, number: int, point: Sequence[float]) -> Floats:
        """Where a point of a body is, in the unit of the axes."""
        found = np.array(point, dtype=np.float64)
        if number:
            x, y, angle = self.scene["frames"]["poses"][0][number - 1]
            c, s = np.cos(angle), np.sin(angle)
            found = np.array([x + c * found[0] - s * found[1], y + s * found[0] + c * found[1]])
        return found / self.scale.divisor

    def corners(self, body: dict[str, Any]) -> Floats:
        """The outline of a body, closed where it is a polygon, (n, 2)."""
        found = [self.at(body["number"], corner) for corner in body["outline"]]
        return np.array([*found, *found[:1]] if len(found) > 2 else found).reshape(-1, 2)

    def pins(self) -> list[Floats]:
        """Where the joints are."""
        return [self.at(joint["bodies"][1], joint["points"][1]) for joint in self.scene["joints"]]

    def points(self, places: Floats) -> Floats:
        """Places on the axes in points of print."""
        dots: Floats = self.axes.transData.transform(places)
        return dots * 72.0 / float(self.axes.figure.dpi)

    def keep_clear(self, place: Floats, reach: float, below: float | None = None) -> None:
        """Take the square around a place on the axes, so many points to each side."""
        centre = self.points(place)
        low = centre - [reach, reach if below is None else below]
        self.boxes.append(np.concatenate([low, centre + reach]))

    def write(self, names: Sequence[str], anchors: Sequence[Floats], **look: Any) -> None:
        """Write names beside their anchors where they lie on nothing else."""
        if not names:
            return
        texts = [
            self.axes.annotate(
                name, (0.0, 0.0), ha="center", va="center", zorder=8, annotation_clip=False, **look
            )
            for name in names
        ]
        for text in texts:
            text.set_in_layout(False)
        dots = 72.0 / float(self.axes.figure.dpi)
        sizes = [np.array(text.get_window_extent().size) * dots for text in texts]
        lines = np.concatenate([np.empty((0, 2, 2)), *self.lines])
        places = self.points(np.array(anchors))
        corners = self.axes.get_window_extent().get_points() * dots
        centres = place_labels(places, np.array(sizes), lines, self.boxes, corners)
        for text, anchor, offset, size in zip(texts, anchors, centres - places, sizes, strict=True):
            text.xy = (float(anchor[0]), float(anchor[1]))
            text.set_position((float(offset[0]), float(offset[1])))
            text.anncoords = "offset points"
            centre = self.points(anchor) + offset
            self.boxes.append(np.concatenate([centre - size / 2.0, centre + size / 2.0]))


def drawn(axes: Axes, scene: dict[str, Any], title: str) -> Picture:
    """Draw links, ground, springs and pins; the names are left to the caller."""
    axes.set_title(title, loc="left")
    made = _framed(axes, scene)
    for body in scene["bodies"]:
        if body["number"]:
            _draw_link(made, body)
    for force in scene["forces"]:
        if "torsion" in force["type"]:
            _draw_spiral(made, made.at(force["bodies"][1], force["point"]))
        elif force["type"] == "spring_damper":
            ends = zip(force["bodies"], force["points"], strict=True)
            _draw_spring_damper(made, *(made.at(number, at) for number, at in ends))
    for joint, pin in zip(scene["joints"], made.pins(), strict=True):
        if joint["type"] == "distance":
            _draw_rod(made, joint)
        else:
            _draw_pin(made, pin, to_ground=0 in joint["bodies"])
    return made


def frame(scene: dict[str, Any]) -> tuple[Floats, Floats]:
    """Least and largest x and y of the axes, m: the mechanism and room around it."""
    low, high = np.array(scene["bounds"]).reshape(2, 2)
    middle, sides = (low + high) / 2.0, high - low
    sides = sides + 2.0 * _MARGIN * (float(sides.max()) or 1.0)
    half = np.maximum(sides, _LEAST_SIDE * sides.max()) / 2.0
    return middle - half, middle + half


def _framed(axes: Axes, scene: dict[str, Any]) -> Picture:
    """Equal axes with room around the mechanism; laid out, so that print sizes are known."""
    low, high = frame(scene)
    unit = scale("m", float(max(high - low)))
    (left, bottom), (right, top) = low / unit.divisor, high / unit.divisor
    axes.set_aspect("equal")
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_xlabel(unit.axis("x"))
    axes.set_ylabel(unit.axis("y"))
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.grid(color="#EEEEEE")
    style.lay_out(axes.figure.canvas.figure)
    return Picture(axes, scene, unit)


def _draw_link(made: Picture, body: dict[str, Any]) -> None:
    """A rounded bar or plate: a wide dark line and a narrower light one in it."""
    corners = made.corners(body)
    edge = style.colour(body["number"])
    face = lighter(edge)
    if len(corners) == 1:
        made.axes.plot(
            *corners.T, "o", markersize=14.0, markerfacecolor=face, markeredgecolor=edge, zorder=2
        )
        made.keep_clear(corners[0], 8.0)
        return
    look: dict[str, Any] = {"solid_capstyle": "round", "solid_joinstyle": "round", "zorder": 2}
    made.axes.plot(*corners.T, color=edge, linewidth=_LINK + 2.0 * _EDGE, **look)
    if len(corners) > 2:
        made.axes.fill(*corners.T, facecolor=face, edgecolor="none", zorder=2)
    made.axes.plot(*corners.T, color=face, linewidth=_LINK, **look)
    dots = made.points(corners)
    for begin, end in pairwise(dots):
        made.lines.append(wide(begin, end, _LINK / 2.0))


def wide(begin: Floats, end: Floats, half: float) -> Floats:
    """A line with its two edges, (3, 2, 2)."""
    along = end - begin
    length = float(np.hypot(*along)) or 1.0
    aside = np.array([-along[1], along[0]]) / length * half
    line = np.array([begin, end])
    return np.array([line - aside, line, line + aside])


def lighter(colour: str) -> tuple[float, float, float]:
    """A colour mixed with white."""
    from matplotlib.colors import to_rgb

    red, green, blue = (part + (1.0 - part) * _WHITE for part in to_rgb(colour))
    return red, green, blue


def _draw_pin(made: Picture, place: Floats, *, to_ground: bool) -> None:
    if to_ground:
        symbols.draw(made.axes, symbols.SUPPORT, place, zorder=1.5, facecolor="white")
        symbols.draw(made.axes, symbols.HATCHING, place, zorder=1.5)
        made.keep_clear(place, 9.0, below=17.0)
    made.axes.plot(
        *place,
        "o",
        markersize=_PIN,
        markerfacecolor="white",
        markeredgecolor="black",
        markeredgewidth=1.0,
        zorder=6,
    )
    made.keep_clear(place, _PIN / 2.0 + 1.0)


def _draw_rod(made: Picture, joint: dict[str, Any]) -> None:
    """A massless rod: a line between its two pins."""
    bodies = joint["bodies"]
    ends = [made.at(body, point) for body, point in zip(bodies, joint["points"], strict=True)]
    made.axes.plot(*np.array(ends).T, color=style.GROUND, linewidth=1.6, zorder=5)
    made.lines.append(wide(made.points(ends[0]), made.points(ends[1]), 1.0))
    for body, end in zip(bodies, ends, strict=True):
        _draw_pin(made, end, to_ground=body == 0)


def _draw_spiral(made: Picture, place: Floats) -> None:
    symbols.draw(made.axes, symbols.SPIRAL, place, zorder=4)
    made.keep_clear(place, symbols.SPIRAL_RADIUS)


def _draw_spring_damper(made: Picture, begin: Floats, end: Floats) -> None:
    """A zigzag beside a dashpot, as wide as a pin with its rim whatever the length."""
    width = symbols.SPRING_WIDTH
    apart = float(np.hypot(*(made.points(end) - made.points(begin))))
    length = float(np.hypot(*(end - begin)))
    half = width / 2.0 * length / apart if apart > 0.0 else 0.0
    lines = symbols.spring_damper(begin, end, half)
    made.axes.plot(*lines.T, color=style.GROUND, linewidth=0.9, zorder=4)
    made.lines.append(wide(made.points(begin), made.points(end), width / 2.0))
