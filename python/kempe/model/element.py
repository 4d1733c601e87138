"""Base class of all entries of a model: a name, a section of the file, checked fields."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from typing import Any, ClassVar

from kempe.model.functions import ELEMENT_CHECKS
from kempe.model.values import reference


@dataclass(frozen=True)
class Element:
    """An entry of a model. The constructor checks the fields.

    Attributes:
        name: name in the model.
        section: the section of the file, such as ``joints``.
        kind: the ``type`` in the file.
        value_kinds: kind of value of each field.
        keys: the keys in the file of fields with another name.

    Raises:
        ModelError: the value of a field is invalid; the message names the field.
    """

    name: str
    section: ClassVar[str]
    kind: ClassVar[str]
    value_kinds: ClassVar[Mapping[str, str]]
    keys: ClassVar[Mapping[str, str]] = {}

    def __post_init__(self) -> None:
        """Check every given field and convert it to JSON data."""
        reference(self.name, f"name of a {self.kind}")
        for field, shape in self.value_kinds.items():
            value = getattr(self, field)
            if value is not None:
                path = f"{self.section}.{self.name}.{self.keys.get(field, field)}"
                checked = ELEMENT_CHECKS[shape](value, path)
                object.__setattr__(self, field, checked)

    def tree(self) -> dict[str, Any]:
        """The entry for a case file: the type and the fields that differ from their defaults."""
        entry: dict[str, Any] = {"type": self.kind}
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name != "name" and (field.default is MISSING or value != field.default):
                entry[self.keys.get(field.name, field.name)] = value
        return entry
