"""Where the command line writes: answers on stdout, everything else on stderr.

Colours only on a terminal and without NO_COLOR (rich sees to both); names are shown verbatim, since
only ``Text`` is printed, in which brackets mean nothing; lines are never broken, so that a pipe
gets what a wide window shows.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rich.console import Console
from rich.text import Text


def answers(*, silent: bool = False) -> Console:
    """The console for what was asked for."""
    return Console(highlight=False, markup=False, soft_wrap=True, quiet=silent)


def remarks() -> Console:
    """The console for progress and troubles."""
    return Console(stderr=True, highlight=False, markup=False, soft_wrap=True)


def heading(console: Console, text: str) -> None:
    """An empty line and a title."""
    console.print()
    console.print(Text(text, style="bold"))


def table(
    console: Console, header: Sequence[str], rows: Iterable[Sequence[str]], *, left: int = 1
) -> None:
    """Columns under a header, aligned: the first ``left`` to the left, the others to the right."""
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
    """A number with six digits, and no minus before zero."""
    return f"{value + 0.0:.6g}"
