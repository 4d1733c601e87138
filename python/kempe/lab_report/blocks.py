"""The content of a report as data: sections of paragraphs, tables, formulas, figures and texts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, TypeAlias


@dataclass(frozen=True)
class Number:
    """A number in a cell.

    Attributes:
        value: the number in SI units and rad, with all digits.
        text: the number as printed, in the display unit of its column.
    """

    value: float
    text: str


@dataclass(frozen=True)
class Formula:
    """A formula, or a part of one, as MathML.

    Attributes:
        parts: elements ``math`` between which a line may break.
        number: the number of the equation in the literature; empty for none.
    """

    parts: tuple[str, ...]
    number: str = ""


#: Tables with more rows may break between pages.
SHORT = 24
#: Tables with at least this many columns have smaller letters.
WIDE = 7

Cell: TypeAlias = "str | Number | Formula"


@dataclass(frozen=True)
class Paragraph:
    """A paragraph; a warning is emphasized."""

    text: str
    warning: bool = False
    kind: ClassVar[str] = "paragraph"


@dataclass(frozen=True)
class Points:
    """A list of short texts."""

    texts: Sequence[str]
    kind: ClassVar[str] = "points"


@dataclass(frozen=True)
class Table:
    """A table.

    Attributes:
        caption: one line.
        header: heads of the columns.
        rows: their cells.
    """

    caption: str
    header: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    kind: ClassVar[str] = "table"

    @property
    def texts(self) -> list[bool]:
        """For each column, whether it contains texts, which are left-aligned."""
        columns = zip(*self.rows, strict=True)
        return [not any(isinstance(cell, Number) for cell in column) for column in columns]

    @property
    def is_short(self) -> bool:
        """Whether it is kept on one page."""
        return len(self.rows) <= SHORT

    @property
    def is_wide(self) -> bool:
        """Whether it has many columns, which need smaller letters."""
        return len(self.header) >= WIDE


@dataclass(frozen=True)
class Matrix:
    """A matrix with names.

    Attributes:
        caption: one line.
        groups: name and number of columns of each group of columns, such as the columns of a body.
        columns: full name and short name of each column.
        rows: the name of each row, and its cells.
    """

    caption: str
    groups: Sequence[tuple[str, int]]
    columns: Sequence[tuple[str, str]]
    rows: Sequence[tuple[str, Sequence[Number]]]
    kind: ClassVar[str] = "matrix"

    @property
    def is_short(self) -> bool:
        """Whether it is kept on one page."""
        return len(self.rows) <= SHORT


@dataclass(frozen=True)
class Formulas:
    """Displayed formulas below each other, with a heading; each may be a list of formulas."""

    heading: str
    lines: Sequence[Sequence[Formula]]
    kind: ClassVar[str] = "formulas"


@dataclass(frozen=True)
class Picture:
    """A figure as SVG; a drawing of a mechanism may be smaller than in a file of its own."""

    caption: str
    svg: str
    is_drawing: bool = False
    kind: ClassVar[str] = "picture"


@dataclass(frozen=True)
class Listing:
    """A text in a fixed width, such as a file."""

    text: str
    kind: ClassVar[str] = "listing"


Block: TypeAlias = "Paragraph | Points | Table | Matrix | Formulas | Picture | Listing"


@dataclass(frozen=True)
class Section:
    """A section or a subsection; sections without blocks and parts are left out.

    Attributes:
        title: its heading.
        blocks: its content.
        parts: its subsections.
    """

    title: str
    blocks: Sequence[Block]
    parts: Sequence[Section] = ()

    def kept(self) -> Section | None:
        """The section without empty parts and tables; None if nothing is left."""
        blocks = [block for block in self.blocks if not _is_empty(block)]
        parts = [part for each in self.parts if (part := each.kept()) is not None]
        return Section(self.title, blocks, parts) if blocks or parts else None


def _is_empty(block: Block) -> bool:
    """Whether a table has no rows, a list no texts, and so on."""
    if isinstance(block, Table | Matrix):
        return not block.rows
    if isinstance(block, Points):
        return not block.texts
    if isinstance(block, Formulas):
        return not block.lines
    return isinstance(block, Paragraph | Listing) and not block.text
