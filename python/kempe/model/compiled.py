"""The compiled model: immutable, with numerical values and access by name."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from kempe import _core
from kempe._upwards import CALLS
from kempe.base.names import Named, entry, named
from kempe.model.functions import FunctionLaw, Functions, refuse_saving
from kempe.model.infos import (
    ACCELERATIONS,
    COORDINATES,
    RATES,
    BodyInfo,
    ConstraintInfo,
    ForceInfo,
    Setting,
    Vector,
    bodies,
    constraint,
    force,
    vector,
    whole,
)
from kempe.model.lookup_tables import TableInfo
from kempe.model.measure_infos import MeasureInfo, measure_infos

if TYPE_CHECKING:
    from kempe.model.model import Model

__all__ = [
    "ACCELERATIONS",
    "COORDINATES",
    "RATES",
    "BodyInfo",
    "CompiledModel",
    "ConstraintInfo",
    "ForceInfo",
    "Vector",
]


class CompiledModel:
    """A model with numerical values, created by ``Model.compile()``.

    Attributes:
        core: the compiled model of the core.
    """

    def __init__(
        self,
        core: _core.Model,
        case: str,
        model: Model | None = None,
        functions: Functions | None = None,
    ) -> None:
        self.core = core
        self._functions = functions
        self._origin: CompiledModel | None = None
        if functions is not None:
            functions.belong_to(self)
        self._model = model
        self._case = case
        self._analyses: Mapping[str, Any] | None = None

    @classmethod
    def from_case(cls, case: str) -> CompiledModel:
        """Compile the model of a case given as JSON."""
        return cls(_core.Case(case, "json", None).model("{}"), case)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the model as text; it is compiled again when it is read."""
        self._refuse_functions()
        return _restored, (self.model, self._case, self._analyses, self.core.setting)

    @property
    def model(self) -> Model:
        """The model that was compiled; if there was none, it is built from the case."""
        if self._model is None:
            self._model = CALLS["model"](self)
        return self._model

    @property
    def case(self) -> str:
        """JSON of a case from which the model can be compiled again.

        Raises:
            ModelError: a law is a Python function, which a case cannot contain.
        """
        self._refuse_functions()
        if self._analyses is None:
            return self._case
        return json.dumps({**json.loads(self._case), "analyses": self._analyses})

    def run(self) -> AbstractContextManager[list[str]]:
        """A run of the model; gives a text for each controller that remembers an earlier one."""
        return nullcontext([]) if self._functions is None else self._functions.run()

    @property
    def functions(self) -> list[FunctionLaw]:
        """The laws of forces that are Python functions."""
        return [] if self._functions is None else self._functions.listed()

    def _refuse_functions(self) -> None:
        if self.functions:
            refuse_saving(self.functions)

    @cached_property
    def _about(self) -> dict[str, Any]:
        """The content of the model in numbers."""
        about: dict[str, Any] = json.loads(self.core.describe())
        return about

    @cached_property
    def tree(self) -> Mapping[str, Any]:
        """The case as nested mappings, with a text in place of each Python function."""
        tree: dict[str, Any] = json.loads(self._case)
        return MappingProxyType(tree)

    def with_analyses(self, analyses: Mapping[str, Any]) -> CompiledModel:
        """The same model with other analyses in its case."""
        other = CompiledModel.__new__(CompiledModel)
        other.__dict__.update(self.__dict__)  # five times faster than copy.copy
        other._analyses = analyses
        other._origin = self  # whose functions are called
        return other

    def in_case(self, case: str) -> CompiledModel:
        """The same model as part of a case, given as JSON."""
        other = CompiledModel(self.core, case, self._model)
        other._functions, other._origin = self._functions, self
        return other

    def replaced(
        self, core: _core.Model, sections: Mapping[str, Any], without: Sequence[str]
    ) -> CompiledModel:
        """The compiled model of a mechanism that differs in some sections of the case.

        Args:
            core: the compiled model of the core.
            sections: the sections that differ.
            without: the sections that are left out.
        """
        kept = {name: part for name, part in self.tree.items() if name not in without}
        tree = {**kept, **sections}
        if self.core.setting[0]:
            tree["parameters"] = dict(self.parameters)
        other = CompiledModel(core, json.dumps(tree))
        other._functions, other._origin = self._functions, self
        return other

    def allowing_redundancy(self) -> CompiledModel:
        """The same model with redundant constraints accepted."""
        tree = {**json.loads(self._case), "redundancy": "allow"}
        tree |= {} if self._analyses is None else {"analyses": self._analyses}
        other = CompiledModel(self.core.allowing_redundancy(), json.dumps(tree), self._model)
        other._functions, other._origin = self._functions, self
        return other

    def variant(self, setting: Setting) -> CompiledModel:
        """The model in another setting; see ``kempe.results.phases``."""
        if not any(setting):
            return self
        other = CompiledModel(self.core.variant(*setting), self._case, self._model)
        other._analyses = self._analyses
        other._functions, other._origin = self._functions, self
        return other

    @property
    def released(self) -> tuple[str, ...]:
        """The drivers that no longer act."""
        return tuple(self.core.setting[1])

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
        return vector(self._about["gravity"])

    @property
    def parameters(self) -> Mapping[str, float]:
        """Values of the parameters."""
        return MappingProxyType(Named("parameter", self._about["parameters"]))

    @cached_property
    def tables(self) -> Mapping[str, TableInfo]:
        """The tables, each a function in SI units."""
        return named("table", (TableInfo(self.core, of) for of in self._about["tables"]))

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

    @property
    def n_multipliers(self) -> int:
        """Number of multipliers: of the constraints, then of forces that stick or rest."""
        return int(self._about["n_multipliers"])

    @cached_property
    def all_bodies(self) -> Mapping[str, BodyInfo]:
        """Ground and the moving bodies, in the order of q."""
        return named("body", bodies(self._about["bodies"]))

    @cached_property
    def bodies(self) -> Mapping[str, BodyInfo]:
        """The moving bodies, in the order of q."""
        return named("body", (of for of in self.all_bodies.values() if of.number))

    @property
    def shown_bodies(self) -> Mapping[str, BodyInfo]:
        """The moving bodies, each beam as one with its whole mass."""
        return MappingProxyType(whole(self.bodies.values()))

    @property
    def named_bodies(self) -> Mapping[str, BodyInfo]:
        """The moving bodies, and the ends and named points of beams."""
        return MappingProxyType({k: b for k, b in self.bodies.items() if not b.is_inner})

    @property
    def shown_forces(self) -> Mapping[str, ForceInfo]:
        """The force elements of the file."""
        return MappingProxyType({k: f for k, f in self.forces.items() if f.is_shown})

    @cached_property
    def _all_constraints(self) -> tuple[ConstraintInfo, ...]:
        return tuple(map(constraint, self._about["constraints"]))

    @cached_property
    def constraints(self) -> Mapping[str, ConstraintInfo]:
        """Joints and drivers, in the order of Φ."""
        return named("joint or driver", (of for of in self._all_constraints if of.is_shown))

    def locks(self, beam: str) -> list[ConstraintInfo]:
        """The constraints that lock strains of the pieces of a beam, along the beam."""
        infos = (info for info in self._all_constraints if not info.is_shown)
        return [info for info in infos if info.name.startswith(f"{beam}.")]

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
        return named("force", map(force, self._about["forces"]))

    @cached_property
    def measures(self) -> Mapping[str, MeasureInfo]:
        """The measures, in the order of the file."""
        return named("measure", measure_infos(self))

    @cached_property
    def symbols(self) -> tuple[dict[str, Any], ...]:
        """The symbols of joints, drivers and forces in a drawing, in the order of the elements.

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

    def column_units(self) -> list[str]:
        """Units of the coordinates in the order of q: m, rad, or units of internal coordinates."""
        of_bodies = [("m", "m", "rad")[k] for b in self.bodies.values() for k in range(b.count)]
        return of_bodies + [unit for c in self.constraints.values() for _, unit in c.coordinates]

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

    @cached_property
    def places(self) -> Mapping[str, tuple[str, int]]:
        """The array (q, v or z) and the index in it of each coordinate, rate and state, by name."""
        arrays = {"q": self.column_names(), "v": self.rate_names(), "z": self.state_names()}
        return {name: (of, k) for of, names in arrays.items() for k, name in enumerate(names)}

    @cached_property
    def measured(self) -> Mapping[str, tuple[str, int, int]]:
        """The element, number and order of each position quantity of an element by name."""
        elements: list[ConstraintInfo | ForceInfo] = [
            *self.constraints.values(),
            *self.forces.values(),
        ]
        return {
            f"{info.name}.{name}": (info.name, k, order)
            for info in elements
            for k, of in enumerate(info.measured)
            for order, name in enumerate(of.names)
            if name
        }

    def row_names(self) -> list[str]:
        """Names of the constraint equations in the order of Φ, such as ``A.x``."""
        return [f"{c.name}.{name}" for c in self._all_constraints for name, _ in c.equations]

    def row_units(self) -> list[str]:
        """Units of the constraint equations in the order of Φ: m or rad."""
        return [unit for c in self._all_constraints for _, unit in c.equations]

    def __repr__(self) -> str:
        counts = f"{len(self.bodies)} bodies, {self.n_q} coordinates, {self.n_rows} equations"
        return f"<CompiledModel {self.title!r}: {counts}>"

    def names(self) -> Iterator[str]:
        """Names of all bodies, joints, drivers, forces and measures."""
        yield from self.all_bodies
        yield from self.constraints
        yield from self.forces
        yield from self.measures

    def _column_names(self, of_body: Sequence[str], suffix: str) -> list[str]:
        names = [f"{b.name}.{name}" for b in self.bodies.values() for name in of_body[: b.count]]
        own = [
            f"{c.name}.{name}{suffix}"
            for c in self.constraints.values()
            for name, _ in c.coordinates
        ]
        return names + own

    def _group(self, group: str) -> Mapping[str, ConstraintInfo]:
        own = (of for of in self.constraints.values() if of.group == group)
        return named(group.removesuffix("s"), own)


def _restored(
    model: Model,
    case: str,
    analyses: Mapping[str, Any] | None,
    setting: Setting = ([], [], []),
) -> CompiledModel:
    """A compiled model from its text; the compiled ``model`` itself if its text is equal."""
    made = model.compile() if model.json() == case else CompiledModel.from_case(case)
    made._model = model
    made = made if analyses is None else made.with_analyses(analyses)
    return made.variant(setting)
