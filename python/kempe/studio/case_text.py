"""The text of a case for the page, which reads no other file."""

from __future__ import annotations

import json
from pathlib import Path

from kempe import _core, files
from kempe.case import load


def case_text(path: Path) -> str:
    """The text of a case as TOML.

    A TOML file stays as it is, with its comments. A case in JSON, or with tables in other files, is
    written anew.

    Raises:
        FileError: the file cannot be read, or is no case.
        ModelError: the case is faulty.
    """
    case = load(path)
    if path.suffix.lower() != ".toml":
        return case.text()
    text = files.read_text(path)
    tables = json.loads(_core.Case(text, "toml", str(path)).tree()).get("tables", {})
    return case.text() if any("file" in table for table in tables.values()) else text
