"""The public names of Python as lines of text: calls with keywords and defaults, attributes, bases.

Types are left out: an annotation may become more exact without a change for users. The arguments of
a class count if users make its objects; objects of the other classes come from functions of kempe.
"""

import inspect
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import kempe as kp
from kempe._compact import attributes, call, is_made, methods
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
    bases = [base.__name__ for base in kind.__bases__] if issubclass(kind, BaseException) else []
    yield f"{name}: {' and '.join(bases) or 'class'}"
    if is_made(kind):
        yield call(name, kind)
    yield from (f"{name}.{one}" for one in (*attributes(kind), *methods(kind)))
