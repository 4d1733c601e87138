"""Shapes: outlines of bodies, and joints and symbols with their places on two bodies."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from kempe.arrays import Floats
from kempe.compiled import BodyInfo, CompiledModel, ConstraintInfo, Vector
from kempe.draw.numbers import plain
from kempe.draw.symbols import WHEELS
from kempe.draw.teeth import add_teeth
from kempe.draw.wheels import outer_radius
from kempe.motion import Motion

#: Points of a body that are closer to a line than this share of its length lie on it.
_STRAIGHT = 1e-9
#: Symbols along a line of body i, as long as what moves on it goes.
_GUIDES = ("slide", "slot", "toothed_line", "track")


def body(model: CompiledModel, name: str) -> dict[str, Any]:
    """A body: name, number, kind, named points, mass centre, outline, drawn parts and curves."""
    info = model.all_bodies[name]
    return {
        "name": name,
        "number": info.number,
        "kind": info.type or "ground",
        "points": [{"name": point, "at": _numbers(at)} for point, at in info.points.items()],
        "center": _numbers(info.center),
        "outline": plain(outline(model, info)) if info.number else [],
        "drawn": [{"form": form, "points": plain(np.array(points))} for form, points in info.drawn],
        "curves": [
            {"points": plain(np.array(points)), "closed": closed}
            for points, closed in info.curves.values()
        ],
    }


def joint(model: CompiledModel, name: str) -> dict[str, Any]:
    """A joint: name, the numbers of its bodies, and its point on each.

    A joint on a curve has no point of body j; both are that of body i.
    """
    info = model.joints[name]
    ends = [(info.i, info.point_i), (info.j, info.point_j)]
    if _moves_on(info):
        ends[1] = ends[0]
    return {
        "name": name,
        "bodies": [model.all_bodies[owner].number for owner, _ in ends],
        "points": [_numbers(point) for _, point in ends],
    }


def _moves_on(info: ConstraintInfo) -> bool:
    """Whether the place of a joint on body j moves, as on a curve."""
    return bool(info.columns.stop > info.columns.start)


def symbols(motion: Motion) -> list[dict[str, Any]]:
    """Marks of joints, drivers and forces, with their places on two bodies.

    A mark without points is drawn around the joint that its two bodies share, otherwise at the mass
    centre of body j.
    """
    found = [_symbol(motion, told) for told in motion.compiled.symbols]
    bodies = (motion.body(name) for name in motion.compiled.all_bodies)
    first = [[float(np.atleast_1d(x)[0]) for x in (body.x, body.y, body.angle)] for body in bodies]
    add_teeth(found, np.array(first))
    for symbol in found:
        del symbol["module"]
    return found


def _symbol(motion: Motion, told: dict[str, Any]) -> dict[str, Any]:
    i, j = told["i"], told["j"]
    found = {
        "element": told["element"],
        "mark": told["mark"],
        "bodies": [i["body"], j["body"]],
        "points": [i["point"], j["point"] or _pivot(motion.compiled, i["body"], j["body"])],
        "axes": [i["axis"], j["axis"]],
        "radii": told["radii"],
        "module": told["module"],
        "teeth": None,
        "reach": None,
        "turning": None,
        "sense": 1,
    }
    if i["point"] is None:
        angles = [motion.body(_name(motion, end)).angle for end in found["bodies"]]
        turn = np.atleast_1d(angles[1] - angles[0])
        found["turning"] = [float(turn[0]), float(np.abs(turn - turn[0]).max())]
    elif told["mark"] in _GUIDES:
        found["reach"] = _reach(motion, found)
    elif told["mark"].endswith(("_strands", "cylinder")):
        found["reach"] = _distance(motion, found)
    elif told["mark"] == "face":
        found["reach"] = _touched(motion, found)
    elif told["mark"] == "shift_stop":
        found["points"][0] = _stopped(motion, found)
    if told["mark"] == "force_arrow":
        found["axes"][0] = _pushing(motion, found)
    elif told["mark"] == "torque_arrow":
        torque = motion.force(told["element"]).torque(on=_name(motion, j["body"]))
        found["sense"] = _sign(np.atleast_1d(torque))
    return found


def _pushing(motion: Motion, symbol: dict[str, Any]) -> float:
    """The direction of a force in the frame of body i when it is largest, rad."""
    i, j = (_name(motion, number) for number in symbol["bodies"])
    force = np.atleast_2d(motion.force(symbol["element"]).force(on=j))
    size = np.nan_to_num(np.hypot(*force.T))
    k = int(size.argmax())
    if size[k] == 0.0:
        return float(symbol["axes"][0])
    turned = np.arctan2(force[k, 1], force[k, 0]) - np.atleast_1d(motion.body(i).angle)[k]
    return float(np.arctan2(np.sin(turned), np.cos(turned)))


def _stopped(motion: Motion, symbol: dict[str, Any]) -> list[float]:
    """The place of a stop on body i, beside which the point of j is where it comes nearest."""
    i, j = (motion.body(_name(motion, number)) for number in symbol["bodies"])
    at, axis = symbol["points"][0], symbol["axes"][0]
    away = np.atleast_2d(j.at(symbol["points"][1]).position - i.at(at).position)
    turn = np.atleast_1d(i.angle + axis)
    along = away[:, 0] * np.cos(turn) + away[:, 1] * np.sin(turn)
    aside = away[:, 1] * np.cos(turn) - away[:, 0] * np.sin(turn)
    k = int(np.nan_to_num(along, nan=-np.inf).argmax())
    return _numbers((at[0] - aside[k] * math.sin(axis), at[1] + aside[k] * math.cos(axis)))


def _sign(values: Floats) -> int:
    """The sign of the value of largest magnitude."""
    most = np.nan_to_num(values)[np.abs(np.nan_to_num(values)).argmax()]
    return -1 if most < 0.0 else 1


def _touched(motion: Motion, symbol: dict[str, Any]) -> list[float]:
    """Least and largest place of the contact along a face of i, from the point of i, m."""
    i, j = (motion.body(_name(motion, number)) for number in symbol["bodies"])
    curve = motion.compiled.tree["joints"][symbol["element"]]["curve"].rpartition(".")[2]
    points = np.array(j.info.curves[curve][0])
    angle = np.atleast_1d(j.angle)[:, None]
    x = points[:, 0] * np.cos(angle) - points[:, 1] * np.sin(angle)
    y = points[:, 0] * np.sin(angle) + points[:, 1] * np.cos(angle)
    away = np.atleast_2d(j.r - i.at(symbol["points"][0]).position)
    x, y = x + away[:, :1], y + away[:, 1:]
    turn = np.atleast_1d(i.angle + symbol["axes"][0])[:, None]
    along, aside = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
    touched = np.take_along_axis(along, np.abs(aside).argmin(axis=1)[:, None], axis=1)
    return [float(touched.min()), float(touched.max())]


def _name(motion: Motion, number: int) -> str:
    return list(motion.compiled.all_bodies)[number]


def _pivot(model: CompiledModel, i: int, j: int) -> list[float]:
    """The point of body j in the joint that it shares with body i, or its mass centre."""
    for other in model.symbols:
        ends = {other[side]["body"]: other[side]["point"] for side in ("i", "j")}
        if set(ends) == {i, j} and None not in ends.values():
            found: list[float] = ends[j]
            return found
    return [*list(model.all_bodies.values())[j].center]


def _reach(motion: Motion, symbol: dict[str, Any]) -> list[float]:
    """Least and largest place of the point of j along the axis of i, from the point of i, m."""
    i, j = (motion.body(_name(motion, number)) for number in symbol["bodies"])
    at_i, at_j = symbol["points"]
    away = j.at(at_j).position - i.at(at_i).position
    direction = i.angle + symbol["axes"][0]
    along = away[..., 0] * np.cos(direction) + away[..., 1] * np.sin(direction)
    return [float(along.min()), float(along.max())]


def _distance(motion: Motion, symbol: dict[str, Any]) -> list[float]:
    """Least and largest distance of the two points, m."""
    ends = (
        motion.body(_name(motion, number)).at(at).position
        for number, at in zip(symbol["bodies"], symbol["points"], strict=True)
    )
    apart = np.linalg.norm(np.subtract(*ends), axis=-1)
    return [float(apart.min()), float(apart.max())]


def _numbers(at: Vector) -> list[float]:
    found: list[float] = plain(np.array(at))
    return found


def outline(model: CompiledModel, info: BodyInfo) -> Floats:
    """Corners in the body's frame: 1 (a spot), 2 (a line between its ends) or a convex polygon.

    A slender bar reaches from end to end, its length being √(12 J/m). All bodies contain their
    named points and those of their joints, a general body its mass centre too.
    """
    corners = [*info.points.values()]
    corners += [c.point_i for c in model.joints.values() if c.i == info.name]
    ends = (c for c in model.joints.values() if c.j == info.name and not _moves_on(c))
    corners += [c.point_j for c in ends]
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


def _some(points: list[Any]) -> list[Any]:
    """Some points along a curve, with the last one."""
    return [*points[:: len(points) // 50 + 1], points[-1]]


def own_size(bodies: list[dict[str, Any]], joints: list[dict[str, Any]]) -> float:
    """The largest extent of a body, ground included, in its own frame, m.

    It does not depend on the motion, so that all drawings of a model have the same unit of length.
    """
    sizes = [0.0]
    for entry in bodies:
        corners = [*entry["outline"], *(point["at"] for point in entry["points"])]
        corners += [at for line in (*entry["curves"], *entry["drawn"]) for at in line["points"]]
        for one in joints:
            pairs = zip(one["bodies"], one["points"], strict=True)
            corners += [at for number, at in pairs if number == entry["number"]]
        if corners:
            sizes.append(float(np.ptp(np.array(corners), axis=0).max()))
    return max(sizes)


def bounds(
    motion: Motion,
    bodies: list[dict[str, Any]],
    joints: list[dict[str, Any]],
    symbols: list[dict[str, Any]],
) -> Floats:
    """The area of the drawing over all frames: least x and y, largest x and y, m."""
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for entry in bodies:
        corners = [*entry["outline"], *(point["at"] for point in entry["points"])]
        lines = (*entry["curves"], *entry["drawn"])
        corners += [at for line in lines for at in _some(line["points"])]
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
    for symbol in symbols:
        if symbol["mark"] in WHEELS:
            view = motion.body(_name(motion, symbol["bodies"][1]))
            places, radius = view.at(symbol["points"][1]).position, outer_radius(symbol)
            low = np.minimum(low, places.min(axis=0) - radius)
            high = np.maximum(high, places.max(axis=0) + radius)
        if symbol["mark"] in _GUIDES:
            angle, (x, y) = symbol["axes"][0], symbol["points"][0]
            view = motion.body(_name(motion, symbol["bodies"][0]))
            for along in symbol["reach"]:
                end = (x + along * math.cos(angle), y + along * math.sin(angle))
                places = view.at(end).position
                low = np.minimum(low, places.min(axis=0))
                high = np.maximum(high, places.max(axis=0))
    if not np.all(np.isfinite([*low, *high])):
        return np.array([-1.0, -1.0, 1.0, 1.0])
    return np.array([*low, *high])
