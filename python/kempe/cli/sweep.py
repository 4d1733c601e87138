"""``kempe sweep``: many variants of a case, as a table and figures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.progress import BarColumn, Progress, TextColumn
from rich.text import Text

from kempe.cli.arguments import (
    AsJson,
    Changes,
    File,
    Folder,
    Settings,
    Units,
    read_case,
    shown_in,
    stem,
)
from kempe.cli.console import answers, figure, heading, list_files, remarks, table
from kempe.cli.failure import document
from kempe.errors import FileError, ModelError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rich.console import Console

    from kempe.sweeps import SweepResult

EXAMPLES = """Examples:

  kempe sweep four_bar.toml --over L2=24:28:50 --over k=1e5:1e7:50:log --measure C.force.max

  kempe sweep springs.toml --workers 8 -o out/springs

  kempe sweep springs.toml --scheduler tcp://10.0.0.1:8786
"""


def sweep(  # noqa: PLR0917 - typer uses the annotations of options and arguments
    file: File,
    over: Annotated[
        list[str] | None,
        typer.Option(
            "--over",
            metavar="NAME=FROM:TO:N[:log]",
            help="Vary a parameter or a value at the start, in place of \\[sweep]; "
            "can be repeated.",
        ),
    ] = None,
    measures: Annotated[
        list[str] | None,
        typer.Option("--measure", metavar="TEXT", help="A column, such as C.force.max."),
    ] = None,
    analysis: Annotated[
        str | None,
        typer.Option("--analysis", metavar="NAME", help="The analysis; the last one by default."),
    ] = None,
    output: Folder = None,
    settings: Settings = None,
    workers: Annotated[
        int | None, typer.Option("--workers", help="Threads; one for each processor by default.")
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(help='Address of a Dask scheduler, or "dask" for a cluster on this machine.'),
    ] = None,
    anew: Annotated[
        bool, typer.Option("--anew", help="Drop the results of an earlier sweep in the folder.")
    ] = False,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Run many variants of a case; write a table and figures. Resumes where it was stopped."""
    from kempe.base import files
    from kempe.sweeps import sweep as compute

    with document(as_json) as content, shown_in(units):
        case = read_case(file, Changes(settings))
        folder = files.checked_path(output or Path("out") / stem(file) / "sweep", "write")
        kept = folder / "sweep.db"
        if anew:
            files.remove(kept)
        with _guarded(folder), _told(case.model.title or stem(file)) as progress:
            found = compute(
                case,
                dict(map(_range, over or [])) or None,
                measures or (),
                analysis=analysis,
                workers=workers,
                scheduler=_client(scheduler),
                out=kept,
                progress=progress,
            )
        _finish(found, folder, content, answers(silent=as_json))


def _finish(found: SweepResult, folder: Path, content: dict[str, Any], console: Console) -> None:
    """Print the ranges, and write table and figures."""
    from kempe.plot import save, sweep_pages

    _show(console, found)
    found.to_csv(folder / "sweep.csv")
    written = [folder / "sweep.csv", *save(sweep_pages(found), folder / "figures")]
    content.update({**_summary(found), "files": [str(path) for path in written]})
    list_files(console, written)


def _client(scheduler: str | None) -> Any:
    """A client of the scheduler at an address."""
    if scheduler is None or scheduler == "dask":
        return scheduler
    from kempe.sweeps.cluster import connected

    return connected(scheduler)


def _range(text: str) -> tuple[str, Mapping[str, Any]]:
    """``k=1e3:1e5:50:log`` as a variable."""
    name, _, values = (part.strip() for part in text.partition("="))
    first, *others = values.split(":")
    try:
        last, count = float(others[0]), int(others[1])
        scale = others[2] if others[2:] else "linear"
        if not name or len(others) > 3:
            raise ValueError
        return name, {"from": float(first), "to": last, "n": count, "scale": scale}
    except (ValueError, IndexError):
        hint = (
            "such as --over k=1e3:1e5:50:log; N is a whole number such as 50, and the others are in"
            " SI units and rad"
        )
        raise ModelError(
            f"--over {text}: must be NAME=FROM:TO:N or NAME=FROM:TO:N:log", hint=hint
        ) from None


