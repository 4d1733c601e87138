"""``kempe optimize``: the values of variables that are best within limits."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
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
from kempe.cli.console import answers, figure, heading, in_unit, list_files, remarks, symbol, table
from kempe.cli.failure import document
from kempe.cli.rewriting import save_changed

if TYPE_CHECKING:
    from collections.abc import Callable

    from rich.console import Console

    from kempe.sweeps.problems import Optimum

EXAMPLES = """Examples:

  kempe optimize door.toml

  kempe optimize press.toml --starts 16 --units mm,kN -o out/press
"""
#: Most candidates that are printed.
_MOST = 5
#: Most points of a front that are printed.
_MOST_OF_FRONT = 9


def optimize(  # noqa: PLR0917 - typer uses the annotations of options and arguments
    file: File,
    starts: Annotated[
        int | None, typer.Option("--starts", help="Number of starts, in place of \\[optimize].")
    ] = None,
    seed: Annotated[
        int | None, typer.Option("--seed", help="Number from which starts are drawn.")
    ] = None,
    method: Annotated[
        str | None,
        typer.Option(
            "--method",
            metavar="NAME",
            help="slsqp, trust-constr, least-squares or "
            "differential-evolution, in place of \\[optimize].",
        ),
    ] = None,
    output: Folder = None,
    settings: Settings = None,
    anew: Annotated[
        bool, typer.Option("--anew", help="Drop the runs of an earlier search in the folder.")
    ] = False,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Find the best values of variables within limits; resumes where it was stopped."""
    from kempe.base import files
    from kempe.cli.sweep import naming_anew
    from kempe.sweeps.problems import optimize as solve

    with document(as_json) as content, shown_in(units):
        case = read_case(file, Changes(settings))
        folder = files.checked_path(output or Path("out") / stem(file) / "optimize", "write")
        kept = folder / "optimize.db"
        if anew:
            files.remove(kept)
        console = answers(silent=as_json)
        with naming_anew(), _told(case) as progress:
            try:
                best = solve(
                    case, starts=starts, seed=seed, method=method, out=kept, progress=progress
                )
            except KeyboardInterrupt as error:
                found = getattr(error, "result", None)
                if found is not None:
                    written = _write(found, file, settings, folder)
                    _files(remarks(), written)
                told = "interrupted: the runs are kept, and the same command continues"
                remarks().print(Text(told))
                raise
        _show(console, best)
        written = _write(best, file, settings, folder)
        content.update({**_summary(best), "files": [str(path) for path in written]})
        _files(console, written)


def _write(best: Optimum, file: Path, settings: list[str] | None, folder: Path) -> list[Path]:
    """Write the case with the best values, the history and the figure."""
    from kempe.plot import save
    from kempe.plot.optimization import optimization_pages

    path = folder / "optimized.toml"
    save_changed(best.case, file, best.values, settings, path)
    best.to_csv(folder / "history.csv")
    figures = save(optimization_pages(best), folder / "figures")
    tables = [folder / "history.csv"]
    if len(best.labels) > 1:
        tables.append(folder / "front.csv")
        best.front_to_csv(tables[-1])
    return [path, *tables, *figures]


@contextmanager
def _told(case: Any) -> Iterator[Callable[[int, int, float], None]]:
    """Display runs, failures and the best objective while the block runs."""
    from rich.progress import Progress, SpinnerColumn, TextColumn

    console = remarks()
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}", markup=False),
        TextColumn("{task.fields[told]}", markup=False),
    )
    with Progress(
        *columns, console=console, transient=True, disable=not console.is_terminal
    ) as shown:
        task = shown.add_task(case.model.title, total=None, told="")

        def tell(runs: int, failed: int, best: float) -> None:
            known = f", best {best:.6g}" if best == best else ""  # noqa: PLR0124 - not a number
            shown.update(task, told=f"{runs} runs, {failed} failed{known}")

        yield tell


def _show(console: Console, best: Optimum) -> None:
    """Print the objective, the values, what limits them, and other candidates."""
    title = f"{best.label} = {_with_unit(best.objective, best.unit)}"
    title = f"Front of {', '.join(best.labels)}" if len(best.labels) > 1 else title
    console.print(Text(title, style="bold"))
    console.print(Text(f"  {best.message}; {best.runs} runs"))
    if len(best.labels) > 1:
        _show_front(console, best)
        return
    heading(console, "Variables")
    rows = []
    before = best.before
    for name, value in best.values.items():
        ends = [in_unit(x, best.units[name]) for x in (before[name], value, *best.bounds[name])]
        rows.append([name, *ends, symbol(best.units[name])])
    table(console, ["variable", "before", "best", "least", "largest", "unit"], rows)
    if best.measures:
        heading(console, "Measures")
        table(
            console,
            ["measure", "best", "unit"],
            [
                [name, in_unit(x, best.units[name]), symbol(best.units[name])]
                for name, x in best.measures.items()
            ],
        )
    if best.active:
        heading(console, "What limits it")
        about = "the objective gains per SI unit"
        table(console, ["bound or limit", about], [[k, figure(x)] for k, x in best.active.items()])
    for text in best.remarks:
        console.print(Text(f"  {text}"))
    if len(best.candidates) > 1:
        heading(console, "Other candidates")
        names = list(best.values)
        rows = [
            [
                _with_unit(one.objective, best.unit),
                *(in_unit(one.values[name], best.units[name]) for name in names),
            ]
            for one in best.candidates[1 : _MOST + 1]
        ]
        table(console, [best.label, *names], rows)


def _show_front(console: Console, best: Optimum) -> None:
    """Print points that are evenly spread over the front; ``front.csv`` has all."""
    count = len(best.candidates)
    places = sorted({round(k * (count - 1) / (_MOST_OF_FRONT - 1)) for k in range(_MOST_OF_FRONT)})
    units = [
        symbol(unit)
        for unit in (*best.units_of_objectives, *(best.units[name] for name in best.values))
    ]
    rows = []
    for one in (best.candidates[k] for k in places):
        pairs = [*zip(one.objectives.values(), best.units_of_objectives, strict=True)]
        pairs += [(x, best.units[name]) for name, x in one.values.items()]
        rows.append([in_unit(x, unit) for x, unit in pairs])
    names = [*best.labels, *best.values]
    heads = [f"{name} / {unit}" if unit else name for name, unit in zip(names, units, strict=True)]
    heading(console, f"{len(places)} of {count} points")
    table(console, heads, rows)


def _with_unit(value: float, unit: str) -> str:
    return f"{in_unit(value, unit)} {symbol(unit)}".rstrip()


def _files(console: Console, written: list[Path]) -> None:
    list_files(console, written)


def _summary(best: Optimum) -> dict[str, Any]:
    """The numbers in SI units and rad."""
    return {
        "objective": best.objective,
        "values": dict(best.values),
        "measures": dict(best.measures),
        "active": dict(best.active),
        "remarks": list(best.remarks),
        "candidates": [
            {
                "objective": one.objective,
                "objectives": dict(one.objectives),
                "values": dict(one.values),
            }
            for one in best.candidates
        ],
        "runs": best.runs,
        "success": best.success,
        "message": best.message,
    }
