"""Errors for unknown names, with a suggestion."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from kempe.errors import ModelError

#: The largest number of existing names in a message.
_MOST = 24


class UnknownNameError(ModelError, KeyError):
    """The model has no such name. This is also a ``KeyError``, as for any mapping."""


def unknown(what: str, name: object, known: Iterable[str]) -> UnknownNameError:
    """The error for an unknown name.

    Args:
        what: kind of object, such as "body or joint".
        name: the unknown name.
        known: the existing names, in the order of the message.
    """
    names = list(known)
    near = get_close_matches(str(name), names, n=1)
    if near:
        hint = f"did you mean {near[0]!r}?"
    elif names:
        more = f" and {len(names) - _MOST} more" if len(names) > _MOST else ""
        hint = f"there is {', '.join(names[:_MOST])}{more}"
    else:
        hint = "there is none"
    text = repr(name) if isinstance(name, str) else f"{name!r} (not a text)"
    return UnknownNameError(f"unknown {what} {text}", name=str(name), hint=hint)


def one_of(what: str, value: str, known: Iterable[str]) -> str:
    """The value, if it is one of the known names.

    Raises:
        ModelError: the value is unknown.
    """
    names = list(known)
    if value not in names:
        raise unknown(what, value, names)
    return value
