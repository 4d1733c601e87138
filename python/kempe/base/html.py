"""Tables and paragraphs as HTML, for notebooks."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence

#: Largest number of rows of a table; the last row gives the number of omitted rows.
_MOST_ROWS = 30


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table; its cells are texts."""
    given = list(rows)
    lines = [_row("th", header)] if any(header) else []
    lines += [_row("td", row) for row in given[:_MOST_ROWS]]
    if len(given) > _MOST_ROWS:
        lines.append(_row("td", (f"… {len(given) - _MOST_ROWS} more",)))
    return f"<table>{''.join(lines)}</table>"


def _row(kind: str, cells: Sequence[str]) -> str:
    return "<tr>" + "".join(f"<{kind}>{html.escape(cell)}</{kind}>" for cell in cells) + "</tr>"


def paragraph(text: str) -> str:
    """A paragraph."""
    return f"<p>{html.escape(text)}</p>"


def block(caption: str, *parts: str) -> str:
    """Parts below a caption."""
    return f"<div><b>{html.escape(caption)}</b>{''.join(parts)}</div>"
