"""The base of all options and analyses: fields of declared shapes, written as in a file.

The core checks the numbers, so that a file and a program receive the same error messages.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, ClassVar, TypeAlias

from kempe.analyses.event import events
from kempe.base.arguments import Explained
from kempe.base.names import one_of
from kempe.errors import ModelError
from kempe.model.values import CHECKS, number, reference, tolerance

#: The values that a field accepts: the name of a shape, the name of a family of options, or words.
Shape: TypeAlias = "str | tuple[str, ...]"

#: Families of options, each with an example for messages.
_FAMILIES = {"method": "kp.RK45(rtol=1e-6)", "stabilization": "kp.Projection()"}
_CHECKS = {
    **CHECKS,
    "count": number,
    "events": events,
    "name": reference,
    "tolerance": tolerance,
}
#: Fields whose keys in the file are words of Python.
_KEYS = {"after": "from"}


@dataclass(frozen=True, repr=False)
class Option(metaclass=Explained):
    """A choice with numbers, ``{ type = "rk45", rtol = 1e-6 }`` in a file."""

    kind: ClassVar[str]
    shapes: ClassVar[Mapping[str, Shape]]

    def __repr__(self) -> str:
        return _written(self)

    def tree(self, path: str) -> dict[str, Any]:
        """The choice as in a file; a field that is None is left out.

        Args:
            path: the place of the choice, for messages.
        """
        return {"type": self.kind, **_fields(self, self.shapes, path)}


class Analysis(metaclass=Explained):
    """An entry of ``[analyses]``; each analysis is a dataclass."""

    name: str
    kind: ClassVar[str]
    shapes: ClassVar[Mapping[str, Shape]]

    def __repr__(self) -> str:
        return _written(self)

    def tree(self) -> dict[str, Any]:
        """The entry as in a file; a field that is None is left out.

        Raises:
            ModelError: a value does not fit its field.
        """
        path = f"analyses.{reference(self.name, 'name of an analysis')}"
        return {"type": self.kind, **_fields(self, self.shapes, path)}


def core_options(entry: Mapping[str, Any]) -> dict[str, Any]:
    """The part of an entry that the core reads: everything except its start."""
    return {key: value for key, value in entry.items() if key != "from"}


def _written(choice: Any) -> str:
    """The constructor call, with the fields that differ from their defaults."""
    given = (
        f"{field.name}={getattr(choice, field.name)!r}"
        for field in fields(choice)
        if getattr(choice, field.name) != field.default
    )
    return f"{type(choice).__name__}({', '.join(given)})"


def _fields(owner: object, shapes: Mapping[str, Shape], path: str) -> dict[str, Any]:
    given: dict[str, Any] = {}
    for field, shape in shapes.items():
        value, key = getattr(owner, field), _KEYS.get(field, field)
        if shape == "stabilization" and value is None:
            given[key] = {"type": "none"}
        elif value is not None:
            given[key] = _checked(value, shape, f"{path}.{key}")
    return given


def _checked(value: object, shape: Shape, path: str) -> object:
    if isinstance(shape, tuple):
        return one_of(path, reference(value, path), shape)
    if shape in _FAMILIES:
        if not isinstance(value, Option):
            hint = f"pass an object such as {_FAMILIES[shape]}"
            raise ModelError(f"{path}: {value!r}", hint=hint)
        return value.tree(path)
    return _CHECKS[shape](value, path)
