"""Checks of the values in a model, and their conversion to JSON data.

Every check takes the path of the field, such as ``joints.A.axes``, and includes it in the error.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from numbers import Integral, Real
from typing import Any, NoReturn, TypeAlias

from kempe.errors import ModelError, Problem

#: A number in SI units, or a formula in the parameters of the model as text.
Number: TypeAlias = "float | str"
#: Two numbers or formulas, such as a point or a vector.
Pair: TypeAlias = "Sequence[float | str]"
#: Pairs, such as ranges.
Pairs: TypeAlias = "Sequence[Pair]"
#: Numbers or formulas.
Numbers: TypeAlias = "Sequence[float | str]"
#: Numbers or formulas by the names of quantities.
Terms: TypeAlias = "Mapping[str, float | str]"
#: Words.
Words: TypeAlias = "Sequence[str]"
#: A number for all quantities, or one for each of ``length``, ``angle`` and ``z``.
Tolerance: TypeAlias = "float | str | Mapping[str, float | str]"
#: Named points of a body, in its frame, m.
Points: TypeAlias = "Mapping[str, Sequence[float | str]]"

#: Named curves of a body, each a mapping in one of the forms that ``Model.body`` lists.
Curves: TypeAlias = "Mapping[str, Mapping[str, Any]]"

#: Shapes of a body, each a mapping with a type and the fields that ``Model.body`` lists.
Shapes: TypeAlias = "Sequence[Mapping[str, Any]]"
#: Points, or a mapping with the key ``circle`` or ``path``.
Outline: TypeAlias = "Sequence[Sequence[float | str]] | Mapping[str, Any]"

#: Longer texts of wrong values are not part of a message.
_LONGEST = 80
#: A float represents every integer up to this limit exactly.
_LARGEST_EXACT_INTEGER = 2**53


def refuse(path: str, message: str) -> NoReturn:
    """Raise the ``ModelError`` for the field at ``path``."""
    raise ModelError(f"{path}: {message}", problems=(Problem(message, path),))


def number(value: object, path: str) -> float | str:
    """A finite real number, or the text of a formula.

    NumPy scalars and arrays without dimensions are accepted as numbers.
    """
    if type(value) is float and math.isfinite(value):
        return value
    if getattr(value, "ndim", None) == 0 and hasattr(value, "item"):
        value = value.item()
    if isinstance(value, str):
        return value if value.strip() else refuse(path, "empty text; must be a number or a formula")
    if callable(value):
        refuse(path, "a Python function is not allowed; write the formula as text")
    if isinstance(value, bool) or not isinstance(value, Real):
        refuse(path, f"{value!r} is not a real number or the text of a formula")
    if isinstance(value, Integral) and abs(int(value)) <= _LARGEST_EXACT_INTEGER:
        return int(value)
    return _finite(value, path)


def _finite(value: Real, path: str) -> float:
    try:
        result = float(value)
    except OverflowError:
        refuse(path, "too large for a floating point number")
    return result if math.isfinite(result) else refuse(path, f"{result}; must be finite")


def pair(value: object, path: str) -> tuple[float | str, float | str]:
    """Two numbers or formulas from any sequence of two."""
    first, second = two(value, path, "two numbers or formulas")
    return number(first, f"{path}[0]"), number(second, f"{path}[1]")


def pairs(value: object, path: str) -> tuple[tuple[float | str, float | str], ...]:
    """Pairs of numbers or formulas, such as ranges."""
    if isinstance(value, str) or not isinstance(value, Iterable):
        refuse(path, f"{value!r}; must be pairs of numbers")
    return tuple(pair(one, f"{path}[{k}]") for k, one in enumerate(value))


def triple(value: object, path: str) -> tuple[float | str, ...]:
    """Three numbers or formulas from any sequence of three."""
    found = listed_numbers(value, path)
    if len(found) != 3:
        refuse(path, f"{value!r}; must be a list of three numbers or formulas")
    return found


def reference(value: object, path: str) -> str:
    """A name such as ``crank``, ``crank.B`` or ``crank.angle``; its existence is checked later."""
    if not isinstance(value, str):
        refuse(path, f"{value!r} is not a name")
    if not value.strip():
        refuse(path, "empty name")
    if not value.isprintable() and value != value.encode("utf-8", "ignore").decode():
        refuse(path, f"{value!a} contains half a character")
    return value


def vector(value: object, path: str) -> tuple[float, float]:
    """Two numbers, not formulas."""
    if type(value) is tuple and len(value) == 2 and type(value[0]) is type(value[1]) is float:
        return value
    x, y = pair(value, path)
    if isinstance(x, str) or isinstance(y, str):
        refuse(path, f"{value!r}; must be two numbers")
    return float(x), float(y)


def texts(value: object, path: str) -> list[str]:
    """Names in a list."""
    if isinstance(value, str) or (found := _listed(value)) is None:
        hint = f"; write [{value!r}]" if isinstance(value, str) else ""
        refuse(path, f"{value!r}; must be a list of names{hint}")
    return [reference(name, f"{path}[{k}]") for k, name in enumerate(found)]


def instance(value: object, kinds: type | tuple[type, ...], what: str) -> None:
    """Refuse a value of another kind.

    Args:
        value: the value.
        kinds: its kinds.
        what: the kinds in words, such as "a solution".
    """
    if not isinstance(value, kinds):
        text = repr(value)
        raise ModelError(f"{text if len(text) < _LONGEST else type(value)} is not {what}")


def mapping(value: object, path: str, form: str) -> Mapping[Any, Any]:
    """A mapping; an empty one for None."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        refuse(path, f"{value!r}; must be a mapping such as {form}")
    return value


