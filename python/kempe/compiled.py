"""The compiled model: immutable, with numerical values and access by name."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from kempe import _core
from kempe.names import entry, few

if TYPE_CHECKING:
    from kempe.model import Model

COORDINATES = ("x", "y", "angle")
RATES = ("vx", "vy", "omega")
ACCELERATIONS = ("ax", "ay", "alpha")

Vector = tuple[float, float]


@dataclass(frozen=True, repr=False)
class BodyInfo:
    """A body with numerical values.

    Attributes:
        name: name of the body.
        type: such as "bar"; empty for ground.
        number: 0 for ground; moving bodies count from 1.
        mass: kg.
        inertia: about the mass centre, kg·m².
        center: mass centre in the body's frame, m.
        points: named points in the body's frame, m.
        columns: slice of its coordinates in q: x, y, angle; x, y of a point mass; empty for ground.
    """

    name: str
    type: str
    number: int
    mass: float
    inertia: float
    center: Vector
    points: Mapping[str, Vector]
    columns: slice

    def __repr__(self) -> str:
        points = f", points {few(self.points)}" if self.points else ""
        return f"<{self.type or 'ground'} {self.name!r}: {self.mass:g} kg{points}>"

    def __reduce__(self) -> tuple[Any, ...]:
        """A view of a mapping cannot be pickled; the mapping can."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return _body_of, ({**values, "points": dict(self.points)},)

    @property
    def count(self) -> int:
        """Number of its coordinates."""
        return int(self.columns.stop - self.columns.start)

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of its coordinates: ``x``, ``y`` and ``angle``."""
        return COORDINATES[: self.count]

    @property
    def turns(self) -> bool:
        """Whether it has an angle."""
        return "angle" in self.quantities


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
        reaction: the joint whose reaction enters it; None for most forces.
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

    def __repr__(self) -> str:
        return f"<{self.type} {self.name!r}: {' - '.join(self.bodies)}>"


class CompiledModel:
    """A model with numerical values, created by ``Model.compile()``.

    Attributes:
        core: the compiled model of the core.
    """

    def __init__(self, core: _core.Model, case: str, model: Model | None = None) -> None:
        self.core = core
        self._model = model
        self._case = case
        self._analyses: Mapping[str, Any] | None = None
        self._about: dict[str, Any] = json.loads(core.describe())

    @classmethod
    def from_case(cls, case: str) -> CompiledModel:
        """Compile the model of a case given as JSON."""
        return cls(_core.Case(case, "json", None).model("{}"), case)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled as text; compiled again when it is read."""
        return _restored, (self.model, self._case, self._analyses)

    @property
    def model(self) -> Model:
        """The model that was compiled; made from the case where there was none."""
        if self._model is None:
            from kempe.model import Model

            self._model = Model.of_compiled(self)
        return self._model

    @property
    def case(self) -> str:
        """JSON of a case from which the model can be compiled again."""
        if self._analyses is None:
            return self._case
        return json.dumps({**json.loads(self._case), "analyses": self._analyses})

    @cached_property
    def tree(self) -> Mapping[str, Any]:
        """The case as nested mappings, structured as a file."""
        tree: dict[str, Any] = json.loads(self._case)
        return MappingProxyType(tree)

    def with_analyses(self, analyses: Mapping[str, Any]) -> CompiledModel:
        """The same model with other analyses in its case."""
        other = CompiledModel.__new__(CompiledModel)
        other.__dict__.update(self.__dict__)  # five times faster than copy.copy
        other._analyses = analyses
        return other

    def allowing_redundancy(self) -> CompiledModel:
        """The same model with redundant constraints accepted."""
        case = json.dumps({**json.loads(self.case), "redundancy": "allow"})
        return CompiledModel(self.core.allowing_redundancy(), case, self._model)

    @property
    def redundancy(self) -> str:
        """Whether redundant constraints are accepted: "allow" or "refuse"."""
        return str(self._about["redundancy"])

    @property
    def title(self) -> str:
        """Title of the model."""
        return self._about["title"] or ""

    @property
    def gravity(self) -> Vector:
        """Acceleration of free fall, m/s²."""
        return _vector(self._about["gravity"])

    @property
    def parameters(self) -> Mapping[str, float]:
        """Values of the parameters."""
        return MappingProxyType(self._about["parameters"])

    @property
    def n_q(self) -> int:
        """Number of coordinates: those of the moving bodies and the internal ones of joints."""
        return int(self._about["n_q"])

    @property
    def n_z(self) -> int:
        """Number of first-order states of force elements."""
        return int(self._about["n_z"])

    @property
    def n_rows(self) -> int:
        """Number of constraint equations."""
        return int(self._about["n_rows"])

    @cached_property
    def all_bodies(self) -> Mapping[str, BodyInfo]:
        """Ground and the moving bodies, in the order of q."""
        infos = (_body(number, entry) for number, entry in enumerate(self._about["bodies"]))
        return MappingProxyType({info.name: info for info in infos})

    @cached_property
    def bodies(self) -> Mapping[str, BodyInfo]:
        """The moving bodies, in the order of q."""
        return MappingProxyType({k: b for k, b in self.all_bodies.items() if b.number})

    @cached_property
    def constraints(self) -> Mapping[str, ConstraintInfo]:
        """Joints and drivers, in the order of Φ."""
        infos = map(_constraint, self._about["constraints"])
        return MappingProxyType({info.name: info for info in infos})

    @property
    def joints(self) -> Mapping[str, ConstraintInfo]:
        """The joints, in the order of Φ."""
        return self._group("joints")

    @property
    def drivers(self) -> Mapping[str, ConstraintInfo]:
        """The drivers, in the order of Φ."""
        return self._group("drivers")

    @cached_property
    def forces(self) -> Mapping[str, ForceInfo]:
        """The force elements."""
        infos = map(_force, self._about["forces"])
        return MappingProxyType({info.name: info for info in infos})

    @cached_property
    def symbols(self) -> tuple[dict[str, Any], ...]:
        """What a drawing shows for joints, drivers and forces, in their order.

        Each has ``element`` (its name), ``mark`` (a word of the scene's vocabulary), ``i`` and
        ``j`` (``body``: number, ``point``: place in its frame or None, ``axis``: angle) and
        ``radius``.
        """
        return tuple(json.loads(self.core.symbols()))

    def body(self, name: str) -> BodyInfo:
        """A body by name, including ground.

        Raises:
            ModelError: there is no such body.
        """
        return entry("body", name, self.all_bodies)

    def column_names(self) -> list[str]:
        """Names of the coordinates in the order of q, such as ``crank.angle``.

        The coordinates of the moving bodies come first, then the internal ones of joints.
        """
        return self._column_names(COORDINATES, "")

    def rate_names(self) -> list[str]:
        """Names of the velocities in the order of v, such as ``crank.omega``.

        The rate of an internal coordinate ``A.u`` has the name ``A.u_rate``.
        """
        return self._column_names(RATES, "_rate")

    def state_names(self) -> list[str]:
        """Names of the first-order states in the order of z, such as ``motor.current``."""
        return [f"{f.name}.{name}" for f in self.forces.values() for name, _ in f.states]

    def state_units(self) -> list[str]:
        """Units of the first-order states in the order of z."""
        return [unit for f in self.forces.values() for _, unit in f.states]

    def row_names(self) -> list[str]:
        """Names of the constraint equations in the order of Φ, such as ``A.x``."""
        return [f"{c.name}.{name}" for c in self.constraints.values() for name, _ in c.equations]

    def row_units(self) -> list[str]:
        """Units of the constraint equations in the order of Φ: m or rad."""
        return [unit for c in self.constraints.values() for _, unit in c.equations]

    def __repr__(self) -> str:
        counts = f"{len(self.bodies)} bodies, {self.n_q} coordinates, {self.n_rows} equations"
        return f"<CompiledModel {self.title!r}: {counts}>"

    def names(self) -> Iterator[str]:
        """Names of all bodies, joints, drivers and forces."""
        yield from self.all_bodies
        yield from self.constraints
        yield from self.forces

    def _column_names(self, of_body: Sequence[str], suffix: str) -> list[str]:
        names = [f"{b.name}.{name}" for b in self.bodies.values() for name in of_body[: b.count]]
        own = [
            f"{c.name}.{name}{suffix}"
            for c in self.constraints.values()
            for name, _ in c.coordinates
        ]
        return names + own

    def _group(self, group: str) -> Mapping[str, ConstraintInfo]:
        return MappingProxyType({k: c for k, c in self.constraints.items() if c.group == group})


