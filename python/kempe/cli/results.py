"""Writing of the results of an analysis to a folder."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kempe.cli.figures import Drawing
    from kempe.solution import Solution

FILES = ("solution.npz", "solution.csv", "summary.json")


def write_results(
    solution: Solution, summary: dict[str, Any], folder: Path, drawing: Drawing
) -> list[Path]:
    """Write solution, table, drawings, figures and summary; return the list of files.

    The summary is written last, because it lists all files.

    Args:
        solution: the solution.
        summary: its summary.
        folder: the folder for the files.
        drawing: the wanted figures and drawings.

    Raises:
        FileError: a file cannot be written.
    """
    from kempe import files
    from kempe.cli.drawings import write_drawings, write_figures

    data, text, overview = (folder / name for name in FILES)
    solution.save(data)
    solution.to_csv(text)
    written = [data, text, overview, *write_drawings(solution, folder, drawing)]
    written += write_figures(solution, folder, drawing)
    names = [path.relative_to(folder).as_posix() for path in written]
    content = json.dumps({**summary, "files": names}, indent=2, ensure_ascii=False)
    files.write_text(overview, content + "\n")
    return written
