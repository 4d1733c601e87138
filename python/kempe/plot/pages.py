"""The figures of a solution, in the order of reading."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from kempe.model.compiled import COORDINATES
from kempe.model.values import instance
from kempe.plot import design_pages, drawing_pages
from kempe.plot.marks import mark_events
from kempe.plot.page import Page, file_names
from kempe.plot.result_pages import result_pages
from kempe.plot.time_axis import transient
from kempe.plot.time_pages import TimePages, only_turns
from kempe.results.result import Result
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: The figures that are not over time.
DRAWINGS = ("mechanism", "initial", "final")
#: The figures that show a run at a glance, which ``kempe run`` draws by default; of a driven motion
#: also coupler curves, transmission angles and efforts.
KEY = ("mechanism", "residual", "energy", "reactions", "motion")


def pages(
    solution: Solution | Result,
    index_base: int = 1,
    most: int | None = None,
    *,
    compressed: bool = False,
) -> list[Page]:
    """All figures of a solution or another result; each is drawn on request.

    Args:
        solution: the solution or result.
        index_base: number of the first body.
        most: largest number of figures of one kind, such as the joints; no limit when None.
        compressed: whether time axes are compressed after ``transient(solution)``, if the motion
            settles; the axes name this time.

    Returns:
        The figures; figures of one family, such as the joints, have the same number.
    """
    if isinstance(solution, Result):
        return result_pages(solution, index_base)
    instance(solution, Solution, "a solution")
    cut = transient(solution) if compressed else None
    found: list[Page] = []
    for family in _families(solution, index_base, most, cut):
        number = found[-1].number + 1 if found else 1
        found += [replace(page, number=number, key=_is_key(page)) for page in family]
    found = [_with_marks(page, solution) for page in found]
    for family in design_pages.families(solution, index_base, most):
        number = found[-1].number + 1
        found += [replace(page, number=number) for page in family]
    return found


def _is_key(page: Page) -> bool:
    """Whether ``kempe run`` draws it by default; measures always."""
    return page.name in KEY or page.name.startswith("measure_")


def _with_marks(page: Page, solution: Solution) -> Page:
    """The page with the events of the solution, if it is over time."""
    if page.name in DRAWINGS:
        return page

    def draw() -> Figure:
        figure = page.draw()
        mark_events(figure, solution)
        return figure

    return replace(page, draw=draw)


def _families(
    solution: Solution, index_base: int, most: int | None, cut: float | None
) -> Iterator[list[Page]]:
    model = solution.compiled
    yield [drawing_pages.of_mechanism(solution.initial)]
    yield [drawing_pages.of_configuration("initial", solution.initial, index_base)]
    yield [drawing_pages.of_configuration("final", solution.final, index_base)]
    over_time = TimePages(solution, drawing_pages.unit_of_length(solution), cut, index_base)
    for quantity in COORDINATES:
        yield over_time.of_coordinate(quantity)[:most]
    for name, file in _filed(model.shown_bodies)[:most]:
        yield [over_time.of_body(name, file)]
    turning = [name for name in model.shown_forces if only_turns(solution, name)]
    yield [over_time.of_torque(*names) for names in _filed(turning)[:most]]
    yield [over_time.of_reactions(*names) for names in _filed(model.constraints)[:most]]
    yield [over_time.of_measure(*names) for names in _filed(model.measures)[:most]]
    yield [over_time.of_residual()]
    yield [over_time.of_energy()]
    yield [over_time.of_all_reactions()] if model.constraints else []
    yield [over_time.of_motion()]


def _filed(names: Iterable[str]) -> list[tuple[str, str]]:
    """Each name with its form in the name of a file."""
    return list(zip(names, file_names(names), strict=True))
