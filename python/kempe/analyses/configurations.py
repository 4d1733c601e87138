"""Configurations: all positions in which a mechanism closes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from kempe.analyses.assembly import Coordinates
from kempe.analyses.options import Configurations
from kempe.analyses.record import Record, run_analysis
from kempe.base.arguments import explained
from kempe.model.model import Model, compiled_model
from kempe.results.assembly_report import AssemblyReport
from kempe.results.result import Result
from kempe.results.state import State
from kempe.results.table import Column, column

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel

#: Largest number of configurations, if none is given.
LIMIT = 100


class ConfigurationsResult(Result, Sequence[State]):
    """The positions in which a mechanism closes, as a sequence of states.

    Attributes:
        complete: whether there are no other configurations; true only if this is proven.
        states: the states.
        left_out: the number of positions found in which a freedom is left. They are not among the
            states, because each is one of infinitely many.
    """

    kind = "configurations"

    def __init__(self, record: Record, *, found: bool = False) -> None:
        start, numbers = record.initial, record.numbers
        reports = record.findings["reports"]
        rows = zip(numbers["q"], numbers["v"], numbers["z"], reports, strict=True)
        self.states = tuple(
            State(record.model, start.t, q, v, AssemblyReport.from_tree(report), z=z)
            for q, v, z, report in rows
        )
        self.complete: bool = record.findings["complete"]
        self.left_out: int = record.findings["left_out"]
        self._final = self.states[0] if found else start

    @property
    def final(self) -> State:
        """The state from which the analysis started, or the first configuration by default."""
        return self._final

    @overload
    def __getitem__(self, k: int) -> State: ...
    @overload
    def __getitem__(self, k: slice) -> Sequence[State]: ...
    def __getitem__(self, k: int | slice) -> State | Sequence[State]:
        return self.states[k]

    def __len__(self) -> int:
        return len(self.states)

    def __iter__(self) -> Iterator[State]:
        return iter(self.states)

    def summary(self) -> dict[str, Any]:
        """The coordinates of each configuration, m and rad."""
        names = self.states[0].compiled.column_names()
        return {
            "type": self.kind,
            "complete": self.complete,
            "count": len(self),
            "left_out": self.left_out,
            "configurations": [
                dict(zip(names, state.q.tolist(), strict=True)) for state in self.states
            ],
        }

    def report(self) -> list[str]:
        """The number of configurations, and the sides of the dyads in each."""
        count = f"{len(self)} configuration{'' if len(self) == 1 else 's'}"
        verdict = "there are no others" if self.complete else "there may be others"
        lines = [f"{count}; {verdict}"]
        if self.left_out == 1:
            lines.append("1 position is left out, because a freedom remains in it")
        elif self.left_out:
            lines.append(
                f"{self.left_out} positions are left out, because a freedom remains in each of them"
            )
        for k, state in enumerate(self.states, 1):
            modes = () if state.report is None else state.report.modes
            sides = ", ".join(f"{mode.joint} {mode.side}" for mode in modes)
            lines.append(f"{k}: {sides or 'no dyads'}")
        return lines

    def tables(self) -> Mapping[str, Sequence[Column]]:
        """``configurations``: the coordinates of all bodies, one row for each configuration."""
        model = self.states[0].compiled
        rows = np.array([state.q for state in self.states])
        number = Column("configuration", "", np.arange(1, len(self) + 1, dtype=float))
        columns = zip(model.column_names(), model.column_units(), rows.T, strict=True)
        return {"configurations": [number, *(column(*of) for of in columns)]}

    def __repr__(self) -> str:
        return f"<ConfigurationsResult: {self.report()[0]}>"


@explained
def configurations(
    model: Model | CompiledModel,
    set: Coordinates | None = None,  # noqa: A002 - as in assemble
    *,
    limit: int = LIMIT,
    t: float = 0.0,
) -> ConfigurationsResult:
    """All positions in which a mechanism closes.

    Where dyads, rods and wheels that mesh place all bodies, all combinations are computed, and
    ``complete`` is true. Otherwise Newton's method starts from many positions, and from each one
    found the driven values are followed through their limits until they return; ``complete`` is
    then false, even if all have been found. Guesses are not used. Positions in which a freedom is
    left, such as a folded kite, are left out; the report states their number.

    Args:
        model: the mechanism.
        set: coordinates that hold exactly, as in ``assemble``; with the drivers, they leave no
            freedom.
        limit: largest number of configurations.
        t: time for the laws of drivers, s.

    Raises:
        AssemblyError: there is none.
        RedundancyError: constraints are redundant.
        ModelError: a freedom is left in all positions found, so that there are infinitely many; or
            an argument is invalid.
    """
    compiled = compiled_model(model)
    entry = Configurations(set=set or None, limit=limit).tree()
    at = State(compiled, t, np.zeros(compiled.n_q), np.zeros(compiled.n_q))
    return ConfigurationsResult(run_analysis(compiled, at, entry), found=True)
