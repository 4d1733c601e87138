"""Texts beside points of axes that cover neither lines nor each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.model.drawing import measured, place_texts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SIZE = 8.0


def add_labels(
    axes: Axes,
    anchors: Sequence[Floats],
    words: Sequence[str],
    paths: Sequence[Floats] = (),
    **look: Any,
) -> None:
    """Write texts near points.

    Args:
        axes: where to, with limits that are set.
        anchors: a point for each text, (2,), in data.
        words: the texts.
        paths: lines that the texts must not cover, each (n, 2), in data.
        look: properties of the texts, such as ``color``.
    """
    if not words:
        return
    dots = 72.0 / float(axes.figure.dpi)
    box = axes.get_window_extent()
    origin = np.array([box.x0, box.y0])

    def printed(points: Floats) -> Floats:
        found: Floats = (axes.transData.transform(np.reshape(points, (-1, 2))) - origin) * dots
        return found

    segments = [np.empty((0, 4))]
    for path in paths:
        at = printed(_thinned(path))
        segments.append(np.column_stack([at[:-1], at[1:]]))
    plain = [word.replace("$", "").replace("_", "").replace("^", "") for word in words]
    sizes = np.array([measured(word, _SIZE) for word in plain])
    width, height = (float(x) * dots for x in box.size)
    marks = printed(np.array(anchors))
    boxes = np.column_stack([marks - 2.5, marks + 2.5])
    lines = np.concatenate(segments)
    offsets = place_texts(marks, sizes, lines, boxes, (width, height))
    for anchor, offset, text in zip(anchors, offsets, words, strict=True):
        axes.annotate(
            text,
            (float(anchor[0]), float(anchor[1])),
            xytext=(float(offset[0]), float(offset[1])),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=_SIZE,
            zorder=6,
            **look,
        )


def _thinned(path: Floats, most: int = 400) -> Floats:
    return path[:: max(1, len(path) // most)]
