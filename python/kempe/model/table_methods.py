"""The tables of a model: their points and their files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from kempe import _core
from kempe.model.lookup_tables import Interpolation, Outside, Table, TableFile
from kempe.model.values import refuse


class TableMethods:
    """Methods of a model that concern tables."""

    _tree: dict[str, Any]
    _files: dict[str, TableFile]

    def _changed(self) -> None:
        raise NotImplementedError

    def table(
        self,
        name: str,
        *,
        x: Sequence[float] | None = None,
        y: Sequence[float] | None = None,
        file: Path | str | None = None,
        columns: Sequence[str] | None = None,
        x_unit: str | None = None,
        y_unit: str | None = None,
        interpolation: Interpolation = "cubic",
        periodic: bool = False,
        outside: Outside = "refuse",
    ) -> Table:
        """Add a function through given points, which formulas call as ``name(x)``.

        Args:
            name: letters, digits and _.
            x: places, increasing, in ``x_unit``.
            y: values, one for each x, in ``y_unit``.
            file: a CSV file with the points, in place of x and y; relative to the current folder.
                A saved case keeps the reference.
            columns: names of the columns of x and y in the file; the first two if absent.
            x_unit: such as "deg"; SI and rad if absent.
            y_unit: such as "mm"; SI and rad if absent.
            interpolation: "linear", "cubic" (C², second derivative 0 at the ends), "quintic" (C⁴,
                third and fourth derivative 0 at the ends) or "monotone" (PCHIP, C¹).
            periodic: True repeats the table; the last y must be the first one.
            outside: "refuse" ends a run that reads the table outside its range; "hold" is the value
                at the end, "linear" the tangent there.

        Raises:
            ModelError: a value is invalid, or the name is taken.
            FileError: the file cannot be read.
        """
        given = Table(
            name,
            x,
            y,
            None if file is None else str(file),
            columns,
            x_unit,
            y_unit,
            interpolation,
            periodic,
            outside,
        )
        if name in self._tree["tables"]:
            refuse(f"tables.{name}", "the name is taken by another table; choose another")
        entry = given.tree()
        if "file" in entry:
            self._files[name] = TableFile.read(name, entry, Path())
        self._tree["tables"][name] = entry
        self._changed()
        return given

    def _read_files(self, folder: Path) -> None:
        """Read the files of all tables, relative to a folder."""
        for name, entry in self._tree["tables"].items():
            if isinstance(entry, Mapping) and isinstance(entry.get("file"), str):
                self._files[name] = TableFile.read(name, entry, folder)

    def _supplied(self, source: _core.Case) -> _core.Case:
        """A case of the core with the points of the files."""
        for name, points in self._files.items():
            source = source.supply(name, np.array(points.x), np.array(points.y))
        return source

    def with_points(self, tree: dict[str, Any]) -> dict[str, Any]:
        """A tree of this model, with the points of tables in place of their files."""
        if not self._files:
            return tree
        tables = dict(tree["tables"])
        for name, points in self._files.items():
            kept = {k: v for k, v in tables[name].items() if k not in ("file", "columns")}
            tables[name] = {"x": points.x, "y": points.y, **kept}
        return {**tree, "tables": tables}

    def beside(self, tree: dict[str, Any], folder: Path) -> dict[str, Any]:
        """A tree of this model, with the files of tables relative to a folder."""
        if not self._files:
            return tree
        tables = dict(tree["tables"])
        for name, points in self._files.items():
            tables[name] = {**tables[name], "file": points.beside(folder)}
        return {**tree, "tables": tables}
