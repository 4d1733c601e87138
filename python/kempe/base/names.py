"""Errors for unknown names, with a suggestion."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from types import MappingProxyType
from typing import Protocol, TypeVar

from kempe.errors import ModelError

T = TypeVar("T")

#: The largest number of existing names in a message.
_MOST = 24


#: A component of a reaction on a body. The name of a place of a beam contains a dot.
_REACTION = re.compile(r"(.+?)\.((?:[a-z]+_)?(?:fx|fy|torque)_on_.+)")


def owner_of(name: str) -> tuple[str, str]:
    """The owner of a quantity and the last part of its name; the owner may be empty."""
    reaction = _REACTION.fullmatch(name)
    if reaction:
        return reaction[1], reaction[2]
    owner, _, quantity = name.rpartition(".")
    return owner, quantity


class UnknownNameError(ModelError, KeyError):
    """The model has no such name. The error is also a ``KeyError``, as for any mapping."""


def unknown(what: str, name: object, known: Iterable[str]) -> UnknownNameError:
    """The error for an unknown name.

    Args:
        what: kind of object, such as "body or joint".
        name: the unknown name.
        known: the existing names, in the order of the message.
    """
    names = list(known)
    near = _nearest(str(name), names)
    if near is not None:
        hint = f"did you mean {near!r}?"
    elif names:
        hint = f"there is {few(names, _MOST)}"
    else:
        hint = "there is none"
    text = repr(name) if isinstance(name, str) else f"{name!r} (not a text)"
    return UnknownNameError(f"unknown {what} {text}", name=str(name), hint=hint)


def _nearest(name: str, names: list[str]) -> str | None:
    """The most similar name; differences of case have a small weight."""
    same = [known for known in names if known.casefold() == name.casefold()]
    near = same or get_close_matches(name, names, n=1)
    return near[0] if near else None


def few(names: Iterable[str], most: int = 6) -> str:
    """Names in one line: all names, or the first names and the number of the others."""
    given = list(names)
    more = f" and {len(given) - most} more" if len(given) > most else ""
    return ", ".join(given[:most]) + more


class Named(dict[str, T]):
    """A mapping whose unknown keys are errors with a suggestion.

    Attributes:
        what: kind of its values, such as "event".
    """

    def __init__(self, what: str, values: Mapping[str, T]) -> None:
        super().__init__(values)
        self.what = what

    def __missing__(self, key: object) -> T:
        raise unknown(self.what, key, self)


class _HasName(Protocol):
    @property
    def name(self) -> str: ...


E = TypeVar("E", bound=_HasName)


def named(what: str, elements: Iterable[E]) -> Mapping[str, E]:
    """Elements by name, read-only, as in ``Named``."""
    return MappingProxyType(Named(what, {element.name: element for element in elements}))


def entry(what: str, name: object, known: Mapping[str, T]) -> T:
    """The value of a name.

    Raises:
        ModelError: there is no such name.
    """
    if isinstance(name, str) and name in known:
        return known[name]
    raise unknown(what, name, known)


def one_of(what: str, value: str, known: Iterable[str]) -> str:
    """The value, if it is one of the known names.

    Raises:
        ModelError: the value is unknown.
    """
    names = list(known)
    if not isinstance(value, str) or value not in names:
        raise unknown(what, value, names)
    return value
