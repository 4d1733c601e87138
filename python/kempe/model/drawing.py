"""Scenes and display lists, the same for figures, films and pages."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.model.compiled import CompiledModel

#: The parts of a scene that do not depend on time.
STATIC = ("title", "gravity", "bounds", "length", "bodies", "joints", "symbols")

#: Lower left corner, m, points of print for each metre, and width and height in points.
View = tuple[tuple[float, float], float, tuple[float, float]]


def static_scene(
    model: CompiledModel, poses: Floats, efforts: Mapping[str, tuple[Floats, Floats]]
) -> dict[str, Any]:
    """The parts of a scene that do not depend on time; see ``docs/scene.md``.

    Args:
        model: the mechanism.
        poses: x, y and angle of the moving bodies, (n_t, n_bodies, 3), m and rad.
        efforts: what gives the arrows of elements their directions, see ``draw.arrows.efforts``.
    """
    rows = [
        (name, np.ascontiguousarray(force), np.ascontiguousarray(torque))
        for name, (force, torque) in efforts.items()
    ]
    found: dict[str, Any] = json.loads(_core.scene(model.core, np.ascontiguousarray(poses), rows))
    return found


def display_list(
    scene: Mapping[str, Any], poses: Floats, view: View, asked: Mapping[str, Any]
) -> list[dict[str, Any]]:
    """The display list of a scene, in the order of painting.

    Args:
        scene: with the parts that do not depend on time.
        poses: x, y and angle of the moving bodies, (n_t, n_bodies, 3), m and rad.
        view: the scale and the edges for which names are laid out.
        asked: the requested contents of the list, such as ``{"mechanism": True}``.
    """
    static = json.dumps({key: scene[key] for key in STATIC})
    text = _core.display(static, np.ascontiguousarray(poses), view, json.dumps(asked))
    found: list[dict[str, Any]] = json.loads(text)
    return found


def view_around(bounds: Sequence[float], size: tuple[float, float]) -> View:
    """The view of bounds, m, with a margin, on an area of a size in points of print."""
    left, bottom, right, top = map(float, bounds)
    return _core.view_around((left, bottom, right, top), size)


def place_texts(
    anchors: Floats, sizes: Floats, lines: Floats, boxes: Floats, area: tuple[float, float]
) -> Floats:
    """Offsets from anchors to the centres of texts that cover neither lines nor each other.

    All lengths are in points of print, in an area from (0, 0) to its width and height.

    Args:
        anchors: (n, 2).
        sizes: widths and heights, (n, 2).
        lines: x and y of both ends, (m, 4).
        boxes: least x and y, largest x and y, (k, 4).
        area: width and height.

    Returns:
        The offsets, (n, 2).
    """
    whole = partial(np.ascontiguousarray, dtype=np.float64)
    return _core.place_texts(whole(anchors), whole(sizes), whole(lines), whole(boxes), area)


def measured(words: str, size: float, *, bold: bool = False) -> tuple[float, float]:
    """Width and height of a line of text, in the unit of its size."""
    return _core.text_width(words, size, bold), 1.25 * size
