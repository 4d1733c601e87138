"""The phases of a run: the parameters, released drivers and modes of forces of its rows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.model.infos import Setting

if TYPE_CHECKING:
    from kempe import _core
    from kempe.model.compiled import CompiledModel

#: The first row of each phase, with its setting.
Settings: TypeAlias = "Sequence[tuple[int, Setting]]"


class Phases:
    """The models of the rows of a run.

    Attributes:
        models: the model of each phase.
        of_row: the phase of each row.
    """

    def __init__(self, models: Sequence[CompiledModel], of_row: NDArray[np.intp]) -> None:
        self.models = models
        self.of_row = of_row

    def at(self, of_row: NDArray[np.intp]) -> Phases:
        """The phases for a selection of rows."""
        return Phases(self.models, of_row)

    def evaluate(
        self, evaluate: Callable[..., Sequence[Floats]], *rows: Floats | None
    ) -> Sequence[Floats]:
        """Values of the core at rows, each by the model of its phase."""
        found: list[Floats] = []
        for phase in np.unique(self.of_row):
            own = self.of_row == phase
            core: _core.Model = self.models[phase].core
            values = evaluate(core, *(None if row is None else row[own] for row in rows))
            found = found or [np.empty((len(own), *x.shape[1:])) for x in values]
            for whole, part in zip(found, values, strict=True):
                whole[own] = part
        return tuple(found) if found else evaluate(self.models[0].core, *rows)


def phases(compiled: CompiledModel, settings: Settings, count: int) -> Phases:
    """The phases of a run with a given number of rows."""
    models = [compiled.variant(setting) for _, setting in settings]
    firsts = np.array([first for first, _ in settings], dtype=np.intp)
    of_row = np.searchsorted(firsts, np.arange(count), side="right") - 1
    return Phases(models, np.maximum(of_row, 0))
