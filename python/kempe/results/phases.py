"""The phases of a run: the parameters, released drivers and modes of forces of its rows."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
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


class PhaseModels:
    """The model of each phase, made at its first use."""

    def __init__(self, base: CompiledModel, settings: Settings) -> None:
        self._base = base
        self._settings = settings
        self._made: dict[int, CompiledModel] = {}

    def __len__(self) -> int:
        return len(self._settings)

    def __iter__(self) -> Iterator[CompiledModel]:
        return (self[phase] for phase in range(len(self)))

    def __getitem__(self, phase: int) -> CompiledModel:
        if phase not in self._made:
            self._made[phase] = self._base.variant(self.setting(phase))
        return self._made[phase]

    def setting(self, phase: int) -> Setting:
        """The parameters, released drivers and modes of a phase."""
        return self._settings[phase][1]


class Phases:
    """The models of the rows of a run.

    Attributes:
        models: the model of each phase.
        firsts: the first row of each phase in the run.
        of_row: the phase of each row.
    """

    def __init__(
        self, models: PhaseModels, firsts: NDArray[np.intp], of_row: NDArray[np.intp]
    ) -> None:
        self.models = models
        self.firsts = firsts
        self.of_row = of_row

    def at(self, of_row: NDArray[np.intp]) -> Phases:
        """The phases for a selection of rows."""
        return Phases(self.models, self.firsts, of_row)

    def evaluate(
        self, evaluate: Callable[..., Sequence[Floats]], *rows: Floats | None
    ) -> Sequence[Floats]:
        """Values of the core at rows, each by the model of its phase."""
        found: list[Floats] = []
        order = np.argsort(self.of_row, kind="stable")
        begins = np.flatnonzero(np.diff(self.of_row[order])) + 1
        for own in np.split(order, begins) if len(order) else []:
            core: _core.Model = self.models[int(self.of_row[own[0]])].core
            values = evaluate(core, *(None if row is None else row[own] for row in rows))
            found = found or [np.empty((len(order), *x.shape[1:])) for x in values]
            for whole, part in zip(found, values, strict=True):
                whole[own] = part
        return tuple(found) if found else evaluate(self.models[0].core, *rows)


def phases(compiled: CompiledModel, settings: Settings, count: int) -> Phases:
    """The phases of a run with a given number of rows."""
    firsts = np.array([first for first, _ in settings], dtype=np.intp)
    of_row = np.searchsorted(firsts, np.arange(count), side="right") - 1
    return Phases(PhaseModels(compiled, settings), firsts, np.maximum(of_row, 0))
