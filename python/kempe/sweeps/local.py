"""A sweep on the threads of this process."""

from __future__ import annotations

from time import perf_counter

from kempe.base.arrays import Floats
from kempe.sweeps.plan import Plan
from kempe.sweeps.table import Table

#: Time between two writes of results, s, and most rows between them.
_PACE, _MOST = 0.5, 20_000


def fill(table: Table, plan: Plan, design: Floats, workers: int) -> None:
    """Run the variants that are left, block by block."""
    left, first = table.left, 0
    count = workers if plan.is_native else 1
    while first < len(left):
        rows = left[first : first + count]
        began = perf_counter()
        table.add(rows, plan.rows(design[rows], workers))
        seconds = max(perf_counter() - began, 1e-6)
        first += len(rows)
        # at most four times as many: the first blocks are brief and measure little
        count = max(1, min(int(len(rows) * _PACE / seconds), 4 * count, _MOST))
