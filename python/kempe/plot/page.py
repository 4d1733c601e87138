"""A figure of the report: its name, its size, its drawing, and its files."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from kempe.base import files
from kempe.base.names import one_of, unknown
from kempe.model.values import instance, listed, texts
from kempe.plot import style
from kempe.plot.style import FORMATS, Format

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LONGEST = 40


@dataclass(frozen=True, repr=False)
class Page:
    """A figure that can be drawn.

    Attributes:
        number: its number in the report; figures of one family have the same number.
        name: a name such as "reactions_C", valid as the name of a file.
        about: the name with the unchanged names of the model.
        draw: function that draws the page as a figure without a window.
        key: whether it is one of the key figures of a run.
    """

    number: int
    name: str
    about: str
    draw: Callable[[], Figure]
    key: bool = False

    def __repr__(self) -> str:
        return f"<Page {self.number}: {self.about}>"

    @property
    def stem(self) -> str:
        """The name of its file without suffix, such as "11_reactions_C"."""
        return f"{self.number:02d}_{self.name}"

    def figure(self) -> Figure:
        """The figure, drawn, without a window."""
        with style.applied():
            return self.draw()


def save(
    chosen: Page | Iterable[Page],
    folder: Path | str,
    formats: Sequence[Format] | Sequence[str] | Format = ("png", "svg"),
) -> list[Path]:
    """Write figures to a folder, which is created if missing; return the files.

    Args:
        chosen: one page or several, such as ``kp.plot.pages(sol)``.
        folder: the folder.
        formats: some of "png", "svg" and "pdf".

    Raises:
        FileError: a file cannot be written.
        ModelError: there is no such format, or ``chosen`` contains an object that is not a page.
    """
    into = files.checked_path(folder, "write")
    wanted = [formats] if isinstance(formats, str) else texts(formats, "formats")
    kinds = [one_of("format", name, FORMATS) for name in wanted]
    written = []
    for page in [chosen] if isinstance(chosen, Page) else listed(chosen, "figures"):
        instance(page, Page, "a page of kp.plot.pages(solution)")
        written += style.save(page.figure(), into / page.stem, kinds)
    return written


def select(known: Sequence[Page], names: Sequence[str]) -> list[Page]:
    """The pages of the given names, with or without the number; all when no name is given.

    Raises:
        ModelError: there is no page of a name.
    """
    chosen: list[Page] = []
    for name in texts(names, "figures"):
        found = [page for page in known if name in (page.name, page.about, page.stem)]
        if not found:
            raise unknown("figure", name, [page.name for page in known])
        chosen += [page for page in found if page not in chosen]
    return chosen if names else list(known)


def file_names(names: Iterable[str]) -> list[str]:
    """Names of the model as valid file names: plain letters and digits, short, all different."""
    taken: set[str] = set()
    found = []
    for name in names:
        plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
        kept = "".join(c if c.isalnum() or c in "-_" else "_" for c in plain)
        stem = kept.strip("_")[:_LONGEST] or "unnamed"
        count, unique = 1, stem
        while unique.casefold() in taken:  # some file systems do not distinguish a and A
            count += 1
            unique = f"{stem}_{count}"
        taken.add(unique.casefold())
        found.append(unique)
    return found
