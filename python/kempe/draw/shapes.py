"""How bodies, joints and forces are drawn: outlines in the frame of the body, and places."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from kempe.arrays import Floats
from kempe.compiled import BodyInfo, CompiledModel, ConstraintInfo, Vector
from kempe.draw.numbers import plain
from kempe.motion import Motion

#: Joints whose bodies slide on each other.
SLIDES = ("translational",)
#: Points of a body that are closer to a line than this share of its length lie on it.
_STRAIGHT = 1e-9


def body(model: CompiledModel, name: str) -> dict[str, Any]:
    """A body: name, number, kind, named points, mass centre and outline."""
    info = model.all_bodies[name]
    return {
        "name": name,
        "number": info.number,
        "kind": info.type or "ground",
        "points": [{"name": point, "at": _numbers(at)} for point, at in info.points.items()],
        "center": _numbers(info.center),
        "outline": plain(outline(model, info)) if info.number else [],
    }


def joint(motion: Motion, name: str) -> dict[str, Any]:
    """A joint: name, type, the numbers of its bodies, its point and x axis on each, its slide."""
    model = motion.model
    info = model.joints[name]
    return {
        "name": name,
        "type": info.type,
        "bodies": [model.all_bodies[info.i].number, model.all_bodies[info.j].number],
        "points": [_numbers(info.point_i), _numbers(info.point_j)],
        "axes": plain(np.array([info.axis_i, info.axis_j])),
        "slide": plain(_slide(motion, info)) if info.type in SLIDES else None,
    }


def _slide(motion: Motion, info: ConstraintInfo) -> Floats:
    """Least and largest place of the point of j along the axis, from the point of i, (2,), m."""
    i, j = motion.body(info.i), motion.body(info.j)
    away = j.at(info.point_j).position - i.at(info.point_i).position
    direction = i.angle + info.axis_i
    along = away[:, 0] * np.cos(direction) + away[:, 1] * np.sin(direction)
    return np.array([along.min(), along.max()])


def force(model: CompiledModel, name: str) -> dict[str, Any]:
    """A force element: name, type, bodies, and where it is drawn on body j.

    An element between two bodies that a joint connects is drawn at that joint, others at the mass
    centre of body j.
    """
    info = model.forces[name]
    i, j = info.i, info.j
    shared = next((c for c in model.joints.values() if {c.i, c.j} == {i, j}), None)
    on_j = model.all_bodies[j].center if shared is None else _point_on(shared, j)
    return {
        "name": name,
        "type": info.type,
        "bodies": [model.all_bodies[i].number, model.all_bodies[j].number],
        "point": _numbers(on_j),
    }


def _point_on(info: ConstraintInfo, name: str) -> Vector:
    return info.point_j if info.j == name else info.point_i


def _numbers(at: Vector) -> list[float]:
    found: list[float] = plain(np.array(at))
    return found


def outline(model: CompiledModel, info: BodyInfo) -> Floats:
    """Corners in the body's frame: 1 (a spot), 2 (a line between its ends) or a convex polygon.

    A slender bar reaches from end to end, its length being √(12 J/m). All bodies contain their
    named points and those of their joints, a general body its mass centre too.
    """
    corners = [*info.points.values()]
    corners += [_point_on(c, info.name) for c in model.joints.values() if info.name in (c.i, c.j)]
    if info.type == "bar" and info.mass > 0.0:
        half = math.sqrt(12.0 * info.inertia / info.mass) / 2.0
        corners += [(-half, 0.0), (half, 0.0)]
    else:
        corners.append(info.center)
    return hull(np.array(corners))


def hull(points: Floats) -> Floats:
    """Convex hull of points (n, 2), counter-clockwise; the two ends where all lie on a line.

    Andrew's monotone chain (Inf. Proc. Lett. 9, 1979).
    """
    size = float(np.ptp(points, axis=0).max(initial=0.0))
    ordered = np.unique(points, axis=0)
    if size == 0.0:
        return ordered[:1]
    least = _STRAIGHT * size * size
    lower, upper = _chain(ordered, least), _chain(ordered[::-1], least)
    return np.array([*lower[:-1], *upper[:-1]])


def _chain(points: Floats, least: float) -> list[Floats]:
    kept: list[Floats] = []
    for point in points:
        while len(kept) > 1 and _turn(kept[-2], kept[-1], point) <= least:
            kept.pop()
        kept.append(point)
    return kept


def _turn(a: Floats, b: Floats, c: Floats) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def bounds(motion: Motion, bodies: list[dict[str, Any]], joints: list[dict[str, Any]]) -> Floats:
    """What the drawing covers over all frames: least x and y, largest x and y, m."""
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for entry in bodies:
        corners = [*entry["outline"], *(point["at"] for point in entry["points"])]
        if entry["number"]:
            corners.append([0.0, 0.0])
        corners += [
            at
            for one in joints
            for number, at in zip(one["bodies"], one["points"], strict=True)
            if number == entry["number"] == 0
        ]
        view = motion.body(entry["name"])
        for corner in corners:
            places = view.at((corner[0], corner[1])).position
            low = np.minimum(low, places.min(axis=0))
            high = np.maximum(high, places.max(axis=0))
    if not np.all(np.isfinite([*low, *high])):
        return np.array([-1.0, -1.0, 1.0, 1.0])
    return np.array([*low, *high])
