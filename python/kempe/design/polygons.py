"""Velocity and acceleration polygons of a mechanism at an instant.

Each point of the mechanism has an image: the tip of its velocity, drawn from the pole o, or of its
acceleration, drawn from o′. The image of a body is similar to the body (theorems of Mehmke and
Burmester). The images of two points of a body are connected by the relative velocity ω × r, or by
the relative acceleration with its normal part -ω² r and its tangential part α × r. The images of a
point of a slide and of the coincident point below it are connected by the sliding velocity, or by
the relative acceleration with Coriolis' part 2 ω × v (Norton, *Design of Machinery*, ch. 6 and 7).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.design.places import is_pin
from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel, Vector
from kempe.model.values import instance
from kempe.results.motion import Motion
from kempe.results.solution import Solution
from kempe.results.state import State
from kempe.results.variable import Variable

#: Names of the pole.
POLE = "o"
#: Points closer than this fraction of the size of the mechanism are one point.
_SAME = 1e-9


@dataclass(frozen=True, repr=False)
class Side:
    """A vector of a polygon.

    Attributes:
        name: such as "B" for the velocity of B, "BA" for the velocity of B relative to A.
        part: "absolute", "relative", "normal", "tangential", "slip" or "coriolis".
        body: the body to which the vector belongs; empty for absolute vectors.
        start: the point of the polygon where the vector begins, (2,), m/s or m/s².
        vector: the vector, (2,), m/s or m/s².
    """

    name: str
    part: str
    body: str
    start: Floats
    vector: Floats

    @property
    def end(self) -> Floats:
        """The point of the polygon where the vector ends, (2,), m/s or m/s²."""
        return fixed(self.start + self.vector)

    def __repr__(self) -> str:
        return f"<Side {self.name} ({self.part}): {np.hypot(*self.vector):.6g}>"


@dataclass(frozen=True, repr=False)
class Polygon:
    """A velocity or acceleration polygon.

    Attributes:
        kind: "velocity" or "acceleration".
        unit: "m/s" or "m/s²".
        variable, t: the quantity that defines the instant, and its value, s.
        images: the image of each point by name, (2,), seen from the pole; "o" is the pole.
        sides: the vectors, absolute vectors first.
        state: the mechanism at the instant.
    """

    kind: str
    unit: str
    variable: Variable
    t: float
    images: Mapping[str, Floats]
    sides: tuple[Side, ...]
    state: State

    def __repr__(self) -> str:
        return f"<Polygon of {self.kind} with {', '.join(self.images)}>"


@dataclass(frozen=True)
class _Point:
    """A point of a body with its name."""

    name: str
    body: str
    s: Vector


def velocity_polygon(solution_or_state: Solution | State, t: float | None = None) -> Polygon:
    """The velocity polygon at an instant; see ``Polygon``.

    Args:
        solution_or_state: a solution or a state.
        t: the instant in a solution, s; its first when None.

    Raises:
        ModelError: the instant is not within the solution.
    """
    state = state_at(solution_or_state, t)
    points = _points(state)
    images = {p.name: _velocity(state, p) for p in points}
    sides = [
        Side(name, "absolute", "", np.zeros(2), images[name]) for name in images if name != POLE
    ]
    for a, b in _pairs(state.compiled, points):
        apart = _position(state, b) - _position(state, a)
        omega = float(state.body(a.body).omega)
        sides.append(
            Side(b.name + a.name, "relative", a.body, images[a.name], omega * _turned(apart))
        )
    for a, b, slip, _ in _slides(state, points):
        sides.append(Side(b.name + a.name, "slip", a.body, images[a.name], slip))
    return _polygon("velocity", "m/s", state, images, sides)


def acceleration_polygon(solution_or_state: Solution | State, t: float | None = None) -> Polygon:
    """The acceleration polygon at an instant; see ``Polygon``.

    Args:
        solution_or_state: a solution or a state.
        t: the instant in a solution, s; its first when None.

    Raises:
        ModelError: the instant is not within the solution.
    """
    state = state_at(solution_or_state, t)
    points = _points(state)
    images = {p.name: _acceleration(state, p) for p in points}
    sides = [
        Side(name, "absolute", "", np.zeros(2), images[name]) for name in images if name != POLE
    ]
    for a, b in _pairs(state.compiled, points):
        apart = _position(state, b) - _position(state, a)
        body, start = state.body(a.body), images[a.name]
        name, normal = b.name + a.name, -(float(body.omega) ** 2) * apart
        sides.append(Side(name, "normal", a.body, start, normal))
        turning = float(body.alpha) * _turned(apart)
        sides.append(Side(name, "tangential", a.body, start + normal, turning))
    for a, b, slip, axis in _slides(state, points):
        start, whole = images[a.name], images[b.name] - images[a.name]
        coriolis = 2.0 * float(state.body(a.body).omega) * _turned(slip)
        sides.append(Side(b.name + a.name, "coriolis", a.body, start, coriolis))
        along = float((whole - coriolis) @ axis) * axis
        sides.append(Side(b.name + a.name, "slip", a.body, start + coriolis, along))
    return _polygon("acceleration", "m/s²", state, images, sides)


def _polygon(
    kind: str, unit: str, state: State, images: Mapping[str, Floats], sides: list[Side]
) -> Polygon:
    at_pole = {POLE: np.zeros(2)}
    kept = MappingProxyType({name: fixed(i) for name, i in {**images, **at_pole}.items()})
    return Polygon(
        kind, state.variable.rate(unit), state.variable, float(state.t), kept, tuple(sides), state
    )


def state_at(solution_or_state: Solution | State, t: float | None) -> State:
    """The state at an instant of a solution, by default the first; a given state is unchanged."""
    instance(solution_or_state, (Solution, State), "a solution or a state")
    if isinstance(solution_or_state, State):
        if t is not None and t != solution_or_state.t:
            raise ModelError("t: a state has one instant only", hint="pass the solution")
        return solution_or_state
    if t is None:
        return solution_or_state.initial
    found = solution_or_state(float(t))
    assert isinstance(found, State)
    return found


def _turned(vector: Floats) -> Floats:
    return np.array([-vector[1], vector[0]])


def _position(state: Motion, point: _Point) -> Floats:
    return np.asarray(state.body(point.body).at(point.s).position)


def _velocity(state: Motion, point: _Point) -> Floats:
    return np.array(state.body(point.body).at(point.s).velocity)


def _acceleration(state: Motion, point: _Point) -> Floats:
    return np.array(state.body(point.body).at(point.s).acceleration)


def _points(state: State) -> list[_Point]:
    """The pole, then pins, slides and free named points; a pin occurs once for each of its bodies.

    Points of ground have the name of the pole.
    """
    model = state.compiled
    found = [_Point(POLE, next(iter(model.all_bodies)), (0.0, 0.0))]
    for name, info in model.joints.items():
        if is_pin(info):
            at_ground = "ground" in (info.i, info.j)
            label = POLE if at_ground else name
            found += [_Point(label, info.i, info.point_i), _Point(label, info.j, info.point_j)]
        elif _slides_along(info.measured):
            found.append(_Point(name, info.j, info.point_j))
            if info.i != "ground":
                under = _Point("", info.j, info.point_j)
                s = _seen(state, info.i, _position(state, under))
                found.append(_Point(f"{name}′", info.i, s))
    taken = [*found]
    named = [p for body in model.bodies.values() for p in body.points]
    for body, about in model.bodies.items():
        for point, s in about.points.items():
            if not any(p.body == body and _near(p.s, s) for p in taken):
                label = point if named.count(point) == 1 else f"{body}.{point}"
                found.append(_Point(label, body, s))
    return [p for k, p in enumerate(found) if not _repeats(p, found[:k])]


def _repeats(point: _Point, before: list[_Point]) -> bool:
    """Whether this point of the body already has a name."""
    return any(p.body == point.body and _near(p.s, point.s) for p in before)


def _near(a: Vector, b: Vector) -> bool:
    return bool(np.hypot(a[0] - b[0], a[1] - b[1]) <= _SAME * (1.0 + np.hypot(*a)))


def _slides_along(measured: object) -> bool:
    return bool(measured) and measured[0].names[0] == "displacement"  # type: ignore[index]


def _seen(state: State, body: str, place: Floats) -> Vector:
    """Coordinates of a global point in the frame of a body."""
    view = state.body(body)
    x, y = np.asarray(place) - view.r
    cos, sin = np.cos(view.angle), np.sin(view.angle)
    return float(cos * x + sin * y), float(cos * y - sin * x)


def _pairs(model: CompiledModel, points: list[_Point]) -> Iterator[tuple[_Point, _Point]]:
    """The first point of each turning body with each of its other points."""
    for body, info in model.bodies.items():
        own = [p for p in points if p.body == body]
        first = min(own, key=lambda p: p.name != POLE, default=None)
        for other in own:
            if first is not None and other is not first and info.turns:
                yield first, other


def _slides(state: State, points: list[_Point]) -> Iterator[tuple[_Point, _Point, Floats, Floats]]:
    """For slides on moving bodies: the point under it, its own, the slip, and its direction."""
    by = {(p.name, p.body): p for p in points}
    for name, info in state.compiled.joints.items():
        under, own = by.get((f"{name}′", info.i)), by.get((name, info.j))
        if under is not None and own is not None:
            turn = float(state.body(info.i).angle) + info.axis_i
            axis = np.array([np.cos(turn), np.sin(turn)])
            slip = float((_velocity(state, own) - _velocity(state, under)) @ axis) * axis
            yield under, own, slip, axis