@contextmanager
def _guarded(folder: Path) -> Iterator[None]:
    """Keep finished rows, and name --anew where the folder has another or a damaged sweep."""
    try:
        with naming_anew():
            yield
    except KeyboardInterrupt as error:
        _keep(getattr(error, "result", None), folder)
        raise


@contextmanager
def naming_anew() -> Iterator[None]:
    """Name --anew as the remedy where a folder has other or damaged results."""
    from kempe.sweeps.storage import CHANGED, DELETE

    try:
        yield
    except FileError as error:
        way = "--anew discards its results, and --output names another folder"
        if (error.hint or "").startswith(CHANGED):
            error.hint = f"{CHANGED}; {way}"
        elif error.hint == DELETE:
            error.hint = way
        raise


@contextmanager
def _told(title: str) -> Iterator[Callable[[int, int, int, float], None]]:
    """Display finished variants, failures and the time left while the block runs."""
    console = remarks()
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TextColumn("{task.fields[told]}"),
    )
    with Progress(
        *columns, console=console, transient=True, disable=not console.is_terminal
    ) as display:
        task = display.add_task(title, total=None, told="")

        def tell(done: int, failed: int, total: int, left: float) -> None:
            time = f", {left:.0f} s left" if left == left else ""  # noqa: PLR0124 - not a number
            told = f"{done} of {total} variants, {failed} failed{time}"
            display.update(task, completed=done, total=total, told=told)

        yield tell


def _keep(found: SweepResult | None, folder: Path) -> None:
    """Write the finished rows after an interruption."""
    if found is None:
        return
    from kempe.sweeps.table import UNFINISHED

    missing = sum(reason == UNFINISHED for reason in found.reasons.values())
    found.to_csv(folder / "sweep.csv")
    told = f"interrupted: {len(found) - missing} of {len(found)} variants are in {folder}"
    remarks().print(Text(f"{told}; the same command continues"))


def _show(console: Console, found: SweepResult) -> None:
    """Print the range of each measure and the most frequent failures."""
    from collections import Counter

    from kempe.base.display_units import display
    from kempe.results.remarks import not_unique, starred

    names = ", ".join(variable.name for variable in found.variables)
    console.print(Text(f"{len(found)} variants over {names}", style="bold"))
    rows = []
    for text in found.measures:
        unit = display(found.units[text])
        good = found[text][found.succeeded] / unit.divisor
        good = good[good == good]  # noqa: PLR0124 - without rows that do not settle
        cells = (
            [figure(float(x)) for x in (good.min(), good.mean(), good.max())]
            if len(good)
            else ["–"] * 3
        )
        unique = text not in found.choices
        rows.append([starred(text, unique=unique), *cells, unit.symbol])
    heading(console, "Measures")
    table(console, ["measure", "least", "mean", "largest", "unit"], rows)
    for line in not_unique(found.choices):
        console.print(Text(f"  {line}"))
    _show_unbounded(console, found)
    if found.reasons:
        heading(console, f"{len(found.reasons)} variants failed")
        for reason, count in Counter(_kind(text) for text in found.reasons.values()).most_common(3):
            console.print(Text(f"  {count} × {reason}"))


def _show_unbounded(console: Console, found: SweepResult) -> None:
    """Print the measures that have no bound in some variants."""
    from kempe.base.names import few

    if found.unbounded:
        count = int(found.succeeded.sum())
        told = [
            f"{text} ({len(rows)} of {count} variants)" for text, rows in found.unbounded.items()
        ]
        counted = "without bound at singular positions, counted in integrals and means only"
        console.print(Text(f"  {counted}: {few(told)}"))


def _kind(reason: str) -> str:
    """A reason without its numbers, to count equal ones."""
    import re

    return re.sub(r"-?\d+(\.\d+)?([eE][-+]?\d+)?", "…", reason)


def _summary(found: SweepResult) -> dict[str, Any]:
    return {
        "variants": len(found),
        "failed": len(found.reasons),
        "variables": [variable.name for variable in found.variables],
        "measures": list(found.measures),
        "remarks": dict(found.remarks),
    }
