"""Limits of motion: the range of a driver or quantity, or whether it makes full turns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.analyses.options import Limits
from kempe.analyses.record import Progress, Record, run_analysis
from kempe.base.arguments import explained
from kempe.base.display_units import display
from kempe.model.model import Model, compiled_model
from kempe.results.motion import Motion
from kempe.results.result import Result
from kempe.results.state import State
from kempe.results.table import Column, column

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel


class LimitsResult(Result):
    """The limits of a driver or position quantity.

    Attributes:
        over: the quantity, such as ``"crank.angle"``.
        unit: its SI unit, "m" or "rad".
        start: its value at the start.
        lower: its least value; None if it has no limit.
        upper: its largest value; None if it has no limit.
        reasons: the reason of the lower and of the upper limit, or why there is no limit.
        turns: number of turns after which the mechanism returns to its start; None unless it turns
            fully.
        path: the motion between both limits; ``path.t`` contains the values, ascending.
    """

    kind = "limits"
    path: Motion

    def __init__(self, record: Record) -> None:
        found, numbers = record.findings, record.numbers
        self._initial = record.initial
        self.over: str = found["over"]
        self.start: float = found["start"]
        self.unit: str = found["unit"]
        self.lower: float | None = found["lower"]
        self.upper: float | None = found["upper"]
        self.reasons: tuple[str, ...] = tuple(found["reasons"])
        self.turns: int | None = found["turns"]
        values, q = numbers["values"][:, 0], numbers["positions"]
        z = np.tile(record.initial.z, (len(values), 1))
        self.path = Motion(record.model, values, q, np.zeros_like(q), z)

    @property
    def final(self) -> State:
        """The state at the start."""
        return self._initial

    @property
    def turns_fully(self) -> bool:
        """Whether an angle has no limit."""
        return self.unit == "rad" and self.lower is None and self.upper is None

    @property
    def span(self) -> float | None:
        """The range of motion, upper - lower; None unless both are limits."""
        if self.lower is None or self.upper is None:
            return None
        return self.upper - self.lower

    def at_lower(self) -> State | None:
        """The mechanism at the lower limit, ``over`` driven."""
        return None if self.lower is None else self._at(0)

    def at_upper(self) -> State | None:
        """The mechanism at the upper limit, ``over`` driven."""
        return None if self.upper is None else self._at(-1)

    def _at(self, k: int) -> State:
        path = self.path
        return State(path.compiled, float(path.t[k]), path.q[k], path.v[k], z=path.z[k])

    def summary(self) -> dict[str, Any]:
        """The limits as plain data, m or rad."""
        return {
            "type": self.kind,
            "over": self.over,
            "unit": self.unit,
            "start": self.start,
            "lower": self.lower,
            "upper": self.upper,
            "turns_fully": self.turns_fully,
            "turns": self.turns,
            "reasons": list(self.reasons),
        }

    def report(self) -> list[str]:
        """The range and the reasons."""
        ends = [self.shown(value) for value in (self.lower, self.upper)]
        if self.turns_fully:
            found = "turns fully"
        else:
            found = f"{ends[0] or 'no limit below'} to {ends[1] or 'no limit above'}"
        if self.span is not None:
            found += f", a range of {self.shown(self.span)}"
        return [f"{self.over}: {found} (start: {self.shown(self.start)})", *self.reasons]

    def shown(self, value: float | None) -> str:
        """A value with its display unit; empty if there is none."""
        if value is None:
            return ""
        unit = display(self.unit, "deg" if self.unit == "rad" else None)
        return f"{value / unit.divisor:.7g}{'' if unit.symbol == '°' else ' '}{unit.symbol}"

    def tables(self) -> Mapping[str, Sequence[Column]]:
        """``limits``: the values on the way and the coordinates of all bodies."""
        path = self.path
        names, units = path.compiled.column_names(), path.compiled.column_units()
        value = column(self.over, self.unit, np.asarray(path.t))
        rows = zip(names, units, path.q.T, strict=True)
        return {"limits": [value, *(column(name, unit, q) for name, unit, q in rows)]}

    def __repr__(self) -> str:
        return f"<LimitsResult {self.report()[0]}>"


@explained
def limits(
    model: Model | CompiledModel,
    start: State,
    *,
    over: str | None = None,
    progress: Progress | None = None,
) -> LimitsResult:
    """The range of a driver or position quantity in both directions from a state.

    The motion is followed as by ``kinematics`` in both directions until a dead point, a stop or
    contact with restitution, or the end of a curve, which is found to 1e-9. An angle without a
    limit turns fully: the mechanism returns to its start after one or several turns. A length
    without a limit is followed for 100 times the size of the mechanism. Masses are not needed, and
    the law of the driver is not used.

    Args:
        model: the mechanism.
        start: an assembled state.
        over: name of a driver, or a position quantity such as ``"crank.angle"``; the only driver
            if None.
        progress: function that is called repeatedly with the value reached.

    Raises:
        SingularityError: the start is a dead point itself, or the motion cannot be followed.
        AssemblyError: the start does not satisfy the constraints.
        ModelError: ``over`` is unknown or missing, or the drivers leave another freedom.
    """
    entry = Limits(over).tree()
    return LimitsResult(run_analysis(compiled_model(model), start, entry, progress))
