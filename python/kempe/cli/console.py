"""Consoles of the command line: results on stdout, everything else on stderr.

Colours appear only on a terminal and without NO_COLOR, which rich checks. Names are printed
verbatim, because ``Text`` does not interpret brackets. Lines are never wrapped, so a pipe receives
the same text as a wide terminal.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite
from pathlib import Path

from rich.console import Console
from rich.text import Text


def answers(*, silent: bool = False) -> Console:
    """The console for results."""
    return Console(highlight=False, markup=False, soft_wrap=True, quiet=silent)


def remarks() -> Console:
    """The console for progress, warnings and errors."""
    return Console(stderr=True, highlight=False, markup=False, soft_wrap=True)


def heading(console: Console, text: str) -> None:
    """Print an empty line and a title."""
    console.print()
    console.print(Text(text, style="bold"))


def list_files(console: Console, written: Iterable[Path]) -> None:
    """Print the names of written files below a title."""
    heading(console, "Files")
    for path in written:
        console.print(Text(f"  {path}"))


def table(
    console: Console, header: Sequence[str], rows: Iterable[Sequence[str]], *, left: int = 1
) -> None:
    """Print aligned columns: the first ``left`` columns to the left, the others to the right."""
    body = [list(row) for row in rows]
    widths = [max(map(len, column)) for column in zip(header, *body, strict=True)]
    console.print(Text(_line(header, widths, left), style="dim"))
    for row in body:
        console.print(Text(_line(row, widths, left)))


def _line(cells: Sequence[str], widths: Sequence[int], left: int) -> str:
    placed = [
        cell.ljust(width) if k < left else cell.rjust(width)
        for k, (cell, width) in enumerate(zip(cells, widths, strict=True))
    ]
    return ("  " + "  ".join(placed)).rstrip()


def figure(value: float) -> str:
    """A number with six digits, without a minus sign before zero."""
    return f"{value + 0.0:.6g}"


def in_unit(value: float, unit: str) -> str:
    """A number in its display unit; a dash if it is not finite."""
    from kempe.base.display_units import display

    return figure(value / display(unit).divisor) if isfinite(value) else "–"


def symbol(unit: str) -> str:
    """The symbol of a display unit."""
    from kempe.base.display_units import display

    return display(unit).symbol
