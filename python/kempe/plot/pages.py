"""The figures of a solution, in the order in which one looks at them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from kempe.compiled import COORDINATES
from kempe.plot import drawing_pages, time_pages
from kempe.plot.page import Page, file_names
from kempe.plot.time_axis import transient
from kempe.solution import Solution
from kempe.values import instance


def pages(solution: Solution, index_base: int = 1, most: int | None = None) -> list[Page]:
    """All figures of a solution; each is drawn on request.

    Args:
        solution: the solution.
        index_base: number of the first body.
        most: of figures of one kind, such as those of the joints; any number when None.

    Returns:
        The figures; those of one family, such as the joints, have the same number.
    """
    instance(solution, Solution, "a solution")
    found: list[Page] = []
    for family in _families(solution, index_base, most):
        number = found[-1].number + 1 if found else 1
        found += [replace(page, number=number) for page in family]
    return found


def _families(solution: Solution, index_base: int, most: int | None) -> Iterator[list[Page]]:
    model, cut = solution.compiled, transient(solution)
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


def _filed(names: Iterable[str]) -> list[tuple[str, str]]:
    """Each name with the one that it has in the name of a file."""
    return list(zip(names, file_names(names), strict=True))
