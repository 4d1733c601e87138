"""A matrix of the equations of motion with the names of its rows and columns."""

from __future__ import annotations

import html
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from kempe.arrays import Floats
from kempe.errors import ModelError
from kempe.matrices import writing
from kempe.names import one_of
from kempe.values import instance

if TYPE_CHECKING:
    from kempe.compiled import CompiledModel
    from kempe.matrices.values import Matrices
    from kempe.model import Model
    from kempe.state import State
    from kempe.values import Number

MatrixName: TypeAlias = Literal["M", "Phi", "Phi_q", "nu", "gamma", "Q", "kkt", "rhs", "a", "lam"]
#: The matrices that can be shown, each with its symbol and its meaning.
NAMES: Mapping[str, tuple[str, str]] = {
    "M": ("M", "mass matrix"),
    "Phi": ("Φ", "residuals of the constraints, m and rad"),
    "Phi_q": ("Φ_q", "Jacobian"),
    "nu": ("ν", "right side of the velocity equation, -Φ_t"),
    "gamma": ("γ", "right side of the acceleration equation"),
    "Q": ("Q", "generalized forces, N and N·m"),
    "kkt": ("[M Φ_qᵀ; Φ_q 0]", "augmented matrix (Haug 6.3.18)"),
    "rhs": ("[Q; γ]", "right side of the augmented equations (Haug 6.3.18)"),
    "a": ("q̈", "accelerations, m/s² and rad/s²"),
    "lam": ("λ", "multipliers, N and N·m"),
}

#: Entries below this fraction of the largest are rounding errors and are shown as zeros. A residual
#: consists of rounding errors, so that all of its entries are shown.
ROUNDING = 1e-13


@dataclass(frozen=True, repr=False)
class Labelled:
    """A matrix or a column with names; ``print`` shows it aligned.

    Attributes:
        name: such as ``Phi_q``.
        values: (rows, columns), or (rows,) for a column.
        rows: names of the rows, such as ``A.x``.
        columns: names of the columns, such as ``crank.angle``; empty for a column.
    """

    name: str
    values: Floats
    rows: tuple[str, ...]
    columns: tuple[str, ...]

    @property
    def title(self) -> str:
        """One line: symbol, meaning and size."""
        symbol, meaning = NAMES[self.name]
        size = " × ".join(map(str, self.values.shape))
        return f"{symbol}, {meaning}, {size}"

    def cells(self) -> Floats:
        """The values as a matrix (rows, columns), with rounding errors set to zero."""
        full: Floats = self.values.reshape(len(self.rows), -1)
        if self.name == "Phi":
            return full
        largest = float(np.abs(full).max(initial=0.0))
        return np.where(np.abs(full) <= ROUNDING * largest, 0.0, full)

    def text(self) -> str:
        """Aligned lines with the names, zeros as dots."""
        return writing.text(self.rows, self.columns, self.cells())

    def csv(self) -> str:
        """Comma-separated lines with a header, every digit kept."""
        header = self.columns or (self.name,)
        return writing.csv(self.rows, header, self.values.reshape(len(self.rows), -1))

    def latex(self) -> str:
        """A ``bmatrix`` of amsmath with the names of rows and columns beside it."""
        return writing.latex(self.name, self.rows, self.columns, self.cells())

    def _repr_latex_(self) -> str:
        body = writing.latex_body(self.name, self.rows, self.columns, self.cells())
        return f"$\\displaystyle {body}$"

    def _repr_html_(self) -> str:
        from kempe.notebook import table

        header = ["", *(self.columns or (self.name,))]
        numbers = ([writing.number(value) for value in row] for row in self.cells().tolist())
        rows = [[name, *cells] for name, cells in zip(self.rows, numbers, strict=True)]
        return f"<div><b>{html.escape(self.title)}</b>{table(header, rows)}</div>"

    def __array__(self, dtype: object = None, copy: bool | None = None) -> Floats:
        """The values, for conversion by numpy."""
        return np.array(self.values, dtype=dtype, copy=copy)  # type: ignore[call-overload,no-any-return]

    def __str__(self) -> str:
        return f"{self.title}\n{self.text()}"

    def __repr__(self) -> str:
        size = " × ".join(map(str, self.values.shape))
        return f"<Labelled {self.name}: {size}, {NAMES[self.name][1]}>"


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
        assembly: coordinates that an assembly would hold by ``set``. Each adds the row of a driver,
            so that "Phi_q" is the matrix of the Newton iteration.

    Returns:
        The matrix; ``text()``, ``csv()`` and ``latex()`` write it.

    Raises:
        ModelError: there is no such matrix, or the state is of another model.
        SingularityError: "a" or "lam" in a singular position.
    """
    one_of("matrix", what, NAMES)
    _refuse_foreign(model, state)
    if what in ("a", "lam"):
        if assembly:
            raise ModelError(f"{what} is not of the assembly", hint="leave assembly out")
        rows = state.compiled.column_names() if what == "a" else state.compiled.row_names()
        return Labelled(what, getattr(state, what), tuple(rows), ())
    return _of(state.matrices(assembly), what)


def _of(found: Matrices, what: str) -> Labelled:
    rows, columns = found.rows, found.columns
    if what == "rhs":
        return Labelled(what, np.concatenate([found.Q, found.gamma]), (*columns, *rows), ())
    values = getattr(found, what)
    if what == "kkt":
        labels = (*columns, *(f"λ {row}" for row in rows))
        return Labelled(what, values, (*columns, *rows), labels)
    if what in ("M", "Phi_q"):
        return Labelled(what, values, columns if what == "M" else rows, columns)
    return Labelled(what, values, columns if what == "Q" else rows, ())


def _refuse_foreign(model: Model | CompiledModel, state: State) -> None:
    from kempe.model import compiled_model
    from kempe.state import State

    instance(state, State, "a state")
    if list(compiled_model(model).bodies) != list(state.compiled.bodies):
        raise ModelError("the state is of another model", hint="assemble this model")
