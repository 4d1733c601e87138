"""Formulas as trees: read from a text, with names put in, written as text and as LaTeX.

Only what formulas of elements need: sums, products, powers and functions. Zeros and ones that come
in with the numbers of a model are folded away, so that a pin at an origin leaves no arm behind.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

#: How tightly a formula binds: a sum needs brackets in a product, and so on.
SUM, PRODUCT, POWER, ATOM = range(4)


@dataclass(frozen=True)
class Term:
    """A formula.

    Attributes:
        kind: "number", "name", "+", "-" (of one), "*", "/", "^", or the name of a function.
        parts: the formulas in it.
        word: digits of a number, or a name.
    """

    kind: str
    parts: tuple[Term, ...] = ()
    word: str = ""

    def names(self) -> Iterator[str]:
        """All names in it."""
        if self.kind == "name":
            yield self.word
        for part in self.parts:
            yield from part.names()


ZERO, ONE = Term("number", word="0"), Term("number", word="1")


def parse(text: str) -> Term:
    """The formula in a text.

    Raises:
        ValueError: it holds something that formulas of elements do not.
    """
    try:
        return _read(ast.parse(" ".join(text.split()).replace("^", "**"), mode="eval").body)
    except SyntaxError as error:
        raise ValueError(f"{text!r} is not a formula") from error


def _read(node: ast.expr) -> Term:  # noqa: PLR0911 - one for each kind of node
    match node:
        case ast.Constant(value=int() | float() as value):
            return Term("number", word=f"{value:.12g}")
        case ast.Name() | ast.Attribute():
            return Term("name", word=ast.unparse(node))
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return negative(_read(operand))
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            return plus(_read(left), _read(right))
        case ast.BinOp(left=left, op=ast.Sub(), right=right):
            return plus(_read(left), negative(_read(right)))
        case ast.BinOp(left=left, op=ast.Mult(), right=right):
            return times(_read(left), _read(right))
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            return Term("/", (_read(left), _read(right)))
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            return power(_read(left), _read(right))
        case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]):
            return function(name, _read(argument))
    raise ValueError(f"{ast.unparse(node)!r} is not part of a formula")


def negative(a: Term) -> Term:
    """The opposite -a."""
    if a == ZERO:
        return ZERO
    if a.kind == "-":
        return a.parts[0]
    if a.kind == "+":
        return Term("+", tuple(map(negative, a.parts)))
    return Term("-", (a,))


def plus(a: Term, b: Term) -> Term:
    """The sum a + b."""
    parts = [
        part
        for term in (a, b)
        for part in (term.parts if term.kind == "+" else (term,))
        if part != ZERO
    ]
    if not parts:
        return ZERO
    return parts[0] if len(parts) == 1 else Term("+", tuple(parts))


def times(a: Term, b: Term) -> Term:
    """The product a b."""
    if ZERO in (a, b):
        return ZERO
    if "-" in (a.kind, b.kind):
        bare = [term.parts[0] if term.kind == "-" else term for term in (a, b)]
        product = times(*bare)
        return product if a.kind == b.kind else negative(product)
    if ONE in (a, b):
        return b if a == ONE else a
    parts = [part for term in (a, b) for part in (term.parts if term.kind == "*" else (term,))]
    return Term("*", tuple(parts))


def power(a: Term, b: Term) -> Term:
    """The power a^b."""
    return a if a in (ZERO, ONE) or b == ONE else Term("^", (a, b))


def function(name: str, a: Term) -> Term:
    """A function of one argument; those of zero that are known are folded."""
    if a == ZERO and name in ("sin", "cos"):
        return ONE if name == "cos" else ZERO
    if a.kind == "-" and name in ("sin", "cos"):  # odd and even
        inner = Term(name, a.parts)
        return inner if name == "cos" else negative(inner)
    return Term(name, (a,))


def put(term: Term, names: Mapping[str, Term]) -> Term:  # noqa: PLR0911 - as above
    """The formula with names replaced, and folded anew."""
    if term.kind in ("number", "name"):
        return names.get(term.word, term) if term.kind == "name" else term
    parts = [put(part, names) for part in term.parts]
    match term.kind:
        case "+":
            total = ZERO
            for part in parts:
                total = plus(total, part)
            return total
        case "*":
            product = ONE
            for part in parts:
                product = times(product, part)
            return product
        case "-":
            return negative(parts[0])
        case "^":
            return power(*parts)
        case "/":
            return ZERO if parts[0] == ZERO else Term("/", tuple(parts))
        case "ddt" if not any(name == "t" or "." in name for name in parts[0].names()):
            return ZERO  # the second derivative in time of what does not change
        case name:
            return function(name, parts[0])


@dataclass(frozen=True)
class Style:
    """How formulas are written.

    Attributes:
        name: how a name is written.
        times: between factors.
        brackets: around what binds less.
        power: of a base and an exponent.
        quotient: of a numerator and a denominator.
        call: a function of what is in brackets.
    """

    name: Callable[[str], str]
    times: str
    brackets: tuple[str, str]
    power: str
    quotient: str
    call: Callable[[str, str], str]


def write(term: Term, style: Style) -> str:
    """The formula in a style."""
    return _write(term, style)[0]


def _write(term: Term, style: Style) -> tuple[str, int]:  # noqa: PLR0911 - as above
    def inner(part: Term, least: int) -> str:
        text, binds = _write(part, style)
        return text if binds >= least else text.join(style.brackets)

    match term.kind:
        case "number":
            return term.word, ATOM
        case "name":
            return style.name(term.word), ATOM
        case "+":
            first, *others = term.parts
            text = inner(first, SUM)  # a leading minus needs no brackets
            for part in others:
                minus = part.kind == "-"
                sign = "-" if minus else "+"
                text += f" {sign} {inner(part.parts[0] if minus else part, PRODUCT)}"
            return text, SUM
        case "-":
            return f"-{inner(term.parts[0], PRODUCT)}", SUM
        case "*":
            return style.times.join(inner(part, PRODUCT) for part in term.parts), PRODUCT
        case "/":
            top, bottom = (inner(part, POWER) for part in term.parts)
            return style.quotient.format(top, bottom), PRODUCT
        case "^":
            base, exponent = (inner(part, ATOM) for part in term.parts)
            return style.power.format(base, exponent), POWER
        case name:
            return style.call(name, _write(term.parts[0], style)[0]), ATOM
