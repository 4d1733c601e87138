"""Doubts about the values of a model that is valid."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

#: Beside the description of a mechanism.
NO_GRAVITY = "no gravity: nothing falls; gravity = [0, -9.81] adds it"
#: Fields of forces, and the effect of negative values.
_FIELDS = {"stiffness": "it pushes away from rest", "damping": "it adds energy"}


class ModelWarning(UserWarning):
    """A model is valid, but one of its values is unusual for a real mechanism."""


def doubts(
    forces: Mapping[str, Mapping[str, Any]], value: Callable[[Any], float | None]
) -> list[str]:
    """A text for each stiffness or damping that is negative.

    Args:
        forces: the force elements by name, as in a file.
        value: the number of a field; None if it varies.
    """
    found = []
    for name, entry in forces.items():
        for field in _FIELDS.keys() & entry.keys():
            number = value(entry[field])
            if number is not None and number < 0.0:
                found.append(f"forces.{name}.{field} is negative, {number:g}: {_FIELDS[field]}")
    return sorted(found)
