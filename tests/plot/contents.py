"""The contents of a figure as data: its texts, curves, limits and looks."""

from typing import Any

import numpy as np
from kempe.draw.painter import Painting
from kempe.draw.placing import place
from matplotlib.axes import Axes
from matplotlib.collections import Collection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Text

#: Numbers agree within this share of the largest number beside them.
NEAR = 2e-3


def contents(figure: Figure) -> dict[str, Any]:
    """What a reader of the figure sees."""
    figure.canvas.draw()
    return {
        "size": numbers(figure.get_size_inches()),
        "texts": [text.get_text() for text in figure.texts],
        "heading": figure.get_suptitle(),
        "axes": [_axes(axes) for axes in figure.axes],
    }


def numbers(values: Any, size: float = 0.0) -> list[float]:
    """Numbers with five digits; rounding errors of the largest, or of a ``size``, are zero."""
    found = np.asarray(values, dtype=np.float64).ravel()
    finite = np.abs(found[np.isfinite(found)])
    least = 1e-9 * float(finite.max(initial=size))
    return [float(f"{x:.5g}") if not abs(x) <= least else 0.0 for x in found]


def _axes(axes: Axes) -> dict[str, Any]:
    shown = [artist for artist in axes.get_children() if artist.get_visible()]
    legend = axes.get_legend()
    return {
        "title": [axes.get_title(loc) for loc in ("left", "center", "right")],
        "labels": [axes.get_xlabel(), axes.get_ylabel()],
        "scales": [axes.get_xscale(), axes.get_yscale()],
        "limits": numbers(axes.get_xlim()) + numbers(axes.get_ylim()),
        "place": numbers(axes.get_position().bounds),
        "ticks": [_ticks(axes.xaxis), _ticks(axes.yaxis)],
        "legend": [text.get_text() for text in legend.get_texts()] if legend else [],
        "texts": [_text(artist) for artist in shown if isinstance(artist, Text)],
        "lines": [_line(artist) for artist in shown if isinstance(artist, Line2D)],
        "areas": [_area(artist) for artist in shown if isinstance(artist, Collection)],
        "patches": [_patch(artist) for artist in axes.patches],
        "paintings": [_painting(artist) for artist in shown if isinstance(artist, Painting)],
    }


def _ticks(axis: Any) -> list[str]:
    return [t.label1.get_text() for t in axis.get_major_ticks() if t.label1.get_visible()]


def _text(text: Text) -> list[Any]:
    return [text.get_text(), text.get_rotation(), text.get_ha(), numbers(text.get_position())]


def _line(line: Line2D) -> list[Any]:
    axes = line.axes
    sizes = [np.ptp(ends) for ends in (axes.get_xlim(), axes.get_ylim())] if axes else [0.0, 0.0]
    data = [
        numbers([d[0], d[-1], np.nanmin(d), np.nanmax(d)], float(size))
        for d, size in zip(map(_plain, line.get_data()), sizes, strict=True)
    ]
    look = [line.get_label(), to_hex(line.get_color()), str(line.get_linestyle())]
    look += [str(line.get_marker()), line.get_linewidth(), line.get_markersize(), line.get_zorder()]
    look += [to_hex(line.get_markerfacecolor()), numbers(line._dash_pattern[1] or ())]  # type: ignore[attr-defined]
    return [*look, data]


def _plain(values: Any) -> np.ndarray:
    found = np.asarray(values, dtype=np.float64)
    return found if np.isfinite(found).any() else np.zeros(1)


def _area(area: Collection) -> list[Any]:
    colours = [to_hex(c) for c in area.get_facecolor()[:2]]
    centre = np.ma.getdata(area.get_offsets())[:1]
    return [type(area).__name__, area.get_zorder(), colours, numbers(centre)]


def _patch(patch: Patch) -> list[Any]:
    box = patch.get_window_extent().bounds
    return [to_hex(patch.get_facecolor()), patch.get_zorder(), numbers(box)]


def _painting(painting: Painting) -> list[Any]:
    """The number of parts of each kind, the boxes around them in points, and the words."""
    kinds: dict[str, list[np.ndarray]] = {}
    for item in painting.items:
        placed = place(
            {**item, "points": np.reshape(item.get("points", []), (-1, 4))},
            painting.poses,
            painting.view(),
        )
        kinds.setdefault(f"{item['kind']} {item['layer']}", []).append(placed)
    counts = {key: len(parts) for key, parts in kinds.items()}
    corners = {key: np.concatenate(parts) for key, parts in kinds.items()}
    boxes = {key: numbers([*at.min(axis=0), *at.max(axis=0)]) for key, at in corners.items()}
    words = [str(item["text"]) for item in painting.items if "text" in item]
    return [counts, words, boxes]


def differences(found: Any, kept: Any, where: str = "") -> list[str]:
    """The places where contents differ from those that were kept."""
    if isinstance(kept, dict) and isinstance(found, dict):
        keys = [*kept, *(key for key in found if key not in kept)]
        pairs = [(found.get(key), kept.get(key), f"{where}.{key}") for key in keys]
        return [told for pair in pairs for told in differences(*pair)]
    if isinstance(kept, list) and isinstance(found, list) and len(kept) == len(found):
        if kept and all(isinstance(x, int | float) for x in [*kept, *found]):
            a, b = np.array(found, float), np.array(kept, float)
            scale = float(np.abs(b[np.isfinite(b)]).max(initial=0.0)) or 1.0
            same = np.allclose(a, b, rtol=0.0, atol=NEAR * scale, equal_nan=True)
            return [] if same else [f"{where}: {found}, not {kept}"]
        parts = zip(found, kept, range(len(kept)), strict=True)
        return [told for a, b, k in parts for told in differences(a, b, f"{where}[{k}]")]
    return [] if found == kept else [f"{where}: {found!r}, not {kept!r}"]
