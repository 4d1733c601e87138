"""A report read back from its HTML: sections, tables with their numbers, figures, texts."""

from __future__ import annotations

from dataclasses import dataclass, field
from html.parser import HTMLParser

_VOID = {"meta", "br", "use", "path", "image"}
_RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


@dataclass
class Cell:
    """A cell: its text, and the number with all digits if it has one."""

    text: str = ""
    value: float | None = None
    name: str = ""

    @property
    def printed(self) -> float:
        """The number that a person reads."""
        mantissa, _, power = self.text.replace("−", "-").partition("·10")
        return float(mantissa) * 10.0 ** int(power.translate(_RAISED) or 0)


@dataclass
class Table:
    caption: str
    head: list[list[Cell]] = field(default_factory=list)
    rows: list[list[Cell]] = field(default_factory=list)

    def row(self, *names: str) -> list[Cell]:
        """The only row that begins with these texts."""
        (found,) = (
            row for row in self.rows if [cell.text for cell in row[: len(names)]] == [*names]
        )
        return found

    def values(self, *names: str) -> list[float]:
        """The numbers of a row."""
        return [cell.value for cell in self.row(*names) if cell.value is not None]

    def numbers(self) -> list[Cell]:
        return [cell for row in self.rows for cell in row if cell.value is not None]


class Page(HTMLParser):
    """A report; ``headings`` are those of sections and parts without their numbers."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.headings: list[str] = []
        self.tables: list[Table] = []
        self.figures: list[str] = []
        self.identifiers: list[str] = []
        self.paragraphs: list[str] = []
        self.formulas = 0
        self.listing = ""
        self._open: list[str] = []
        self._text = ""
        self._cell: Cell | None = None
        self._caption = ""
        self.feed(text)

    def table(self, beginning: str) -> Table:
        """The first table whose caption begins so."""
        return next(one for one in self.tables if one.caption.startswith(beginning))

    def has_table(self, beginning: str) -> bool:
        return any(one.caption.startswith(beginning) for one in self.tables)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        if given.get("id"):
            self.identifiers.append(str(given["id"]))
        if tag in _VOID:
            return
        self._open.append(tag)
        if tag in ("h1", "h2", "h3", "p", "figcaption", "pre", "li"):
            self._text = ""
        if tag == "table":
            self.tables.append(Table(self._caption))
        elif tag == "tr" and "thead" in self._open:
            self.tables[-1].head.append([])
        elif tag == "tr":
            self.tables[-1].rows.append([])
        elif tag in ("th", "td"):
            self._cell = Cell(name=str(given.get("abbr") or ""))
            rows = self.tables[-1].head if "thead" in self._open else self.tables[-1].rows
            rows[-1].append(self._cell)
        elif tag == "data" and self._cell is not None:
            self._cell.value = float(str(given["value"]))
        elif tag == "math":
            self.formulas += 1

    def handle_startendtag(self, _: str, attrs: list[tuple[str, str | None]]) -> None:
        if dict(attrs).get("id"):
            self.identifiers.append(str(dict(attrs)["id"]))

    def handle_endtag(self, tag: str) -> None:
        if tag in _VOID:
            return
        assert self._open.pop() == tag
        text = " ".join(self._text.split())
        if tag in ("h2", "h3"):
            self.headings.append(text.partition(" ")[2])
        elif tag == "p" and text.startswith("Table "):
            self._caption = text.partition(": ")[2]
        elif tag in ("p", "li"):
            self.paragraphs.append(text)
        elif tag == "figcaption":
            self.figures.append(text.partition(": ")[2])
        elif tag == "pre":
            self.listing = self._text
        elif tag in ("th", "td") and self._cell is not None:
            self._cell.text = self._cell.text.strip()
            self._cell = None

    def handle_data(self, data: str) -> None:
        self._text += data
        if self._cell is not None:
            self._cell.text += data
