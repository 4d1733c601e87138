"""``kp.Data``: measured columns with their times, from a table with units in its headers."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from kempe import _core
from kempe.base import files
from kempe.base.arguments import Explained
from kempe.base.arrays import Floats, fixed
from kempe.base.names import few, unknown
from kempe.errors import FileError, KempeError, ModelError
from kempe.model.values import mapping, refuse

#: A header with a unit: ``phi [deg]``.
_HEADER = re.compile(r"\s*(.*?)\s*\[\s*(.*?)\s*\]\s*")
#: Units in headers that mean a plain number.
_PLAIN = ("", "1", "-", "–")
#: The unit of frequencies.
_HERTZ = "Hz"


class Data(metaclass=Explained):
    """Measured values of quantities over time.

    Args:
        table: a CSV file, a data frame, or a mapping of headers to arrays.
        t: header of the times; for a motion over a quantity, of its values; None for numbers of a
            result at rest, such as frequencies, of which each row is a measurement.
        columns: headers by quantity: ``{"rod.angle": "phi [deg]"}``. The header is as written in
            the table; a unit in brackets is converted, otherwise values are in SI units and rad.
        sigma: standard deviations of the measured values by quantity: numbers in SI units and rad,
            or texts with a unit, such as ``"0.5 deg"``. Without it, they follow from the residuals.
        shift: name of a parameter of the fit, in seconds: the model is at this time later than the
            time of the data. Data with the same name have the same shift.

    Attributes:
        t: the times of each quantity, without those whose value is missing.
        values: the values of each quantity, in SI units and rad.
        missing: the number of rows without a value, by quantity.

    Raises:
        ModelError: a header, a unit or a number is invalid.
        FileError: the file cannot be read.
    """

    def __init__(
        self,
        table: Path | str | Mapping[str, Any] | Any,
        t: str | None = "t",
        columns: Mapping[str, str] | None = None,
        sigma: Mapping[str, float | str] | None = None,
        shift: str | None = None,
    ) -> None:
        given = read_table(table)
        asked = mapping(columns or {}, "columns", "{'rod.angle': 'phi [deg]'}")
        if not asked:
            hint = f"the table has {few(given)}"
            raise ModelError("columns: there are none", hint=hint)
        self.header_of_t = t
        if shift is not None and (not isinstance(shift, str) or not shift or "." in shift):
            refuse("shift", f"{shift!r}; must be the name of a parameter of the fit, such as 't0'")
        self.shift = shift
        times, self._unit_of_t = (None, "") if t is None else _column(given, t, "time")
        times_found, values, units, missing = {}, {}, {}, {}
        for name, header in asked.items():
            found, units[name] = _column(given, header, f"column of {name}")
            times = np.zeros(found.shape) if times is None else times
            if found.shape != times.shape:
                refuse(f"columns.{name}", f"{len(found)} values for {len(times)} times")
            good = np.isfinite(found) & np.isfinite(times)
            missing[name] = int((~good).sum())
            order = np.argsort(times[good], kind="stable")
            times_found[name] = fixed(times[good][order])
            values[name] = fixed(found[good][order])
            if not good.any():
                refuse(f"columns.{name}", f"{header!r} has no values")
        self.t: Mapping[str, Floats] = MappingProxyType(times_found)
        self.values: Mapping[str, Floats] = MappingProxyType(values)
        self.missing: Mapping[str, int] = MappingProxyType(missing)
        self._units: Mapping[str, str] = MappingProxyType(units)
        spread = mapping(sigma or {}, "sigma", "{'rod.angle': '0.5 deg'}")
        for name in spread:
            if name not in values:
                raise unknown("quantity in sigma", name, values)
        read = {name: _sigma(name, of) for name, of in spread.items()}
        self.sigma: Mapping[str, float] = MappingProxyType({k: of for k, (of, _) in read.items()})
        self._units_of_sigma = {name: unit for name, (_, unit) in read.items()}

    def check(self, units: Mapping[str, str], of_t: str) -> None:
        """Refuse columns whose units are not those of their quantities.

        Args:
            units: SI units of the quantities.
            of_t: SI unit of the times.

        Raises:
            ModelError: a unit does not fit.
        """
        pairs = [(f"columns.{name}", self._units[name], units[name]) for name in self.values]
        pairs += [(f"sigma.{name}", of, units[name]) for name, of in self._units_of_sigma.items()]
        for path, own, needed in [*pairs, ("t", self._unit_of_t, of_t)]:
            if _HERTZ in (own, needed) and own not in ("", needed):
                hint = f"; write {needed}" if own == _HERTZ else ""
                refuse(path, f"it is in {own} as written, but the quantity is in {needed}{hint}")
            if own not in ("", needed):
                _refuse_other(path, own, needed)

    def __len__(self) -> int:
        return sum(len(of) for of in self.values.values())

    def __repr__(self) -> str:
        told = ", ".join(f"{len(of)} of {name}" for name, of in self.values.items())
        left = sum(self.missing.values())
        return f"<Data: {told}; {left} missing>" if left else f"<Data: {told}>"


def _refuse_other(path: str, own: str, needed: str) -> None:
    try:
        _core.formula_unit("a - b", ["a", "b"], [own, needed])
    except KempeError:
        refuse(path, f"it is in {own} as written, but the quantity is in {needed}")


def _sigma(name: str, given: float | str) -> tuple[float, str]:
    """A standard deviation in SI units and rad, and its unit; empty without one."""
    path, unit = f"sigma.{name}", ""
    if isinstance(given, str):
        try:
            value, unit = _core.formula_value(given, [], [])[0], _core.formula_unit(given, [], [])
        except KempeError as error:
            refuse(path, f"{given!r}: {error.args[0]}")
    else:
        try:
            value = float("nan" if isinstance(given, bool) else given)
        except (TypeError, ValueError):
            value = float("nan")
    if not value > 0.0 or not np.isfinite(value):
        refuse(path, f"{given!r}; must be > 0: one number, or a text such as '0.5 deg'")
    return value, unit


def read_table(table: Any) -> dict[str, Any]:
    """The columns of a table by their headers."""
    if isinstance(table, str | Path):
        return dict(_csv(Path(table)))
    if hasattr(table, "columns"):
        return {str(name): table[name] for name in table.columns}
    if isinstance(table, Mapping):
        return {str(name): of for name, of in table.items()}
    hint = "give the name of a CSV file, a data frame, or {'t': …, 'phi [deg]': …}"
    raise ModelError(f"table: {type(table).__name__} is not a table", hint=hint)


def headers(table: Mapping[str, Any], t: str) -> dict[str, str]:
    """The headers of a table by their names without units, without that of the times.

    Raises:
        ModelError: two headers differ in their units only.
    """
    found: dict[str, str] = {}
    for header in table:
        name = _split(header)[0]
        if t in (name, header):
            continue
        if name in found:
            hint = "columns={name: header} chooses one of them"
            pair = f"{found[name]!r} and {header!r}"
            raise ModelError(f"table: {pair} are both columns of {name}", name=name, hint=hint)
        found[name] = header
    return found


def is_empty(table: Mapping[str, Any], header: str) -> bool:
    """Whether a column of numbers has no values."""
    try:
        return not np.isfinite(_numbers(table[header])).any()
    except (TypeError, ValueError):
        return False


def _numbers(column: Any) -> Floats:
    """The numbers of a column; NaN where it is masked."""
    if isinstance(column, np.ma.MaskedArray):
        hidden = np.ma.getmaskarray(column)
        return np.where(hidden, np.nan, np.asarray(column.data, dtype=np.float64))
    return np.asarray(column, dtype=np.float64)


def _column(given: Mapping[str, Any], header: str, what: str) -> tuple[Floats, str]:
    """The values of a column in SI units and rad, and the unit; empty if it has none."""
    names = [header] if header in given else [name for name in given if _split(name)[0] == header]
    if len(names) > 1:
        hint = "write the header with its unit"
        raise ModelError(f"{what}: {header!r} may be {' or '.join(map(repr, names))}", hint=hint)
    if not names:
        raise unknown(what, header, given)
    try:
        values = _numbers(given[names[0]])
    except (TypeError, ValueError):
        refuse(f"column {names[0]!r}", "its values are not numbers")
    unit = _split(names[0])[1]
    if unit in (*_PLAIN, _HERTZ):  # not a unit of formulas, where it could be rad/s or rev/s
        return values, unit if unit == _HERTZ else ""
    try:
        factor, of = (
            _core.formula_value(f"1 {unit}", [], [])[0],
            _core.formula_unit(f"1 {unit}", [], []),
        )
    except KempeError:
        refuse(f"column {names[0]!r}", f"{unit!r} is not a unit")
    return values * factor, of


def read_columns(path: Path, wanted: Mapping[str, str]) -> dict[str, Floats]:
    """Columns of a CSV file in SI units and rad; those that the file lacks are left out.

    Args:
        path: the file.
        wanted: the unit of each column: "m", "rad", or "" for any number.

    Raises:
        FileError, ModelError: the file cannot be read, a cell is not a number, or a unit is wrong.
    """
    given, found = _csv(path), dict[str, Floats]()
    for name, needed in wanted.items():
        if any(name in (header, _split(header)[0]) for header in given):
            what = f"column in {path}"
            found[name], own = _column(given, name, what)
            if own and needed and own != needed:
                _refuse_other(f"{path}: {name}", own, needed)
            if np.isnan(found[name]).any():
                refuse(f"{path}: {name}", "a cell is empty")
    return found


def _split(header: str) -> tuple[str, str]:
    match = _HEADER.fullmatch(header)
    # behind a comma, kempe writes remarks on a column
    return (match[1], match[2].partition(",")[0].rstrip()) if match else (header.strip(), "")


def _csv(path: Path) -> Mapping[str, list[float]]:
    """The columns of a CSV file; commas, semicolons or tabs divide them.

    Raises:
        FileError: it cannot be read, or a cell is not a number.
    """
    text = files.read_text(path)
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    if not lines:
        raise FileError(f"{path} is empty", name=str(path))
    mark = next((mark for mark in "\t;" if mark in lines[0]), ",")
    header, *rows = csv.reader(lines, delimiter=mark)
    names = [name.strip() for name in header]
    if len(set(names)) < len(names):
        raise FileError(f"{path}: a header occurs twice: {few(names)}", name=str(path))
    columns: list[list[float]] = [[] for _ in names]
    for k, row in enumerate(rows):
        if len(row) != len(names):
            told = f"{path}: row {k + 1} has {len(row)} cells, the header {len(names)}"
            raise FileError(told, name=str(path))
        for name, column, cell in zip(names, columns, row, strict=True):
            column.append(_number(cell, mark, f"{path}: row {k + 1}, {name!r}"))
    return dict(zip(names, columns, strict=True))


def _number(cell: str, mark: str, place: str) -> float:
    """A number of a cell; NaN if it is empty."""
    text = cell.strip()
    if mark != ",":  # a decimal comma
        text = text.replace(",", ".")
    if text.lower() in ("", "nan", "na", "n/a", "null"):
        return np.nan
    try:
        return float(text)
    except ValueError:
        raise FileError(f"{place}: {cell!r} is not a number") from None
