"""The text of a case for the page, which reads no other file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from kempe import _core
from kempe.base import files
from kempe.case import FORMATS
from kempe.loading import load
from kempe.model.lookup_tables import TableFile


def case_text(path: Path) -> str:
    """The text of a case as TOML.

    A TOML file is returned unchanged, with its comments. A case in JSON, or with tables in other
    files, is converted; the text then contains the points of these tables. So is a file of another
    tool.

    Raises:
        FileError: a file cannot be read, or is not a case.
        ModelError: the case is faulty.
    """
    case = load(path)  # a faulty case is refused with its lines
    if path.suffix.lower() not in FORMATS:
        return case.text()
    text, form = files.read_text(path), path.suffix.lower().lstrip(".")
    tree: dict[str, Any] = json.loads(_core.Case(text, form, str(path)).tree())
    outside = {n: table for n, table in tree.get("tables", {}).items() if "file" in table}
    if form == "toml" and not outside:
        return text
    for name, table in outside.items():
        read = TableFile.read(name, table, path.parent)
        own = {key: value for key, value in table.items() if key not in {"file", "columns"}}
        tree["tables"][name] = {"x": read.x, "y": read.y, **own}
    return _core.Case(json.dumps(tree, allow_nan=False), "json", None).write("toml")
