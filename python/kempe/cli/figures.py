"""Functions for all commands that write figures."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Annotated

import typer

from kempe.cli.animate import Form
from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.plot import Page
    from kempe.results.result import Result
    from kempe.results.solution import Solution


class Which(str, Enum):
    """Which figures and drawings a run writes."""

    all = "all"
    key = "key"
    none = "none"


class Axis(str, Enum):
    """The time axis of figures."""

    linear = "linear"
    compressed = "compressed"


IndexBase = Annotated[
    int, typer.Option("--index-base", min=0, max=1, help="Number of the first body: 1 or 0.")
]

TimeAxis = Annotated[
    Axis,
    typer.Option(
        "--time-axis", help="compressed: the rest after a transient takes a short grey part."
    ),
]

#: Largest number of figures of one kind, such as joints, that a run draws.
MOST_FIGURES = 12


@dataclass(frozen=True)
class Drawing:
    """The figures and drawings that a run writes.

    Attributes:
        which: all, the key figures, or none.
        index_base: number of the first body in figures.
        time_axis: the time axis of figures.
        video: format of an additional video; None for no video.
    """

    which: Which = Which.key
    index_base: int = 1
    time_axis: Axis = Axis.linear
    video: Form | None = None

    def pages(self, solution: Solution | Result) -> list[Page]:
        """The figures of a solution or another result."""
        from kempe.plot import pages

        compressed = self.time_axis is Axis.compressed
        found = pages(solution, self.index_base, MOST_FIGURES, compressed=compressed)
        return [page for page in found if page.key or self.which is Which.all]


def formats(text: str) -> list[str]:
    """``png,svg`` → ["png", "svg"], each once.

    Raises:
        ModelError: it is empty or names a format that there is not.
    """
    from kempe.base.names import one_of
    from kempe.plot.style import FORMATS

    words = [word.strip().lower() for word in text.split(",") if word.strip()]
    if not words:
        raise ModelError(f"--format {text}: must be some of {','.join(FORMATS)}")
    return [one_of("format", word, FORMATS) for word in dict.fromkeys(words)]
