"""Mobility: the freedoms of a mechanism at a position, and its redundant constraints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from math import degrees
from typing import TYPE_CHECKING, Any

from kempe.analyses.record import Record, check, run_analysis
from kempe.base.arguments import explained
from kempe.base.display_units import display
from kempe.base.names import few
from kempe.model.model import Model, compiled_model
from kempe.results.result import Result
from kempe.results.state import State

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel

#: Largest number of redundancies or loops in a report.
_MOST = 20
#: Descriptions of the kinds of singular positions.
_KINDS = {
    "dead point": "a driver cannot move the mechanism from here",
    "change point": "motions cross here, so that the branch is not determined",
    "uncertainty": "there are velocities, but no motion in their direction",
    "second order": "so in every position; these equations keep a coordinate constant",
}


@dataclass(frozen=True)
class Remedy:
    """The equations of one joint that may be removed to resolve a redundancy.

    Its ``str`` is a text such as ``B along x``.

    Attributes:
        joint: the joint or driver.
        equations: the equations of the joint that take part, such as ``B.x``.
        axis: for a pin, the direction that may be freed, rad from the x axis of ``body``; a slot
            with this axis in ``body`` leaves it free. None for other joints.
        body: the body with which the direction turns, or "ground" if it is constant. None if the
            direction turns with neither body; ``axis`` is then measured from ground and valid in
            this position only.
        text: the text in reports.
    """

    joint: str
    equations: tuple[str, ...]
    axis: float | None
    body: str | None
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Redundancy:
    """A redundant equation: other equations imply it, permanently or at this position.

    Attributes:
        joints: the joints and drivers that take part.
        equations: their equations that take part, such as ``C.x``. Any one of them may be removed.
        remedies: for each joint the equations that may be removed while the joint is kept; one
            remedy is enough.
        remove: one of ``equations``; these choices of all redundancies may be removed together.
        consistent: whether the rates that drivers prescribe satisfy the redundant equation.
        kind: "dead point", "change point" or "uncertainty" if the equation is redundant at this
            position only; "second order" if it is so in every position and keeps a coordinate
            constant; empty if it is permanently redundant.
    """

    joints: tuple[str, ...]
    equations: tuple[str, ...]
    remedies: tuple[Remedy, ...]
    remove: str
    consistent: bool
    kind: str = ""

    @property
    def example(self) -> Remedy:
        """The remedy that removes ``remove``."""
        return next(each for each in self.remedies if self.remove in each.equations)


@dataclass(frozen=True)
class FourBar:
    """A closed loop of four bodies and four pins.

    Attributes:
        bodies: the bodies, each next to its neighbours; ground first if it takes part.
        pins: the joints between consecutive bodies, beginning with the first and second body.
        lengths: the distances of the two pins of each body, m.
        kind: "crank-rocker", "double crank", "double rocker", "triple rocker", "change point", or
            "Grashof" if ground does not take part.
        turning: the bodies that turn fully relative to their neighbours; None for a change-point
            loop, where this depends on the branch.
    """

    bodies: tuple[str, ...]
    pins: tuple[str, ...]
    lengths: tuple[float, ...]
    kind: str
    turning: tuple[str, ...] | None


class MobilityResult(Result):
    """The freedoms and redundant constraints of a mechanism at a position.

    Attributes:
        gruebler: number of coordinates minus number of constraint equations, including drivers.
        degrees_of_freedom: number of coordinates minus number of independent constraint equations.
        rank: number of independent constraint equations.
        driven: number of equations of drivers.
        redundant: equations that are redundant at every position.
        singular: equations that are redundant at this position only.
        locked: bodies that cannot move, even if the drivers are released.
        loose: bodies that no chain of joints connects with ground.
        undetermined: massless bodies whose motion is not determined, by name, with the message of
            the error that ``dynamics`` raises.
        four_bars: closed loops of four pins.
    """

    kind = "mobility"

    def __init__(self, record: Record) -> None:
        self._state, found = record.initial, record.findings
        self.gruebler: int = found["gruebler"]
        self.degrees_of_freedom: int = found["degrees_of_freedom"]
        self.rank: int = found["rank"]
        self.driven: int = found["driven"]
        self.redundant = tuple(_redundancy(each) for each in found["redundant"])
        self.singular = tuple(_redundancy(each) for each in found["singular"])
        self.locked: tuple[str, ...] = tuple(found["locked"])
        self.loose: tuple[str, ...] = tuple(found["loose"])
        self.undetermined: dict[str, str] = dict(found["undetermined"])
        self.four_bars = tuple(_four_bar(each) for each in found["four_bars"])

    @property
    def final(self) -> State:
        """The state that was examined."""
        return self._state

    def summary(self) -> dict[str, Any]:
        """The findings as plain data; lengths in m."""
        return {
            "type": self.kind,
            "gruebler": self.gruebler,
            "degrees_of_freedom": self.degrees_of_freedom,
            "rank": self.rank,
            "driven": self.driven,
            "redundant": [asdict(each) for each in self.redundant],
            "singular": [asdict(each) for each in self.singular],
            "locked": list(self.locked),
            "loose": list(self.loose),
            "undetermined": self.undetermined,
            "four_bars": [asdict(each) for each in self.four_bars],
        }

    def report(self) -> list[str]:
        """The findings in sentences."""
        model = self._state.compiled
        counts = f"{model.n_q} coordinates - {model.n_rows} equations = {self.gruebler} by Grübler"
        free = _plural(self.degrees_of_freedom, "degree")
        lines = [f"{counts}; rank {self.rank}: {free} of freedom{self._without_drivers()}"]
        lines += _limited([line for each in self.redundant for line in _told(each)])
        lines += _limited([line for each in self.singular for line in _told(each)])
        if self.locked:
            lines.append(f"cannot move: {few(self.locked)}")
        if self.loose:
            lines.append(f"not connected with ground: {few(self.loose)}")
        lines += _limited(list(self.undetermined.values()))
        return lines + _limited([_loop(each) for each in self.four_bars])

    def _without_drivers(self) -> str:
        if not self.driven:
            return ""
        dependent = len(self.redundant) + len(self.singular)
        if dependent:
            return f", with {_plural(self.driven, 'equation')} of drivers"
        return f", {self.degrees_of_freedom + self.driven} without its {_drivers(self.driven)}"

    def __repr__(self) -> str:
        free = _plural(self.degrees_of_freedom, "degree")
        redundant = f", {len(self.redundant)} redundant" if self.redundant else ""
        singular = f", {self.singular[0].kind}" if self.singular else ""
        return f"<MobilityResult: {free} of freedom{redundant}{singular}>"


@explained
def mobility(model: Model | CompiledModel, state: State) -> MobilityResult:
    """Find the freedoms and redundant constraints of a mechanism at an assembled position.

    The result contains the degrees of freedom by Grübler's count and by rank, redundant equations
    with all joints that take part, the kind of a singular position, locked and loose bodies,
    massless bodies whose motion is not determined, and four-bar loops with their Grashof type.
    Forces are not needed.

    Args:
        model: the mechanism. A model with redundant joints needs ``redundancy="allow"`` to be
            assembled.
        state: an assembled state.
    """
    compiled = compiled_model(model)
    check(compiled, state, "state")
    return MobilityResult(run_analysis(compiled, state, {"type": MobilityResult.kind}))


def _redundancy(found: Mapping[str, Any]) -> Redundancy:
    joints, equations = tuple(found["joints"]), tuple(found["equations"])
    remedies = tuple(
        Remedy(each["joint"], tuple(each["equations"]), each["axis"], each["body"], each["text"])
        for each in found["remedies"]
    )
    kind = found.get("kind", "")
    return Redundancy(joints, equations, remedies, found["remove"], found["consistent"], kind)


def _four_bar(found: Mapping[str, Any]) -> FourBar:
    bodies, pins, lengths = (tuple(found[key]) for key in ("bodies", "pins", "lengths"))
    turning = None if found["turning"] is None else tuple(found["turning"])
    return FourBar(bodies, pins, lengths, found["kind"], turning)


def _told(one: Redundancy) -> list[str]:
    """The lines about a redundancy."""
    joints = ", ".join(one.joints)
    if one.kind:
        return [f"singular position, {one.kind}: {_KINDS[one.kind]} ({joints})"]
    verdict = "" if one.consistent else "; the drivers CONTRADICT each other"
    any_of = ", ".join(map(str, one.remedies))
    return [
        f"one equation too many among {joints}{verdict}",
        f"  any one of these may be freed: {any_of}; {_advice(one.example)}",
    ]


def _advice(remedy: Remedy) -> str:
    """How to free one direction or equation."""
    if remedy.axis is None:
        return f"for example {remedy.equations[0]}"
    axis = f"axis = {degrees(remedy.axis) + 0.0:.6g} deg"
    if remedy.body is None:
        return f"for example {remedy.joint} as a pin in a slot"
    return f"for example {remedy.joint} as a pin in a slot of {remedy.body}, {axis}"


def _loop(one: FourBar) -> str:
    """The line about a four-bar loop."""
    unit = display("m")
    pairs = zip(one.bodies, one.lengths, strict=True)
    links = ", ".join(f"{name} {length / unit.divisor:.4g}" for name, length in pairs)
    if one.turning is None:
        turns = "all links can lie in line"
    elif not one.turning:
        turns = "no link turns fully"
    else:
        verb = "turns" if len(one.turning) == 1 else "turn"
        turns = f"{' and '.join(one.turning)} {verb} fully"
    return f"four-bar {'-'.join(one.pins)}: {one.kind}, {turns} ({links} {unit.symbol})"


def _limited(lines: list[str]) -> list[str]:
    if len(lines) <= _MOST:
        return lines
    return [*lines[:_MOST], f"and {len(lines) - _MOST} more lines"]


def _plural(count: int, word: str) -> str:
    return f"{count} {word}{'' if count == 1 else 's'}"


def _drivers(count: int) -> str:
    return "driver" if count == 1 else "drivers"
