"""Files of solutions: NumPy arrays and one JSON text that contains the case, without pickle.

``archive`` reads them.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe import _core
from kempe._version import __version__
from kempe.base import files
from kempe.base.arrays import Floats
from kempe.results.runs import STATUS

if TYPE_CHECKING:
    from kempe.results.solution import Solution

KIND = "kempe solution"
#: Version of the file layout.
LAYOUT = 1
#: The arrays of the events.
EVENTS = ("event_t", "event_q", "event_v", "event_z", "event_impulses")


def save(solution: Solution, path: Path | str) -> None:
    """Write a solution completely or not at all; see ``Solution.save``."""
    arrays = {name: getattr(solution, name) for name in ("t", "q", "v", "z", "a", "lam")}
    arrays["energy"] = solution.energy.columns
    if solution.dense is not None:
        dense = solution.dense
        arrays |= {"dense_t": dense.t, "dense_y": dense.y, "dense_c": dense.c}
    arrays |= _event_arrays(solution)
    about = json.dumps(_about(solution), allow_nan=False)
    with files.writing(path) as file:
        np.savez(file, about=np.array(about), **arrays)


def _about(solution: Solution) -> dict[str, Any]:
    settings = solution._run.settings
    return {
        "kind": KIND,
        "layout": LAYOUT,
        "kempe": __version__,
        "core": _core.version(),
        "numpy": np.__version__,
        "case": json.loads(solution._base.case),
        "status": next(name for name, status in STATUS.items() if status == solution.status),
        "message": solution.message,
        "statistics": dict(solution.statistics),
        "projection": solution._run.projection,
        "settings": [[row, list(map(list, p)), *rest] for row, (p, *rest) in settings],
        "variable": [solution.variable.name, solution.variable.unit],
        "static": solution.variable.static,
        "events": [[name, len(t)] for name, t, *_ in solution._run.events],
    }


def _event_arrays(solution: Solution) -> dict[str, Floats]:
    """The states of all events, one event after the other; empty if no event occurred."""
    if not any(len(t) for _, t, *_ in solution._run.events):
        return {}
    columns = list(zip(*solution._run.events, strict=True))[1:]
    return {name: np.concatenate(part) for name, part in zip(EVENTS, columns, strict=True)}
