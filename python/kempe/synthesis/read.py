"""Tasks of synthesis in CSV files and in cases."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arguments import explained
from kempe.errors import FileError, ModelError
from kempe.sweeps.fits.data import read_columns
from kempe.synthesis.found import Found
from kempe.synthesis.function import function
from kempe.synthesis.motion import motion
from kempe.synthesis.path import path as path_of
from kempe.synthesis.path import solved

if TYPE_CHECKING:
    from kempe.case import Case

#: Columns of each task with their units; those in the second row may be missing.
_COLUMNS: dict[str, tuple[dict[str, str], dict[str, str]]] = {
    "motion": ({"x": "m", "y": "m", "angle": "rad"}, {}),
    "path": ({"x": "m", "y": "m"}, {"angle": "rad"}),
    "function": ({"crank": "rad", "rocker": "rad"}, {}),
}


@explained
def from_file(task: str, path: str | Path, **options: Any) -> Found:
    """Solve the task of a CSV file with headers such as ``x [mm], y [mm], angle [deg]``.

    A task "motion" has the columns x, y and angle; "path" has x, y and, if the crank angles are
    given, angle; "function" has crank and rocker. Columns without a unit are in m and rad.

    Args:
        task: "motion", "path" or "function".
        path: the file.
        options: further arguments of that function.

    Raises:
        FileError: the file cannot be read, or a column is missing.
        ModelError: as for that function.
    """
    if task not in _COLUMNS:
        raise ModelError(f"task: {task!r}; must be motion, path or function")
    needed, more = _COLUMNS[task]
    found = read_columns(Path(path), {**needed, **more})
    missing = [name for name in needed if name not in found]
    if missing:
        told = f"{path}: no column {' and '.join(missing)}"
        hint = f"the header of a task {task!r} is {', '.join({**needed, **more})}, with units"
        raise FileError(told, name=str(path), hint=hint)
    rows = np.column_stack([found[name] for name in needed]).tolist()
    if task == "motion":
        options.pop("progress", None)  # it needs no search
        return motion(rows, **options)
    if task == "function":
        return function([tuple(row) for row in rows], **options)
    angles = found.get("angle")
    return path_of(rows, angles=None if angles is None else angles.tolist(), **options)


#: The argument of each task that has no default.
_LISTS = {"motion": "poses", "path": "points", "function": "pairs"}


@explained
def from_case(case: Case, **options: Any) -> Found:
    """Solve the task of the section ``[synthesis]`` of a case.

    ``choice`` of the section is the number, from 1, of the candidate whose bodies the case has.
    With it, the candidates are those that the studio shows for this section, so that nine points
    may have more of them without.

    Args:
        case: the case.
        options: replace arguments of the section, such as ``defects="tell"``.

    Raises:
        ModelError: the case has no such section, or as for the function of its task.
    """
    section = {**case.synthesis, **options}
    if not case.synthesis:
        hint = 'write [synthesis] with task = "motion" and poses, or use kp.synthesis.motion'
        raise ModelError("the case has no section [synthesis]", hint=hint)
    chosen = section.pop("choice", None) is not None
    task = str(section.pop("task"))
    given = section.pop(_LISTS[task])
    if task == "motion":
        section.pop("progress", None)
        return motion(given, **section)
    if task == "function":
        return function([tuple(row) for row in given], **section)
    return solved(given, follows=False, **section) if chosen else path_of(given, **section)
