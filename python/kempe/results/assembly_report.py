"""The report of an assembly: its iterations, the assembly mode, and the unset coordinates."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from kempe.base.display_units import display
from kempe.base.names import few

#: Largest number of modes that a report lists.
MOST_MODES = 20
#: From this number on, the number of other assemblies is given as a power of two.
MOST_COUNTED = 1_000_000
#: Largest number of coordinates and rates that a report names.
_MOST_CHOICES = 4
#: The remarks about the sources of values that differ from the names of the sources.
_SOURCES = {
    "guesses": "from the guesses",
    "drawing": "as drawn",
    "nothing": "no guess",
    "rest": "at rest",
}


@dataclass(frozen=True)
class Iteration:
    """One iteration of an assembly.

    Attributes:
        residual: norm of Φ after the iteration, with lengths relative to the size of the mechanism;
            the first entry is the residual of the start.
        step: norm of the full Newton step, with lengths relative to this size; 0 for the start.
        damping: applied fraction of the full Newton step.
    """

    residual: float
    step: float
    damping: float = 1.0


@dataclass(frozen=True)
class Mode:
    """The side on which a dyad, or a body on two rods (``distance``), was closed.

    Attributes:
        bodies: the bodies of the dyad, or the body on two rods.
        joint: the joint between them, or the body on two rods.
        anchors: the outer joints of the dyad, or the rods.
        side: side of the line from the first to the second anchor on which the joint lies, "left"
            or "right". If the second anchor is a slide: "ahead" of the first anchor along the
            slide, or "behind" it.
        folded: whether the loop is folded: the joint and the pin between the two bodies that carry
            the dyad lie on the same side of the line between the anchors. None if there is no
            such pin.
    """

    bodies: tuple[str, ...]
    joint: str
    anchors: tuple[str, ...]
    side: str
    folded: bool | None = None


@dataclass(frozen=True)
class Choice:
    """A coordinate or rate that was not set, with the value that was chosen.

    Attributes:
        name: such as ``crank.angle`` or ``crank.omega``.
        value: m, rad or per s.
        unit: SI unit.
        source: "guess"; "near guess": as near to the guess as the joints allow; "guesses":
            quantities of points or joints were guessed; "drawing": the body was drawn there;
            "nothing": no value was given. A rate can also have the sources "rest": nothing moves,
            and "least energy": the motion has the least kinetic energy of all motions with the
            rates that are set.
        guess: the guess, if the value differs from it.
    """

    name: str
    value: float
    unit: str
    source: str
    guess: float | None = None

    def __str__(self) -> str:
        told = self.source if self.guess is None else f"near its guess of {self._shown(self.guess)}"
        return f"{self.name} = {self._shown(self.value)} ({_SOURCES.get(told, told)})"

    def _shown(self, value: float) -> str:
        unit = display(self.unit, "deg" if self.unit == "rad" else None)
        return f"{value / unit.divisor + 0.0:.6g}{'' if unit.symbol == '°' else ' '}{unit.symbol}"


@dataclass(frozen=True)
class Unset:
    """The coordinates and rates that a request for an assembly did not set.

    Attributes:
        freedoms: number of degrees of freedom that neither drivers nor ``set`` determine.
        free_rates: number of degrees of freedom of the velocities that neither determine.
        coordinates: one coordinate for each freedom; setting them determines the position. Empty
            in a model with more than 120 coordinates.
        rates: one rate for each free rate; setting them determines the velocities.
    """

    freedoms: int = 0
    free_rates: int = 0
    coordinates: tuple[Choice, ...] = ()
    rates: tuple[Choice, ...] = ()

    @classmethod
    def from_tree(cls, found: Mapping[str, Any]) -> Unset:
        """From the tree of the core."""
        coordinates, rates = (
            tuple(Choice(**each) for each in found[key]) for key in ("coordinates", "rates")
        )
        freedoms, free_rates = found["count"]
        return cls(freedoms, free_rates, coordinates, rates)

    def __str__(self) -> str:
        """One line; empty if everything was set."""
        if not self.coordinates and not self.rates:
            counts = (self.freedoms, "degree", " of freedom"), (self.free_rates, "rate", "")
            told = [f"{n} {word}{'s' * (n != 1)}{of}" for n, word, of in counts if n]
            return f"not set: {', '.join(told)}" if told else ""
        parts = [few(map(str, self.coordinates), _MOST_CHOICES)] if self.coordinates else []
        if self.rates and all(rate.source == "rest" for rate in self.rates):
            parts.append(f"{few((rate.name for rate in self.rates), _MOST_CHOICES)} = 0 (at rest)")
        elif self.rates:
            parts.append(few(map(str, self.rates), _MOST_CHOICES))
        return f"not set: {'; '.join(parts)}"


@dataclass(frozen=True, repr=False)
class AssemblyReport:
    """Report of an assembly.

    Attributes:
        iterations: the Newton iterations.
        degrees_of_freedom: number of degrees of freedom.
        modes: the side of every dyad.
        warnings: texts of the warnings.
        unset: the coordinates and rates that were not set, with the chosen values. Empty if the
            assembly began at a state.
    """

    iterations: tuple[Iteration, ...]
    degrees_of_freedom: int
    modes: tuple[Mode, ...]
    warnings: tuple[str, ...]
    unset: Unset = Unset()

    @property
    def alternatives(self) -> int:
        """Number of other combinations of sides, reachable or not: 2 for each dyad, less one."""
        return int(2 ** len(self.modes) - 1)

    @classmethod
    def from_json(cls, text: str) -> AssemblyReport:
        """The report from the JSON text of the core."""
        return cls.from_tree(json.loads(text))

    @classmethod
    def from_tree(cls, report: Mapping[str, Any]) -> AssemblyReport:
        """The report from the data of the core."""
        return cls(
            iterations=tuple(
                Iteration(i["residual"], i["step"], i["damping"]) for i in report["iterations"]
            ),
            degrees_of_freedom=report["degrees_of_freedom"],
            modes=tuple(
                Mode(tuple(m["bodies"]), m["joint"], tuple(m["anchors"]), m["side"], m["folded"])
                for m in report["modes"]
            ),
            warnings=tuple(report["warnings"]),
            unset=Unset.from_tree(report["unset"]),
        )

    def __repr__(self) -> str:
        free = self.degrees_of_freedom
        count = f"{len(self.iterations)} iteration{'s' * (len(self.iterations) != 1)}"
        return f"<AssemblyReport: {count}, {free} degree{'s' * (free != 1)} of freedom>"

    def __str__(self) -> str:
        last = f", residual {self.iterations[-1].residual:.1e}" if self.iterations else ""
        count = len(self.iterations)
        lines = [f"{count} iteration{'' if count == 1 else 's'}{last}"]
        shown = self.modes[:MOST_MODES]
        lines += [f"{' and '.join(m.bodies)}: {m.joint} lies {_place(m)}" for m in shown]
        if len(self.modes) > MOST_MODES:
            lines.append(_others(self.modes[MOST_MODES:]))
        if 0 < self.alternatives < MOST_COUNTED:
            lines.append(f"other assemblies exist: {self.alternatives}")
        elif self.alternatives:
            lines.append(f"other assemblies exist: up to 2^{len(self.modes)} - 1")
        lines += filter(None, [str(self.unset)])
        return "\n".join([*lines, *(f"warning: {text}" for text in self.warnings)])


def _others(modes: Sequence[Mode]) -> str:
    """``and 244 more, of which 3 are folded: R12, R40, R77``."""
    folded = [mode.joint for mode in modes if mode.folded]
    text = f"and {len(modes)} more"
    if not folded:
        return text + ", none of them folded"
    more = ", …" if len(folded) > MOST_MODES else ""
    return f"{text}, of which {len(folded)} folded: {', '.join(folded[:MOST_MODES])}{more}"


def _place(mode: Mode) -> str:
    """``to the left of A → D, unfolded``, or ``ahead of B along the slide S``."""
    if mode.side in ("ahead", "behind"):
        first, slide = mode.anchors
        return f"{mode.side}{' of' * (mode.side == 'ahead')} {first} along the slide {slide}"
    folded = {None: "", False: ", unfolded", True: ", folded"}[mode.folded]
    return f"to the {mode.side} of {' → '.join(mode.anchors)}{folded}"
