"""Tables: functions through given points. Formulas call them by name."""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from kempe import _core
from kempe.base import files
from kempe.base.arrays import Floats
from kempe.errors import FileError
from kempe.model.values import flag, listed, number, reference, refuse

#: The curve between the points of a table.
Interpolation: TypeAlias = Literal["linear", "cubic", "quintic", "monotone"]
#: The value of a table beyond its points.
Outside: TypeAlias = Literal["refuse", "hold", "linear"]
_LINE_BREAK = re.compile(r"\r\n|\r|\n")
#: The largest part of a field that a message repeats.
_LONGEST_SHOWN = 40


@dataclass(frozen=True)
class Table:
    """A table as it is written.

    Attributes:
        name: formulas call the table as ``name(x)``.
        x: arguments, increasing, in ``x_unit``.
        y: values, one for each x, in ``y_unit``.
        file: a CSV file with the points, in place of x and y.
        columns: names of the columns of x and y; by default the first two columns.
        x_unit: unit of x, such as "deg"; by default SI and rad.
        y_unit: unit of y, such as "mm"; by default SI and rad.
        interpolation: "linear" (C⁰), "monotone" (C¹), "cubic" (C²) or "quintic" (C⁴).
        periodic: whether the table is periodic; the last y must equal the first.
        outside: "refuse", "hold" or "linear".

    Raises:
        ModelError: the value of a field is invalid; the message names the field.
    """

    name: str
    x: Sequence[float] | None = None
    y: Sequence[float] | None = None
    file: str | None = None
    columns: Sequence[str] | None = None
    x_unit: str | None = None
    y_unit: str | None = None
    interpolation: Interpolation = "cubic"
    periodic: bool = False
    outside: Outside = "refuse"

    def __post_init__(self) -> None:
        """Check every given field and convert it to JSON data."""
        path = f"tables.{reference(self.name, 'name of a table')}"
        for field in fields(self)[1:]:
            value = getattr(self, field.name)
            if value is not None:
                checked = _checked(field.name, value, f"{path}.{field.name}")
                object.__setattr__(self, field.name, checked)

    def tree(self) -> dict[str, Any]:
        """The entry for a case file: the fields that differ from their defaults."""
        given = ((field.name, getattr(self, field.name), field.default) for field in fields(self))
        return {name: value for name, value, default in list(given)[1:] if value != default}


def _checked(field: str, value: object, path: str) -> object:
    if field in ("x", "y"):
        return [_plain_number(entry, f"{path}[{k}]") for k, entry in enumerate(listed(value, path))]
    if field == "columns":
        return [reference(entry, f"{path}[{k}]") for k, entry in enumerate(listed(value, path))]
    return flag(value, path) if field == "periodic" else reference(value, path)


def _plain_number(value: object, path: str) -> float:
    checked = number(value, path)
    if isinstance(checked, str):
        refuse(path, f"{checked!r} is not a number; write h*lift(x) to scale a table")
    return checked


@dataclass(frozen=True)
class TableFile:
    """The points of a table in a file.

    Attributes:
        path: the file.
        x: arguments, in the unit of the table.
        y: values, in the unit of the table.
    """

    path: Path
    x: list[float]
    y: list[float]

    @classmethod
    def read(cls, name: str, entry: Mapping[str, Any], folder: Path) -> TableFile:
        """Read the points of a table.

        Args:
            name: name of the table, for messages.
            entry: its fields, with ``file`` relative to the folder.
            folder: the folder of the case.

        Raises:
            FileError: the file cannot be read, has no such columns, or contains a text that is not
                a number.
        """
        path = Path(os.path.abspath(folder / files.checked_path(entry["file"], "read")))  # noqa: PTH100
        try:
            x, y = _points(files.read_text(path), path, entry.get("columns"))
        except FileError as error:
            raise FileError(f"tables.{name}: {error.args[0]}", name=name, hint=error.hint) from None
        return cls(path, x, y)

    def beside(self, folder: Path) -> str:
        """The name of the file relative to a folder; the whole path on another drive."""
        try:
            return Path(os.path.relpath(self.path, folder.resolve())).as_posix()
        except ValueError:
            return self.path.as_posix()


