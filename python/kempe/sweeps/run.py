"""``kp.sweep``: many variants of a case."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.model.values import refuse
from kempe.sweeps import design as designs
from kempe.sweeps.asked import asked_of, design_of, planned
from kempe.sweeps.local import fill
from kempe.sweeps.plan import Plan
from kempe.sweeps.result import SweepResult
from kempe.sweeps.storage import Storage
from kempe.sweeps.table import Progress, Table
from kempe.sweeps.variables import Values

if TYPE_CHECKING:
    from kempe.case import Case

#: Largest number of threads or processes.
_MOST = 1024


@explained
def sweep(
    case: Case,
    variables: Mapping[str, Values] | None = None,
    measures: Sequence[str] = (),
    *,
    design: str | None = None,
    n: int | None = None,
    seed: int | None = None,
    analysis: str | None = None,
    workers: int | None = None,
    scheduler: Any = None,
    out: Path | str | None = None,
    progress: Progress | None = None,
) -> SweepResult:
    """Run many variants of a case; the results equal those of single runs to the last bit.

    A variant that fails is a row with its reason. Without arguments, ``[sweep]`` of the case runs.

    Args:
        case: the case.
        variables: values by the name of a parameter (``L2``) or of a coordinate or rate at the
            start (``crank.omega``): a list, ``{"from": 1e3, "to": 1e5, "n": 50, "scale": "log"}``,
            ``{"normal": [mean, deviation]}`` or ``{"uniform": [least, most]}``, SI units and rad.
        measures: statistics of measures and quantities, such as ``"pin.max"``; for an analysis that
            is not a motion, numbers of its result, such as ``"frequency[0]"``, or quantities at
            rest, such as ``"rocker.angle"``.
        design: "grid" (default), "paired", "random", "latin" or "sobol"; the last two need SciPy.
        n: number of variants of the last three designs.
        seed: number from which values are drawn.
        analysis: name of the analysis; the last one of the case by default.
        workers: number of threads, or of processes with ``scheduler="dask"``.
        scheduler: a client of Dask, or "dask" for a cluster on this machine.
        out: file to which results are written during the sweep. A sweep resumes from its file.
        progress: called with the numbers of finished, failed and all variants, and the seconds
            left.

    Raises:
        ModelError: a variable, a measure or the design is invalid.
        FileError: ``out`` cannot be written, or contains another sweep.
        KeyboardInterrupt: Ctrl-C was pressed; ``result`` contains the finished rows.
    """
    asked = asked_of(case, variables, measures, design, n, seed, analysis)
    plan, known = planned(case, asked)
    given = designs.rows(known, *design_of(asked))
    threads = _workers(workers)
    storage = None if out is None else Storage(out, plan.key_of(given))
    try:
        table = Table(len(given), len(plan.wanted), storage, progress)
        _fill(table, plan, given, (scheduler, workers, threads))
    except KeyboardInterrupt as error:
        table.interrupted()
        error.result = SweepResult(plan, known, given, table)  # type: ignore[attr-defined]
        raise
    finally:
        if storage is not None:
            storage.close()
    return SweepResult(plan, known, given, table)


def _fill(table: Table, plan: Plan, given: Floats, where: tuple[Any, int | None, int]) -> None:
    """Run the variants that are left on threads, or on a cluster."""
    scheduler, workers, threads = where
    table.tell()
    if scheduler is None:
        fill(table, plan, given, threads)
    else:
        from kempe.sweeps import cluster

        cluster.fill(table, plan, given, scheduler, workers)


def _workers(workers: int | None) -> int:
    if workers is None:
        affinity = getattr(os, "sched_getaffinity", None)
        return len(affinity(0)) if affinity else (os.cpu_count() or 1)
    if not isinstance(workers, int) or isinstance(workers, bool) or not 1 <= workers <= _MOST:
        refuse("workers", f"{workers!r}; must be a whole number from 1 to {_MOST}")
    return workers
