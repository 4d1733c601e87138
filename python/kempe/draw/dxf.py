"""Drawings as DXF files: plates of links, positions and paths, each on a layer of its own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from kempe import foreign
from kempe.base import files
from kempe.base.arguments import explained
from kempe.base.names import one_of
from kempe.draw.scene import scene
from kempe.errors import ModelError
from kempe.model.values import instance
from kempe.results.solution import Solution
from kempe.results.state import State

#: Metres per unit of a drawing.
UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
Point = tuple[float, float]


@dataclass
class _Sheet:
    """Lines (layer, closed, corners, bulges), circles and texts, in metres."""

    lines: list[tuple[str, bool, list[Point], list[float]]] = field(default_factory=list)
    circles: list[tuple[str, Point, float]] = field(default_factory=list)
    texts: list[tuple[str, Point, float, str]] = field(default_factory=list)


@explained
def write_dxf(
    drawn: State | Solution,
    path: Path | str,
    *,
    times: Sequence[float] = (),
    paths: Sequence[str] = (),
    width: float | None = None,
    hole: float | None = None,
    unit: str = "mm",
) -> Path:
    """Write the links of a mechanism as a DXF drawing.

    Each body has a layer of its name: its outline as a closed polyline, and its points as circles
    with their names. Without an outline, the plate is a rounded link around the points. Ground is
    on the layer ``ground``. ``kp.load`` reads such a file as bodies with points and outlines.

    Args:
        drawn: a state, or a motion, which is drawn at its start.
        path: the file; its name should end in ``.dxf``.
        times: further instants of a motion, s; their plates are on layers such as
            ``crank t 0.5 s``.
        paths: points of a motion, such as ``"coupler.P"``; their paths are on layers such as
            ``path coupler.P``.
        width: width of rounded links, m; a tenth of the mechanism if None.
        hole: diameter of the circles, m; a third of the width if None.
        unit: unit of the drawing: "mm", "cm", "m", "in" or "ft".

    Returns:
        The path.

    Raises:
        ModelError: an unknown unit or point, an instant outside the motion, or instants of a state.
        FileError: the file cannot be written.
    """
    one_of("unit", unit, UNITS)
    instance(drawn, (State, Solution), "a state or a solution")
    if isinstance(drawn, State) and (times or paths):
        raise ModelError("a state has no times and paths", hint="give the solution")
    first = drawn if isinstance(drawn, State) else _at(drawn, float(drawn.t[0]))
    shown = scene(first)
    bounds = shown["bounds"]
    size = max(bounds[2] - bounds[0], bounds[3] - bounds[1]) or 1.0
    radius = (size / 10 if width is None else float(width)) / 2
    bore = radius / 3 if hole is None else float(hole) / 2
    sheet = _Sheet()
    _plates(sheet, first, shown["bodies"], "", (radius, bore))
    for t, label in _labels(times).items():
        assert isinstance(drawn, Solution)
        _plates(sheet, _at(drawn, t), shown["bodies"], f" t {label} s", (radius, bore))
    for name in paths:
        x, y = (np.asarray(drawn[f"{name}.{axis}"]) for axis in "xy")
        points = list(zip(x.tolist(), y.tolist(), strict=True))
        sheet.lines.append((f"path {name}", False, points, []))
    files.write_text(path, foreign.dxf_text(UNITS[unit], sheet.lines, sheet.circles, sheet.texts))
    return Path(path)


def _labels(times: Sequence[float]) -> dict[float, str]:
    """Each instant with its digits, which are as few as tell it from the others."""
    each = dict.fromkeys(float(t) for t in times)
    few = [f"{t:g}" for t in each]
    return {t: of if few.count(of) == 1 else repr(t) for t, of in zip(each, few, strict=True)}


def _at(solution: Solution, t: float) -> State:
    """The state of a motion at an instant."""
    state = solution(t)
    assert isinstance(state, State)
    return state


def _plates(
    sheet: _Sheet,
    state: State,
    bodies: Iterable[dict[str, Any]],
    suffix: str,
    sizes: tuple[float, float],
) -> None:
    """The plates of all bodies at an instant; ground only once."""
    radius, bore = sizes
    for body in bodies:
        name = body["name"]
        if name == "ground" and suffix:
            continue
        layer = name + suffix
        for corners, bulges in _outlines(body, radius):
            placed = [_placed(state, name, corner) for corner in corners]
            sheet.lines.append((layer, True, placed, bulges))
        for point in body["points"]:
            # more digits than those of the scene
            at = state[f"{name}.{point['name']}.x"], state[f"{name}.{point['name']}.y"]
            sheet.circles.append((layer, at, bore))
            sheet.texts.append((layer, at, bore, point["name"]))


def _placed(state: State, body: str, at: Sequence[float]) -> Point:
    """A point of a body in the global frame."""
    if body == "ground":
        return float(at[0]), float(at[1])
    x, y = float(state[f"{body}.x"]), float(state[f"{body}.y"])
    angle = _angle(state, body)
    c, s = np.cos(angle), np.sin(angle)
    return float(x + c * at[0] - s * at[1]), float(y + s * at[0] + c * at[1])


def _angle(state: State, body: str) -> float:
    try:
        return float(state[f"{body}.angle"])
    except ModelError:  # a point mass
        return 0.0


def _outlines(body: dict[str, Any], radius: float) -> list[tuple[list[Point], list[float]]]:
    """Closed lines of a body in its frame, each with its bulges."""
    areas = [drawn["points"] for drawn in body["drawn"] if drawn["form"] == "area"]
    if areas:
        return [([(p[0], p[1]) for p in points], []) for points in areas]
    if body["name"] == "ground" or not body["outline"]:
        return []
    return [rounded([(p[0], p[1]) for p in body["outline"]], radius)]


def rounded(corners: Sequence[Point], radius: float) -> tuple[list[Point], list[float]]:
    """The line at a distance around a spot, a segment or a convex polygon.

    Args:
        corners: the corners, counter-clockwise.
        radius: the distance.

    Returns:
        Its corners, and the bulge of the piece after each: the tangent of a quarter of its angle.
    """
    if len(corners) == 1:
        (x, y), at = corners[0], radius
        return [(x + at, y), (x - at, y)], [1.0, 1.0]
    out: list[Point] = []
    bulges: list[float] = []
    normals = []
    for k, (x, y) in enumerate(corners):
        dx, dy = (b - a for a, b in zip((x, y), corners[(k + 1) % len(corners)], strict=True))
        length = float(np.hypot(dx, dy))
        normals.append((dy / length, -dx / length))
    for k, (x, y) in enumerate(corners):
        (ax, ay), (bx, by) = normals[k - 1], normals[k]
        turn = float(np.arctan2(ax * by - ay * bx, ax * bx + ay * by)) % (2 * np.pi)
        out += [(x + radius * ax, y + radius * ay), (x + radius * bx, y + radius * by)]
        bulges += [float(np.tan(turn / 4)), 0.0]
    return out, bulges
