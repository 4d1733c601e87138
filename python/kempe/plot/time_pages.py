"""The figures over time on pages: panels side by side and one below the other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from kempe.compiled import ACCELERATIONS, RATES
from kempe.plot import style
from kempe.plot.body_motion import accelerations, body_title, positions, velocities
from kempe.plot.energy import energy, energy_balance
from kempe.plot.page import Page
from kempe.plot.reactions import all_reactions, reactions
from kempe.plot.residual import residual
from kempe.plot.torques import torques

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.solution import Solution

#: More panels than this do not fit on a page.
_MOST_PANELS = 12
#: Height of a panel, and of the texts above and below all panels, mm.
_PANEL, _AROUND = 38.0, 14.0


def of_coordinate(
    solution: Solution, quantity: str, cut: float | None, index_base: int
) -> list[Page]:
    """One coordinate of all bodies that have it, a panel for each; more pages for many bodies."""
    bodies = [
        name for name, info in solution.compiled.bodies.items() if quantity in info.quantities
    ]
    count = math.ceil(len(bodies) / _MOST_PANELS)
    found = []
    for k in range(count):
        some = bodies[k * len(bodies) // count : (k + 1) * len(bodies) // count]
        columns = 1 if len(some) <= 4 else 2
        rows = math.ceil(len(some) / columns)
        draw = partial(
            _draw_coordinate,
            solution=solution,
            quantity=quantity,
            bodies=some,
            columns=columns,
            cut=cut,
            index_base=index_base,
        )
        name = quantity if count == 1 else f"{quantity}_{k + 1}"
        found.append(Page(0, name, name, rows * _PANEL + _AROUND, draw))
    return found


def _draw_coordinate(
    figure: Figure,
    *,
    solution: Solution,
    quantity: str,
    bodies: Sequence[str],
    columns: int,
    cut: float | None,
    index_base: int,
) -> None:
    panels = _grid(figure, len(bodies), columns)
    for panel, body in zip(panels, bodies, strict=True):
        positions(solution, body, quantity, ax=panel, cut=cut, index_base=index_base)
    _label_lowest(panels, columns)


def of_body(solution: Solution, body: str, file: str, cut: float | None, index_base: int) -> Page:
    """Velocities of a body to the left, accelerations to the right."""
    draw = partial(_draw_body, solution, body, cut, index_base)
    rows = solution.compiled.bodies[body].count
    return Page(0, file, body, rows * _PANEL + _AROUND, draw)


def _draw_body(
    solution: Solution, body: str, cut: float | None, index_base: int, figure: Figure
) -> None:
    count = solution.compiled.bodies[body].count
    panels = _grid(figure, 2 * count, 2)
    common: dict[str, Any] = {"cut": cut, "index_base": index_base}
    for k, (rate, acceleration) in enumerate(
        zip(RATES[:count], ACCELERATIONS[:count], strict=True)
    ):
        velocities(solution, body, rate, ax=panels[2 * k], **common)
        accelerations(solution, body, acceleration, ax=panels[2 * k + 1], **common)
    for panel in panels:
        panel.set_title("", loc="left")
    title = body_title(solution.compiled.bodies[body], index_base)
    panels[0].set_title(f"{title}: velocity", loc="left")
    panels[1].set_title("acceleration", loc="left")
    _label_lowest(panels, 2)


def only_turns(solution: Solution, force: str) -> bool:
    """Whether a force element exerts only torques."""
    view = solution.force(force)
    return not view.force(on=view.info.j).any()


def of_torque(solution: Solution, force: str, file: str, cut: float | None) -> Page:
    """Torque of a force element on its body j, in parts."""

    def draw(figure: Figure) -> None:
        torques(solution, force, ax=figure.add_subplot(), cut=cut)

    return Page(0, f"torque_{file}", f"torque_{force}", style.HEIGHT, draw)


def of_reactions(solution: Solution, joint: str, file: str, cut: float | None) -> Page:
    """Reactions of a joint on both bodies, in the global frame and in its own."""
    view = solution.constraint(joint)
    # A driver of a coordinate acts on one body only.
    both = dict.fromkeys((view.info.i, view.info.j))
    bodies = [on for on in both if view.force(on=on).any() or view.torque(on=on).any()]
    forces: list[dict[str, Any]] = [
        {"on": body, "frame": frame} for body in bodies or both for frame in ("global", "joint")
    ]
    moments: list[dict[str, Any]] = [
        {"on": body, "quantity": "torque"} for body in bodies if view.torque(on=body).any()
    ]
    if moments and not any(view.force(on=body).any() for body in bodies):
        forces = []
    columns = 2 if forces else len(moments)
    rows = math.ceil((len(forces) + len(moments)) / columns)
    draw = partial(
        _draw_reactions,
        solution=solution,
        joint=joint,
        wanted=(forces, moments),
        columns=columns,
        cut=cut,
    )
    height = rows * 1.25 * _PANEL + _AROUND
    return Page(0, f"reactions_{file}", f"reactions_{joint}", height, draw)


def _draw_reactions(
    figure: Figure,
    *,
    solution: Solution,
    joint: str,
    wanted: tuple[Sequence[dict[str, Any]], Sequence[dict[str, Any]]],
    columns: int,
    cut: float | None,
) -> None:
    forces, moments = wanted
    panels = _grid(figure, len(forces) + len(moments), columns)
    for panel, what in zip(panels, [*forces, *moments], strict=True):
        reactions(solution, joint, ax=panel, cut=cut, legend=False, **what)
        frame = f", {what['frame']} frame" if "frame" in what else ""
        panel.set_title(f"{_beside(joint, what['on'])}{frame}", loc="left")
    if forces:
        _share_limits(panels[: len(forces)])
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper right", ncols=len(labels))
    _label_lowest(panels, columns)


def _beside(joint: str, body: str) -> str:
    """A title for a panel of half the width of a page."""
    longest = style.LONGEST_NAME if len(joint) + len(body) <= 18 else 8
    return f"{style.short(joint, longest)} on {style.short(body, longest)}"


def of_residual(solution: Solution, cut: float | None) -> Page:
    """By how much the constraints are not met."""

    def draw(figure: Figure) -> None:
        residual(solution, ax=figure.add_subplot(), cut=cut)

    return Page(0, "residual", "residual", style.HEIGHT, draw)


def of_energy(solution: Solution, cut: float | None) -> Page:
    """The parts of the energy, and below them the error of the balance."""

    def draw(figure: Figure) -> None:
        upper, lower = figure.subplots(2, 1, height_ratios=[3, 2])
        energy(solution, ax=upper, cut=cut)
        energy_balance(solution, ax=lower, cut=cut)
        _label_lowest([upper, lower], 1)

    return Page(0, "energy", "energy", 120.0, draw)


def of_all_reactions(solution: Solution, cut: float | None) -> Page:
    """Magnitudes of the reactions at all joints."""

    def draw(figure: Figure) -> None:
        all_reactions(solution, ax=figure.add_subplot(), cut=cut)

    return Page(0, "reactions", "reactions", style.HEIGHT + 10.0, draw)


def _grid(figure: Figure, count: int, columns: int) -> list[Axes]:
    """So many panels, row by row."""
    rows = math.ceil(count / columns)
    grid = figure.add_gridspec(rows, columns)
    return [figure.add_subplot(grid[divmod(k, columns)]) for k in range(count)]


def _share_limits(panels: Sequence[Axes]) -> None:
    """The same range in all panels, so that they compare."""
    ranges = [panel.get_ylim() for panel in panels]
    for panel in panels:
        panel.set_ylim(min(low for low, _ in ranges), max(high for _, high in ranges))


def _label_lowest(panels: Sequence[Axes], columns: int) -> None:
    """Write times only below the lowest panel of each column."""
    for panel in panels[:-columns]:
        panel.set_xlabel("")
        panel.tick_params(labelbottom=False)
    figure = panels[0].figure
    figure.align_ylabels(panels)
