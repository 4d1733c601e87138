"""Names that somebody may have mistyped, and the suggestion that goes with the refusal."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from kempe.errors import ModelError


class UnknownNameError(ModelError, KeyError):
    """A name that the model does not have; also a ``KeyError``, as for any mapping."""


def unknown(what: str, name: object, known: Iterable[str]) -> UnknownNameError:
    """The error for a name that is not among the known ones.

    Args:
        what: what was looked for, such as "body or joint".
        name: what was written.
        known: the names there are, in the order in which they are to be listed.
    """
    names = list(known)
    near = get_close_matches(str(name), names, n=1)
    if near:
        hint = f"did you mean {near[0]!r}?"
    elif names:
        hint = f"there is {', '.join(names)}"
    else:
        hint = "there is none"
    text = repr(name) if isinstance(name, str) else f"{name!r} (not a text)"
    return UnknownNameError(f"unknown {what} {text}", name=str(name), hint=hint)


def one_of(what: str, value: str, known: Iterable[str]) -> str:
    """The value itself if it is among the known ones.

    Raises:
        ModelError: it is not.
    """
    names = list(known)
    if value not in names:
        raise unknown(what, value, names)
    return value
