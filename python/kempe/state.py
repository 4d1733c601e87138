"""The state of a mechanism at one time, and the report of its assembly."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from kempe.arrays import Floats, fixed
from kempe.compiled import CompiledModel
from kempe.matrices import Matrices, matrices
from kempe.motion import Motion
from kempe.values import Number

#: Largest number of modes that a report lists.
MOST_MODES = 20
#: Numbers of other assemblies from here on are given as a power of two.
MOST_COUNTED = 1_000_000


@dataclass(frozen=True)
class Iteration:
    """One iteration of an assembly.

    Attributes:
        residual: norm of Φ after the iteration, with lengths relative to the size of the mechanism;
            the first entry is the residual of the start.
        step: norm of the full Newton step, with lengths relative to the same size; 0 for the start.
        damping: applied fraction of the full Newton step.
    """

    residual: float
    step: float
    damping: float = 1.0


@dataclass(frozen=True)
class Mode:
    """The side on which a dyad was closed.

    Attributes:
        bodies: the bodies of the dyad.
        joint: the joint between them.
        anchors: the outer joints of the dyad.
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
class AssemblyReport:
    """Report of an assembly.

    Attributes:
        iterations: the Newton iterations.
        degrees_of_freedom: number of degrees of freedom.
        modes: the side of every dyad.
        warnings: texts of the warnings.
    """

    iterations: tuple[Iteration, ...]
    degrees_of_freedom: int
    modes: tuple[Mode, ...]
    warnings: tuple[str, ...]

    @property
    def alternatives(self) -> int:
        """Number of other combinations of sides, reachable or not: 2 for each dyad, less one."""
        return int(2 ** len(self.modes) - 1)

    @classmethod
    def from_json(cls, text: str) -> AssemblyReport:
        """The report from the JSON text of the core."""
        report: dict[str, Any] = json.loads(text)
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
        )

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


class State(Motion):
    """A mechanism at one time: ``state["crank"].angle``, ``state["C"].residual``.

    Attributes:
        model: the compiled model.
        t: time, s.
        q: (n_q,): x, y, angle of each moving body, m and rad, then the internal coordinates of
            joints; read-only.
        v: (n_q,): their rates, per s; read-only.
        z: (n_z,): first-order states of force elements; empty for most models; read-only.
        report: report of the assembly; None if the state is not the result of an assembly.
    """

    def __init__(
        self,
        model: CompiledModel,
        t: float,
        q: Floats,
        v: Floats,
        report: AssemblyReport | None = None,
        *,
        z: Floats | None = None,
    ) -> None:
        super().__init__(model, fixed(t), q, v, z)
        self.report = report

    def matrices(self, set: Mapping[str, Number] | None = None) -> Matrices:  # noqa: A002
        """The matrices of the equations of motion in this state.

        Args:
            set: prescribed coordinates, as in an assembly; each adds a row.
        """
        return matrices(self, set or {})

    def coordinates(self) -> dict[str, float]:
        """Coordinates, rates and first-order states by name, in SI units.

        For example ``{"crank.x": …, "crank.omega": …, "motor.current": …}``.
        """
        model = self.model
        names = [*model.column_names(), *model.rate_names(), *model.state_names()]
        values = [*self.q.tolist(), *self.v.tolist(), *self.z.tolist()]
        return dict(zip(names, values, strict=True))

    def _further(self) -> Iterator[tuple[str, float, str]]:
        """Names, values and units of internal coordinates and first-order states."""
        own = [c for c in self.model.constraints.values() if c.coordinates]
        for info in own:
            values = self.q[info.columns].tolist()
            for (name, unit), value in zip(info.coordinates, values, strict=True):
                yield f"{info.name}.{name}", value, unit
        names, units = self.model.state_names(), self.model.state_units()
        yield from zip(names, self.z.tolist(), units, strict=True)

    def __str__(self) -> str:
        width = max((len(name) for name in self.model.bodies), default=4)
        units = ("x / m", "y / m", "angle / °", "vx / m/s", "vy / m/s", "omega / rad/s")
        lines = [" " * width + "".join(f"{unit:>15}" for unit in units)]
        for name in self.model.bodies:
            body = self.body(name)
            numbers = [body.x, body.y, np.degrees(body.angle), body.vx, body.vy, body.omega]
            absent = () if body.info.turns else (2, 5)
            row = "".join(
                f"{'':>15}" if k in absent else f"{float(number) + 0.0:15.6g}"
                for k, number in enumerate(numbers)
            )
            lines.append(f"{name:<{width}}{row}".rstrip())
        lines += [f"{name} = {value:.6g} {unit}" for name, value, unit in self._further()]
        report = [] if self.report is None else [str(self.report)]
        return "\n".join([f"t = {float(self.t):g} s", *lines, *report])

    def __repr__(self) -> str:
        return f"<State of {self.model.title!r} at t = {float(self.t):g} s>\n{self}"
