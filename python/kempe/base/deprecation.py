"""Former names: they work for one more minor version and give a ``DeprecationWarning``.

``docs/promise.md`` states the rule. A name that became former in 0.3 works in every 0.3.x. Former
names of ``kempe`` itself are listed in ``_FORMER`` in ``kempe/__init__.py``.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar, cast

from kempe.base.warn import warn
from kempe.errors import ModelError

P = ParamSpec("P")
R = TypeVar("R")
_MARK = "_former_since"


def renamed(since: str, **former: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """A decorator of a function whose arguments have new names: ``old="new"``.

    It stands above ``explained``, which refuses unknown names. The former names may only be given
    by name, so arguments that could be given by position keep their places.

    Args:
        since: the version with the new names, such as ``"0.3"``.
        **former: the present name of each former one.
    """

    def decorate(function: Callable[P, R]) -> Callable[P, R]:
        known = inspect.signature(function).parameters
        unknown = [name for name in former.values() if name not in known]
        if unknown:
            raise ValueError(f"{function.__name__} has no argument {unknown[0]!r}")

        @functools.wraps(function)
        def call(*given: P.args, **named: P.kwargs) -> R:
            words = cast(dict[str, Any], named)
            for old, new in former.items():
                if old not in words:
                    continue
                what = f"{function.__name__}: the argument {old!r}"
                if new in words:
                    message = f"{what} is the former name of {new!r}, which is given too"
                    raise ModelError(message, name=function.__name__, hint=f"leave out {old!r}")
                announce(what, f"{new!r}", since)
                words[new] = words.pop(old)
            return function(*given, **named)

        setattr(call, _MARK, since)
        return call

    return decorate


def former(since: str, instead: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """A decorator of a function or method that another one replaces.

    Args:
        since: the version with the replacement, such as ``"0.3"``.
        instead: how the call is written now, such as ``"sol.drift.position"``.
    """

    def decorate(function: Callable[P, R]) -> Callable[P, R]:
        @functools.wraps(function)
        def call(*given: P.args, **named: P.kwargs) -> R:
            announce(function.__name__, instead, since)
            return function(*given, **named)

        setattr(call, _MARK, since)
        return call

    return decorate


def former_since(function: Any) -> str | None:
    """The version since which a function, or one of its arguments, has another name."""
    found = getattr(function, _MARK, None)
    return found if isinstance(found, str) else None


def removal(since: str) -> str:
    """The first version that may lack a name which is former since a version.

    >>> removal("0.3")
    '0.4'
    """
    major, minor, *_ = since.split(".")
    return f"{major}.{int(minor) + 1}"


def announce(what: str, instead: str, since: str) -> None:
    """Give the ``DeprecationWarning`` for a former name, at the line of the user."""
    warn(
        f"{what} is deprecated since version {since}: write {instead}; version "
        f"{removal(since)} may refuse it",
        DeprecationWarning,
    )
