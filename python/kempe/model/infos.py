"""Descriptions of the elements of a compiled model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields, replace
from types import MappingProxyType
from typing import Any, TypeAlias

from kempe.base.names import few

COORDINATES = ("x", "y", "angle")
RATES = ("vx", "vy", "omega")
ACCELERATIONS = ("ax", "ay", "alpha")

Vector = tuple[float, float]
#: Force, name of its mode, sign, leader and held value.
Mode: TypeAlias = "tuple[int, str, float, int, float]"
#: Values of parameters that differ from those of the case, released drivers, and modes of forces.
Setting: TypeAlias = "tuple[list[tuple[str, float]], list[str], list[Mode]]"


@dataclass(frozen=True, repr=False)
class BodyInfo:
    """A body with numerical values.

    Attributes:
        name: name of the body.
        type: such as "bar"; empty for ground.
        number: 0 for ground; moving bodies count from 1.
        shown_number: its number in lists and figures, where a beam counts as one body; 0 for ground
            and for the nodes of beams.
        mass: kg.
        inertia: about the mass centre, kg·m².
        center: mass centre in the body's frame, m.
        points: named points in the body's frame, m.
        curves: named curves, each by points along it in the body's frame, m, and whether it is
            closed.
        drawn: the shape in drawings in place of a link around the points: "area", "rod" or
            "line", and points in the body's frame, m; empty without outline and shapes.
        columns: slice of its coordinates in q: x, y, angle; x, y of a point mass; empty for ground.
    """

    name: str
    type: str
    number: int
    shown_number: int
    mass: float
    inertia: float
    center: Vector
    points: Mapping[str, Vector]
    curves: Mapping[str, tuple[tuple[Vector, ...], bool]]
    drawn: tuple[tuple[str, tuple[Vector, ...]], ...]
    columns: slice

    def __repr__(self) -> str:
        points = f", points {few(self.points)}" if self.points else ""
        return f"<{self.type or 'ground'} {self.name!r}: {self.mass:g} kg{points}>"

    def __reduce__(self) -> tuple[Any, ...]:
        """A view of a mapping cannot be pickled; the mapping can."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return _body_of, ({**values, "points": dict(self.points), "curves": dict(self.curves)},)

    @property
    def count(self) -> int:
        """Number of its coordinates."""
        return int(self.columns.stop - self.columns.start)

    @property
    def is_shown(self) -> bool:
        """Whether lists and figures show it: a node inside of a beam is part of the beam."""
        return self.type != "node"

    @property
    def has_inertia(self) -> bool:
        """Whether it has one moment of inertia: a point and a beam that bends have none."""
        return self.turns and self.type != "beam"

    @property
    def is_inner(self) -> bool:
        """Whether it is a node of a beam without a name in the file."""
        return ".#" in self.name

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of its coordinates: ``x``, ``y`` and ``angle``."""
        return COORDINATES[: self.count]

    @property
    def turns(self) -> bool:
        """Whether it has an angle."""
        return "angle" in self.quantities


@dataclass(frozen=True)
class Measured:
    """A position quantity of an element: the motion of body j as seen from body i.

    Attributes:
        names: of the position, its rate and its acceleration, such as angle, omega, alpha.
        unit: SI unit of the position.
    """

    names: tuple[str, str, str]
    unit: str

    @property
    def units(self) -> tuple[str, str, str]:
        """SI units of the position, the rate and the acceleration."""
        return self.unit, f"{self.unit}/s", f"{self.unit}/s^2"


@dataclass(frozen=True, repr=False)
class ConstraintInfo:
    """A joint or a driver with numerical values.

    Attributes:
        name: name of the joint or driver.
        group: "joints" or "drivers".
        type: the ``type`` in the file.
        i, j: the first two connected bodies.
        bodies: all connected bodies.
        point_i, point_j: the joint point in the frame of each body, m.
        axis_i, axis_j: angle of the joint's x axis in the frame of each body, rad.
        rows: slice of its equations in Φ and λ.
        equations: names and units of the equations.
        columns: slice of its internal coordinates in q; empty for most joints.
        coordinates: names and units of its internal coordinates.
        results: names and units of its results beside the reaction, such as ``("normal", "N")``.
        events: for each of these results the event that occurs when it becomes negative, or None.
        measured: its position quantities.
        is_shown: whether lists and figures show it; a lock is part of its beam.
        is_limited: whether it is a driver whose effort has a limit.
        may_slip: whether it is a joint with friction against slip.
    """

    name: str
    group: str
    type: str
    i: str
    j: str
    point_i: Vector
    point_j: Vector
    axis_i: float
    axis_j: float
    rows: slice
    equations: tuple[tuple[str, str], ...]
    bodies: tuple[str, ...]
    columns: slice
    coordinates: tuple[tuple[str, str], ...]
    results: tuple[tuple[str, str], ...]
    events: tuple[str | None, ...]
    measured: tuple[Measured, ...]
    is_shown: bool
    is_limited: bool
    may_slip: bool

    def __repr__(self) -> str:
        return f"<{self.type} {self.name!r}: {' - '.join(self.bodies)}>"


@dataclass(frozen=True, repr=False)
class ForceInfo:
    """A force element with numerical values.

    Attributes:
        name: name of the element.
        type: the ``type`` in the file.
        i, j: the first two bodies on which it acts.
        bodies: all bodies on which it acts.
        parts: names of its parts, such as "stiffness" and "damping".
        points: the two points of a force along a line, in the frames of bodies i and j, m; None for
            other forces.
        places: slice of its first-order states in z; empty for most forces.
        states: names and units of its first-order states, such as ``("current", "A")``.
        reaction: the joint on whose reaction it depends; None for most forces.
        is_joint: whether the file has it among the joints, such as a gear with backlash.
        is_shown: whether lists and figures show it; an elastic piece is part of its beam.
        reads_multipliers: whether it depends on multipliers.
        results: names and units of its results beside its wrenches, such as ``("load", "N")``.
        measured: its position quantities.
    """

    name: str
    type: str
    i: str
    j: str
    parts: tuple[str, ...]
    points: tuple[Vector, Vector] | None
    bodies: tuple[str, ...]
    places: slice
    states: tuple[tuple[str, str], ...]
    reaction: str | None
    is_joint: bool
    is_shown: bool
    reads_multipliers: bool
    results: tuple[tuple[str, str], ...]
    measured: tuple[Measured, ...]

    def __repr__(self) -> str:
        return f"<{self.type} {self.name!r}: {' - '.join(self.bodies)}>"


def _body_of(values: dict[str, Any]) -> BodyInfo:
    named = {key: MappingProxyType(values[key]) for key in ("points", "curves")}
    return BodyInfo(**{**values, **named})


def vector(two: list[float]) -> Vector:
    """Two numbers."""
    x, y = two
    return float(x), float(y)


def _units(entries: list[dict[str, str]]) -> tuple[tuple[str, str], ...]:
    """Names and units."""
    return tuple((entry["name"], entry["unit"]) for entry in entries)


def _measured(entries: list[dict[str, Any]]) -> tuple[Measured, ...]:
    return tuple(Measured(names=tuple(of["names"]), unit=of["unit"]) for of in entries)


def bodies(entries: Iterable[dict[str, Any]]) -> Iterator[BodyInfo]:
    """The bodies, ground first, from their entries in the description by the core."""
    shown = 0
    for number, entry in enumerate(entries):
        is_shown = number > 0 and entry["type"] != "node"
        shown += is_shown
        yield _body(number, shown if is_shown else 0, entry)


def whole(infos: Iterable[BodyInfo]) -> dict[str, BodyInfo]:
    """Bodies by name, each beam as one with its whole mass."""
    masses: dict[str, float] = {}
    shown = {}
    for info in infos:
        body = info.name.split(".")[0]
        masses[body] = masses.get(body, 0.0) + info.mass
        if info.is_shown:
            shown[info.name] = info
    return {name: replace(info, mass=masses[name]) for name, info in shown.items()}


def _body(number: int, shown_number: int, entry: dict[str, Any]) -> BodyInfo:
    points = {name: vector(point) for name, point in entry["points"].items()}
    curves = {
        name: (tuple(map(vector, curve["points"])), bool(curve["closed"]))
        for name, curve in entry["curves"].items()
    }
    return BodyInfo(
        curves=MappingProxyType(curves),
        name=entry["name"],
        type=entry["type"] or "",
        number=number,
        shown_number=shown_number,
        mass=float(entry["mass"] or 0.0),
        inertia=float(entry["inertia"] or 0.0),
        center=vector(entry["center"]),
        points=MappingProxyType(points),
        drawn=tuple((part["form"], tuple(map(vector, part["points"]))) for part in entry["drawn"]),
        columns=slice(*entry["columns"]),
    )


def constraint(entry: dict[str, Any]) -> ConstraintInfo:
    """A joint or driver from its entry in the description by the core."""
    return ConstraintInfo(
        name=entry["name"],
        group=entry["group"],
        type=entry["type"],
        i=entry["i"],
        j=entry["j"],
        point_i=vector(entry["point_i"]),
        point_j=vector(entry["point_j"]),
        axis_i=float(entry["axis_i"]),
        axis_j=float(entry["axis_j"]),
        rows=slice(*entry["rows"]),
        equations=_units(entry["equations"]),
        bodies=tuple(entry["bodies"]),
        columns=slice(*entry["columns"]),
        coordinates=_units(entry["coordinates"]),
        results=_units(entry["results"]),
        events=tuple(result["negative"] for result in entry["results"]),
        measured=_measured(entry["measured"]),
        is_shown=entry["is_shown"],
        is_limited=entry["is_limited"],
        may_slip=entry["may_slip"],
    )


def force(entry: dict[str, Any]) -> ForceInfo:
    """A force element from its entry in the description by the core."""
    points = entry["points"]
    return ForceInfo(
        name=entry["name"],
        type=entry["type"],
        i=entry["i"],
        j=entry["j"],
        parts=tuple(entry["parts"]),
        points=None if points is None else (vector(points[0]), vector(points[1])),
        bodies=tuple(entry["bodies"]),
        places=slice(*entry["places"]),
        states=_units(entry["states"]),
        reaction=entry["reaction"],
        is_joint=entry["is_joint"],
        is_shown=entry["is_shown"],
        reads_multipliers=entry["reads_multipliers"],
        results=_units(entry["results"]),
        measured=_measured(entry["measured"]),
    )
