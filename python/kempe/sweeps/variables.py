"""The variables of a sweep: parameters or start values, with a list, a range or a distribution."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import NormalDist
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.names import unknown
from kempe.model.values import instance, mapping, refuse

if TYPE_CHECKING:
    from kempe.case import Case

#: The values of a variable as the user gives them.
Values: TypeAlias = "Sequence[float] | Mapping[str, Any]"

_FORMS = (
    "a list of numbers, {'from': 1, 'to': 2, 'n': 11}, {'normal': [mean, deviation]} or "
    "{'uniform': [least, most]}"
)
#: Largest number of variants of a sweep; a table of ten columns then has 0.8 GB.
MOST = 10_000_000
#: Least distance from the ends of the unit interval for values of a normal distribution; a number
#: nearer to 1 is rounded to 1.
_EDGE = 2.0**-53


@dataclass(frozen=True)
class Variable:
    """A variable.

    Attributes:
        name: a parameter such as ``L2``, or a coordinate or rate at the start such as
            ``crank.omega``.
        levels: the values of a list or a range; None for a distribution, and for a range without
            ``n``.
        ends: least and largest value of a range or a uniform distribution; mean and standard
            deviation of a normal distribution; None for a list.
        kind: "list", "linear", "log", "uniform" or "normal".
    """

    name: str
    levels: tuple[float, ...] | None
    ends: tuple[float, float] | None
    kind: str

    @property
    def of_start(self) -> bool:
        """Whether it is a value at the start."""
        return "." in self.name

    @property
    def is_log(self) -> bool:
        """Whether its values are spread over a logarithmic scale."""
        return self.kind == "log"

    def at(self, share: Floats) -> Floats:
        """Its values at points of the unit interval: the inverse of its distribution function.

        Lists and ranges have an even distribution, logarithmic ranges on the logarithmic scale.
        """
        if self.kind == "list":
            assert self.levels is not None
            count = len(self.levels)
            place = np.minimum((share * count).astype(int), count - 1)
            chosen: Floats = np.array(self.levels)[place]
            return chosen
        assert self.ends is not None
        first, second = self.ends
        if self.kind == "normal":
            normal = NormalDist(first, second)
            inside = np.clip(share, _EDGE, 1.0 - _EDGE)
            return np.array([normal.inv_cdf(u) for u in inside.tolist()])
        if self.kind == "log":
            return np.asarray(first * (second / first) ** share, dtype=np.float64)
        return np.asarray(first + share * (second - first), dtype=np.float64)


def read_variables(case: Case, variables: Mapping[str, Values]) -> list[Variable]:
    """The variables of a case, checked.

    Raises:
        ModelError: a name is neither a parameter nor a coordinate or rate, or values are invalid.
    """
    given = mapping(variables, "variables", "{'L2': [25, 26, 27]}")
    check_names(case, given)
    return [_variable(name, values) for name, values in given.items()]


def check_names(case: Case, names: Collection[str]) -> None:
    """Refuse names of variables that cannot be parameters, coordinates or rates.

    Raises:
        ModelError: a name is neither a parameter nor has a point.
    """
    compiled = case.model.compile()
    known = [*compiled.parameters, *compiled.column_names(), *compiled.rate_names()]
    for name in names:
        if name not in compiled.parameters and (not isinstance(name, str) or "." not in name):
            raise unknown("variable", name, known)


def changed(case: Case, values: Mapping[str, Any]) -> Case:
    """The case with other values of parameters and of coordinates and rates at the start.

    Raises:
        ModelError: the model is impossible with these values.
    """
    parameters = {name: x for name, x in values.items() if "." not in name}
    start = {name: x for name, x in values.items() if "." in name}
    case = case.with_parameters(parameters) if parameters else case
    return case.with_start(start) if start else case


def present(case: Case, names: Iterable[str]) -> dict[str, float]:
    """The values of parameters, and of coordinates and rates at the start, in the case.

    A name without a point that is no parameter has the value NaN.

    Raises:
        KempeError: the mechanism does not close, or there is no such coordinate.
    """
    from kempe.case import Case

    instance(case, Case, "a case, as kp.load(path) returns")
    parameters, start = case.model.parameters, None
    found = {}
    for name in names:
        if name in parameters or "." not in name:
            found[name] = float(parameters.get(name, np.nan))
            continue
        start = start or case.start()
        found[name] = float(start[name])
    return found


def _variable(name: str, values: Values) -> Variable:
    path = f"variables.{name}"
    if isinstance(values, Mapping):
        keys = set(values)
        for kind in ("normal", "uniform"):
            if keys == {kind}:
                return Variable(name, None, _ends(values[kind], f"{path}.{kind}", kind), kind)
        if {"from", "to"} <= keys <= {"from", "to", "n", "scale"}:
            return _range(name, values, path)
        refuse(path, f"{dict(values)!r} is none of {_FORMS}")
    levels = tuple(_numbers(values, path))
    if not levels:
        refuse(path, "the list is empty")
    return Variable(name, levels, None, "list")


def _range(name: str, given: Mapping[str, Any], path: str) -> Variable:
    first, last = _numbers([given["from"], given["to"]], path)
    scale, count = given.get("scale", "linear"), given.get("n")
    if scale not in ("linear", "log"):
        refuse(f"{path}.scale", f"{scale!r} is neither 'linear' nor 'log'")
    if scale == "log" and not first * last > 0.0:
        refuse(path, f"a logarithmic range from {first:g} to {last:g}; both must have one sign")
    if count is None:
        return Variable(name, None, (first, last), scale)
    if not isinstance(count, int) or isinstance(count, bool) or not 2 <= count <= MOST:
        refuse(f"{path}.n", f"{count!r}; must be a whole number from 2 to {MOST}")
    spaced = np.geomspace if scale == "log" else np.linspace
    return Variable(name, tuple(spaced(first, last, count).tolist()), (first, last), scale)


def _ends(pair: Any, path: str, kind: str) -> tuple[float, float]:
    numbers = _numbers(pair, path)
    if len(numbers) != 2:
        refuse(path, f"{len(numbers)} numbers; must be 2")
    first, second = numbers
    if kind == "normal" and not second > 0.0:
        refuse(path, f"the standard deviation is {second:g}; must be > 0")
    if kind == "uniform" and not second > first:
        refuse(path, f"from {first:g} to {second:g}; the second must be larger")
    return first, second


def _numbers(values: Any, path: str) -> list[float]:
    try:
        found = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        refuse(path, f"{values!r} is none of {_FORMS}; numbers are in SI units and rad")
    if found.ndim != 1:
        refuse(path, f"{values!r} is none of {_FORMS}")
    if not np.isfinite(found).all():
        refuse(path, f"{values!r} has a number that is not finite")
    return [float(x) for x in found]
