"""Configurations: all positions in which a mechanism closes."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from kempe import _core
from kempe.analyses import Coordinates, Progress, refuse_foreign, released
from kempe.assembly_report import AssemblyReport
from kempe.errors import ModelError
from kempe.model import Model, compiled_model
from kempe.options import Configurations
from kempe.request_cache import encode
from kempe.result import Result
from kempe.state import State
from kempe.table import Column, column
from kempe.values import numbers

if TYPE_CHECKING:
    from kempe.compiled import CompiledModel

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

    def __init__(
        self, states: Sequence[State], *, complete: bool, final: State, left_out: int = 0
    ) -> None:
        self.states = tuple(states)
        self.complete = complete
        self.left_out = left_out
        self._final = final

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
    Configurations(limit=limit).tree()  # checks it
    return _found(compiled_model(model), numbers(set, "set"), limit, t, None)


def find_configurations(
    model: CompiledModel, start: State, entry: Mapping[str, Any], _: Progress | None
) -> ConfigurationsResult:
    """The configurations with the options of an entry of a case; see ``configurations``."""
    refuse_foreign(model, start)
    model = model.variant(([], released(model, start), []))
    limit = int(entry.get("limit", LIMIT))
    return _found(model, numbers(entry.get("set"), "set"), limit, float(start.t), start)


def _found(
    model: CompiledModel, held: Mapping[str, Any], limit: int, t: float, start: State | None
) -> ConfigurationsResult:
    if isinstance(limit, bool) or not isinstance(limit, int) or limit < 1:
        raise ModelError(f"limit: {limit!r}; must be a whole number from 1")
    q, v, z, text = _core.configurations(model.core, encode(held), limit, t)
    found = json.loads(text)
    states = [
        State(model, t, at, rates, AssemblyReport.from_json(report), z=own)
        for at, rates, own, report in zip(q, v, z, found["reports"], strict=True)
    ]
    return ConfigurationsResult(
        states,
        complete=found["complete"],
        final=start or states[0],
        left_out=found["left_out"],
    )
