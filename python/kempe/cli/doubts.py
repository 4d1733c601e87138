"""Doubts about the values of a model that is valid."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kempe.errors import KempeError

if TYPE_CHECKING:
    from kempe.model.model import Model

#: Fields of forces whose negative values add energy or push away from the free position.
_FIELDS = ("stiffness", "damping")


def negative_constants(model: Model) -> list[str]:
    """A warning for each stiffness or damping that is negative."""
    tree, parameters = model.tree(), dict(model.compile().parameters)
    found = []
    for name, entry in tree.get("forces", {}).items():
        for field in _FIELDS:
            value = _value(entry.get(field), parameters)
            if value is not None and value < 0.0:
                effect = "it adds energy" if field == "damping" else "it pushes away from rest"
                found.append(f"warning: forces.{name}.{field} is negative, {value:g}: {effect}")
    return found


def _value(given: Any, parameters: dict[str, float]) -> float | None:
    """The number of a field; None if it has none, or varies."""
    from kempe.model.model import Model

    if not isinstance(given, str):
        return float(given) if isinstance(given, int | float) else None
    name = "value_of_the_field"
    try:
        return float(Model(parameters={**parameters, name: given}).compile().parameters[name])
    except KempeError:  # a formula in the position or the time
        return None
