"""Laws of kempe in the notation of OndselSolver."""

from __future__ import annotations

import ast
from collections.abc import Mapping

from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel
from kempe.model.constants import value_of

#: Functions of kempe in the notation of the file, where `{}` is the argument.
_FUNCTIONS = {
    "sin": "sin({})",
    "cos": "cos({})",
    "tan": "(sin({0})/cos({0}))",
    "asin": "arcsin({})",
    "atan": "arctan({})",
    "abs": "abs({})",
    "sqrt": "({}^0.5)",
}
_SIGNS = {ast.Add: " + ", ast.Sub: " - ", ast.Mult: "*", ast.Div: "/", ast.Pow: "^"}


def number(value: float) -> str:
    """A number in a formula; a negative one is in parentheses."""
    text = repr(float(value) + 0.0)
    return f"({text})" if value < 0 else text


def translated(model: CompiledModel, place: str, law: object, names: Mapping[str, str]) -> str:
    """A law in the notation of the file; parts that depend on parameters only are numbers.

    Args:
        model: the model with its parameters.
        place: the element and the field, for messages.
        law: a number or a formula of kempe.
        names: variables of kempe, and their names in the file.

    Raises:
        ModelError: the law contains a name or a function that the file cannot contain.
    """
    value = value_of(model, law)
    if value is not None:
        return number(value)
    if not isinstance(law, str):
        raise ModelError(f"{place}: a function of Python cannot be written as asmt", name=place)
    try:
        tree = ast.parse(law.strip().replace("^", "**"), mode="eval").body
        return _Printer(model, names).text(tree)
    except (SyntaxError, RecursionError, _UnknownError) as error:
        why = f": {error}" if isinstance(error, _UnknownError) else ""
        raise ModelError(
            f"{place} = {law!r}{why} cannot be written as asmt",
            name=place,
            hint=f"formulas of {', '.join(names)} with {', '.join(_FUNCTIONS)} can be",
        ) from error


class _UnknownError(Exception):
    """A part of a formula that the file cannot contain."""


class _Printer:
    """Prints the tree of a formula, whose notation is that of Python except for the sign ^."""

    def __init__(self, model: CompiledModel, names: Mapping[str, str]) -> None:
        self.model, self.names = model, names

    def text(self, node: ast.expr) -> str:
        """The text of a part. Sums, products and powers with a variable are in parentheses."""
        written = ast.unparse(node).replace("**", "^")
        if not self.names.keys() & {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}:
            value = value_of(self.model, written)
            if value is None:
                raise _UnknownError(written)
            return number(value)
        match node:
            case ast.Name(id=name):
                return self.names[name]
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return f"(-{self.text(operand)})"
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.text(operand)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _SIGNS:
                return f"({self.text(left)}{_SIGNS[type(op)]}{self.text(right)})"
            case ast.Call(func=ast.Name(id=name), args=[argument]) if name in _FUNCTIONS:
                return _FUNCTIONS[name].format(self.text(argument))
            case ast.Call(func=ast.Name(id=name)):
                raise _UnknownError(f"the function {name}")
            case _:
                raise _UnknownError(written)
