"""The equations of a joint as SymPy expressions."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from kempe.base.exports import needed
from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.results.matrices.equations import Texts

#: A name, in backticks or of parts with points, and the bracket behind a function.
_NAME = re.compile(r"`([^`]+)`|((?!\d)\w+(?:\.(?!\d)\w+)*)(\s*\()?")
#: Functions of the language of expressions that SymPy calls otherwise.
_FUNCTIONS = {"abs": "Abs", "min": "Min", "max": "Max", "ln": "log"}


@dataclass(frozen=True)
class Symbolic:
    """The equations of a joint or driver for SymPy.

    Attributes:
        symbols: the symbols by name, such as ``crank.angle``.
        columns: the coordinates by which Φ is differentiated.
        residual: Φ, a column.
        jacobian: ∂Φ/∂q, a row for each equation.
        gamma: γ, a column.
    """

    symbols: Mapping[str, Any]
    columns: tuple[str, ...]
    residual: Any
    jacobian: Any
    gamma: Any


def symbolic(texts: Texts) -> Symbolic:
    """Equations in the language of expressions as matrices of SymPy.

    Raises:
        ModelError: SymPy is not installed, or has no form for one of the formulas.
    """
    sympy = needed("sympy", "sympy", "to_sympy")
    read = _Reader(sympy)
    for name, formula in texts.definitions:
        read.known[name] = read.expression(formula)
    residual = _column(sympy, [read.expression(text) for text in texts.residual])
    rows = [[read.expression(text) for text in row] for row in texts.jacobian]
    jacobian = sympy.Matrix(len(rows), len(texts.columns), [of for row in rows for of in row])
    gamma = _column(sympy, [read.expression(text) for text in texts.gamma])
    return Symbolic(dict(read.symbols), texts.columns, residual, jacobian, gamma)


def _column(sympy: Any, values: Sequence[Any]) -> Any:
    return sympy.Matrix(len(values), 1, list(values))


class _Reader:
    """Reads formulas, in which equal names are equal symbols."""

    def __init__(self, sympy: Any) -> None:
        self._sympy = sympy
        self.symbols: dict[str, Any] = {}
        #: The expressions of named parts of the equations.
        self.known: dict[str, Any] = {"pi": sympy.pi, "deg": sympy.pi / 180}

    def expression(self, text: str) -> Any:
        given: dict[str, Any] = {}

        def placed(match: re.Match[str]) -> str:
            quoted, name, bracket = match.groups()
            value = self._function(name) if bracket else self._symbol(quoted or name)
            given[f"v{len(given)}"] = value
            return f"v{len(given) - 1}{bracket or ''}"

        plain = _NAME.sub(placed, re.sub(r"(?<=\d)[eE](?=[-+]?\d)", "\0", text))
        plain = plain.replace("\0", "e").replace("^", "**")
        try:
            return self._sympy.parse_expr(plain, local_dict=given)
        except (SyntaxError, TypeError, ValueError) as error:
            raise ModelError(f"SymPy has no form for the formula {text!r}") from error

    def _function(self, name: str) -> Any:
        known = getattr(self._sympy, _FUNCTIONS.get(name, name), None)
        return known if callable(known) else self._sympy.Function(name)

    def _symbol(self, name: str) -> Any:
        if name in self.known:
            return self.known[name]
        return self.symbols.setdefault(name, self._sympy.Symbol(name, real=True))
