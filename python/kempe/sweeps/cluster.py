"""A sweep on the machines of a Dask cluster.

A worker receives blocks of rows and runs them on its threads. A block whose worker is killed runs
again on another worker. The size of a block follows from the measured time of a row.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.errors import KempeError, ModelError
from kempe.sweeps.plan import Block, Plan
from kempe.sweeps.table import Table

#: Target time of a block, s, and its largest number of rows; a message costs some milliseconds.
_PACE, _MOST = 2.0, 20_000
#: Blocks that wait for each thread, so that none is idle between two blocks.
_AHEAD = 2
#: Time after which a scheduler that does not answer counts as missing, s.
_LONGEST_WAIT = 10


def fill(table: Table, plan: Plan, design: Floats, scheduler: Any, workers: int | None) -> None:
    """Run the variants that are left on a cluster.

    Raises:
        ModelError: Dask is not installed, there is no such scheduler, or it was lost.
    """
    with _client_of(scheduler, workers) as client:
        with _answering():
            link = client.dashboard_link
        print(f"Dask dashboard: {link}", flush=True)
        _Blocks(table, plan, design, client).run()


@contextmanager
def _answering() -> Iterator[None]:
    """Report a cluster or a worker that fails; Dask raises errors of many classes."""
    try:
        yield
    except KempeError:
        raise
    except Exception as error:
        raise ModelError(
            f"the Dask cluster was lost, or a worker failed: {type(error).__name__}: {error}",
            hint="check the scheduler and that its workers have this version of kempe, then repeat "
            "the sweep with a new client; with a file for its rows it continues from them",
        ) from error


class _Blocks:
    """The blocks of a sweep on a cluster."""

    def __init__(self, table: Table, plan: Plan, design: Floats, client: Any) -> None:
        self._table, self._plan, self._design, self._client = table, plan, design, client
        self._left = table.left
        self._next, self._count = 0, 1
        self._rows: dict[str, NDArray[np.intp]] = {}

    def run(self) -> None:
        from distributed import as_completed

        with _answering():
            threads = max(1, sum(self._client.nthreads().values()))
            blocks = [self._submitted() for _ in range(_AHEAD * threads) if self._more]
            pending = as_completed(blocks)
        try:
            while self._rows:
                with _answering():
                    future = next(pending)
                    block, seconds = future.result()
                rows = self._rows.pop(future.key)
                self._table.add(rows, block)
                self._size(len(rows), seconds)
                if self._more:
                    with _answering():
                        pending.add(self._submitted())
        finally:
            with suppress(Exception):  # the client may have been closed
                self._client.cancel(list(pending.futures), force=True)

    @property
    def _more(self) -> bool:
        return self._next < len(self._left)

    def _submitted(self) -> Any:
        rows = self._left[self._next : self._next + self._count]
        self._next += len(rows)
        # impure: a block has no equal, and its result need not be kept
        future = self._client.submit(_computed, self._plan, self._design[rows], pure=False)
        self._rows[future.key] = rows
        return future

    def _size(self, count: int, seconds: float) -> None:
        """Choose the rows of the next block; at most four times as many."""
        wanted = int(count * _PACE / max(seconds, 1e-6))
        self._count = max(1, min(wanted, 4 * self._count, _MOST))


def _computed(plan: Plan, given: Floats) -> tuple[Block, float]:
    """A block and the time that it took, on a worker; Dask uses the other threads."""
    began = perf_counter()
    block = plan.rows(np.array(given), 1)
    return block, perf_counter() - began


def connected(address: str) -> Any:
    """A client of the scheduler at an address.

    Raises:
        ModelError: Dask is not installed, or there is no scheduler.
    """
    distributed = _distributed()
    try:
        return distributed.Client(address, timeout=_LONGEST_WAIT)
    except (OSError, ValueError) as error:
        raise ModelError(
            f"no Dask scheduler at {address}: {error}", hint="check the address and the network"
        ) from error


@contextmanager
def _client_of(scheduler: Any, workers: int | None) -> Iterator[Any]:
    """The given client, or the client of a cluster on this machine that ends with the block."""
    distributed = _distributed()
    if isinstance(scheduler, distributed.Client):
        yield scheduler
        return
    if scheduler != "dask":
        raise ModelError(
            f"scheduler: {scheduler!r}; must be a client of Dask or 'dask'",
            hint="distributed.Client(address) makes a client",
        )
    # a process for each worker, with one thread: Python's lock then delays no other worker
    with (
        distributed.LocalCluster(n_workers=workers, threads_per_worker=1) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def _distributed() -> Any:
    try:
        import distributed
    except ImportError as error:
        raise ModelError(
            "a sweep on a cluster needs Dask, which is not installed",
            hint="pip install 'kempe[dask]'",
        ) from error
    return distributed
