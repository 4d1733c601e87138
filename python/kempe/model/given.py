"""Numbers that users give as numbers or as texts with a unit."""

from __future__ import annotations

from typing import Any

from kempe import _core
from kempe.errors import KempeError
from kempe.model.values import number, refuse


def value(given: Any, path: str, unit: str) -> float:
    """A number or the text of a formula without names, in SI units and rad.

    Raises:
        ModelError: it is not a number, or its unit is not this one; "" allows any unit.
    """
    found = number(given, path)
    if not isinstance(found, str):
        return float(found)
    try:
        own = _core.formula_unit(found, [], [])
        result = float(_core.formula_value(found, [], [])[0])
    except KempeError as error:
        refuse(path, f"{given!r}: {error.args[0]}")
    if unit and own not in ("", unit):
        what = "an angle, such as '30 deg'" if unit == "rad" else f"in {unit}"
        refuse(path, f"{given!r} is in {own}; must be {what}")
    return result
