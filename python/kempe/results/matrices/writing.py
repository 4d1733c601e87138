"""A matrix with names as aligned text, as CSV and as LaTeX."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from kempe.base.arrays import Floats
from kempe.base.files import csv_cell

ZERO = "·"
#: Outside of this range a number is written with an exponent.
SMALLEST, LARGEST = 1e-3, 1e6

_SYMBOLS = {
    "M": "M",
    "Phi": r"\Phi",
    "Phi_q": r"\Phi_q",
    "nu": r"\nu",
    "gamma": r"\gamma",
    "Q": "Q",
    "kkt": r"\begin{bmatrix} M & \Phi_q^{\mathsf T} \\ \Phi_q & 0 \end{bmatrix}",
    "rhs": r"\begin{bmatrix} Q \\ \gamma \end{bmatrix}",
    "a": r"\ddot q",
    "lam": r"\lambda",
}


def number(value: float) -> str:
    """Six digits, a dot for zero."""
    if value == 0.0:
        return ZERO
    if SMALLEST <= abs(value) < LARGEST:
        digits = f"{value:.4f}" if abs(value) < 100.0 else f"{value:.6g}"
        return digits.rstrip("0").rstrip(".") if "." in digits else digits
    return f"{value:.4e}"


def text(rows: Sequence[str], columns: Sequence[str], values: Floats) -> str:
    """Lines with aligned columns: names to the left, decimal points below each other."""
    body = [_aligned([number(value) for value in column]) for column in values.T.tolist()]
    header = list(columns) or [""] * len(body)
    widths = [
        max(len(name), *map(len, cells), 1) if cells else len(name)
        for name, cells in zip(header, body, strict=True)
    ]
    left = max(map(len, rows), default=0)
    lines = []
    if columns:
        names = (name.rjust(width) for name, width in zip(header, widths, strict=True))
        lines.append("  ".join([" " * left, *names]))
    for k, row in enumerate(rows):
        cells = (cells[k].rjust(width) for cells, width in zip(body, widths, strict=True))
        lines.append("  ".join([row.ljust(left), *cells]).rstrip())
    return "\n".join(lines)


def _aligned(cells: Sequence[str]) -> list[str]:
    """Cells padded with blanks so that the decimal points are aligned."""
    behind = [
        0 if _exponent(cell) else len(cell.partition(".")[2]) + ("." in cell) for cell in cells
    ]
    most = max(behind, default=0)
    return [
        cell if _exponent(cell) else cell + " " * (most - length)
        for cell, length in zip(cells, behind, strict=True)
    ]


def _exponent(cell: str) -> bool:
    return "e" in cell


def csv(rows: Sequence[str], columns: Sequence[str], values: Floats) -> str:
    """A header with an empty first cell, then one line for each row; shortest exact digits."""
    lines = [["", *map(csv_cell, columns)]]
    for name, row in zip(rows, values.tolist(), strict=True):
        lines.append([csv_cell(name), *(repr(value + 0.0) for value in row)])
    return "".join(",".join(cells) + "\n" for cells in lines)


def latex(name: str, rows: Sequence[str], columns: Sequence[str], values: Floats) -> str:
    """A displayed formula for amsmath: names of the rows, the matrix, names of the columns.

    The names of the columns are written as the column vector by which the matrix is multiplied, so
    that the columns can be narrow.
    """
    wide = f"\\setcounter{{MaxMatrixCols}}{{{len(columns)}}}\n" if len(columns) > 10 else ""
    body = latex_body(name, rows, columns, values)
    return wide + "\\begin{equation*}\n" + body + "\n\\end{equation*}\n"


def latex_body(name: str, rows: Sequence[str], columns: Sequence[str], values: Floats) -> str:
    """The formula without its environment."""
    lines = [r" & ".join(map(latex_number, row)) for row in values.tolist()]
    parts = [f"{_SYMBOLS[name]} =", _stack("matrix", [named(row) for row in rows])]
    parts.append(_stack("bmatrix", lines))
    if columns:
        parts.append(_stack("matrix", [named(column) for column in columns]))
    return "\n".join(parts)


def _stack(kind: str, lines: Sequence[str]) -> str:
    body = " \\\\\n".join(f"  {line}" for line in lines)
    return f"\\begin{{{kind}}}\n{body}\n\\end{{{kind}}}"


def latex_number(value: float) -> str:
    """The number as in the text, with a power of ten in place of an exponent."""
    if value == 0.0:
        return r"\cdot"
    digits, _, exponent = number(value).partition("e")
    return f"{digits} \\times 10^{{{int(exponent)}}}" if exponent else digits


_ESCAPED = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "λ": r"\ensuremath{\lambda}",
    **{sign: f"\\{sign}" for sign in "&%$#_{}"},
}


_SIGNS = {escaped: sign for sign, escaped in _ESCAPED.items()}
_ESCAPE = re.compile("|".join(map(re.escape, _SIGNS)))
_NAMED = re.compile(rf"\\text{{((?:{_ESCAPE.pattern}|[^\\{{}}])*)}}")


def named(name: str) -> str:
    """A name as upright text in a formula."""
    return "\\text{" + "".join(_ESCAPED.get(sign, sign) for sign in name) + "}"


def replace_names(latex: str, made: Callable[[str], str]) -> str:
    """A formula with another text in place of each name, which ``made`` gets as it was written."""

    def replaced(found: re.Match[str]) -> str:
        return made(_ESCAPE.sub(lambda escape: _SIGNS[escape[0]], found[1]))

    return _NAMED.sub(replaced, latex)
