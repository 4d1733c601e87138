"""The figures of results that are not motions: one function for each type of analysis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from kempe.plot.configurations import pages as sheets
from kempe.plot.equilibrium import rest_pages
from kempe.plot.limits import pages as limit_pages
from kempe.plot.modes import mode_pages
from kempe.plot.page import Page
from kempe.plot.reachable import pages as region_pages
from kempe.results.result import Result

#: The function that lists the figures of a result, by the type of the analysis. It is called with
#: the result and the number of the first body.
_PAGES: dict[str, Callable[[Any, int], list[Page]]] = {
    "configurations": sheets,
    "limits": limit_pages,
    "reachable": region_pages,
    "equilibrium": rest_pages,
    "modes": mode_pages,
}


def result_pages(result: Result, index_base: int = 1) -> list[Page]:
    """All figures of a result; each is drawn on request."""
    listed = _PAGES.get(result.kind)
    found = [] if listed is None else listed(result, index_base)
    return [replace(page, number=number) for number, page in enumerate(found, 1)]
