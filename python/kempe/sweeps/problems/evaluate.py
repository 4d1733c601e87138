"""The runs of a search: computed once, kept in a file, and told while the search goes on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import replace
from itertools import count
from threading import Event, Lock
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.errors import InternalError, KempeError
from kempe.sweeps.plan import Block
from kempe.sweeps.problems.columns import has_slopes
from kempe.sweeps.problems.problem import Numbers, Problem, Run
from kempe.sweeps.reasons import origin_of, reason
from kempe.sweeps.storage import Storage

#: Called with the numbers of runs and of failed runs, and the best objective so far.
Progress: TypeAlias = "Callable[[int, int, float], object]"
#: Largest number of runs in a file.
_MOST = 100_000_000


class StoppedError(Exception):
    """The search was stopped."""


class Evaluations:
    """The runs of a search on several threads.

    Attributes:
        history: the place in the search, the start and the run, in the order of computation.
    """

    def __init__(
        self, problem: Problem, storage: Storage | None, progress: Progress | None, workers: int
    ) -> None:
        self.problem, self._workers = problem, workers
        self.history: list[tuple[int, int, Run]] = []
        self.stop = Event()
        self._lock, self._storage, self._progress = Lock(), storage, progress
        self._known: dict[bytes, tuple[Floats, str]] = {}
        self._counts: dict[int, int] = {}
        self.best, self._failed = np.nan, 0
        path, columns = problem.path, problem.columns
        self._ranges = np.array([[bound.least, bound.largest] for bound in problem.bounds])
        self._shape = (len(problem.bounds), len(columns), path.size if path else 0)
        kept = 0
        if storage is not None:
            for k, numbers, told, _ in storage.read(_MOST, self._width):
                self._known[self._key(numbers)] = numbers.copy(), told
                kept = k + 1
        self._places = count(kept)

    @property
    def _width(self) -> int:
        n, width, size = self._shape
        return 1 + n + (width + size) * (1 + n)

    def _key(self, numbers: Floats) -> bytes:
        return np.ascontiguousarray(numbers[: 1 + self._shape[0]]).tobytes()

    def has_slopes(self, row: Floats) -> bool | None:
        """Whether the core gives some slope of each column at a point; None if the run fails."""
        return has_slopes(self.problem.columns.parts, row)

    def of(self, problem: Problem) -> Evaluations:
        """The same runs, which another problem with the same columns judges; a history of its own.

        They have no progress of their own.
        """
        other = copy(self)
        other.problem, other.history, other._progress, other._counts = problem, [], None, {}
        return other

    def at(self, start: int, row: Floats) -> Run:
        """A run with its derivatives.

        Raises:
            StoppedError: the search was stopped.
        """
        return self._of(start, np.array([row]), slopes=True)[0]

    def values(self, start: int, rows: Floats) -> list[Run]:
        """Runs without derivatives, side by side.

        Raises:
            StoppedError: the search was stopped.
        """
        return self._of(start, rows, slopes=False)

    def _of(self, start: int, rows: Floats, *, slopes: bool) -> list[Run]:
        if self.stop.is_set():
            raise StoppedError
        keys = [self._key(np.array([slopes, *row])) for row in rows]
        new = {key: row for key, row in zip(keys, rows, strict=True) if key not in self._known}
        if new:
            given = np.array(list(new.values()))
            computed = self._slopes(given[0]) if slopes else self._values(given)
            self._keep(given, computed, slopes=slopes)
        found = [self._judged(row, *self._known[key]) for key, row in zip(keys, rows, strict=True)]
        self._tell(start, found)
        return found

    def _judged(self, row: Floats, numbers: Floats, told: str) -> Run:
        if told:
            return Run.failed(row, told)
        n, width, size = self._shape
        ends = np.cumsum([1 + n, width, width * n, size, size * n])
        _, columns, slopes, residuals, of = np.split(numbers, ends[:-1])
        parts = Numbers(columns, slopes.reshape(width, n), residuals, of.reshape(size, n))
        return self.problem.judged(row, parts)

    def _values(self, rows: Floats) -> list[tuple[Numbers | None, str]]:
        n, width, _ = self._shape
        if self.problem.path is not None or not width:
            return [self._slopes(row)[0] for row in rows]
        values, reasons = self.problem.columns.rows(rows, self._workers)
        none = np.full((width, n), np.nan), np.zeros(0), np.zeros((0, n))
        pairs = zip(values, reasons, strict=True)
        return [(None, told) if told else (Numbers(of, *none), "") for of, told in pairs]

    def _slopes(self, row: Floats) -> list[tuple[Numbers | None, str]]:
        try:
            return [(self._measured(row), "")]
        except InternalError:
            raise
        except KempeError as error:
            return [(None, reason(str(error.args[0]), origin_of(self.problem.plan.case.model)))]

    def _measured(self, row: Floats) -> Numbers:
        """The numbers of a run.

        Raises:
            KempeError: the run fails.
        """
        plan, path = self.problem.plan, self.problem.path
        n, width, _ = self._shape
        residuals, of = np.zeros(0), np.zeros((0, n))
        if path is not None:
            residuals, of = path.residuals(plan, row)
        elif not width:  # an objective of parameters alone; the case must run all the same
            plan.run(row)
        if not width:
            return Numbers(np.zeros(0), np.zeros((0, n)), residuals, of)
        values, slopes = self.problem.columns.slopes(row, self._ranges, self._workers)
        return Numbers(values, slopes, residuals, of)

    def _keep(
        self, rows: Floats, computed: Sequence[tuple[Numbers | None, str]], *, slopes: bool
    ) -> None:
        """Write runs into the file, and remember them."""
        lines, n = np.full((len(rows), self._width), np.nan), self._shape[0]
        lines[:, 0], lines[:, 1 : 1 + n] = slopes, rows
        for line, (found, _) in zip(lines, computed, strict=True):
            if found is not None:
                parts = (found.columns, found.slopes, found.residuals, found.residual_slopes)
                line[1 + n :] = np.concatenate([part.ravel() for part in parts])
        reasons = [told for _, told in computed]
        with self._lock:
            if self._storage is not None:
                marks: NDArray[np.uint8] = np.zeros(lines.shape, np.uint8)
                places = np.array([next(self._places) for _ in lines])
                self._storage.add(places, Block(lines, reasons, marks))
            for line, told in zip(lines, reasons, strict=True):
                self._known[self._key(line)] = line, told

    def _tell(self, start: int, found: Sequence[Run]) -> None:
        """Note runs in the history and call the function for progress."""
        with self._lock:
            for run in found:
                k = self._counts[start] = self._counts.get(start, -1) + 1
                self.history.append((start, k, _light(run)))
                self._failed += bool(run.reason)
                better = self.problem.sign * (run.objective - self.best) < 0.0
                if run.holds and (better or np.isnan(self.best)):
                    self.best = run.objective
            if self._progress is not None:
                self._progress(len(self.history), self._failed, self.best)


def _light(run: Run) -> Run:
    """A run without derivatives, for the history."""
    none = np.zeros(0)
    pair = (none, none)
    return replace(run, slope=none, pieces=pair, residuals=pair, room_slopes=none)
