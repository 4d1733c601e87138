"""The state of a mechanism at one time, and the report of its assembly."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from kempe.arrays import Floats
from kempe.compiled import CompiledModel
from kempe.matrices import Matrices, matrices
from kempe.model import Model
from kempe.motion import Motion
from kempe.values import Number, mapping
from kempe.views import BodyView, ConstraintView, ForceView


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
    """

    bodies: tuple[str, ...]
    joint: str
    anchors: tuple[str, ...]
    side: str


@dataclass(frozen=True)
class AssemblyReport:
    """Report of an assembly.

    Attributes:
        iterations: the Newton iterations.
        degrees_of_freedom: number of degrees of freedom.
        modes: the side of every dyad.
        alternatives: number of other assembly modes.
        warnings: texts of the warnings.
    """

    iterations: tuple[Iteration, ...]
    degrees_of_freedom: int
    modes: tuple[Mode, ...]
    alternatives: int
    warnings: tuple[str, ...]

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
                Mode(tuple(m["bodies"]), m["joint"], tuple(m["anchors"]), m["side"])
                for m in report["modes"]
            ),
            alternatives=report["alternatives"],
            warnings=tuple(report["warnings"]),
        )

    def __str__(self) -> str:
        last = f", residual {self.iterations[-1].residual:.1e}" if self.iterations else ""
        count = len(self.iterations)
        lines = [f"{count} iteration{'' if count == 1 else 's'}{last}"]
        lines += [f"{' and '.join(m.bodies)}: {m.joint} lies {_place(m)}" for m in self.modes]
        if self.alternatives:
            lines.append(f"other assemblies exist: {self.alternatives}")
        return "\n".join([*lines, *(f"warning: {text}" for text in self.warnings)])


def _place(mode: Mode) -> str:
    """``to the left of A → D``, or ``ahead of B along the slide S``."""
    if mode.side in ("ahead", "behind"):
        first, slide = mode.anchors
        return f"{mode.side}{' of' * (mode.side == 'ahead')} {first} along the slide {slide}"
    return f"to the {mode.side} of {' → '.join(mode.anchors)}"


class State(Motion):
    """A mechanism at one time: ``state["crank.angle"]``, ``state["C"].residual``.

    ``kp.State(model, t, q, v)`` makes a state from numbers, ``kp.assemble`` one that closes.

    Args:
        model: the mechanism.
        t: time, s.
        q: (n_q,), in the order of ``model.column_names()``.
        v: (n_q,), in the order of ``model.rate_names()``.
        report: report of the assembly.
        z: (n_z,), in the order of ``model.state_names()``; zeros by default.

    Attributes:
        t: time, s; a float.
        q: (n_q,): x, y, angle of each moving body, m and rad, then the internal coordinates of
            joints; read-only.
        v: (n_q,): their rates, per s; read-only.
        z: (n_z,): first-order states of force elements; empty for most models; read-only.
        report: report of the assembly; None if the state is not the result of an assembly.
    """

    t: float  # type: ignore[assignment]

    def __init__(
        self,
        model: Model | CompiledModel,
        t: float,
        q: Floats,
        v: Floats,
        report: AssemblyReport | None = None,
        *,
        z: Floats | None = None,
    ) -> None:
        super().__init__(model, t, q, v, z)
        self.t = float(self.t)
        self.report = report

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.compiled, self.t, self.q, self.v, self.report, self.z)

    def body(self, name: str) -> BodyView[float]:  # type: ignore[override]
        """A body by name, including ground.

        Raises:
            ModelError: there is no such body; the error is also a ``KeyError``.
        """
        return super().body(name)  # type: ignore[return-value]

    def constraint(self, name: str) -> ConstraintView[float]:  # type: ignore[override]
        """A joint or driver by name.

        Raises:
            ModelError: there is no such joint or driver; the error is also a ``KeyError``.
        """
        return super().constraint(name)  # type: ignore[return-value]

    def joint(self, name: str) -> ConstraintView[float]:  # type: ignore[override]
        """A joint by name.

        Raises:
            ModelError: there is no such joint; the error is also a ``KeyError``.
        """
        return super().joint(name)  # type: ignore[return-value]

    def driver(self, name: str) -> ConstraintView[float]:  # type: ignore[override]
        """A driver by name.

        Raises:
            ModelError: there is no such driver; the error is also a ``KeyError``.
        """
        return super().driver(name)  # type: ignore[return-value]

    def force(self, name: str) -> ForceView[float]:  # type: ignore[override]
        """A force element by name.

        Raises:
            ModelError: there is no such force element; the error is also a ``KeyError``.
        """
        return super().force(name)  # type: ignore[return-value]

    def matrices(self, set: Mapping[str, Number] | None = None) -> Matrices:  # noqa: A002
        """The matrices of the equations of motion in this state.

        Args:
            set: prescribed coordinates, as in an assembly; each adds a row.
        """
        return matrices(self, mapping(set, "set", "{'crank.angle': 1}"))

    def coordinates(self) -> dict[str, float]:
        """Coordinates, rates and first-order states by name, in SI units.

        For example ``{"crank.x": …, "crank.omega": …, "motor.current": …}``.
        """
        model = self.compiled
        names = [*model.column_names(), *model.rate_names(), *model.state_names()]
        values = [*self.q.tolist(), *self.v.tolist(), *self.z.tolist()]
        return dict(zip(names, values, strict=True))

    def _further(self) -> Iterator[tuple[str, float, str]]:
        """Names, values and units of internal coordinates and first-order states."""
        own = [c for c in self.compiled.constraints.values() if c.coordinates]
        for info in own:
            values = self.q[info.columns].tolist()
            for (name, unit), value in zip(info.coordinates, values, strict=True):
                yield f"{info.name}.{name}", value, unit
        names, units = self.compiled.state_names(), self.compiled.state_units()
        yield from zip(names, self.z.tolist(), units, strict=True)

    def __str__(self) -> str:
        width = max((len(name) for name in self.compiled.bodies), default=4)
        units = ("x / m", "y / m", "angle / °", "vx / m/s", "vy / m/s", "omega / rad/s")
        lines = [" " * width + "".join(f"{unit:>15}" for unit in units)]
        for name in self.compiled.bodies:
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
        return "\n".join([f"t = {self.t:g} s", *lines, *report])

    def __repr__(self) -> str:
        bodies = ", ".join(self.compiled.bodies)
        return f"<State of {self.compiled.title!r} at t = {self.t:g} s: {bodies}>"


def _restored(  # noqa: PLR0917 - a pickle passes positional arguments
    model: CompiledModel,
    t: float,
    q: Floats,
    v: Floats,
    report: AssemblyReport | None,
    z: Floats,
) -> State:
    return State(model, t, q, v, report, z=z)
