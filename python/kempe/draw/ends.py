"""The ends of elements: where forces of joints, drivers and force elements act, and with what sign.

The forces themselves are in the frames and channels of a scene, as forces on body j. An end on
body i has the opposite force. An element without a force has no ends, and neither has a body on
which the element exerts none, such as ground for a stop of a coordinate.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from kempe.draw.numbers import plain
from kempe.model.compiled import ConstraintInfo
from kempe.model.infos import ForceInfo, Vector
from kempe.results.motion import Motion
from kempe.results.remarks import choice_of, joint_remark, remark
from kempe.results.solution import Solution
from kempe.results.state import State

#: A place: the body in whose frame a point is, and the point.
_Place = tuple[str, Vector]
#: Forces below this share of the largest one of an element are rounding errors.
_NOTHING = 1e-9


def ends(drawn: Solution | State, motion: Motion) -> list[dict[str, Any]]:
    """The ends of all elements with a force, body j first; see ``docs/scene.md``.

    Args:
        drawn: the whole motion, for the remarks.
        motion: the motion at the frames.
    """
    model = motion.compiled
    joints = (_of_joint(drawn, motion, info) for info in model.constraints.values())
    forces = (_of_force(motion, info) for info in model.forces.values())
    return [end for each in (*joints, *forces) for end in each]


def _of_joint(
    drawn: Solution | State, motion: Motion, info: ConstraintInfo
) -> list[dict[str, Any]]:
    """A joint on a curve has no point of body j: both forces act at the point of body i."""
    at_i = info.i, info.point_i
    at_j = at_i if info.coordinates else (info.j, info.point_j)
    return _made(motion, info, {info.i: at_i, info.j: at_j}, joint_remark(drawn, info.name))


def _of_force(motion: Motion, info: ForceInfo) -> list[dict[str, Any]]:
    told = remark(choice_of(motion, f"{info.name}.force"))
    return _made(motion, info, _places(motion, info), told)


def _places(motion: Motion, info: ForceInfo) -> dict[str, _Place]:
    """The points of a force along a line, otherwise those of its first symbol.

    A contact has a point of body i only, and a force on body j a point of body j only.
    """
    if info.points is not None:
        return {info.i: (info.i, info.points[0]), info.j: (info.j, info.points[1])}
    symbols = motion.compiled.symbols
    symbol = next((one for one in symbols if one["element"] == info.name), None)
    if symbol is None:
        return {info.j: (info.j, (0.0, 0.0))}
    at_i, at_j = (
        None if end["point"] is None else (name, (end["point"][0], end["point"][1]))
        for name, end in ((info.i, symbol["i"]), (info.j, symbol["j"]))
    )
    found = {} if at_i is None else {info.i: at_i}
    return found | {info.j: at_j or at_i or (info.j, (0.0, 0.0))}


def _made(
    motion: Motion, info: ConstraintInfo | ForceInfo, places: Mapping[str, _Place], told: str
) -> list[dict[str, Any]]:
    """The ends on bodies j and i, if the force on i is opposite to that on j."""
    group = info.group if isinstance(info, ConstraintInfo) else "forces"
    forces = {on: motion[info.name].force(on=on) for on in (info.i, info.j)}
    of_j = forces[info.j]
    most = float(np.nanmax(np.abs(of_j), initial=0.0))
    if not most > 0.0:
        return []
    numbers = {name: body.number for name, body in motion.compiled.all_bodies.items()}
    found = []
    for on, sign in ((info.j, 1), (info.i, -1)):
        error = np.nanmax(np.abs(forces[on] - sign * of_j), initial=0.0)
        if on not in places or not error <= _NOTHING * most:
            continue
        frame, point = places[on]
        found.append(
            {
                "element": info.name,
                "group": group,
                "body": numbers[on],
                "frame": numbers[frame],
                "point": plain(np.array(point)),
                "sign": sign,
                "remark": told.removeprefix(", "),
            }
        )
    return found
