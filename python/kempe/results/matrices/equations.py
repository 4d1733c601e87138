"""The equations of joints and drivers as formulas with the names of a model.

The core evaluates the residual of each joint with symbolic numbers, simplifies and differentiates
it, and prints the result. This module arranges the texts.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from kempe import _core
from kempe.base.arguments import explained
from kempe.model.model import Model, compiled_model
from kempe.results.matrices.symbolic import Symbolic, symbolic
from kempe.results.matrices.writing import named

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel, ConstraintInfo


@dataclass(frozen=True)
class Texts:
    """The equations of a joint or driver in one form of print.

    Attributes:
        columns: the coordinates by which Φ is differentiated.
        definitions: names of parts of the equations, each with its formula.
        residual: Φ of each equation.
        jacobian: ∂Φ/∂q of each equation by column.
        gamma: γ of each equation.
    """

    columns: tuple[str, ...]
    definitions: tuple[tuple[str, str], ...]
    residual: tuple[str, ...]
    jacobian: tuple[tuple[str, ...], ...]
    gamma: tuple[str, ...]


@dataclass(frozen=True, repr=False)
class Equations:
    """The equations of a joint or driver.

    Attributes:
        name: of the joint or driver.
        type: the ``type`` in the file.
        rows: names of the equations, such as ``C.x``.
        expressions: the equations in the language of expressions, which can be evaluated.
        symbols: the equations in LaTeX.
        points: the points of the joint that occur, such as ``coupler.C``, in the frames of their
            bodies, m.
    """

    name: str
    type: str
    rows: tuple[str, ...]
    expressions: Texts
    symbols: Texts
    points: Mapping[str, tuple[float, float]]

    def __repr__(self) -> str:
        return f"<Equations of {self.name} ({self.type}): {', '.join(self.rows)}>"

    def __str__(self) -> str:
        return self.text()

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self._aligned('aligned')}$"

    def text(self) -> str:
        """Lines of text, in the language of expressions."""
        told = self.expressions
        lines = [f"{self.name} ({self.type})"]
        lines += [f"  {name} = {formula}" for name, formula in told.definitions]
        for k, row in enumerate(self.rows):
            lines.append(f"  Φ[{row}] = {told.residual[k]}")
            lines += [
                f"    ∂Φ[{row}]/∂({column}) = {entry}"
                for column, entry in zip(told.columns, told.jacobian[k], strict=True)
                if entry != "0"
            ]
            lines.append(f"    γ[{row}] = {told.gamma[k]}")
        if self.points:
            places = (f"{name} = ({x:.6g}, {y:.6g}) m" for name, (x, y) in self.points.items())
            lines.append(f"  with {', '.join(places)} in the frame of its body")
        return "\n".join(lines)

    def latex(self) -> str:
        """Displayed formulas for amsmath."""
        return f"% {self.name} ({self.type})\n{self._aligned('align*')}\n"

    def to_sympy(self) -> Symbolic:
        """The equations as matrices of SymPy, in symbols such as ``crank.angle``.

        Raises:
            ModelError: SymPy is not installed.
        """
        return symbolic(self.expressions)

    def _aligned(self, environment: str) -> str:
        told = self.symbols
        lines = [f"{name} &= {formula}" for name, formula in told.definitions]
        for k, row in enumerate(self.rows):
            label = named(row)
            lines.append(rf"\Phi_{{{label}}} &= {told.residual[k]}")
            lines += [
                rf"\frac{{\partial \Phi_{{{label}}}}}{{\partial {column}}} &= {entry}"
                for column, entry in zip(told.columns, told.jacobian[k], strict=True)
                if entry != "0"
            ]
            lines.append(rf"\gamma_{{{label}}} &= {told.gamma[k]}")
        body = " \\\\\n".join(f"  {line}" for line in lines)
        return f"\\begin{{{environment}}}\n{body}\n\\end{{{environment}}}"


@explained
def equations(model: Model | CompiledModel) -> list[Equations]:
    """The equations of all joints and drivers of a model, in the order of Φ.

    Args:
        model: the mechanism.
    """
    compiled = compiled_model(model)
    tree = compiled.tree
    infos = compiled.constraints.values()
    return [_of(compiled, info, tree[info.group][info.name]) for info in infos]


def _of(compiled: CompiledModel, info: ConstraintInfo, entry: Mapping[str, Any]) -> Equations:
    written = {field: value for field, value in entry.items() if isinstance(value, str)}

    def printed(form: str) -> dict[str, Any]:
        told: dict[str, Any] = json.loads(_core.formulas(compiled.core, info.name, written, form))
        return told

    expressions = printed("expression")
    points = {written.get("i", ""): info.point_i, written.get("j", ""): info.point_j}
    used = {name.rpartition(".")[0] for name in expressions["names"]}
    return Equations(
        name=info.name,
        type=info.type,
        rows=tuple(f"{info.name}.{name}" for name, _ in info.equations),
        expressions=_texts(expressions),
        symbols=_texts(printed("latex")),
        points={name: at for name, at in points.items() if name and name in used},
    )


def _texts(told: Mapping[str, Any]) -> Texts:
    rows = told["rows"]
    return Texts(
        columns=tuple(told["columns"]),
        definitions=tuple((name, formula) for name, formula in told["definitions"]),
        residual=tuple(row["residual"] for row in rows),
        jacobian=tuple(tuple(row["jacobian"]) for row in rows),
        gamma=tuple(row["gamma"] for row in rows),
    )
