"""The declarations of elements, analyses and options: their types, fields, units and defaults."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from typing import Any

from kempe import _core


@cache
def declared(group: str) -> Mapping[str, Mapping[str, Any]]:
    """The declarations of a group by type.

    Args:
        group: such as "forces", "joints", "drivers", "methods", "stabilizations" or "analyses".

    Returns:
        For each type its text ``doc``, and ``fields``: name, unit, default and doc of each field.
    """
    entries: list[dict[str, Any]] = json.loads(_core.catalogue())[group]
    return {entry["name"]: entry for entry in entries}


def about(group: str, kind: str) -> str:
    """The description of a type on one line, without the backticks of code."""
    return " ".join(declared(group)[kind]["doc"].replace("`", "").split())
