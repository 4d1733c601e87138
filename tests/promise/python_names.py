"""The public names of Python as lines of text: calls with keywords and defaults, attributes, bases.

Types are left out: an annotation may become more exact without a change for users. The arguments of
a class count if users make its objects; objects of the other classes come from functions of kempe.
"""

import inspect
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cached_property
from types import ModuleType
from typing import Any

import kempe as kp
from kempe.analyses import options
from kempe.base.deprecation import former_since
from kempe.model import elements
from kempe.model.element import Element
from kempe.model.ground import Ground
from kempe.results.drift import Drift
from kempe.results.events import EventTimes
from kempe.results.newton_euler import NewtonEuler
from kempe.results.views.body import BodyView
from kempe.results.views.constraint import ConstraintView
from kempe.results.views.force import ForceView
from kempe.results.views.reaction import Reaction

#: Classes whose objects users make.
MADE = {kp.Case, kp.Data, kp.Event, kp.Function, kp.Model, kp.Path, kp.Sampled, kp.Start}
MADE |= {kp.State, kp.Stepper} | {one for one in vars(options).values() if inspect.isclass(one)}
#: Classes that have no public name, and whose objects public names return.
RETURNED = (
    *(BodyView, ConstraintView, Drift, EventTimes, ForceView, Ground, NewtonEuler, Reaction),
    *(one for one in vars(elements).values() if inspect.isclass(one) and issubclass(one, Element)),
)


def lines() -> list[str]:
    """All public names, sorted."""
    found = {line for name in kp.__all__ for line in of(name, getattr(kp, name))}
    found |= {line for kind in RETURNED for line in of_class(f"returned.{kind.__name__}", kind)}
    return sorted(found)


def of(name: str, value: Any) -> Iterator[str]:
    """The lines of one public name."""
    if isinstance(value, ModuleType):
        yield f"{name}: module"
        for inner in getattr(value, "__all__", ()):
            yield from of(f"{name}.{inner}", getattr(value, inner))
    elif inspect.isclass(value):
        yield from of_class(name, value)
    elif callable(value):
        yield call(name, value)
    else:
        yield name


def of_class(name: str, kind: type[Any]) -> Iterator[str]:
    """A class with its bases or its arguments, and a line for each attribute and method."""
    bases = [base for base in kind.__bases__ if base.__name__ in kp.__all__ or not own(base)]
    known = [base.__name__ for base in bases if issubclass(kind, BaseException)]
    yield f"{name}: {' and '.join(known) or 'class'}"
    if kind in MADE:
        yield call(name, kind)
    attributes = {one for base in kind.__mro__ if own(base) for one in documented(base)}
    attributes |= {one.name for one in fields(kind)} if is_dataclass(kind) else set()
    yield from (f"{name}.{one}" for one in attributes if not one.startswith("_"))
    for member in dir(kind):
        static = inspect.getattr_static(kind, member)
        owner = next(base for base in kind.__mro__ if member in vars(base))
        if member.startswith("_") or not own(owner):
            continue
        method = static.__func__ if isinstance(static, classmethod | staticmethod) else static
        if callable(method):
            yield call(f"{name}.{member}", method)
        elif isinstance(static, property | cached_property):
            yield f"{name}.{member}"


def own(kind: type[Any]) -> bool:
    """Whether a class is defined in kempe."""
    return kind.__module__.partition(".")[0] == "kempe"


def documented(kind: type[Any]) -> list[str]:
    """The attributes that the docstring of a class lists."""
    text = inspect.cleandoc(vars(kind).get("__doc__") or "")
    section = re.search(r"^Attributes:\n((?: .*\n|\n)*)", f"{text}\n", re.M)
    names = re.findall(r"^ {4}((?:\w+, )*\w+):", section[1], re.M) if section else []
    return [name for line in names for name in line.split(", ")]


def call(name: str, function: Any) -> str:
    """``name(arguments)`` with defaults and without types; ``self`` and ``cls`` are left out."""
    given = inspect.signature(function).parameters.values()
    shown = [one for one in given if one.name not in ("self", "cls")]
    parts, keyword = [], False
    for one in shown:
        if one.kind is one.KEYWORD_ONLY and not keyword:
            parts += ["*"] * (parts == [] or not parts[-1].startswith("*"))
            keyword = True
        parts.append({one.VAR_POSITIONAL: "*", one.VAR_KEYWORD: "**"}.get(one.kind, "") + one.name)
        if one.default is not one.empty:
            parts[-1] += f"={default(one.default)}"
    since = former_since(function)
    mark = f", former since {since}" if since else ""
    return f"{name}({', '.join(parts)}){mark}"


def default(value: Any) -> str:
    """A default as text, the same in each process."""
    text = value.__name__ if inspect.isroutine(value) else repr(value)
    assert " at 0x" not in text, f"a default without a stable text: {text}"
    return text
