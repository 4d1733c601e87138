"""The figures of design on pages: of motions with drivers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from kempe.design.coupler_curve import coupler_curve as curve_of
from kempe.design.transmission import transmitting
from kempe.errors import KempeError
from kempe.model.compiled import CompiledModel
from kempe.plot import style
from kempe.plot.centres import instant_centres
from kempe.plot.coupler_curves import coupler_curve
from kempe.plot.efforts import effort, torque_speed
from kempe.plot.page import Page, file_names
from kempe.plot.pin_loads import pin_load
from kempe.plot.polygons import acceleration_polygon, velocity_polygon
from kempe.plot.shaking import shaking_force
from kempe.plot.transmission import transmission_angle
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: The method of motions that drivers determine.
_DRIVEN = "continuation"
_SQUARE = 110.0
#: Points nearer than this are one point, m, relative to 1 m.
_SAME = 1e-12


def families(solution: Solution, index_base: int, most: int | None) -> Iterator[list[Page]]:
    """The pages of a driven motion; none for others. Forces are drawn only if they are unique.

    A run with drivers has efforts, and paths of bodies that no joint holds to ground alone; a
    motion that drivers determine has all pages.

    Args:
        solution: the solution.
        index_base: number of the first body.
        most: largest number of figures of one kind; no limit when None.
    """
    model = solution.compiled
    if not model.drivers or len(solution.t) < 2:
        return
    determined = solution.statistics.get("method") == _DRIVEN
    points = [name for name in free_points(model, guided=determined) if _moves(solution, name)]
    yield _pages("path", points, partial(coupler_curve, solution), _SQUARE, key=True)[:most]
    drives = [name for name in model.drivers if f"{name}.effort" in solution]
    if _has_forces(solution):
        yield _pages("effort", drives, partial(effort, solution), key=True)[:most]
    if not determined:
        return
    joints = transmitting(model)
    angles = partial(transmission_angle, solution)
    yield _pages("transmission", joints, angles, key=True)[:most]
    t = float(solution.t[0] + 0.4 * (solution.t[-1] - solution.t[0]))
    centres = partial(instant_centres, index_base=index_base)
    yield [
        _page("velocity_polygon", lambda ax: velocity_polygon(solution, t, ax=ax), _SQUARE),
        _page("acceleration_polygon", lambda ax: acceleration_polygon(solution, t, ax=ax), _SQUARE),
        _page("instant_centres", lambda ax: centres(solution, t, ax=ax), 120.0),
    ]
    if _has_forces(solution):
        yield _pages("duty", drives, partial(torque_speed, solution), 90.0)[:most]
        yield _loads(solution)[:most]
        yield [_page("shaking_force", lambda ax: shaking_force(solution, ax=ax), _SQUARE)]


def free_points(model: CompiledModel, *, guided: bool = True) -> list[str]:
    """Named points of moving bodies that are not at a joint, such as "coupler.P".

    Args:
        model: the model.
        guided: whether to include bodies that one joint on ground leaves one freedom: all their
            points move on circles or on lines.
    """
    found = []
    held = {
        name
        for joint in model.joints.values()
        if "ground" in (joint.i, joint.j) and joint.rows.stop - joint.rows.start == 2
        for name in (joint.i, joint.j)
    }
    for body, info in model.bodies.items():
        if not guided and body in held:
            continue
        joined = [
            place
            for joint in model.joints.values()
            for on, place in ((joint.i, joint.point_i), (joint.j, joint.point_j))
            if on == body
        ]
        for name, s in info.points.items():
            if all(np.hypot(s[0] - x, s[1] - y) > _SAME for x, y in joined):
                found.append(f"{body}.{name}")
    return found


def _moves(solution: Solution, point: str) -> bool:
    try:
        curve_of(solution, point)
    except KempeError:
        return False
    return True


def _has_forces(solution: Solution) -> bool:
    try:
        return bool(solution.lam.any())
    except KempeError:
        return False


def _loads(solution: Solution) -> list[Page]:
    model = solution.compiled
    pairs = [
        (joint, body)
        for joint, info in model.joints.items()
        for body in dict.fromkeys((info.i, info.j))
        if body in model.bodies
    ]
    names = [f"{joint}_on_{body}" for joint, body in pairs]
    files = file_names(f"pin_load_{name}" for name in names)
    return [
        _page(file, partial(pin_load, solution, joint, on=body), _SQUARE, f"pin_load_{name}")
        for file, name, (joint, body) in zip(files, names, pairs, strict=True)
    ]


def _pages(
    kind: str,
    names: list[str],
    draw: Callable[..., Axes],
    height: float = style.HEIGHT,
    *,
    key: bool = False,
) -> list[Page]:
    """A page for each name."""
    files = file_names(f"{kind}_{name}" for name in names)
    return [
        _page(file, partial(draw, name), height, f"{kind}_{name}", key=key)
        for file, name in zip(files, names, strict=True)
    ]


def _page(
    name: str, draw: Callable[..., Axes], height: float, about: str = "", *, key: bool = False
) -> Page:
    def drawing() -> Figure:
        figure = style.figure(height)
        draw(ax=figure.add_subplot())
        return figure

    return Page(0, name, about or name, drawing, key)
