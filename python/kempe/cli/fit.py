"""``kempe fit``: values of parameters that agree best with measured data."""

from __future__ import annotations

from math import isfinite
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
from kempe.cli.console import answers, heading, in_unit, list_files, symbol, table
from kempe.cli.failure import document
from kempe.cli.rewriting import save_changed

if TYPE_CHECKING:
    from rich.console import Console

    from kempe.sweeps.fits import Data, Fit

EXAMPLES = """Examples:

  kempe fit rod.toml rod.csv

  kempe fit rig.toml run.csv --units deg,mm -o out/rig
"""


def fit(  # noqa: PLR0917 - typer uses the annotations of options and arguments
    file: File,
    data: Annotated[Path, typer.Argument(metavar="DATA", help="CSV file with headers.")],
    output: Folder = None,
    settings: Settings = None,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Fit parameters to measured data; write their values, residuals and a figure."""
    from kempe.base import files
    from kempe.plot import save
    from kempe.plot.fits import fit_pages
    from kempe.sweeps.fits import fit as solve
    from kempe.sweeps.fits.run import data_of

    with document(as_json) as content, shown_in(units):
        case = read_case(file, Changes(settings))
        folder = files.checked_path(output or Path("out") / stem(file) / "fit", "write")
        measured = data_of(case, data)
        found = solve(case, measured)
        console = answers(silent=as_json)
        _show(console, found, measured)
        save_changed(found.case, file, found.values, settings, folder / "fitted.toml")
        found.to_csv(folder / "residuals.csv")
        written = [folder / "fitted.toml", folder / "residuals.csv"]
        written += save(fit_pages(found), folder / "figures")
        content.update({**_summary(found, measured), "files": [str(path) for path in written]})
        list_files(console, written)


def _show(console: Console, found: Fit, measured: Data) -> None:
    """Print the values with their intervals, and what speaks against them."""
    console.print(Text("Parameters", style="bold"))
    rows = []
    for name, value in found.values.items():
        unit, (low, high) = found.units[name], found.intervals[name]
        numbers = (value, found.standard_errors[name], low, high)
        rows.append([name, *(in_unit(x, unit) for x in numbers), symbol(unit)])
    table(console, ["parameter", "value", "standard error", "95 % from", "to", "unit"], rows)
    for text in (*found.undetermined, *found.remarks):
        console.print(Text(f"  {text}"))
    heading(console, "Data")
    rows = [
        [
            name,
            str(len(of)),
            str(measured.missing[name]),
            in_unit(found.sigma[name], found.units[name]),
            symbol(found.units[name]),
        ]
        for name, of in found.residuals.items()
    ]
    spread = "sigma" if measured.sigma else "sigma, from residuals"
    table(console, ["quantity", "values", "missing", spread, "unit"], rows)


def _summary(found: Fit, measured: Data) -> dict[str, Any]:
    """The numbers in SI units and rad; null for infinite ones."""
    return {
        "values": dict(found.values),
        "standard_errors": {name: _finite(x) for name, x in found.standard_errors.items()},
        "intervals": {name: [_finite(x) for x in ends] for name, ends in found.intervals.items()},
        "undetermined": list(found.undetermined),
        "remarks": list(found.remarks),
        "sigma": {name: _finite(x) for name, x in found.sigma.items()},
        "missing": dict(measured.missing),
        "success": found.success,
    }


def _finite(value: float) -> float | None:
    return value if isfinite(value) else None
