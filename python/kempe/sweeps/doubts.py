"""Values of variables that look like degrees; a warning as for values at the start of a case."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import radians

from kempe.analyses.record import AssemblyWarning
from kempe.base.names import few
from kempe.base.warn import warn
from kempe.sweeps.plan import Plan
from kempe.sweeps.variables import Variable

#: Least magnitude of an angle that causes a warning, rad, as in the core.
_LEAST = 10.0


def warn_of_degrees(plan: Plan, variables: Sequence[Variable]) -> None:
    """Warn about angles of 10 rad or more with at most one decimal, such as 70 or 22.5."""
    for variable in variables:
        found = [x for x in _written(variable) if abs(x) >= _LEAST and _is_short(x)]
        if found and _is_angle(plan, variable.name):
            told, looks = few([f"{x:g}" for x in found], 3), "look" if found[1:] else "looks"
            warn(
                f"variables.{variable.name}: {told} {looks} like degrees, but values of a sweep "
                f"are in rad; {found[0]:g} degrees are {radians(found[0]):.6g}",
                AssemblyWarning,
            )


def _written(variable: Variable) -> Iterable[float]:
    """The numbers that the user wrote, without a standard deviation."""
    if variable.ends is None:
        return variable.levels or ()
    return variable.ends[:1] if variable.kind == "normal" else variable.ends


def _is_short(x: float) -> bool:
    return abs(10.0 * x - round(10.0 * x)) < 1e-12 * abs(x)


def _is_angle(plan: Plan, name: str) -> bool:
    """Whether a variable is an angle, or a parameter that is the value of an angle at the start."""
    return "rad" in map(plan.unit_of, [name, *_set_by(plan, name)])


def _set_by(plan: Plan, parameter: str) -> Iterator[str]:
    """The coordinates at the start that are a parameter and nothing else."""
    start = plan.case._start
    for coordinate, value in [*start.set.items(), *start.guess.items()]:
        if isinstance(value, str) and value.strip() == parameter:
            yield coordinate
