"""Compare kempe with the results that assembly files carry: one table for a folder of them.

    .venv/bin/python tools/compare_assemblies.py ../OndselSolver/testapp

Each row contains a file, a quantity, its largest magnitude in the file, the difference at the
first time and the largest difference.
Files that are refused are listed with the reason. Times, names and units are those of the files.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from pathlib import Path

import kempe as kp
import numpy as np

#: Quantities of the table, and the ends of the names that belong to them.
FAMILIES = {
    "position": (".x", ".y"),
    "angle": (".angle",),
    "velocity": (".vx", ".vy"),
    "angular velocity": (".omega",),
    "acceleration": (".ax", ".ay"),
    "angular acceleration": (".alpha",),
    "force of joints": (".fx_on_", ".fy_on_"),
    "torque of joints": (".torque_on_",),
    "effort of motions": (".effort",),
}

#: Rows of values and differences below this are left out.
ZERO = 1e-9


def family(name: str) -> str:
    """The quantity of a column."""
    own = name[name.rindex(".") :]
    ends = ((known, end) for known, ends in FAMILIES.items() for end in ends)
    return next(
        known for known, end in ends if own == end or (end[-1] == "_" and own.startswith(end))
    )


def differences(path: Path) -> dict[str, tuple[float, float, float]]:
    """Largest magnitude, difference at the first time, largest difference of each quantity."""
    case = kp.load(path)
    if not case.recorded:
        return {}
    solution = next(iter(case.run().values()))
    t = case.recorded["t"]
    found: dict[str, tuple[float, float, float]] = {}
    at = [np.argmin(np.abs(solution.t - time)) for time in t]
    apart = np.abs(solution.t[at] - t).max()
    if apart > 1e-9:
        raise kp.KempeError(f"the run lacks times of the file, by {apart:.1e} s")
    for name, column in case.recorded.items():
        if name == "t" or not known(solution, name):
            continue
        own = family(name)
        try:
            error = solution[name][at] - column
        except kp.SingularityError:
            continue  # parts without mass
        if own == "angle":
            error = np.remainder(error + np.pi, 2 * np.pi) - np.pi
        size, first, before = found.get(own, (0.0, 0.0, 0.0))
        found[own] = (
            max(size, np.abs(column).max()),
            max(first, np.abs(error[0])),
            max(before, np.abs(error).max()),
        )
    return found


def known(solution: kp.Solution, name: str) -> bool:
    """Whether the reaction is unique; the share of a redundant joint is a matter of choice."""
    own = name.rpartition(".")[0]
    return not ("_on_" in name or name.endswith(".effort")) or solution[own].unique


def rows(folder: Path) -> Iterator[str]:
    """The lines of the table."""
    refused, empty = [], []
    yield "| file | quantity | largest value | difference at the start | largest difference |"
    yield "|---|---|---|---|---|"
    for path in sorted(folder.glob("*.asmt")):
        try:
            found = differences(path)
        except kp.KempeError as error:
            text = str(error).replace(str(path), "").partition("; partial=True")[0]
            reason = text.replace("cannot read :", "").strip().splitlines()
            refused.append(f"| {path.name} | {reason[0]} |")
            continue
        if not found:
            empty.append(path.name)
        for name in (name for name in FAMILIES if name in found):
            size, first, error = found[name]
            if max(size, error) < ZERO:
                continue
            yield f"| {path.name} | {name} | {size:.4g} | {first:.1e} | {error:.1e} |"
    yield f"\nread, without results: {', '.join(empty)}\n"
    yield "| refused | first reason |"
    yield "|---|---|"
    yield from refused


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    for line in rows(Path(sys.argv[1])):
        print(line)
