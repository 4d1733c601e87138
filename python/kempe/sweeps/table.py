"""The results of a sweep while it runs: numbers, reasons, and which rows are finished."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.sweeps.plan import Block
from kempe.sweeps.storage import Storage

#: Called with the numbers of finished, failed and all variants, and the seconds left.
Progress: TypeAlias = "Callable[[int, int, int, float], object]"
#: The reason of a row that was not computed before an interruption.
UNFINISHED = "not computed: the sweep was interrupted"


class Table:
    """Rows of results in the order of the design.

    Attributes:
        values: the wanted numbers, (n, n_wanted); NaN in rows that failed or are not finished.
        reasons: the reasons of rows that failed.
        marks: the marks of the numbers, (n, n_wanted); see ``kempe.sweeps.remarked``.
    """

    def __init__(
        self, n: int, width: int, storage: Storage | None, progress: Progress | None
    ) -> None:
        self.values = np.full((n, width), np.nan)
        self.marks = np.zeros((n, width), np.uint8)
        self.reasons: dict[int, str] = {}
        self._done = np.zeros(n, dtype=bool)
        self._storage, self._progress = storage, progress
        if storage is not None:
            for k, numbers, reason, marks in storage.read(n, width):
                self._put(k, numbers, reason)
                self.marks[k] = marks
        self._began, self._before = monotonic(), int(self._done.sum())

    def _put(self, k: int, numbers: Floats, reason: str) -> None:
        self.values[k] = numbers
        self._done[k] = True
        if reason:
            self.reasons[k] = reason

    @property
    def left(self) -> NDArray[np.intp]:
        """The rows that are not finished."""
        return np.flatnonzero(~self._done)

    def add(self, rows: NDArray[np.intp], block: Block) -> None:
        """Keep finished rows."""
        if self._storage is not None:
            self._storage.add(rows, block)
        self.values[rows], self.marks[rows] = block.values, block.marks
        self._done[rows] = True
        for k, reason in zip(rows.tolist(), block.reasons, strict=True):
            if reason:
                self.reasons[k] = reason
        self.tell()

    def tell(self) -> None:
        """Call the function for progress."""
        if self._progress is None:
            return
        done, total = int(self._done.sum()), len(self._done)
        here = done - self._before
        left = (monotonic() - self._began) * (total - done) / here if here else float("nan")
        self._progress(done, len(self.reasons), total, left)

    def interrupted(self) -> None:
        """Mark the rows that are not finished with the reason of an interruption."""
        self.reasons.update(dict.fromkeys(self.left.tolist(), UNFINISHED))
