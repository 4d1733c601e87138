"""Changes that Cosmic Ray does not make itself: arguments swapped, a statement left out."""

from collections.abc import Iterator
from typing import Any

import parso
from cosmic_ray.operators.operator import Example, Operator
from cosmic_ray.plugins import OPERATOR_PROVIDERS

Span = tuple[tuple[int, int], tuple[int, int]]


class SwapArguments(Operator):  # type: ignore[misc]
    """Swaps two neighbouring positional arguments of a call that differ."""

    def mutation_positions(self, node: Any) -> Iterator[Span]:
        """Each pair of neighbours."""
        for k in self._pairs(node):
            yield node.children[k].start_pos, node.children[k + 2].end_pos

    def mutate(self, node: Any, index: int) -> Any:
        """Swap a pair; the white space in front of each argument stays."""
        k = self._pairs(node)[index]
        first, second = node.children[k], node.children[k + 2]
        one, other = first.get_first_leaf(), second.get_first_leaf()
        one.prefix, other.prefix = other.prefix, one.prefix
        node.children[k], node.children[k + 2] = second, first
        return node

    @staticmethod
    def _pairs(node: Any) -> list[int]:
        if node.type != "arglist":
            return []
        plain = [child.type not in ("argument", "operator") for child in node.children]
        words = [child.get_code().strip() for child in node.children]
        pairs = ((k, k + 2) for k in range(len(plain) - 2))
        return [a for a, b in pairs if plain[a] and plain[b] and words[a] != words[b]]

    @classmethod
    def examples(cls) -> tuple[Example, ...]:
        """An example of the change."""
        return (Example("f(a, b)", "f(b, a)"),)


class DropStatement(Operator):  # type: ignore[misc]
    """Leaves out a call, an error or an assignment such as ``+=``."""

    def mutation_positions(self, node: Any) -> Iterator[Span]:
        """The whole statement."""
        if node.type == "simple_stmt" and self._acts(node.children[0]):
            yield node.children[0].start_pos, node.children[0].end_pos

    def mutate(self, node: Any, index: int) -> Any:
        """Put ``pass`` in its place."""
        del index
        prefix = node.children[0].get_first_leaf().prefix
        node.children[0] = parso.parse(f"{prefix}pass")
        return node

    @staticmethod
    def _acts(statement: Any) -> bool:
        if statement.type == "expr_stmt":
            sign = statement.children[1]
            return sign.get_code().strip() != "=" and sign.type != "annassign"
        return statement.type in ("atom_expr", "raise_stmt")

    @classmethod
    def examples(cls) -> tuple[Example, ...]:
        """An example of the change."""
        return (Example("f(a)", "pass"),)


OPERATOR_PROVIDERS["kempe"] = {one.__name__: one for one in (SwapArguments, DropStatement)}