def names(value: object, path: str) -> tuple[str, str]:
    """Two names."""
    first, second = two(value, path, "two names")
    return reference(first, f"{path}[0]"), reference(second, f"{path}[1]")


def points(value: object, path: str) -> dict[str, tuple[float | str, float | str]]:
    """Named points, each two numbers or formulas."""
    return {
        reference(name, path): pair(point, f"{path}.{name}")
        for name, point in _items(value, path, "{'P': (x, y)}")
    }


def curves(value: object, path: str) -> dict[str, dict[str, Any]]:
    """Named curves; the core checks which keys make a curve."""
    form = "{'rim': {'circle': (x, y, r)}}"
    return {
        reference(name, path): {
            reference(key, f"{path}.{name}"): _of_curve(entry, f"{path}.{name}.{key}")
            for key, entry in _items(curve, f"{path}.{name}", "{'circle': (x, y, r)}")
        }
        for name, curve in _items(value, path, form)
    }


def shapes(value: object, path: str) -> list[dict[str, Any]]:
    """Shapes of a body; the core checks which keys make a shape."""
    form = "{'type': 'disc', 'radius': 0.1, 'mass': 1}"
    if isinstance(value, str | bytes | Mapping) or (found := _listed(value)) is None:
        refuse(path, f"{value!r}; must be a list of shapes such as {form}")
    return [
        {
            reference(key, f"{path}[{k}]"): _of_curve(entry, f"{path}[{k}].{key}")
            for key, entry in _items(shape, f"{path}[{k}]", form)
        }
        for k, shape in enumerate(found)
    ]


def outline(value: object, path: str) -> Any:
    """Points without names, or a mapping with a circle or a path; the core checks them."""
    if isinstance(value, Mapping):
        return {
            reference(key, path): _of_curve(entry, f"{path}.{key}") for key, entry in value.items()
        }
    if isinstance(value, str | bytes) or (found := _listed(value)) is None:
        form = "[(x, y), …], {'circle': (x, y, r)} or {'path': 'M 0 0 L …'}"
        refuse(path, f"{value!r}; must be {form}")
    return [list(pair(point, f"{path}[{k}]")) for k, point in enumerate(found)]


def section(value: object, path: str) -> dict[str, Any]:
    """A cross section: a mapping with one key; the core checks it."""
    form = "kp.Section.rectangle(height=0.01, width=0.02)"
    if not isinstance(value, Mapping):
        refuse(path, f"{value!r}; must be a section such as {form}")
    return {reference(key, path): _of_curve(entry, f"{path}.{key}") for key, entry in value.items()}


