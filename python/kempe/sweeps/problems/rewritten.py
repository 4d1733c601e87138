"""The text of a case with other values of parameters and of the start; comments are kept."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping

from kempe import _core
from kempe.errors import KempeError

#: A key and its value, in TOML.
_ENTRY = re.compile(
    r"""(?P<key>"[^"]*"|'[^']*'|[\w.\- ]+?)\s*=\s*(?P<value>"(?:[^"\\]|\\.)*"|'[^']*'|[-+\w.]+)"""
)
#: A number with a unit, or times a constant, in a text.
_UNIT = re.compile(r"\s*[-+]?[\d.]+(?:[eE][-+]?\d+)?(?P<unit>\s*\*\s*deg|\s*[^\W\d_].*|\s*°)")


def rewritten(text: str, values: Mapping[str, float]) -> str | None:
    """The text of a case in TOML with other values.

    A value keeps the unit in which it is written, and all other text remains.

    Args:
        text: the text.
        values: values in SI units and rad by the names of parameters, or of coordinates and rates
            that are set at the start.

    Returns:
        The text; None if it does not set one of the names.
    """
    lines = text.split("\n")
    for name, value in values.items():
        path = f"start.set.{name}" if "." in name else f"parameters.{name}"
        place = _core.Case("\n".join(lines), "toml", "").place(path)
        if place is None:
            return None
        _, line, column = place
        match = _ENTRY.match(lines[line - 1], column - 1)
        if match is None:
            return None
        begin, end = match.span("value")
        new = _written(match["value"], value)
        lines[line - 1] = lines[line - 1][:begin] + new + lines[line - 1][end:]
    return "\n".join(lines)


def _written(old: str, value: float) -> str:
    """A value in the unit of the old text."""
    match = _UNIT.fullmatch(old[1:-1]) if old[0] in "\"'" else None
    if match is None:
        return repr(value)
    unit = match["unit"]
    try:
        factor = _core.formula_value(f"1{unit}", [], [])[0]
    except KempeError:
        return repr(value)
    return json.dumps(f"{value / factor!r}{unit}", ensure_ascii=False)
