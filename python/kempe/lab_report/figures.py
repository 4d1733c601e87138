"""The figures of ``kempe.plot`` as parts of a report."""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from kempe.lab_report.blocks import Picture
from kempe.plot import Page, pages, style
from kempe.plot.pages import DRAWINGS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kempe.results.result import Result
    from kempe.results.solution import Solution

#: Largest number of figures of one kind, such as the figures of the joints.
MOST = 12
#: Identifiers in an SVG picture and the references to them, which are unique in one picture only.
_IDS = re.compile(r'(\bid="|href="#|url\(#)')
#: Captions by the name of the figure.
_CAPTIONS = {
    "mechanism": "The mechanism with its dimensions",
    "initial": "Initial configuration with the numbers of the bodies",
    "final": "Final configuration",
    "motion": "Positions and angles of all bodies",
    "residual": "Residuals of the constraints",
    "energy": "Energies, and the error of the energy balance",
    "reactions": "Magnitudes of the reactions of all joints",
}
#: Captions by the beginning of the name.
_FAMILIES = {
    "torque_": "Torque of {}",
    "reactions_": "Reactions of {} on both bodies, in the global frame and in that of the joint",
    "measure_": "Measure {}",
}


def picture(figure: Figure, caption: str, prefix: str) -> Picture:
    """A drawn figure.

    Args:
        figure: the figure.
        caption: its caption.
        prefix: a text before its identifiers, which is unique in the report.
    """
    plain = re.sub(r"\W+", "-", prefix, flags=re.ASCII)
    svg = _IDS.sub(rf"\g<1>{plain}-", style.svg(figure))
    label = html.escape(caption, quote=True)
    return Picture(caption, svg.replace("<svg ", f'<svg role="img" aria-label="{label}" ', 1))


def drawn(page: Page, prefix: str) -> Picture:
    """A figure of ``kempe.plot`` with its caption."""
    found = picture(page.figure(), _caption(page), f"{prefix}-{page.stem}")
    return replace(found, is_drawing=page.name in DRAWINGS)


class Figures:
    """The figures of a result; each is drawn once.

    Args:
        found: the result.
        analysis: its name, which makes identifiers unique.
    """

    def __init__(self, found: Solution | Result, analysis: str) -> None:
        self._pages = pages(found, most=MOST, compressed=True)
        self._analysis = analysis

    def all(self) -> list[Picture]:
        """All figures."""
        return self._drawn(self._pages)

    def named(self, *names: str) -> list[Picture]:
        """The figures with these names."""
        return self._drawn(page for page in self._pages if page.name in names)

    def beginning(self, *beginnings: str) -> list[Picture]:
        """The figures whose names begin with a text."""
        return self._drawn(page for page in self._pages if page.name.startswith(beginnings))

    def about(self, captions: Mapping[str, str]) -> list[Picture]:
        """The figures about these subjects, with a caption for each."""
        kept = [page for page in self._pages if page.about in captions]
        return [self._picture(page, captions[page.about]) for page in kept]

    def others(self, is_known: Callable[[str], bool]) -> list[Picture]:
        """The figures whose subjects are not known otherwise."""
        return self._drawn(page for page in self._pages if not is_known(page.about))

    def _drawn(self, chosen: Iterable[Page]) -> list[Picture]:
        return [drawn(page, self._analysis) for page in chosen]

    def _picture(self, page: Page, caption: str) -> Picture:
        return picture(page.figure(), caption, f"{self._analysis}-{page.stem}")


def _caption(page: Page) -> str:
    if page.name in _CAPTIONS:
        return _CAPTIONS[page.name]
    for beginning, caption in _FAMILIES.items():
        if page.about.startswith(beginning):
            return caption.format(page.about.removeprefix(beginning))
    words = page.about.replace("_", " ")
    return words[:1].upper() + words[1:]
