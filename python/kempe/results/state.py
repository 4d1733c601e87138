"""The state of a mechanism at one time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from kempe._upwards import CALLS
from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, tidy
from kempe.base.display_units import display, heading
from kempe.base.names import few
from kempe.model.compiled import CompiledModel
from kempe.model.doubts import NO_GRAVITY
from kempe.model.model import Model
from kempe.model.values import Number, mapping
from kempe.results.assembly_report import AssemblyReport
from kempe.results.matrices.values import Matrices, matrices
from kempe.results.motion import Motion
from kempe.results.origin import Origin
from kempe.results.sizes import largest, size_of
from kempe.results.views.body import BodyView
from kempe.results.views.constraint import ConstraintView
from kempe.results.views.force import ForceView

#: Columns of a printed state: quantity, SI unit, and the unit where none was chosen.
_COLUMNS = (
    ("x", "m", None),
    ("y", "m", None),
    ("angle", "rad", "deg"),
    ("vx", "m/s", None),
    ("vy", "m/s", None),
    ("omega", "rad/s", None),
)


@explain_methods
class State(Motion):
    """A mechanism at one time: ``state["crank.angle"]``, ``state["C"].residual``.

    ``kp.State(model, t, q, v)`` makes a state from numbers. ``kp.assemble`` returns a state with
    closed joints.

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
        #: How it was made; None if this is not known.
        self.origin: Origin | None = None

    def __reduce__(self) -> tuple[Any, ...]:
        made = self.compiled, self.t, self.q, self.v, self.report, self.z
        return _restored, made, {"variable": self.variable, "origin": self.origin}

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

    def table(self) -> tuple[list[str], list[list[str]]]:
        """Position and velocity of each body in display units: header and rows of texts.

        Angles are in degrees unless ``kp.units`` chose another unit. Rounding errors are 0.
        """
        columns = [(name, self.variable.rate(unit), usual) for name, unit, usual in _COLUMNS]
        header = [heading(name, unit, usual) for name, unit, usual in columns]
        tidied, rows = self._tidied(), []
        for k, (name, info) in enumerate(self.compiled.named_bodies.items()):
            row = [name]
            for quantity, unit, usual in columns:
                turning = quantity in ("angle", "omega")
                value = tidied[quantity][k] / display(unit, usual).divisor
                row.append("" if turning and not info.turns else f"{value + 0.0:.6g}")
            rows.append(row)
        return ["body", *header], rows

    def _tidied(self) -> dict[str, list[float]]:
        """Each quantity of the bodies, with rounding errors replaced by zeros."""
        bodies = [self.body(name) for name in self.compiled.named_bodies]
        read = {name: np.array([getattr(body, name) for body in bodies]) for name, *_ in _COLUMNS}
        size = size_of(self)
        speed, turning = largest(read["vx"], read["vy"]), largest(read["omega"])
        scales = {
            "m": size,
            "rad": 1.0,
            "m/s": max(speed, size * turning),
            "rad/s": max(turning, speed / size if size else 0.0),
        }
        return {name: tidy(read[name], scales[unit]) for name, unit, _ in _COLUMNS}

    def __str__(self) -> str:
        header, rows = self.table()
        width = max((len(row[0]) for row in rows), default=4)
        table = [["", *header[1:]], *rows]
        lines = [f"{name:<{width}}{''.join(f'{c:>15}' for c in cells)}" for name, *cells in table]
        for name, value, unit in self._further():
            shown = display(unit)
            lines.append(f"{name} = {value / shown.divisor:.6g} {shown.unit}")
        report = [] if self.report is None else [str(self.report)]
        if report and not any(self.compiled.gravity):
            report.append(NO_GRAVITY)
        of, shown = self.variable, display(self.variable.unit)
        lines = [
            f"{of.name} = {self.t / shown.divisor:g} {shown.unit}",
            *map(str.rstrip, lines),
            *report,
        ]
        return "\n".join(lines)

    def __repr__(self) -> str:
        at = f"{self.variable.name} = {self.t:g} {self.variable.unit}"
        return f"<State of {self.compiled.title!r} at {at}: {few(self.compiled.shown_bodies)}>"

    def _repr_html_(self) -> str:
        return str(CALLS["html"](self))


def _restored(  # noqa: PLR0917 - a pickle passes positional arguments
    model: CompiledModel,
    t: float,
    q: Floats,
    v: Floats,
    report: AssemblyReport | None,
    z: Floats,
) -> State:
    return State(model, t, q, v, report, z=z)