def _points(
    text: str, path: Path, columns: Sequence[str] | None
) -> tuple[list[float], list[float]]:
    """Two columns of a CSV text.

    Empty lines and lines that begin with # are left out. The first line is a header if it contains
    a text that is not a number. Fields are separated by commas, or by semicolons.
    """
    lines = [
        (number, line)
        for number, line in enumerate(_LINE_BREAK.split(text), 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise FileError(f"{path} has no points", hint="write two columns of numbers")
    mark = ";" if ";" in lines[0][1] and "," not in lines[0][1] else ","
    rows = [(number, _row(line, mark, number, path)) for number, line in lines]
    first = rows[0][1]
    header = None if all(_float(cell) is not None for cell in first) else first
    at = _places(header, len(first), columns, path)
    if header is not None:
        rows = rows[1:]
    if not rows:
        raise FileError(f"{path} has no points", hint="write numbers below the names of columns")
    x, y = ([_cell(row, k, line, path) for line, row in rows] for k in at)
    return x, y


def _row(line: str, mark: str, number: int, path: Path) -> list[str]:
    """The fields of a line. A field ends with its line, also where a quotation mark opens it."""
    try:
        (row,) = csv.reader([line], delimiter=mark, skipinitialspace=True, strict=True)
    except csv.Error as error:
        raise FileError(
            f"line {number} of {path}: {error}",
            hint="write each point in one line, as two numbers without quotation marks",
        ) from None
    return [cell.strip() for cell in row]


def _places(
    header: list[str] | None, width: int, columns: Sequence[str] | None, path: Path
) -> tuple[int, int]:
    if columns is None:
        if width < 2:
            hint = "write two columns of numbers, separated by a comma or a semicolon"
            raise FileError(f"{path} has one column", hint=hint)
        return 0, 1
    if len(columns) != 2:
        hint = "name two columns, of x and of y"
        raise FileError(f"columns: {len(columns)} given; must be 2", hint=hint)
    if header is None:
        hint = "remove columns, so that the first two are read, or add a first line with names"
        raise FileError(f"{path} has no names of columns", hint=hint)
    for name in columns:
        if name not in header:
            known = ", ".join(repr(known) for known in header)
            raise FileError(f"{path} has no column {name!r}", hint=f"it has {known}")
    first, second = (header.index(name) for name in columns)
    return first, second


def _cell(row: list[str], column: int, line: int, path: Path) -> float:
    cell = row[column] if column < len(row) else ""
    value = _float(cell)
    if value is None or not np.isfinite(value):
        shown = cell if len(cell) <= _LONGEST_SHOWN else f"{cell[:_LONGEST_SHOWN]}…"
        raise FileError(
            f"line {line} of {path}: {shown!r} in column {column + 1} is not a finite number",
            hint="write it with a decimal point"
            if "," in cell and _float(cell.replace(",", ".")) is not None
            else "correct or remove this line",
        )
    return value


def _float(cell: str) -> float | None:
    try:
        return None if "_" in cell else float(cell)  # Python reads 1_000 as a number
    except ValueError:
        return None


class TableInfo:
    """A table of a compiled model, a function in SI units.

    ::

        model.tables["lift"](np.linspace(0, np.pi))                 # m
        model.tables["lift"]([0.1, 0.2], derivative=1)              # m/rad

    Attributes:
        name: its name.
        interpolation: the curve between the points.
        range: first and last argument, in SI units.
        period: the period of a periodic table; otherwise None.
    """

    def __init__(self, core: _core.Model, about: Mapping[str, Any]) -> None:
        self._core = core
        self.name: str = about["name"]
        self.interpolation: str = about["interpolation"]
        self.range: tuple[float, float] = (about["range"][0], about["range"][1])
        self.period: float | None = about["period"]

    def __call__(self, x: npt.ArrayLike, derivative: int = 0) -> Floats:
        """Values, or those of a derivative, in the shape of x.

        Args:
            x: arguments, in SI units.
            derivative: order of the derivative, from 0 to 5.

        Returns:
            Values in SI units; NaN outside the range of a table with ``outside="refuse"``.
        """
        places = np.asarray(x, dtype=float)
        flat = np.ascontiguousarray(places.reshape(-1))
        return self._core.table(self.name, derivative, flat).reshape(places.shape)

    def __repr__(self) -> str:
        first, last = self.range
        return f"<table {self.name!r}: {self.interpolation}, {first:g} to {last:g}>"
