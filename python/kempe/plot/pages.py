"""The figures of a solution, in the order in which one looks at them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from kempe.compiled import COORDINATES
from kempe.plot import drawing_pages, motion_page, time_pages
from kempe.plot.page import Page, file_names
from kempe.plot.time_axis import transient

if TYPE_CHECKING:
    from kempe.solution import Solution


#: The figures that show a run at a glance, which ``kempe run`` draws by default.
KEY = ("mechanism", "residual", "energy", "reactions", "motion")


def pages(
    solution: Solution,
    index_base: int = 1,
    most: int | None = None,
    *,
    compressed: bool = False,
) -> list[Page]:
    """All figures of a solution; each is drawn on request.

    Args:
        solution: the solution.
        index_base: number of the first body.
        most: of figures of one kind, such as those of the joints; any number when None.
        compressed: whether the time axis is compressed after ``transient``.

    Returns:
        The figures; those of one family, such as the joints, have the same number.
    """
    cut = transient(solution) if compressed else None
    found: list[Page] = []
    for family in _families(solution, index_base, most, cut):
        number = found[-1].number + 1 if found else 1
        found += [replace(page, number=number, key=page.name in KEY) for page in family]
    return found


def _families(
    solution: Solution, index_base: int, most: int | None, cut: float | None
) -> Iterator[list[Page]]:
    model = solution.model
    yield [drawing_pages.of_mechanism(solution)]
    yield [drawing_pages.of_configuration("initial", solution.initial, index_base)]
    yield [drawing_pages.of_configuration("final", solution.final, index_base)]
    for quantity in COORDINATES:
        yield time_pages.of_coordinate(solution, quantity, cut, index_base)[:most]
    for name, file in _filed(model.bodies)[:most]:
        yield [time_pages.of_body(solution, name, file, cut, index_base)]
    turning = [name for name in model.forces if time_pages.only_turns(solution, name)]
    yield [time_pages.of_torque(solution, *names, cut) for names in _filed(turning)[:most]]
    joints = _filed(model.constraints)[:most]
    yield [time_pages.of_reactions(solution, *names, cut) for names in joints]
    yield [time_pages.of_residual(solution, cut)]
    yield [time_pages.of_energy(solution, cut)]
    yield [time_pages.of_all_reactions(solution, cut)]
    yield [motion_page.of_motion(solution, cut, index_base)]


def _filed(names: Iterable[str]) -> list[tuple[str, str]]:
    """Each name with the one that it has in the name of a file."""
    return list(zip(names, file_names(names), strict=True))
