"""The display list of a scene, which figures, frames and the page paint.

Symbols are chosen by the physics that the elements declare, names are laid out once for the whole
motion, and names of what coincides are written once.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import Any

import numpy as np

from kempe.arrays import Floats
from kempe.draw import along, bodies, items, symbols
from kempe.draw.geometry import placed
from kempe.draw.items import Frame, Item, fill, line, print_points, text, upright
from kempe.draw.labels import Taken, measured, place_labels
from kempe.draw.palette import one_line
from kempe.draw.pins import Symbol, dot, support
from kempe.draw.places import Places
from kempe.draw.placing import View, place
from kempe.draw.scene import Scene

#: Instants at which names are kept clear of everything.
_SAMPLES = 12
#: Places no farther apart than this share of the drawing at any instant are one place.
_SAME = 1e-3
#: Where a name is anchored along the x axis of a frame.
_HALF_WAY = {"body": 0.0, "line": 0.5}
#: Between the names of objects at one place.
BETWEEN_NAMES = " · "
#: More names than these do not fit on a drawing.
MOST_NAMES, MOST_NUMBERS = 60, 40
_NUMBER, _RINGED = 7.0, 20.0  # radius of the circle around a number, and of symbols around a pin
_MOST_OBSTACLES = 60  # corners of one item

#: Role, names and frame of objects at one place.
_Named = tuple[str, list[str], Frame]
#: A name without a place yet: its object, words, role, and the frame of its anchor.
_Name = tuple[str, str, str, Frame]


class Display:
    """A display list in the making.

    Args:
        scene: the scene.
        view: the scale and the edges for which names are laid out.
        taken: boxes that names must not cover, (n, 4), points of print.
    """

    def __init__(self, scene: Scene, view: View, taken: Floats | None = None) -> None:
        self.scene, self.view = scene, view
        self._taken = np.empty((0, 4)) if taken is None else taken
        frames = scene["frames"]["poses"]
        chosen = np.unique(np.linspace(0, len(frames) - 1, _SAMPLES).round().astype(int))
        poses = [[[0.0] * 3, *frames[k]] for k in chosen]
        #: Of all bodies, ground first, at some instants, (n_t, n_bodies, 3).
        self.poses = np.nan_to_num(np.array(poses, dtype=np.float64).reshape(len(chosen), -1, 3))
        low, high = np.array(scene["bounds"]).reshape(2, 2)
        self._near = _SAME * (float((high - low).max()) or 1.0)
        self._items: list[Item] = []
        self._names: list[_Name] = []

    def add(self, found: Iterator[Item] | list[Item]) -> None:
        """Add items."""
        self._items += found

    def finish(self) -> list[Item]:
        """The display list in the order of painting, with the names in their places."""
        self.add(list(self._laid_out()))
        self._names = []
        return sorted(self._items, key=lambda item: int(item["layer"]))

    # --- the mechanism ----------------------------------------------------------------------------

    def draw_mechanism(self) -> None:
        """Bodies, the symbols of all elements, supports, and points without a symbol."""
        for body in self.scene["bodies"]:
            self.add(bodies.rims(body))
        self.add(bodies.body(self.scene["bodies"][0]))
        self._draw_links()
        places, pinned = Places(self._near), Places(self._near)
        rings = symbols.Rings(lambda symbol: places.index(self._ends(symbol)[-1]))
        for own in self._by_element():
            aside = along.parallel(own)
            for symbol in own:
                if symbol["mark"] == "slot":  # drawn with its body
                    continue
                if symbol["mark"] != "pin" or pinned.is_new(self._ends(symbol)[-1]):
                    self.add(symbols.draw(symbol, rings, aside.get(symbol["mark"], 0.0)))
        self._draw_supports()
        self._draw_points()

    def _draw_links(self) -> None:
        """The bodies: those with a slot first, so that the links that move in it are seen."""
        slots = [symbol for symbol in self.scene["symbols"] if symbol["mark"] == "slot"]
        slotted = {symbol["bodies"][0] for symbol in slots}
        drawn = [
            body
            for body in self.scene["bodies"]
            if body["number"]
            and (body["drawn"] or not (body["curves"] and len(body["outline"]) == 1))
        ]
        for body in drawn:
            if body["number"] in slotted:
                self.add(bodies.body(body))
        for symbol in slots:
            self.add(symbols.draw(symbol, symbols.Rings()))
        for body in drawn:
            if body["number"] not in slotted:
                self.add(bodies.body(body))

    def _by_element(self) -> list[list[Symbol]]:
        """The symbols of each element together, those with the largest wheels first."""
        groups = groupby(self.scene["symbols"], key=lambda symbol: symbol["element"])
        found = [list(group) for _, group in groups]

        def largest(own: list[Symbol]) -> float:
            wheels = (symbol for symbol in own if symbol["mark"] in symbols.WHEELS)
            return max((float(symbol["radii"][1]) for symbol in wheels), default=0.0)

        return sorted(found, key=largest, reverse=True)

    def _draw_supports(self) -> None:
        """One support for each place on ground on which something turns."""
        supported = Places(self._near)
        for symbol in self.scene["symbols"]:
            if symbol["mark"] in symbols.PINNED:
                for body, at in zip(symbol["bodies"], symbol["points"], strict=True):
                    if body == 0 and supported.is_new(self._path(body, at)):
                        self.add(support(symbol["element"], at))

    def _draw_points(self) -> None:
        """A dot at each named point that no symbol marks."""
        marked = Places(self._near)
        for symbol in self.scene["symbols"]:
            ends = self._ends(symbol)
            for path in ends[symbols.unmarked(symbol) :]:
                marked.is_new(path)
        for body in self.scene["bodies"]:
            for point in body["points"]:
                if marked.is_new(self._path(body["number"], point["at"])):
                    self.add(dot(body["name"], body["number"], point["at"]))

    def _path(self, body: int, at: items.At) -> Floats:
        """Where a point of a body is at the instants, (n_t, 2), m."""
        return placed(self.poses[:, body], at)

    def _ends(self, symbol: Symbol) -> list[Floats]:
        """Where the points of a symbol are at the instants."""
        ends = zip(symbol["bodies"], symbol["points"], strict=True)
        return [self._path(body, at) for body, at in ends if at is not None]

    # --- names ------------------------------------------------------------------------------------

    @property
    def contacts(self) -> list[dict[str, Any]]:
        """The symbols of forces at a point of body i that touches a curve."""
        joints = {joint["name"] for joint in self.scene["joints"]}
        marks = ("touch", "round")
        found = (symbol for symbol in self.scene["symbols"] if symbol["mark"] in marks)
        return [symbol for symbol in found if symbol["element"] not in joints]

    def name_joints(self) -> None:
        """Write the names of joints and contacts, one text for each place, and of free points."""
        joints = self.scene["joints"]
        if len(joints) > MOST_NAMES:
            return
        rods = {s["element"]: s for s in self.scene["symbols"] if s["mark"] in symbols.ALONG}
        places, found = Places(self._near), list[_Named]()
        for joint in joints:
            rod = rods.get(joint["name"])
            if rod is not None:
                self.name("joint", joint["name"], items.between(rod["bodies"], rod["points"]))
                continue
            number, at = joint["bodies"][1], joint["points"][1]
            k = places.index(self._path(number, at))
            if k == len(found):
                found.append(("joint", [], upright(number, at)))
            found[k][1].append(one_line(joint["name"]))
        for symbol in self.contacts:
            number, at = symbol["bodies"][0], symbol["points"][0]
            k = places.index(self._path(number, at))
            if k == len(found):
                found.append(("element", [], upright(number, at)))
            found[k][1].append(one_line(symbol["element"]))
        count = sum(len(body["points"]) for body in self.scene["bodies"])
        for body in self.scene["bodies"] if count <= MOST_NAMES else []:
            for point in body["points"]:
                k = places.index(self._path(body["number"], point["at"]))
                if k == len(found):
                    found.append(("point", [], upright(body["number"], point["at"])))
                if found[k][0] == "point":  # where there is a joint or a contact, points go unnamed
                    found[k][1].append(one_line(point["name"]))
        for role, names, frame in found:
            self.name(role, BETWEEN_NAMES.join(dict.fromkeys(names)), frame)

    def name_elements(self) -> None:
        """Write the names of forces and drivers beside their symbols."""
        seen = {joint["name"] for joint in self.scene["joints"]}
        seen |= {symbol["element"] for symbol in self.contacts}
        for symbol in self.scene["symbols"]:
            if symbol["element"] in seen or len(seen) > MOST_NAMES:
                continue
            seen.add(symbol["element"])
            i, j = symbol["bodies"]
            role = "driver" if symbol["mark"].startswith("drive") else "element"
            if symbol["mark"] in symbols.ALONG:
                frame = items.between((i, j), symbol["points"])
                self.name(role, symbol["element"], frame)
            else:
                k = 0 if symbol["mark"] == "shift_stop" else 1
                frame = upright(symbol["bodies"][k], symbol["points"][k])
                self.name(role, symbol["element"], frame)

    def number_bodies(self, index_base: int = 1, *, names: bool = False) -> None:
        """Write a number in a circle on each body, and its name beside it.

        Args:
            index_base: number of the first body.
            names: whether to write names.
        """
        bodies = self.scene["bodies"][1:]
        if len(bodies) > MOST_NUMBERS:
            return
        pins = [
            (self.view.points(path), _RINGED if symbol["mark"] in symbols.AROUND else _NUMBER)
            for symbol in self.scene["symbols"]
            for path in self._ends(symbol)
        ]
        for body in bodies:
            number = str(body["number"] - 1 + index_base)
            at = self._free_place(body, pins)
            words = one_line(body["name"]) if names else ""
            if at is None:
                at = body["center"]
                role, words = ("body", f"{number} {words}") if names else ("number", number)
                self._names.append((body["name"], words, role, upright(body["number"], at)))
                continue
            self.add(_numbered(body, at, number))
            pins.append((self.view.points(self._path(body["number"], at)), _NUMBER))
            if words:
                self.name("body", body["name"], upright(body["number"], at))

    def _free_place(
        self, body: dict[str, Any], pins: list[tuple[Floats, float]]
    ) -> items.At | None:
        """Where a number covers no pin and no other number; None if there is no room.

        Args:
            body: the body.
            pins: places with the radius around them that is taken.
        """
        for at in bodies.middles(body):
            path = self.view.points(self._path(body["number"], list(at)))
            gaps = (float(np.hypot(*(path - pin).T).min()) - wide for pin, wide in pins)
            if min(gaps, default=np.inf) > _NUMBER:
                return [float(x) for x in at]
        return None

    def name(self, role: str, words: str, frame: Frame) -> None:
        """Write a name near the origin of a frame or half-way along it, where there is room."""
        self._names.append((words, one_line(words), role, frame))

    def _laid_out(self) -> Iterator[Item]:
        if not self._names:
            return
        found = [
            text(of, frame, [_HALF_WAY[frame["type"]], 0.0, 0.0, 0.0], words, role)
            for of, words, role, frame in self._names
        ]
        anchors = np.array(
            [[place(one, poses, self.view)[0] for one in found] for poses in self.poses]
        )
        sizes = np.array([size_of(one) for one in found])
        offsets = place_labels(anchors, sizes, self.taken())
        for one, offset in zip(found, offsets, strict=True):
            one["offset"] = [float(x) for x in offset]
            if one["role"] == "number":
                self.add(_circled(one["of"], one["frame"], one["offset"]))
            yield one

    def taken(self) -> Taken:
        """Areas that names must not cover: lines, texts and the outside of the view."""
        count = len(self.poses)
        segments, reach, boxes = (
            [np.empty((count, 0, 2, 2))],
            [],
            [np.tile(self._taken, (count, 1, 1))],
        )
        for item in self._items:
            if item["kind"] == "text":
                half = np.array(size_of(item)) / 2.0
                centre = self._placed(item)
                boxes.append(np.concatenate([centre - half, centre + half], axis=2))
            elif item["layer"] < items.NUMBER:
                points = self._placed({**item, "points": _thinned(item)})
                segments.append(np.stack([points[:, :-1], points[:, 1:]], axis=2))
                half_width = item.get("width", 0.0) / 2.0 + (4.0 if item.get("hatch") else 0.0)
                reach += [half_width] * (points.shape[1] - 1)
        edges = np.array([[0.0, 0.0], self.view.size])
        lines = np.concatenate(segments, axis=1)
        return Taken(lines, np.array(reach), np.concatenate(boxes, axis=1), edges)

    def _placed(self, item: Item) -> Floats:
        """The points of an item at the instants, (n_t, n, 2), points of print."""
        return np.array([place(item, poses, self.view) for poses in self.poses])


def display(
    scene: Scene, view: View, *, labels: bool = True, taken: Floats | None = None
) -> list[Item]:
    """The display list of frames and of the page.

    Args:
        scene: the scene.
        view: the visible area.
        labels: whether to write numbers and names.
        taken: boxes that names must not cover, (n, 4), points of print.
    """
    made = Display(scene, view, taken)
    made.draw_mechanism()
    if labels:
        made.number_bodies()
        made.name_joints()
        made.name_elements()
    return made.finish()


def size_of(item: Item) -> tuple[float, float]:
    """Width and height of a text, points."""
    if item["role"] == "number":
        return 2.0 * _NUMBER, 2.0 * _NUMBER
    return measured(item["text"], item["size"], item["weight"] == "bold", item["slanted"])


def _thinned(item: Item) -> items.Rows:
    rows: items.Rows = item["points"]
    if item.get("closed"):
        rows = [*rows, rows[0]]
    return rows[:: len(rows) // _MOST_OBSTACLES + 1] if len(rows) > _MOST_OBSTACLES else rows


def _numbered(body: dict[str, Any], at: items.At, number: str) -> list[Item]:
    frame, of = upright(body["number"], at), body["name"]
    return [*_circled(of, frame, (0.0, 0.0)), text(of, frame, [0.0] * 4, number, "number")]


def _circled(of: str, frame: Frame, offset: items.At) -> list[Item]:
    """The circle around the number of a body."""
    rim = print_points(items.circle(_NUMBER) + np.asarray(offset))
    colour = f"body {frame['body']}"
    found = [
        fill(of, frame, rim, "paper", layer=items.NUMBER),
        line(of, frame, rim, colour, 1.0, layer=items.NUMBER, closed=True),
    ]
    return [{**item, "numbered": True} for item in found]
