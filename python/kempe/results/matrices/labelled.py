"""A matrix of the equations of motion with the names of its rows and columns."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.base.display_units import chosen_for, display, units
from kempe.base.html import block, table
from kempe.base.names import one_of
from kempe.errors import ModelError
from kempe.model.model import Model, compiled_model
from kempe.model.values import instance
from kempe.results.matrices import writing
from kempe.results.quantities import FORCE_UNITS
from kempe.results.state import State

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel
    from kempe.model.values import Number
    from kempe.results.matrices.values import Matrices

MatrixName: TypeAlias = Literal["M", "Phi", "Phi_q", "nu", "gamma", "Q", "kkt", "rhs", "a", "lam"]
#: The matrices that can be shown, each with its symbol, its meaning, and the units of a column.
NAMES: Mapping[str, tuple[str, str, tuple[str, ...]]] = {
    "M": ("M", "mass matrix", ()),
    "Phi": ("Φ", "residuals of the constraints", ("m", "rad")),
    "Phi_q": ("Φ_q", "Jacobian", ()),
    "nu": ("ν", "right side of the velocity equation, -Φ_t", ("m/s", "rad/s")),
    "gamma": ("γ", "right side of the acceleration equation", ("m/s^2", "rad/s^2")),
    "Q": ("Q", "generalized forces", ("N", "N*m")),
    "kkt": ("[M Φ_qᵀ; Φ_q 0]", "augmented matrix (Haug 6.3.18)", ()),
    "rhs": (
        "[Q; γ]",
        "right side of the augmented equations (Haug 6.3.18)",
        ("N", "N*m", "m/s^2", "rad/s^2"),
    ),
    "a": ("q̈", "accelerations", ("m/s^2", "rad/s^2")),
    "lam": ("λ", "multipliers", ("N", "N*m")),
}

#: Entries below this fraction of the largest are rounding errors and are shown as zeros. A residual
#: consists of rounding errors, so that all of its entries are shown.
ROUNDING = 1e-13


@dataclass(frozen=True, repr=False)
class Labelled:
    """A matrix or a column with names; ``print`` shows it with aligned columns.

    Numbers are printed in display units (``kp.units``): in the units of the numbers of a column, or
    of the quantities that a matrix connects. Units other than SI are printed after the names.

    Attributes:
        name: the name, such as ``Phi_q``.
        values: (rows, columns), or (rows,) for a column; always in SI units.
        rows: names of the rows, such as ``A.x``.
        columns: names of the columns, such as ``crank.angle``; empty for a column.
        row_units: SI units of the rows of the product of matrix and vector.
        column_units: SI units of the components of the vector.
    """

    name: str
    values: Floats
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    row_units: tuple[str, ...]
    column_units: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """One line: symbol, meaning, units and size."""
        symbol, meaning, column = NAMES[self.name]
        words = [symbol, meaning]
        if column:
            *most, last = (display(unit).symbol for unit in column)
            words.append(f"{', '.join(most)} and {last}")
        elif self._is_converted:
            words.append(f"in {', '.join(units().chosen)}")
        return ", ".join([*words, " × ".join(map(str, self.values.shape))])

    @property
    def _is_converted(self) -> bool:
        return any(chosen_for(unit) for unit in (*self.row_units, *self.column_units))

    def _names(self, names: Sequence[str], of: Sequence[str]) -> list[str]:
        """Names, with units other than SI."""
        if not self._is_converted:
            return list(names)
        return [f"{name} [{display(unit).unit}]" for name, unit in zip(names, of, strict=True)]

    def _labels(self) -> tuple[list[str], list[str]]:
        """Names of rows and columns."""
        columns = self._names(self.columns, self.column_units)
        return self._names(self.rows, self.row_units), columns

    @property
    def _full(self) -> Floats:
        # a model without constraints has a Jacobian without rows
        return self.values.reshape(len(self.rows), -1 if self.rows else len(self.columns))

    def _shown(self, full: Floats) -> Floats:
        """A matrix (rows, columns) in display units."""
        if not self._is_converted:
            return full
        out = np.array([display(unit).divisor for unit in self.row_units])
        factors = np.array([display(unit).divisor for unit in self.column_units] or [1.0])
        shown: Floats = full * factors / out[:, None]
        return shown

    def cells(self) -> Floats:
        """The numbers as written, (rows, columns), with rounding errors set to zero."""
        full = self._full
        if self.name != "Phi":
            largest = float(np.abs(full).max(initial=0.0))
            full = np.where(np.abs(full) <= ROUNDING * largest, 0.0, full)
        return self._shown(full)

    def text(self) -> str:
        """Aligned lines with the names, zeros as dots."""
        return writing.text(*self._labels(), self.cells())

    def csv(self) -> str:
        """Comma-separated lines with a header, every digit kept."""
        rows, columns = self._labels()
        return writing.csv(rows, columns or [self.name], self._shown(self._full))

    def latex(self) -> str:
        """A ``bmatrix`` of amsmath with the names of rows and columns beside it."""
        return writing.latex(self.name, *self._labels(), self.cells())

    def _repr_latex_(self) -> str:
        body = writing.latex_body(self.name, *self._labels(), self.cells())
        return f"$\\displaystyle {body}$"

    def _repr_html_(self) -> str:
        names, columns = self._labels()
        header = ["", *(columns or [self.name])]
        numbers = ([writing.number(value) for value in row] for row in self.cells().tolist())
        rows = [[name, *cells] for name, cells in zip(names, numbers, strict=True)]
        return block(self.title, table(header, rows))

    def __array__(self, dtype: object = None, copy: bool | None = None) -> Floats:
        """The values, for conversion by numpy."""
        return np.array(self.values, dtype=dtype, copy=copy)  # type: ignore[call-overload,no-any-return]

    def __str__(self) -> str:
        return f"{self.title}\n{self.text()}"

    def __repr__(self) -> str:
        size = " × ".join(map(str, self.values.shape))
        return f"<Labelled {self.name}: {size}, {NAMES[self.name][1]}>"


@explained
def show(
    model: Model | CompiledModel,
    state: State,
    what: MatrixName | str = "Phi_q",
    *,
    assembly: Mapping[str, Number] | None = None,
) -> Labelled:
    """A matrix of the equations of motion with its names, to be printed.

    Args:
        model: the mechanism.
        state: the state at which the matrix is evaluated.
        what: "Phi_q", "M", "Phi", "nu", "gamma", "Q", "kkt", "rhs", "a" or "lam".
        assembly: coordinates that an assembly prescribes by ``set``. Each adds a row as a driver
            does, so that "Phi_q" is the matrix of the Newton iteration.

    Returns:
        The matrix; ``text()``, ``csv()`` and ``latex()`` write it.

    Raises:
        ModelError: there is no such matrix, or the state is of another model.
        SingularityError: "a" or "lam" in a singular position.
    """
    one_of("matrix", what, NAMES)
    _refuse_foreign(model, state)
    known = state.compiled
    coordinates = dict(zip(known.column_names(), known.column_units(), strict=True))
    if what in ("a", "lam"):
        if assembly:
            raise ModelError(f"{what} is not of the assembly", hint="leave assembly out")
        rows = coordinates if what == "a" else known.row_names()
        of = (
            [*map(_acceleration, coordinates.values())]
            if what == "a"
            else _duals(known.row_units())
        )
        return Labelled(what, getattr(state, what), tuple(rows), (), tuple(of))
    found = state.matrices(assembly)
    return _of(found, what, list(coordinates.values()), list(found.units))


def _of(found: Matrices, what: str, q: list[str], phi: list[str]) -> Labelled:
    """A matrix with its names; ``q`` and ``phi`` are the units of the coordinates and of Φ."""
    rows, columns = found.rows, found.columns
    motion, forces = [*map(_acceleration, q)], _duals(q)
    if what == "rhs":
        of = (*forces, *map(_acceleration, phi))
        return Labelled(what, np.concatenate([found.Q, found.gamma]), (*columns, *rows), (), of)
    values = getattr(found, what)
    if what == "kkt":
        labels = (*columns, *(f"λ {row}" for row in rows))
        of = (*forces, *map(_acceleration, phi))
        return Labelled(what, values, (*columns, *rows), labels, of, (*motion, *_duals(phi)))
    if what == "M":
        return Labelled(what, values, columns, columns, tuple(forces), tuple(motion))
    if what == "Phi_q":
        return Labelled(what, values, rows, columns, tuple(phi), tuple(q))
    if what == "Q":
        return Labelled(what, values, columns, (), tuple(forces))
    suffix = {"Phi": "", "nu": "/s", "gamma": "/s^2"}[what]
    return Labelled(what, values, rows, (), tuple(f"{unit}{suffix}" for unit in phi))


def _acceleration(unit: str) -> str:
    return f"{unit}/s^2"


def _duals(coordinates: Iterable[str]) -> list[str]:
    """Units of generalized forces: force times coordinate is an energy."""
    return [FORCE_UNITS.get(unit, f"J/{unit}") for unit in coordinates]


def _refuse_foreign(model: Model | CompiledModel, state: State) -> None:
    instance(state, State, "a state")
    if list(compiled_model(model).bodies) != list(state.compiled.bodies):
        raise ModelError("the state is of another model", hint="assemble this model")
