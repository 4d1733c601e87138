"""Writing of the results of an analysis to a folder."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kempe.cli.figures import Drawing
    from kempe.results.result import Result
    from kempe.results.solution import Solution

SUMMARY = "summary.json"
EVENTS = "events.csv"
FILES = ("solution.npz", "solution.csv", SUMMARY)


def write_results(
    solution: Solution, summary: dict[str, Any], folder: Path, drawing: Drawing
) -> list[Path]:
    """Write solution, tables, drawings, figures and summary; return the list of files.

    The summary is written last, because it lists all files.

    Args:
        solution: the solution.
        summary: its summary.
        folder: the folder for the files.
        drawing: the wanted figures and drawings.

    Raises:
        FileError: a file cannot be written.
    """
    from kempe.cli.drawings import write_drawings, write_figures
    from kempe.results.event_table import write_events

    data, text, overview = (folder / name for name in FILES)
    solution.save(data)
    solution.to_csv(text)
    occurred = [folder / EVENTS] if write_events(solution, folder / EVENTS) else []
    written = [data, text, *occurred, overview, *write_drawings(solution, folder, drawing)]
    written += write_figures(solution, folder, drawing)
    _write_summary(overview, summary, written)
    return written


def write_result(result: Result, folder: Path, drawing: Drawing) -> list[Path]:
    """Write tables, figures and summary of a result that is not a motion; return the files.

    Raises:
        FileError: a file cannot be written.
    """
    from kempe.cli.drawings import write_figures

    overview = folder / SUMMARY
    written = [*result.save(folder), overview, *write_figures(result, folder, drawing)]
    _write_summary(overview, result.summary(), written)
    return written


def _write_summary(path: Path, summary: dict[str, Any], written: list[Path]) -> None:
    from kempe.base import files

    names = [each.relative_to(path.parent).as_posix() for each in written]
    files.write_text(path, files.json_text({**summary, "files": names}) + "\n")
