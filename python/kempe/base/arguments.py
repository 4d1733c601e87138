"""Wrong arguments of public functions: messages with a suggestion, in place of Python's."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping, Sequence, Sized
from types import FunctionType
from typing import TYPE_CHECKING, Any, NoReturn, ParamSpec, TypeVar

from kempe.base.names import few
from kempe.base.synonyms import question, suggested
from kempe.errors import ModelError

P = ParamSpec("P")
R = TypeVar("R")
_MARK = "_arguments_are_explained"


class ArgumentError(ModelError, TypeError):
    """A call with an unknown, missing or superfluous argument. It is also a ``TypeError``."""


def is_given(value: object) -> bool:
    """Whether an argument has a value. Empty lists have none, and an array has no truth."""
    return len(value) > 0 if isinstance(value, Sized) else value is not None


def explained(function: Callable[P, R]) -> Callable[P, R]:
    """A function whose wrong calls raise ``ArgumentError`` with a suggestion."""

    @functools.wraps(function)
    def call(*given: P.args, **named: P.kwargs) -> R:
        try:
            return function(*given, **named)
        except TypeError as error:
            _explain(function, function.__name__, given, named, error)

    setattr(call, _MARK, True)
    return call


def explain_methods(kind: type[R]) -> type[R]:
    """Explain wrong calls of the public methods of a class, also of inherited ones.

    An attribute that does not exist is explained too.
    """
    for name in dir(kind):
        method = inspect.getattr_static(kind, name)
        public = not name.startswith("_") and isinstance(method, FunctionType)
        if public and not hasattr(method, _MARK):
            setattr(kind, name, explained(method))
    return explain_attributes(kind)


def explain_attributes(kind: type[R]) -> type[R]:
    """Explain attributes that a class does not have, by their names and words of other programs."""
    if not hasattr(kind, "__getattr__"):
        setattr(kind, "__getattr__", _missing)  # noqa: B010 - types know the attributes without it
    return kind


def _missing(self: object, name: str) -> NoReturn:
    kind = type(self)
    if name in dir(kind):  # a property raised an AttributeError of its own
        object.__getattribute__(self, name)
    raise AttributeError(
        missing_attribute(kind.__name__, name, () if name[0] == "_" else dir(self))
    )


def explain_functions(package: dict[str, Any]) -> None:
    """Explain wrong calls and names of public functions of a package, given its ``globals()``."""
    for name in package["__all__"]:
        if isinstance(package[name], FunctionType) and not hasattr(package[name], _MARK):
            package[name] = explained(package[name])

    def missing(name: str) -> NoReturn:
        known = () if name[0] == "_" else package["__all__"]
        raise AttributeError(missing_attribute(f"module {package['__name__']!r}", name, known))

    package.setdefault("__getattr__", missing)


class Explained(type):
    """The class of classes whose wrong calls raise ``ArgumentError`` with a suggestion."""

    if not TYPE_CHECKING:  # a type checker sees the arguments of the class

        def __call__(cls, *given: Any, **named: Any) -> Any:  # noqa: D102
            try:
                return super().__call__(*given, **named)
            except TypeError as error:
                _explain(cls.__init__, cls.__name__, (None, *given), named, error)

    @property
    def __signature__(cls) -> inspect.Signature:
        """The arguments of the class, for ``help`` and notebooks."""
        whole = inspect.signature(cls.__init__)  # type: ignore[misc]
        return whole.replace(parameters=list(whole.parameters.values())[1:])


def missing_attribute(owner: str, name: str, known: Sequence[str]) -> str:
    """The message of an ``AttributeError``, with a suggestion."""
    if name.removeprefix("add_").removeprefix("set_") in {"parameter", "parameters"}:
        hint = "give parameters to kp.Model(parameters={'k': 2}); m.with_parameters changes values"
        return f"{owner} has no attribute {name!r}: {hint}"
    names = suggested(name, known, "names")
    message = f"{owner} has no attribute {name!r}"
    if names:
        return f"{message}; {question(names)}"
    public = [one for one in known if not one.startswith("_")]
    return f"{message}; it has {few(public, 12)}" if public else message


def _explain(
    function: Callable[..., Any],
    name: str,
    given: Sequence[Any],
    named: Mapping[str, Any],
    error: TypeError,
) -> NoReturn:
    """Raise an error for a call that does not fit; otherwise the error of the function itself."""
    signature = inspect.signature(function)
    try:
        signature.bind(*given, **named)
    except TypeError as fault:
        if isinstance(error, ModelError):
            raise error from None
        kinds = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
        known = [n for n, p in signature.parameters.items() if p.kind in kinds and n != "self"]
        there_are = f"the arguments are {few(known, 30)}"
        unknown = [word for word in named if word not in known]
        if unknown:
            free = [word for word in known if word not in named]
            names = suggested(unknown[0], free, "arguments")
            hint = question(names) if names else there_are
            message = f"{name}: unknown argument {unknown[0]!r}"
        else:
            message, hint = f"{name}: {fault}", there_are
            if str(fault).startswith("too many"):
                hint += "; write them by name, such as " + f"{known[-1]}=…"
        raise ArgumentError(message, name=name, hint=hint) from None
    raise error
