"""Writes what an analysis gave into a folder."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kempe.solution import Solution


def write_results(solution: Solution, summary: dict[str, Any], folder: Path) -> list[Path]:
    """Solution, table, summary and figure; returns the files in that order.

    Raises:
        FileError: a file cannot be written.
    """
    from kempe import files, plot
    from kempe.plot import style

    data, text = folder / "solution.npz", folder / "solution.csv"
    told, drawing = folder / "summary.json", folder / "figures" / "linkage.png"
    solution.save(data)
    solution.to_csv(text)
    files.write_text(told, json.dumps(summary, indent=2, ensure_ascii=False) + "\n")
    figure = style.figure()
    plot.linkage(solution, figure.add_subplot())
    style.save(figure, drawing)
    return [data, text, told, drawing]