def _restored(model: Model, case: str, analyses: Mapping[str, Any] | None) -> CompiledModel:
    """A compiled model from its text; that of the user's model if the text is the same."""
    made = model.compile() if model.json() == case else CompiledModel.from_case(case)
    made._model = model
    return made if analyses is None else made.with_analyses(analyses)


def _body_of(values: dict[str, Any]) -> BodyInfo:
    return BodyInfo(**{**values, "points": MappingProxyType(values["points"])})


def _vector(two: list[float] | None) -> Vector:
    x, y = two or (0.0, 0.0)
    return float(x), float(y)


def _units(entries: list[dict[str, str]]) -> tuple[tuple[str, str], ...]:
    """Names and units."""
    return tuple((entry["name"], entry["unit"]) for entry in entries)


def _body(number: int, entry: dict[str, Any]) -> BodyInfo:
    points = {name: _vector(point) for name, point in entry["points"].items()}
    return BodyInfo(
        name=entry["name"],
        type=entry["type"] or "",
        number=number,
        mass=float(entry["mass"] or 0.0),
        inertia=float(entry["inertia"] or 0.0),
        center=_vector(entry["center"]),
        points=MappingProxyType(points),
        columns=slice(*entry["columns"]),
    )


def _constraint(entry: dict[str, Any]) -> ConstraintInfo:
    return ConstraintInfo(
        name=entry["name"],
        group=entry["group"],
        type=entry["type"],
        i=entry["i"],
        j=entry["j"],
        point_i=_vector(entry["point_i"]),
        point_j=_vector(entry["point_j"]),
        axis_i=float(entry["axis_i"]),
        axis_j=float(entry["axis_j"]),
        rows=slice(*entry["rows"]),
        equations=_units(entry["equations"]),
        bodies=tuple(entry["bodies"]),
        columns=slice(*entry["columns"]),
        coordinates=_units(entry["coordinates"]),
    )


def _force(entry: dict[str, Any]) -> ForceInfo:
    points = entry["points"]
    return ForceInfo(
        name=entry["name"],
        type=entry["type"],
        i=entry["i"],
        j=entry["j"],
        parts=tuple(entry["parts"]),
        points=None if points is None else (_vector(points[0]), _vector(points[1])),
        bodies=tuple(entry["bodies"]),
        places=slice(*entry["places"]),
        states=_units(entry["states"]),
        reaction=entry["reaction"],
    )
