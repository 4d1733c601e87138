"""Remarks beside values of reactions: that they are not unique, or that they have no bound.

Redundant constraints do not determine the reactions of the joints that take part; the values are
then the smallest ones that carry the loads. Joints that keep a coordinate only to second order
would need infinite forces for a load along it, which their values leave out. Friction that drivers
hold at rest may carry any part of the load up to its limit; the values are then the middle of their
interval. Contacts and friction at rest may share a load in more than one way; the values are then
one of these ways. A run can also pass a singular position beside which a reaction has no bound.
Tables, files and figures state this beside the values, and so they do for measures and other
results that read such a joint, driver or force.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from kempe.base.display_units import display
from kempe.base.names import few, owner_of
from kempe.results.extrema import peak, unbounded
from kempe.results.quantities import values_of
from kempe.results.variable import TIME, Variable

if TYPE_CHECKING:
    from kempe.base.arrays import Floats
    from kempe.model.compiled import CompiledModel
    from kempe.model.infos import ConstraintInfo, ForceInfo
    from kempe.model.measure_infos import MeasureInfo
    from kempe.results.motion import Motion

#: The remarks at values that are not unique: which of the possible values is given.
MINIMUM_NORM = "minimum norm"
LEFT_OUT = "second-order load left out"
MIDDLE = "middle of friction at rest"
ONE_SHARE = "one way to share the load"
#: What they mean, behind "not unique".
_MEANING = {
    MINIMUM_NORM: f"of the smallest multipliers ({MINIMUM_NORM})",
    LEFT_OUT: "the load along a coordinate kept only to second order is left out: it would need "
    "infinite forces",
    MIDDLE: "friction at rest may have any value in an interval, whose middle is given",
    ONE_SHARE: "contacts and friction at rest can share the load in several ways; one of them is "
    "given",
}
#: Times closer than this fraction of the motion belong to one position.
_SAME_TIME = 1e-3
#: Reactions below this fraction of the largest multipliers are zero; errors have poles too.
_NOTHING = 1e-9
#: Units of measures that are forces or torques.
_FORCES = ("N", "N*m")
#: Units of results of force elements that change with their forces.
_LOADS = (*_FORCES, "Pa")

#: For each motion, the times that are known of a joint or driver and a part of its reaction.
_known: WeakKeyDictionary[Motion, dict[tuple[str, str], list[float]]] = WeakKeyDictionary()


def read_by(model: CompiledModel, names: Iterable[str]) -> frozenset[str]:
    """The joints, drivers and forces whose loads enter into quantities or measures.

    Positions and rates of a joint or driver do not depend on its multipliers. A force element that
    follows from a reaction, such as friction, also reads the joint of this reaction.
    """
    found: set[str] = set()
    for name in names:
        owner, quantity = owner_of(name)
        if name in model.measures:
            found |= read_by(model, model.measures[name].quantities)
        elif owner in model.constraints:
            if quantity not in _positions(model.constraints[owner]):
                found.add(owner)
        elif owner in model.forces and model.forces[owner].reads_multipliers:
            info = model.forces[owner]
            found |= set(model.constraints) if info.reaction is None else {info.reaction}
            if quantity not in _unloaded(info):
                found.add(owner)
    return frozenset(found)


def _unloaded(info: ForceInfo) -> set[str]:
    """The quantities of a force element that do not depend on its forces."""
    results = {name for name, unit in info.results if unit not in _LOADS}
    return results | {name for of in info.measured for name in of.names if name}


def _positions(info: ConstraintInfo) -> set[str]:
    """The quantities of a joint or driver that do not depend on multipliers."""
    own = {f"{name}{end}" for name, _ in info.coordinates for end in ("", "_rate")}
    return own | {name for of in info.measured for name in of.names if name}


def choice_of(motion: Motion, *names: str) -> str:
    """Which of the possible values quantities or measures have; empty if they are unique."""
    choices = motion.choices
    read = read_by(motion.compiled, names) if choices else frozenset()
    return together(choices[name] for name in read if name in choices)


def together(choices: Iterable[str]) -> str:
    """Choices in one text, each once."""
    joined = " and ".join(choices)
    return " and ".join(one for one in _MEANING if one in joined)


def by_choice(choices: Mapping[str, str]) -> Iterator[tuple[str, str, list[str]]]:
    """Each choice that occurs, what it means behind "not unique", and the names that have it."""
    for choice, meaning in _MEANING.items():
        if names := [name for name, own in choices.items() if choice in own]:
            yield choice, meaning, names


def condition(motion: Motion, name: str, unit: str) -> str:
    """What a force, power or measure of reactions over a driven quantity contains; or empty."""
    measure = motion.compiled.measures.get(name)
    if measure is not None and measure.solves:
        return motion.variable.condition
    return motion.variable.condition_of(unit)


def unbounded_at(
    motion: Motion, joint: str, parts: Sequence[str] = ("force", "torque")
) -> tuple[float, ...]:
    """Times of singular positions beside which the reaction of a joint or driver has no bound.

    Args:
        motion: a solution; any other motion has no such times.
        joint: the joint or driver.
        parts: the parts of the reaction.
    """
    known = _known.setdefault(motion, {})
    found: list[float] = []
    for part in parts:
        if (joint, part) not in known:
            known[joint, part] = _unbounded_at(motion, joint, part)
        for t in known[joint, part]:
            if all(abs(t - other) > _SAME_TIME * np.ptp(motion.t) for other in found):
                found.append(t)
    return tuple(sorted(found))


def _unbounded_at(motion: Motion, joint: str, part: str) -> list[float]:
    on = motion.compiled.constraints[joint].j

    def force(at: Motion) -> Floats:
        return np.asarray(np.hypot(*at.constraint(joint).force(on=on).T))

    def torque(at: Motion) -> Floats:
        return np.asarray(at.constraint(joint).torque(on=on))

    return poles(motion, force if part == "force" else torque)


def poles(motion: Motion, read: Callable[[Motion], Floats]) -> list[float]:
    """Times of singular positions beside which a force or torque has no bound.

    A force that vanishes has none, although its errors grow beside such a position.
    """

    def multipliers(at: Motion) -> Floats:
        return np.asarray(np.linalg.norm(np.atleast_2d(at.lam), axis=1))

    found: list[float] = unbounded(motion, read).tolist()
    if found and abs(peak(motion, read).value) <= _NOTHING * peak(motion, multipliers).value:
        return []
    return found


def measure_unbounded_at(motion: Motion, info: MeasureInfo) -> tuple[float, ...]:
    """Times of singular positions beside which a measure has no bound."""

    def read(at: Motion) -> Floats:
        return values_of(at, info)

    if info.is_of_run or not info.solves:
        return ()
    return tuple(poles(motion, read) if info.unit in _FORCES else unbounded(motion, read).tolist())


def remark(choice: str = "", *, times: Sequence[float] = (), variable: Variable = TIME) -> str:
    """The remarks behind a name or value, such as ``, minimum norm``; empty if there is none.

    Args:
        choice: which of the possible values are given; empty if they are unique.
        times: the times beside which they have no bound.
        variable: the quantity in these times.
    """
    told = f", {choice}" if choice else ""
    return told + (f", without bound {when(times, variable)}" if times else "")


def remark_of_variants(choice: str = "", *, unbounded: int, count: int) -> str:
    """The remarks behind the name of a measure of many variants; empty if there is none.

    Args:
        choice: which of the possible values are given; empty if all are unique.
        unbounded: the number of variants in which the measure has no bound.
        count: the number of variants that succeeded.
    """
    told = remark(choice)
    return told + (f", without bound in {unbounded} of {count} variants" if unbounded else "")


def joint_remark(motion: Motion, joint: str) -> str:
    """The remarks on the reaction of a joint or driver."""
    choice = motion.choices.get(joint, "")
    return remark(choice, times=unbounded_at(motion, joint), variable=motion.variable)


def starred(name: str, *, unique: bool) -> str:
    """A name in a table of numbers, with a star if these are not unique."""
    return name if unique else f"* {name}"


def not_unique(choices: Mapping[str, str]) -> list[str]:
    """The lines below a table that has stars, for the choices of the names in it."""
    return [f"* not unique, {meaning}: {few(names)}" for _, meaning, names in by_choice(choices)]


def when(
    times: Sequence[float], variable: Variable, place: Callable[[float], str] | None = None
) -> str:
    """Times in a sentence: ``at 0.5 s``, or ``first at 0.5 s, last at 2 s``.

    Args:
        times: at least one time, ascending.
        variable: the quantity in these times.
        place: writes a time with its unit; with four digits when None.
    """
    shown = display(variable.unit, "deg" if variable.unit == "rad" else None)
    gap = "" if shown.symbol == "°" else " "

    def usual(t: float) -> str:
        return f"{t / shown.divisor:.4g}{gap}{shown.symbol}".replace("-", "−")

    first, last = ((place or usual)(times[k]) for k in (0, -1))
    return f"at {first}" if first == last else f"first at {first}, last at {last}"
