"""Models built in Python from named bodies, joints, drivers and forces."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from kempe import _core
from kempe._upwards import CALLS
from kempe.base.arguments import Explained, explain_methods, missing_attribute
from kempe.base.names import few, unknown
from kempe.base.warn import warn
from kempe.errors import ModelError
from kempe.model.body_methods import BodyMethods
from kempe.model.compiled import BodyInfo, CompiledModel, ConstraintInfo, ForceInfo
from kempe.model.doubts import ModelWarning, doubts
from kempe.model.elements import E, ElementMethods
from kempe.model.functions import Functions
from kempe.model.ground import Ground, with_ground
from kempe.model.lookup_tables import TableInfo
from kempe.model.measure_methods import MeasureMethods
from kempe.model.tree_methods import TreeMethods
from kempe.model.values import (
    Number,
    Outline,
    Pair,
    curves,
    mapping,
    numbers,
    outline,
    pair,
    points,
    refuse,
)

#: Version of the case format.
FORMAT = 1
#: Whether redundant constraints are accepted.
Redundancy: TypeAlias = Literal["refuse", "allow"]
SECTIONS = ("bodies", "joints", "drivers", "forces")
#: The sections whose entries share one namespace.
NAMED = (*SECTIONS, "measures")


class Model(BodyMethods, ElementMethods, MeasureMethods, TreeMethods, metaclass=Explained):
    """A planar mechanism that is built step by step.

    ::

        m = kp.Model("pendulum", gravity=(0, -9.81), parameters={"L": 1})
        m.ground.points(A=(0, 0))
        m.bar("rod", mass=2, length="L", ends=("A", "B"))
        m.revolute("A", "ground.A", "rod.A")

    Numbers are in SI units and angles in rad. A string is a formula in the parameters. The order of
    the calls determines the order in q and Φ. Every type of joint, driver and force has a method
    of that name; see ``kempe.model.elements``.

    Args:
        title: title of the model.
        gravity: acceleration of free fall, m/s²; zero by default.
        parameters: named numbers, or formulas in other parameters.
        redundancy: "allow" accepts redundant constraints and computes the smallest multipliers that
            carry the loads. By default, redundant constraints are an error.

    Raises:
        ModelError: a value is invalid; the message names the field.
    """

    def __init__(
        self,
        title: str = "",
        *,
        gravity: Pair = (0.0, 0.0),
        parameters: Mapping[str, Number] | None = None,
        redundancy: Redundancy | None = None,
    ) -> None:
        if not isinstance(title, str):
            refuse("title", f"{title!r} is not a text")
        if redundancy is not None and not (
            isinstance(redundancy, str) and redundancy in ("refuse", "allow")
        ):
            refuse("redundancy", f"{redundancy!r} is neither 'refuse' nor 'allow'")
        self._tree: dict[str, Any] = {
            "kempe": FORMAT,
            "title": title,
            "gravity": pair(gravity, "gravity"),
            **({"redundancy": redundancy} if redundancy else {}),
            "parameters": numbers(parameters, "parameters"),
            "tables": {},
            **{section: {} for section in NAMED},
        }
        self._source: tuple[_core.Case, dict[str, float | str]] | None = None
        self._compiled: CompiledModel | None = None
        self._files = {}

    # --- writing ----------------------------------------------------------------------------------

    @property
    def ground(self) -> Ground:
        """The fixed body."""
        return Ground(self)

    def _add(self, element: E) -> E:
        self._refuse_taken(element.section, element.name)
        self._tree[element.section][element.name] = element.tree()
        self._changed()
        return element

    def _refuse_taken(self, of: str, name: str) -> None:
        path = f"{of}.{name}"
        if _core.is_reserved(name):
            refuse(path, "this name is reserved; choose another")
        for section in NAMED:
            if name in self._tree[section]:
                refuse(path, f"the name is taken by {section}.{name}; choose another")

    def _ground_points(self, given: Mapping[str, Pair]) -> None:
        self._on_ground("point", given, points)

    def _ground_curves(self, given: Mapping[str, Mapping[str, Any]]) -> None:
        self._on_ground("curve", given, curves)

    def _ground_outline(self, given: Outline) -> None:
        checked = outline(given, "bodies.ground.outline")
        bodies = self._tree["bodies"]
        ground = {**bodies.get("ground", {}), "outline": checked}
        self._tree["bodies"] = {"ground": ground} | {
            name: body for name, body in bodies.items() if name != "ground"
        }
        self._changed()

    def _on_ground(
        self, what: str, given: Mapping[str, Any], check: Callable[[object, str], dict[str, Any]]
    ) -> None:
        self._tree["bodies"] = with_ground(self._tree["bodies"], what, given, check)
        self._changed()

    def _changed(self) -> None:
        self._source = None
        self._compiled = None

    # --- reading ----------------------------------------------------------------------------------

    @classmethod
    def from_tree(
        cls,
        tree: Mapping[str, Any],
        source: _core.Case | None = None,
        folder: Path | None = None,
    ) -> Model:
        """A model from the tree of a case.

        Args:
            tree: the case as nested mappings, structured as the file.
            source: the case in the core with the same tree; its errors contain line numbers.
            folder: the folder of the files of tables; by default the current folder.

        Raises:
            FileError: the file of a table cannot be read.
        """
        model = cls._of(tree)
        model._read_files(folder or Path())
        model._source = None if source is None else (model._supplied(source), {})
        return model

    @classmethod
    def _of(cls, tree: Mapping[str, Any]) -> Model:
        """A model with a copy of a tree."""
        model = cls()
        tree = mapping(tree, "tree", "{'bodies': {…}}")
        kept = {key: tree[key] for key in (*model._tree, "redundancy") if key in tree}
        model._tree.update(copy.deepcopy(kept))
        return model

    @classmethod
    def of_compiled(cls, compiled: CompiledModel) -> Model:
        """The model of a compiled model that was made from a text."""
        model = cls.from_tree(json.loads(compiled.case))
        model._compiled = compiled
        return model

    def __getstate__(self) -> dict[str, Any]:
        """Everything that the text of the model contains; a copy has a tree of its own."""
        tree = copy.deepcopy(self._tree)
        return {**vars(self), "_tree": tree, "_source": None, "_compiled": None}

    def with_parameters(self, parameters: Mapping[str, Number]) -> Model:
        """A copy of the model with other values of some parameters.

        Raises:
            ModelError: the model has no such parameter, or a value is not a number or a formula.
        """
        changed = numbers(parameters, "parameters")
        for name in changed:
            if name not in self._tree["parameters"]:
                if self._source is not None:  # the error gives the line of the file
                    self._source[0].model(json.dumps(changed, allow_nan=False))
                raise unknown("parameter", name, self._tree["parameters"])
        model = Model._of(self._tree)
        model._files = dict(self._files)
        source, overrides = self._written()
        model._source = (source, {**overrides, **changed})
        model._tree["parameters"].update(changed)
        return model

    def _written(self) -> tuple[_core.Case, dict[str, float | str]]:
        """The model as a case of the core, and parameters that replace those of the case."""
        return self._source or (_core.Case(self.text(), "json", None), {})

    def compile(self) -> CompiledModel:
        """The compiled model; it is kept until the model changes.

        Raises:
            ModelError: the model is invalid; ``problems`` lists all problems.
        """
        if self._compiled is None:
            source, overrides = self._written()
            functions = Functions(self._tree)
            given = (functions.described(), functions.state) if functions.laws else ()
            core = source.model(json.dumps(overrides, allow_nan=False), *given)
            self._compiled = CompiledModel(core, self.text(), self, functions)
            for doubt in doubts(self._tree["forces"], self._constant):
                warn(doubt, ModelWarning)
        return self._compiled

    def _constant(self, given: Any) -> float | None:
        """The number of a field; None if it has none, or varies."""
        if not isinstance(given, str):
            return float(given) if isinstance(given, int | float) else None
        parameters, name = self.compile().parameters, "value_of_the_field"
        if given in parameters:
            return parameters[given]
        try:
            formula = Model(parameters={**parameters, name: given})
            return formula.compile().parameters[name]
        except ModelError:  # a formula in the position or the time
            return None

    @property
    def title(self) -> str:
        """Title of the model."""
        return str(self._tree["title"])

    @property
    def n_q(self) -> int:
        """Number of coordinates: those of the moving bodies and the internal ones of joints."""
        return self.compile().n_q

    @property
    def n_z(self) -> int:
        """Number of first-order states of force elements."""
        return self.compile().n_z

    @property
    def n_rows(self) -> int:
        """Number of constraint equations."""
        return self.compile().n_rows

    @property
    def gravity(self) -> tuple[float, float]:
        """Acceleration of free fall, m/s²."""
        return self.compile().gravity

    @property
    def parameters(self) -> Mapping[str, float]:
        """Values of the parameters."""
        return self.compile().parameters

    @property
    def tables(self) -> Mapping[str, TableInfo]:
        """The tables, each a function in SI units: ``m.tables["lift"](x, derivative=1)``."""
        return self.compile().tables

    @property
    def bodies(self) -> Mapping[str, BodyInfo]:
        """The moving bodies with numerical values, in the order of q."""
        return self.compile().bodies

    @property
    def joints(self) -> Mapping[str, ConstraintInfo]:
        """The joints with numerical values, in the order of Φ."""
        return self.compile().joints

    @property
    def drivers(self) -> Mapping[str, ConstraintInfo]:
        """The drivers with numerical values, in the order of Φ."""
        return self.compile().drivers

    @property
    def forces(self) -> Mapping[str, ForceInfo]:
        """The force elements with numerical values."""
        return self.compile().forces

    @property
    def constraints(self) -> Mapping[str, ConstraintInfo]:
        """Joints and drivers with numerical values, in the order of Φ."""
        return self.compile().constraints

    @property
    def all_bodies(self) -> Mapping[str, BodyInfo]:
        """Ground and the moving bodies with numerical values, in the order of q."""
        return self.compile().all_bodies

    @property
    def redundancy(self) -> str:
        """Whether redundant constraints are accepted: "allow" or "refuse"."""
        return self.compile().redundancy

    def column_names(self) -> list[str]:
        """Names of the coordinates in the order of q, such as ``crank.angle``."""
        return self.compile().column_names()

    def rate_names(self) -> list[str]:
        """Names of the velocities in the order of v, such as ``crank.omega``."""
        return self.compile().rate_names()

    def state_names(self) -> list[str]:
        """Names of the first-order states in the order of z, such as ``motor.current``."""
        return self.compile().state_names()

    def state_units(self) -> list[str]:
        """Units of the first-order states in the order of z."""
        return self.compile().state_units()

    def row_names(self) -> list[str]:
        """Names of the constraint equations in the order of Φ, such as ``A.x``."""
        return self.compile().row_names()

    def row_units(self) -> list[str]:
        """Units of the constraint equations in the order of Φ: m or rad."""
        return self.compile().row_units()

    if not TYPE_CHECKING:  # a type checker refuses unknown names by itself

        def __getattr__(self, name: str) -> Any:
            raise AttributeError(missing_attribute("Model", name, dir(type(self))))

    def __repr__(self) -> str:
        moving = {section: dict(self._tree[section]) for section in SECTIONS}
        moving["bodies"].pop("ground", None)
        parts = [f"{section} {few(names)}" for section, names in moving.items() if names]
        return f"<Model {self.title!r}: {'; '.join(parts) or 'empty'}>"

    def _repr_html_(self) -> str:
        return str(CALLS["html"](self))


explain_methods(Model)


def compiled_model(model: Model | CompiledModel) -> CompiledModel:
    """The compiled model.

    Raises:
        ModelError: the argument is not a model, or the model is invalid.
    """
    if isinstance(model, CompiledModel):
        return model
    if isinstance(model, Model):
        return model.compile()
    raise ModelError(f"{model!r} is not a model", hint="kp.Model(…) creates one")
