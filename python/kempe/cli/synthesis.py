"""``kempe synthesis``: linkages for poses, points or pairs of angles."""

from __future__ import annotations

from dataclasses import asdict
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.text import Text

from kempe.cli.arguments import AsJson, stem
from kempe.cli.clock import counting
from kempe.cli.console import answers, figure, list_files, remarks, table
from kempe.cli.failure import document
from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.synthesis import Candidate, Found

EXAMPLES = """Examples:

  kempe synthesis motion poses.csv

  kempe synthesis path points.csv --transmission-angle "40 deg" --rank drive.effort.peak

  kempe synthesis flap.toml
"""
#: Tasks that are in CSV files.
TASKS = ("motion", "path", "function")
#: Candidates in the printed table.
_SHOWN = 10


def synthesis(  # noqa: PLR0917 - typer uses the annotations of options and arguments
    task: Annotated[
        str,
        typer.Argument(
            metavar="TASK", help="motion, path or function; or a case with a section \\[synthesis]."
        ),
    ],
    file: Annotated[
        Path | None, typer.Argument(metavar="FILE", help="CSV with units in its headers.")
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Folder for results; default out/<FILE>/synthesis."),
    ] = None,
    family: Annotated[
        str | None,
        typer.Option(
            help="four_bar, the default; slider_crank for motion; watt_1, watt_2, stephenson_1, "
            "stephenson_2 or stephenson_3 for path and function."
        ),
    ] = None,
    tell: Annotated[bool, typer.Option("--tell", help="Keep candidates with defects.")] = False,
    transmission_angle: Annotated[
        str | None, typer.Option(help="Least transmission angle, such as '40 deg'.")
    ] = None,
    grashof: Annotated[
        bool, typer.Option("--grashof", help="Require Grashof's condition.")
    ] = False,
    rank: Annotated[
        str | None, typer.Option(help="Sort by a column of sweeps, such as drive.effort.peak.")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(help="Seed of samples and starts; 0 by default.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Find linkages for a task; write a table, the best case and a figure."""
    from kempe.base import files
    from kempe.plot import save
    from kempe.plot.synthesis import synthesis_pages

    with document(as_json) as content:
        source = Path(task) if file is None else file
        folder = files.checked_path(output or Path("out") / stem(source) / "synthesis", "write")
        given: dict[str, Any] = {"transmission_angle": transmission_angle, "family": family}
        given |= {"defects": "tell" if tell else None, "grashof": grashof or None, "seed": seed}
        options = {key: of for key, of in given.items() if of is not None}
        found = _searched(task, file, options, folder)
        if rank is not None:
            found = found.ranked(rank)
        console = answers(silent=as_json)
        console.print(Text(repr(found)[1:-1]))
        written = []
        if len(found):
            rows = [_row(k, one) for k, one in enumerate(found[:_SHOWN], 1)]
            table(console, ["", "type", "error", "transmission angle", "size [m]", "defects"], rows)
            written = _write(found, folder)
            written += save(synthesis_pages(found), folder / "figures")
            list_files(console, written)
        content.update({**_summary(found), "files": [str(path) for path in written]})


def _searched(task: str, file: Path | None, options: dict[str, Any], folder: Path) -> Found:
    """The linkages, with a display of the progress; those found so far are kept after Ctrl-C."""
    try:
        with counting((file or Path(task)).name) as progress:
            return _found(task, file, {**options, "progress": progress})
    except KeyboardInterrupt as error:
        _keep(getattr(error, "result", None), folder)
        raise


def _found(task: str, file: Path | None, options: dict[str, Any]) -> Found:
    """The linkages for the task of a CSV file, or of a case in place of the task."""
    from kempe.loading import load
    from kempe.synthesis import from_case, from_file

    if file is not None:
        return from_file(task, file, **options)
    if task in TASKS:
        hint = f"write kempe synthesis {task} FILE.csv, or the file of a case"
        raise ModelError(f"the task '{task}' needs a file", hint=hint)
    return from_case(load(Path(task)), **options)


def _row(number: int, one: Candidate) -> list[str]:
    angle = f"{degrees(one.transmission_angle):.1f}°"
    wrong = "; ".join(one.defects)
    error = figure(one.error) if one.error > 1e-9 * one.size else "0"
    return [str(number), one.type, error, angle, figure(one.size), wrong]


def _write(found: Found, folder: Path) -> list[Path]:
    """The table of all candidates and the case of the best one."""
    from kempe.base import files

    files.write_text(folder / "candidates.csv", found.text())
    found[0].case.save(folder / "best.toml")
    return [folder / "candidates.csv", folder / "best.toml"]


def _keep(found: Found | None, folder: Path) -> None:
    """Write what an interrupted search has found."""
    if found is None or not len(found):
        remarks().print(Text("interrupted before anything was found"))
        return
    remarks().print(Text(f"interrupted: {len(found)} candidates of a part of the search"))
    list_files(remarks(), _write(found, folder))


def _summary(found: Found) -> dict[str, Any]:
    """The candidates in SI units and rad."""
    return {
        "complete": found.complete,
        "followed": found.followed and asdict(found.followed),
        "excluded": dict(found.excluded),
        "candidates": [
            {
                "type": one.type,
                "points": dict(one.points),
                "lengths": dict(one.lengths),
                "error": one.error,
                "transmission_angle": one.transmission_angle,
                "defects": list(one.defects),
            }
            for one in found
        ],
    }
