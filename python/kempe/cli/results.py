"""Writing of the results of an analysis to a folder."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kempe.cli.animate import Form
    from kempe.solution import Solution

FILES = ("solution.npz", "solution.csv", "summary.json")
#: Largest number of figures of one kind, such as joints; ``kempe plot`` draws all.
MOST_FIGURES = 12


def write_results(
    solution: Solution,
    summary: dict[str, Any],
    folder: Path,
    *,
    index_base: int = 1,
    with_figures: bool = True,
    video: Form | None = None,
) -> list[Path]:
    """Write solution, table, drawings, figures and summary; return the list of files.

    The summary is written last, because it lists all files.

    Args:
        solution: the solution.
        summary: its summary.
        folder: the folder for the files.
        index_base: number of the first body in figures.
        with_figures: whether to draw figures.
        video: format of an additional video; None for no video.

    Raises:
        FileError: a file cannot be written.
    """
    from kempe import files
    from kempe.cli.drawings import write_drawings

    data, text, overview = (folder / name for name in FILES)
    solution.save(data)
    solution.to_csv(text)
    written = [data, text, overview]
    if with_figures or video is not None:
        written += write_drawings(solution, folder, video)
    if with_figures:
        from kempe.plot import pages, save

        written += save(pages(solution, index_base, MOST_FIGURES), folder / "figures")
    names = [path.relative_to(folder).as_posix() for path in written]
    content = json.dumps({**summary, "files": names}, indent=2, ensure_ascii=False)
    files.write_text(overview, content + "\n")
    return written