def _of_curve(value: object, path: str) -> Any:
    """A number, a text, a flag, or lists of them to any depth, arrays included."""
    if isinstance(value, bool | str):
        return value
    if getattr(value, "ndim", 0) or isinstance(value, list | tuple):
        return [_of_curve(entry, f"{path}[{k}]") for k, entry in enumerate(value)]  # type: ignore[arg-type, var-annotated]
    return number(value, path)


def numbers(value: object, path: str) -> dict[str, float | str]:
    """Named numbers or formulas, such as parameters or given coordinates."""
    return {
        reference(name, path): number(entry, f"{path}.{name}")
        for name, entry in _items(value, path, "{'name': number}")
    }


def tolerance(value: object, path: str) -> float | str | dict[str, float | str]:
    """A number, or a mapping with numbers for some of ``length``, ``angle`` and ``z``."""
    return numbers(value, path) if isinstance(value, Mapping) else number(value, path)


def two(value: object, path: str, what: str) -> tuple[object, object]:
    """The entries of a sequence of two."""
    if callable(value):
        refuse(path, "one Python function; write two, or formulas as text")
    entries = None if isinstance(value, str | bytes | Mapping) else _listed(value)
    if entries is None:
        refuse(path, f"{value!r}; must be {what}")
    if len(entries) != 2:
        refuse(path, f"{len(entries)} values; must be {what}")
    return entries[0], entries[1]


def listed_numbers(value: object, path: str) -> tuple[float | str, ...]:
    """Numbers or formulas from any sequence."""
    if isinstance(value, str | bytes | Mapping) or (found := _listed(value)) is None:
        refuse(path, f"{value!r}; must be a list of numbers or formulas")
    return tuple(number(entry, f"{path}[{k}]") for k, entry in enumerate(found))


def listed_words(value: object, path: str) -> tuple[str, ...]:
    """Words from any sequence."""
    if isinstance(value, str | bytes | Mapping) or (found := _listed(value)) is None:
        refuse(path, f"{value!r}; must be a list of words")
    return tuple(reference(entry, f"{path}[{k}]") for k, entry in enumerate(found))


def flag(value: object, path: str) -> bool:
    """True or False."""
    if getattr(value, "ndim", None) == 0 and hasattr(value, "item"):
        value = value.item()  # of NumPy
    if isinstance(value, bool | int):
        return bool(value)
    return refuse(path, f"{value!r}; must be True or False")


def plain(value: object, path: str) -> Any:
    """A value as in a file: texts, numbers, lists and tables of them."""
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, Mapping):
        return {reference(key, path): plain(entry, f"{path}.{key}") for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry, f"{path}[{k}]") for k, entry in enumerate(value)]
    return number(value, path)


def listed(value: object, path: str) -> list[Any]:
    """The entries of a sequence."""
    found = _listed(value)
    return refuse(path, f"{value!r}; must be a list") if found is None else found


def _listed(value: object) -> list[object] | None:
    """The entries of a sequence; None for any other value."""
    try:
        return list(value)  # type: ignore[call-overload,no-any-return]
    except TypeError:
        return None


def _items(value: object, path: str, form: str) -> list[tuple[object, object]]:
    return list(mapping(value, path, form).items())


def data(value: Any) -> Any:
    """A copy as data of a file: mappings and lists."""
    if isinstance(value, Mapping):
        return {key: data(entry) for key, entry in value.items()}
    return [data(entry) for entry in value] if isinstance(value, list | tuple) else value


#: The check for each kind of field; ``functions`` has those of laws.
CHECKS: Mapping[str, Callable[[object, str], Any]] = {
    "body": reference,
    "point": reference,
    "coordinate": reference,
    "joint": reference,
    "number": number,
    "pair": pair,
    "ranges": pairs,
    "triple": triple,
    "laws": listed_numbers,
    "terms": numbers,
    "units": listed_words,
    "flag": flag,
    "word": reference,
    "names": names,
    "points": points,
    "curves": curves,
    "shapes": shapes,
    "outline": outline,
    "section": section,
    "curve": reference,
    "condition": reference,
    "name_list": listed_words,
    "quantities": listed_words,
    "two_texts": listed_words,
    "values": numbers,
}
