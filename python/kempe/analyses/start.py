"""The request for the assembly of a case."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from kempe.analyses.assembly import Coordinates
from kempe.base.arguments import Explained
from kempe.base.names import unknown
from kempe.model.values import mapping, numbers


@dataclass(frozen=True)
class Start(metaclass=Explained):
    """The request for assembly before the first analysis.

    Attributes:
        set: coordinates and rates that hold exactly, m, rad and per s.
        guess: approximate coordinates and rates.
    """

    set: Coordinates = field(default_factory=dict)
    guess: Coordinates = field(default_factory=dict)

    def tree(self) -> dict[str, Any]:
        """The section ``start`` as in a file."""
        held, hint = numbers(self.set, "start.set"), numbers(self.guess, "start.guess")
        return {key: value for key, value in (("set", held), ("guess", hint)) if value}


def read_start(start: Start | Mapping[str, Coordinates] | None) -> Start:
    """The request, given as a ``Start`` or as a mapping structured as in a file."""
    if isinstance(start, Start):
        return start
    given = mapping(start, "start", "{'set': {…}, 'guess': {…}}")
    for key in given:
        if key not in ("set", "guess"):
            raise unknown("key of start", key, ["set", "guess"])
    return Start(_flat(given.get("set", {})), _flat(given.get("guess", {})))


def _flat(coordinates: Mapping[str, Any]) -> dict[str, Any]:
    """``{"crank": {"angle": 1}}``, which a dotted key means in TOML, as ``{"crank.angle": 1}``."""
    flat: dict[str, Any] = {}
    for key, value in coordinates.items():
        nested = value.items() if isinstance(value, Mapping) else ()
        flat |= {f"{key}.{name}": entry for name, entry in nested} or {key: value}
    return flat
