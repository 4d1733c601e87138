"""Optional packages, and files that they write."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from kempe.base import files
from kempe.base.arrays import Floats
from kempe.errors import ModelError

#: Longest name of a variable in MATLAB.
_LONGEST = 63


def needed(package: str, extra: str, for_: str) -> ModuleType:
    """An optional package.

    Raises:
        ModelError: it is not installed; the message names the extra that has it.
    """
    try:
        return import_module(package)
    except ImportError as error:
        root = package.partition(".")[0]
        raise ModelError(
            f"{for_} needs {root}, which is not installed", hint=f"pip install 'kempe[{extra}]'"
        ) from error


def identifiers(names: Iterable[str], longest: int = _LONGEST) -> list[str]:
    """Names of letters, digits and underscores, all different: ``rod_angle`` for ``rod.angle``."""
    found: list[str] = []
    for name in names:
        plain = re.sub(r"\W", "_", name, flags=re.ASCII)[: longest - 4]
        plain = plain if plain[:1].isalpha() else f"v{plain}"
        other = (f"{plain}_{k}" for k in range(2, len(found) + 3))
        found.append(plain if plain not in found else next(of for of in other if of not in found))
    return found


def write_parquet(path: Path | str, columns: Sequence[tuple[str, str, Floats]]) -> None:
    """Write named columns with units as a Parquet file; a unit is the metadata of its column.

    Raises:
        ModelError: pyarrow is not installed.
        FileError: the file cannot be written; an existing file is not changed.
    """
    arrow = needed("pyarrow", "parquet", "to_parquet")
    parquet = needed("pyarrow.parquet", "parquet", "to_parquet")
    fields = [
        arrow.field(name, arrow.float64(), metadata={"unit": unit}) for name, unit, _ in columns
    ]
    table = arrow.table([arrow.array(of) for *_, of in columns], schema=arrow.schema(fields))
    with files.writing(files.checked_path(path, "write")) as file:
        parquet.write_table(table, file)


def write_mat(
    path: Path | str, columns: Sequence[tuple[str, str, Floats]], others: dict[str, Any]
) -> None:
    """Write named columns with units as a ``.mat`` file of MATLAB.

    Names of variables contain letters, digits and underscores. The cell arrays ``variables``,
    ``names`` and ``units`` give the name and the unit of each.

    Raises:
        ModelError: SciPy is not installed.
        FileError: the file cannot be written; an existing file is not changed.
    """
    io = needed("scipy.io", "design", "to_mat")
    taken = [*others, "variables", "names", "units"]
    given = identifiers([*taken, *(name for name, *_ in columns)])[len(taken) :]
    cells = {
        "variables": given,
        "names": [name for name, *_ in columns],
        "units": [unit for _, unit, _ in columns],
    }
    found = {name: _cells(of) for name, of in cells.items()} | {
        name: _cells(of) if isinstance(of, tuple) else of for name, of in others.items()
    }
    found |= {name: of for name, (*_, of) in zip(given, columns, strict=True)}
    with files.writing(files.checked_path(path, "write")) as file:
        io.savemat(file, found, long_field_names=True, oned_as="column")


def _cells(texts: Iterable[str]) -> Any:
    """A cell array of texts."""
    return np.array([*texts, None], dtype=object)[:-1]
