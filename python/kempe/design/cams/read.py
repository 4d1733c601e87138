"""Programmes of cams in CSV files."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Any

from kempe.base import files
from kempe.errors import FileError

#: The columns; lift and law may be empty, as for a dwell.
_COLUMNS = ("segment", "angle", "lift", "law")
_HEADER = "segment, angle [deg], lift [mm], law"


def read_programme(path: Path | str) -> list[tuple[Any, ...]]:
    """The segments of a CSV file with a header such as ``segment, angle [deg], lift [mm], law``.

    Each row is a segment: rise, dwell or return. Columns without a unit are in rad and m. The lift
    of a dwell is empty, and that of a return to no lift too.

    Args:
        path: the file.

    Returns:
        The segments for ``kp.design.cam``.

    Raises:
        FileError: the file cannot be read, or a column or a cell is missing.
    """
    text = files.read_text(path)
    rows = [row for row in csv.reader(text.splitlines(), skipinitialspace=True) if any(row)]
    heads = [re.fullmatch(r"\s*(\w+)\s*(?:\[(.+)\])?\s*", head) for head in rows[0]] if rows else []
    names = [head[1] if head else "" for head in heads]
    units = dict(zip(names, (head[2] or "" if head else "" for head in heads), strict=True))
    missing = [name for name in _COLUMNS if name not in names]
    if missing:
        told = f"{path}: no column {' and '.join(missing)}"
        raise FileError(told, name=str(path), hint=f"the header is {_HEADER}")
    found = []
    for line, row in enumerate(rows[1:], 2):
        cells = dict(zip(names, (cell.strip() for cell in row), strict=False))
        parts: list[str] = [cells.get("segment", "")]
        for name in ("angle", "lift"):
            cell = cells.get(name, "")
            if cell:
                parts.append(f"{cell} {units[name]}".strip())
            elif name == "angle":
                told = f"{path}: row {line} has no angle"
                raise FileError(told, name=str(path), hint=f"the header is {_HEADER}")
        parts += [cells["law"]] if cells.get("law") else []
        found.append(tuple(parts))
    return found
