"""The events of a solution as a table: name, time, and the state of the mechanism there."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from kempe.base import files
from kempe.results.solution import Solution
from kempe.results.table import column


def write_events(solution: Solution, path: Path | str) -> bool:
    """Write one line for each event as CSV with 17 digits, in the order of time.

    The columns are the name of the event, its time, and the coordinates, rates and first-order
    states, in display units. At the impact of a contact, they are the values before the impact.
    Without events, no file is written, and the file of an earlier run is removed.

    Returns:
        Whether there are events.

    Raises:
        FileError: the file cannot be written; an existing file is not changed.
    """
    found = [
        (float(t), event.name, state)
        for event in solution.events.values()
        for t, state in zip(event.t, event.states, strict=True)
    ]
    if not found:
        files.remove(Path(path))
        return False
    found.sort(key=lambda line: line[0])
    model, first = solution.compiled, solution.variable
    units = model.column_units()
    names = [first.name, *model.column_names(), *model.rate_names(), *model.state_names()]
    of = [first.unit, *units, *(first.rate(f"{unit}/s") for unit in units), *model.state_units()]
    rows = np.array([[t, *state.q, *state.v, *state.z] for t, _, state in found])
    table = [column(*each) for each in zip(names, of, rows.T, strict=True)]
    lines = [["event", *(files.csv_cell(each.label) for each in table)]]
    for k, (_, name, _) in enumerate(found):
        lines.append([files.csv_cell(name), *(f"{each.values[k]:.17g}" for each in table)])
    files.write_text(path, "\n".join(map(",".join, lines)) + "\n")
    return True
