"""The free-body diagram of a body: all forces and moments on it, with values, and -m a.

An arrow begins at the point where the force acts, or ends there if the force pushes on the body.
The lengths are proportional to the forces, but each arrow has a minimum length, so that it is
visible. With d'Alembert's force -m a, drawn dashed at the mass centre, all forces are in balance.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.design.free_body import FreeBody
from kempe.design.free_body import free_body as body_of
from kempe.draw.display import Display
from kempe.draw.items import (
    NUMBER,
    Item,
    arc,
    arrow_head,
    fill,
    line,
    print_points,
    upright,
)
from kempe.draw.palette import verbatim
from kempe.draw.scene import Scene, scene
from kempe.draw.units import number, scale
from kempe.plot import style
from kempe.plot.configuration import instant
from kempe.plot.picture import drawn, paint
from kempe.plot.remarked import NO_BOUND, NOT_UNIQUE
from kempe.results.remarks import together, when
from kempe.results.solution import Solution
from kempe.results.state import State

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT = 110.0
#: Margin around the body for arrows, as a fraction of its larger side.
_ROOM = 0.32
#: Longest and shortest arrow, radius of a moment, its width, points.
_LONGEST, _SHORTEST, _RADIUS, _WIDTH = 64.0, 15.0, 13.0, 1.5
#: Loads below this fraction of the largest are not drawn.
_NOTHING = 1e-9
_COLOURS = {"joint": "reaction", "driver": "drive", "element": "force", "gravity": "ink"}

#: An arrow: name, colour, place, vector, and whether it is dashed.
_Arrow = tuple[str, str, Floats, Floats, bool]


def free_body(
    solution_or_state: Solution | State,
    body: str,
    t: float | None = None,
    *,
    ax: Axes | None = None,
) -> Axes:
    """Draw a body with all forces and moments on it.

    Args:
        solution_or_state: a solution or a state.
        body: a moving body.
        t: the instant in a solution, s; its first when None.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such moving body, or the instant is not within the solution.
        SingularityError: reactions are not unique.
    """
    return draw_free_body(body_of(solution_or_state, body, t), ax=ax)


def draw_free_body(found: FreeBody, *, ax: Axes | None = None) -> Axes:
    """Draw a free body, such as one of ``kp.design.load_cases``."""
    arrows = list(_arrows(found))
    most = max((float(np.hypot(*vector)) for _, _, _, vector, _ in arrows), default=0.0)
    moments = [(_signed(found, load.name), load.place, float(load.moment)) for load in found.loads]
    moments.append(("−J α", found.inertia.centre, -float(found.inertia.moment)))
    turning = max(abs(moment) for _, _, moment in moments)
    case = f"{found.name}, " if found.name else ""
    title = f"Forces on {style.short(found.body)}, {case}{instant(found.state)}"
    with style.on(ax, _HEIGHT) as axes:
        made = drawn(axes, _alone(found), title, _note(found))
        for arrow in arrows:
            if float(np.hypot(*arrow[3])) > _NOTHING * most:
                _add_force(made, arrow, most, np.asarray(found.inertia.centre))
        least = max(_NOTHING * turning, 1e-9 * most * _size(made.scene))
        for name, place, moment in moments:
            if abs(moment) > least:
                _add_moment(made, name, place, moment)
        paint(axes, made)
        return axes


def _signed(found: FreeBody, name: str) -> str:
    """The name of a load, with the signs of its remarks."""
    shown = style.one_line(name, 14)
    shown += f" {NOT_UNIQUE}" if name in found.not_unique else ""
    return f"{shown} {NO_BOUND}" if name in found.unbounded_at else shown


def _note(found: FreeBody) -> str:
    """What loads over a driven quantity contain, and the meaning of their signs."""
    of = found.variable
    times = sorted({t for each in found.unbounded_at.values() for t in each})
    told = [verbatim(of.condition)] if of.condition else []
    told += [f"{NOT_UNIQUE} {together(found.not_unique.values())}"] if found.not_unique else []
    told += [f"{NO_BOUND} without bound {verbatim(when(times, of))}"] if times else []
    return ", ".join(told)


def _arrows(found: FreeBody) -> Iterator[_Arrow]:
    for load in found.loads:
        name = "m g" if load.kind == "gravity" else _signed(found, load.name)
        yield name, _COLOURS[load.kind], np.asarray(load.place), np.asarray(load.force), False
    of = found.inertia
    yield "−m a", "quiet", np.asarray(of.centre), -np.asarray(of.force), True


def _alone(found: FreeBody) -> Scene:
    """The scene with this body only, and room for arrows."""
    made = scene(found.state)
    own = next(body for body in made["bodies"] if body["name"] == found.body)
    view = found.state.body(found.body)
    lines = (*own["curves"], *own["drawn"])
    corners = np.array([*own["outline"], *(at for line in lines for at in line["points"])])
    places = np.array([view.at((float(x), float(y))).position for x, y in corners])
    loads = np.array([*(load.place for load in found.loads), found.inertia.centre])
    places = np.vstack([places, loads])
    low, high = places.min(axis=0), places.max(axis=0)
    room = _ROOM * (float((high - low).max()) or _size(made))
    middle, half = (low + high) / 2.0, (high - low) / 2.0 + room
    half = np.maximum(half, [1.3 * half[1], 0.0])  # for the names beside an upright body
    bounds = [*map(float, middle - half), *map(float, middle + half)]
    kept = [body for body in made["bodies"] if body is own or not body["number"]]
    ground = {**kept[0], "points": [], "curves": [], "drawn": []}
    alone: dict[str, Any] = {"bodies": [ground, *kept[1:]], "joints": [], "symbols": []}
    return {**made, **alone, "bounds": bounds, "traces": []}


def _size(made: Scene) -> float:
    low, high = np.array(made["bounds"]).reshape(2, 2)
    return float((high - low).max()) or 1.0


def _add_force(made: Display, arrow: _Arrow, most: float, centre: Floats) -> None:
    name, colour, place, vector, dashed = arrow
    size = float(np.hypot(*vector))
    length = max(_LONGEST * size / most, _SHORTEST)
    along = vector / size
    inwards = float(along @ (centre - place)) > 1e-3 * _size(made.scene)
    begin = -length if inwards else 0.0
    frame = upright(0, [float(x) for x in place])
    shaft = length - 6.0
    pieces = [(0.0, shaft)]
    if dashed:
        count = max(2, int(shaft // 6.0))
        marks = np.linspace(0.0, shaft, 2 * count)
        pieces = [(float(marks[2 * k]), float(marks[2 * k + 1])) for k in range(count)]
    items: list[Item] = []
    for first, last in pieces:
        rows = print_points(np.array([(begin + first) * along, (begin + last) * along]))
        items.append(line(name, frame, rows, colour, _WIDTH, layer=NUMBER - 1))
    tip = (begin + length) * along
    head = arrow_head([float(x) for x in tip], float(np.arctan2(*along[::-1])), 8.0)
    made.add([*items, fill(name, frame, print_points(head), colour, layer=NUMBER - 1)])
    free = begin * along if inwards else tip  # the end that is away from the body
    at = made.view.plane(made.view.points(place) + free)
    words = f"{name}: {_valued('N', size)}"
    made.name("measure", words, upright(0, [float(x) for x in at]))


def _valued(unit: str, value: float) -> str:
    """A number with the unit that keeps it short."""
    shown = scale(unit, abs(value))
    return f"{number(value / shown.divisor)} {shown.unit}"


def _add_moment(made: Display, name: str, place: Floats, moment: float) -> None:
    frame = upright(0, [float(x) for x in place])
    turned = np.array([1.0, 1.0 if moment > 0.0 else -1.0])
    begin, end = np.radians([-60.0, 200.0])
    shaft = print_points(arc(_RADIUS, begin, end - 4.0 / _RADIUS) * turned)
    tip = arc(_RADIUS, end, end, 1)[0]
    head = arrow_head(tip, end + np.pi / 2.0 - 3.5 / _RADIUS, 8.0) * turned
    colour = "quiet" if name == "−J α" else "force"
    made.add([line(name, frame, shaft, colour, _WIDTH, layer=NUMBER - 1)])
    made.add([fill(name, frame, print_points(head), colour, layer=NUMBER - 1)])
    made.name("measure", f"{name}: {_valued('N·m', moment)}", frame)
