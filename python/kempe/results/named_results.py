"""Solutions and other results of the analyses of a case."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from kempe.base.names import entry as named
from kempe.results.result import Result
from kempe.results.solution import Solution


class Results(Mapping[str, Any]):
    """Solutions and other results of a case: by name, or by position as in a list."""

    def __init__(self, solutions: Mapping[str, Solution | Result]) -> None:
        self._solutions = dict(solutions)

    def __getitem__(self, key: str | int) -> Any:
        """A ``Solution`` or ``Result`` by the name of its analysis or by its position.

        Raises:
            ModelError: there is no analysis of that name; the error is a ``KeyError`` too.
            IndexError: there is no analysis at that position.
        """
        if isinstance(key, int):
            return list(self._solutions.values())[key]
        return named("analysis", key, self._solutions)

    def __iter__(self) -> Iterator[str]:
        return iter(self._solutions)

    def __len__(self) -> int:
        return len(self._solutions)

    def __repr__(self) -> str:
        lines = [f"  {name}: {solution!r}" for name, solution in self.items()]
        return "\n".join(["<Results", *lines]) + ">"
