"""The file of a case with other values: its comments, formulas and units are kept."""

from __future__ import annotations

from collections.abc import Mapping
from math import isclose
from pathlib import Path
from typing import TYPE_CHECKING

from kempe.cli.arguments import STDIN, setting

if TYPE_CHECKING:
    from kempe.case import Case


def save_changed(
    case: Case, file: Path, values: Mapping[str, float], settings: list[str] | None, path: Path
) -> None:
    """Write a case as its file with other numbers, or as a whole if that gives another case.

    Args:
        case: the case to write.
        file: the file from which it was read.
        values: its new values.
        settings: the arguments of ``--set``.
        path: the new file.
    """
    from kempe.base import files
    from kempe.errors import KempeError
    from kempe.loading import load
    from kempe.sweeps.problems.rewritten import rewritten

    changed, text = dict(values), None
    for one in settings or []:
        name, value = setting(one)
        if isinstance(value, float):
            changed.setdefault(name, value)
    if str(file) != STDIN and file.suffix.lower() == ".toml":
        text = rewritten(files.read_text(file), changed)
    if text is not None:
        files.write_text(path, text)
        try:
            if _is_same(load(path), case):
                return
        except KempeError:
            pass
    case.save(path)


def _is_same(one: Case, other: Case) -> bool:
    """Whether two cases have equal parameters and starts, up to rounding."""
    pairs = [
        (one.model.parameters, other.model.parameters),
        (one.start().coordinates(), other.start().coordinates()),
    ]
    return all(
        a.keys() == b.keys() and all(isclose(a[k], b[k], rel_tol=1e-9, abs_tol=1e-12) for k in a)
        for a, b in pairs
    )
