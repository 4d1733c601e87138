"""The base of results that are not motions, such as equilibria and modes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from kempe._upwards import CALLS
from kempe.base import files
from kempe.results.table import Column, write_columns

if TYPE_CHECKING:
    from kempe.results.state import State


class Result(ABC):
    """The result of an analysis that is not a motion.

    Attributes:
        kind: type of the analysis, as in a file.
    """

    kind: ClassVar[str]

    @property
    @abstractmethod
    def final(self) -> State:
        """The state in which the next analysis of a case starts."""

    @abstractmethod
    def summary(self) -> dict[str, Any]:
        """The result as plain data in SI units and rad, for ``summary.json``."""

    @abstractmethod
    def report(self) -> list[str]:
        """The result in lines, as ``kempe run`` prints it."""

    def tables(self) -> Mapping[str, Sequence[Column]]:
        """The tables that are written as CSV, by the name of the file without suffix."""
        return {}

    def save(self, folder: Path | str) -> list[Path]:
        """Write each table as CSV with 17 digits, which preserves every number.

        Returns:
            The files.

        Raises:
            FileError: a file cannot be written.
        """
        where = files.checked_path(folder, "write")
        written = []
        for name, columns in self.tables().items():
            written.append(where / f"{name}.csv")
            write_columns(columns, written[-1])
        return written

    def _repr_html_(self) -> str:
        return str(CALLS["html"](self))

    def __str__(self) -> str:
        return "\n".join(self.report())
