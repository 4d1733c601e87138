"""SI units as powers of base units, which FMUs declare."""

from __future__ import annotations

import json
import re
from collections import Counter
from functools import cache

from kempe import _core

#: Base units in the order of the standards; an angle counts as one.
BASE = ("kg", "m", "s", "A", "rad")
_FACTOR = re.compile(r"([*/]?)([A-Za-z]+)(?:\^(-?\d+))?")


@cache
def _dimensions() -> dict[str, dict[str, int]]:
    """The powers of base units in each unit of factor 1."""
    known = {
        unit["name"]: _powers(unit["dimension"], {name: {name: 1} for name in BASE})
        for unit in json.loads(_core.catalogue())["units"]
        if unit["si"] == 1
    }
    return {name: powers or {} for name, powers in known.items()} | {"rad": {"rad": 1}}


def powers_of(unit: str) -> dict[str, int] | None:
    """The powers of the base units, such as ``{"kg": 1, "m": 1, "s": -2}`` for N.

    None if the text is not a unit, as for the largest violation of constraints in m or rad.
    """
    return _powers(unit, _dimensions())


def _powers(text: str, known: dict[str, dict[str, int]]) -> dict[str, int] | None:
    if text == "1":
        return {}
    found: Counter[str] = Counter()
    end = 0
    for factor in _FACTOR.finditer(text):
        sign, name, power = factor.groups()
        if factor.start() != end or name not in known or (end > 0) != bool(sign):
            return None
        times = int(power or 1) * (-1 if sign == "/" else 1)
        found.update({base: times * own for base, own in known[name].items()})
        end = factor.end()
    if end != len(text) or not text:
        return None
    return {base: found[base] for base in BASE if found[base]}
