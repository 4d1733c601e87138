"""The figures over time on pages: panels side by side and one below the other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING

from kempe.draw.units import Scale
from kempe.model.compiled import ACCELERATIONS, COORDINATES, RATES
from kempe.plot import style
from kempe.plot.body_motion import QUANTITIES, body_panel, body_title
from kempe.plot.energy import energy, energy_balance
from kempe.plot.grid import Sheet, sheet_figure
from kempe.plot.measures import measure
from kempe.plot.page import Page
from kempe.plot.panel import Curve, Panel, times
from kempe.plot.reactions import all_reactions, force_panel
from kempe.plot.reactions import torque_panel as reaction_torque
from kempe.plot.residual import residual
from kempe.plot.still import drawn_and_left_out, largest_values
from kempe.plot.time_axis import transient
from kempe.plot.torques import torque_panel
from kempe.results.fine import fine
from kempe.results.remarks import unbounded_at, when

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kempe.results.solution import Solution

#: Largest number of panels on a page.
_MOST_PANELS = 12
#: Largest number of curves of the key figure of reactions.
_MOST_REACTIONS = 6
#: Largest number of lines that can be distinguished.
_MOST_BODIES = 24


@dataclass(frozen=True)
class TimePages:
    """The pages of a solution over time.

    Attributes:
        solution: the solution.
        length: unit of lengths in the drawings.
        cut: time after which the time axis is compressed, s; never when None.
        index_base: number of the first body.
    """

    solution: Solution
    length: Scale
    cut: float | None
    index_base: int

    @cached_property
    def _largest(self) -> dict[str, float]:
        return largest_values(self.solution)

    def of_coordinate(self, quantity: str) -> list[Page]:
        """One coordinate of all bodies, a panel for each; more pages for many bodies."""
        found = self.solution.compiled.named_bodies.items()
        bodies = [name for name, info in found if quantity in info.quantities]
        count = math.ceil(len(bodies) / _MOST_PANELS)
        pages = []
        for k in range(count):
            some = bodies[k * len(bodies) // count : (k + 1) * len(bodies) // count]
            name = quantity if count == 1 else f"{quantity}_{k + 1}"
            pages.append(Page(0, name, name, partial(self._coordinate, quantity, some)))
        return pages

    def _coordinate(self, quantity: str, bodies: Sequence[str]) -> Figure:
        panels = [body_panel(self.solution, name, quantity, self.index_base) for name in bodies]
        return self._figure(panels)

    def of_body(self, body: str, file: str) -> Page:
        """Velocities and accelerations of a body side by side."""
        return Page(0, file, body, partial(self._body, body))

    def _body(self, body: str) -> Figure:
        info = self.solution.compiled.bodies[body]
        pairs = zip(RATES[: info.count], ACCELERATIONS[: info.count], strict=True)
        quantities = [quantity for pair in pairs for quantity in pair]
        panels = [body_panel(self.solution, body, one, self.index_base) for one in quantities]
        title = body_title(info, self.index_base)
        named = [replace(panel, title="", name=panel.symbol) for panel in panels]
        return self._figure(named, columns=2, title=f"{title}: velocity and acceleration")

    def of_torque(self, force: str, file: str) -> Page:
        """Torque of a force element on its body j, in parts."""
        return Page(0, f"torque_{file}", f"torque_{force}", partial(self._torque, force))

    def _torque(self, force: str) -> Figure:
        return self._figure([torque_panel(self.solution, force)])

    def of_reactions(self, joint: str, file: str) -> Page:
        """Reactions of a joint on both bodies, in the global frame and in its own."""
        draw = partial(self._reactions, joint)
        return Page(0, f"reactions_{file}", f"reactions_{joint}", draw)

    def _reactions(self, joint: str) -> Figure:
        info = self.solution.constraint(joint).info
        bodies = dict.fromkeys((info.i, info.j))  # a driver of a coordinate acts on one body only
        forces = [
            force_panel(self.solution, joint, body, frame, remarked=False)
            for body in bodies
            for frame in ("global", "joint")
        ]
        torques = [reaction_torque(self.solution, joint, body, remarked=False) for body in bodies]
        if not any(panel.peak for panel in torques):  # a pin has none by its nature
            torques = []
        elif not any(panel.peak for panel in forces):
            forces = []
        of, told = f"The reactions of {joint} are", ""
        if choice := self.solution.constraint(joint).choice:
            told += f"{of} not unique: {choice}. "
        if passed := unbounded_at(self.solution, joint):
            told += f"{of} without bound {when(passed, self.solution.variable)}. "
        panels = [*forces, *torques]
        return self._figure(panels, columns=2, shared=True, legend=bool(forces), before=told)

    def _figure(
        self,
        panels: Sequence[Panel],
        columns: int | None = None,
        *,
        title: str = "",
        shared: bool = False,
        legend: bool = False,
        before: str = "",
    ) -> Figure:
        fixed = {"m": self.length}
        kept, note = drawn_and_left_out(panels, self._largest, fixed)
        note = before + note
        if title and kept:
            kept = [replace(kept[0], title=title), *kept[1:]]
        elif title:
            note = f"{title}. {note}"
        count = columns or (1 if len(kept) <= 4 else 2)
        sheet = Sheet(kept, min(count, max(len(kept), 1)), note, shared, legend)
        return sheet_figure(sheet, times(self.solution), self.cut, fixed)

    def of_motion(self) -> Page:
        """x, y and angle of all bodies, a line for each."""
        return Page(0, "motion", "motion", self._motion)

    def _motion(self) -> Figure:
        known = list(self.solution.compiled.named_bodies)
        panels = [self._together(quantity, known[:_MOST_BODIES]) for quantity in COORDINATES]
        few = f" of the first {_MOST_BODIES} of {len(known)} bodies" if known[_MOST_BODIES:] else ""
        return self._figure(
            [panel for panel in panels if panel.curves],
            columns=1,
            title=f"Motion{few}",
            legend=True,
        )

    def _together(self, quantity: str, bodies: Sequence[str]) -> Panel:
        """One coordinate of several bodies, without marked peaks."""
        infos = [self.solution.compiled.bodies[name] for name in bodies]
        curves = [
            Curve(
                body_title(info, self.index_base),
                getattr(fine(self.solution).body(info.name), quantity),
                style.line(info.number - 1),
            )
            for info in infos
            if quantity in info.quantities
        ]
        symbol, unit = QUANTITIES[quantity]
        unit = self.solution.variable.rate(unit)
        return Panel(symbol, unit, curves, name=symbol, variable=self.solution.variable)

    def of_measure(self, name: str, file: str) -> Page:
        """A measure over time."""
        return Page(0, f"measure_{file}", f"measure_{name}", partial(self._measure, name))

    def _measure(self, name: str) -> Figure:
        figure = style.figure(style.HEIGHT, layout=None)
        axes = style.axes_at(figure, (19.0, 11.0, 137.0, 55.0), style.HEIGHT)
        measure(self.solution, name, ax=axes, cut=self.cut)
        return figure

    def of_residual(self) -> Page:
        """The residual of the constraints."""

        def draw() -> Figure:
            figure = style.figure(style.HEIGHT, layout=None)
            axes = style.axes_at(figure, (19.0, 11.0, 137.0, 55.0), style.HEIGHT)
            residual(self.solution, ax=axes, cut=self.cut)
            return figure

        return Page(0, "residual", "residual", draw)

    def of_energy(self) -> Page:
        """The parts of the energy, and below them the error of the balance."""

        def draw() -> Figure:
            height = 118.0
            figure = style.figure(height, layout=None)
            upper = style.axes_at(figure, (19.0, 55.0, 137.0, 55.0), height)
            lower = style.axes_at(figure, (19.0, 11.0, 137.0, 33.0), height)
            energy(self.solution, ax=upper, cut=self.cut)
            energy_balance(self.solution, ax=lower, cut=self.cut)
            upper.set_xlabel("")
            upper.tick_params(labelbottom=False)
            return figure

        return Page(0, "energy", "energy", draw)

    def of_all_reactions(self) -> Page:
        """Magnitudes of the reactions at all joints."""

        def draw() -> Figure:
            figure = style.figure(style.HEIGHT + 10.0)
            cut = transient(self.solution) if self.cut is None else self.cut
            axes = figure.add_subplot()
            all_reactions(self.solution, ax=axes, cut=cut, most=_MOST_REACTIONS)
            return figure

        return Page(0, "reactions", "reactions", draw)


def only_turns(solution: Solution, force: str) -> bool:
    """Whether a force element exerts only torques."""
    view = solution.force(force)
    return not view.force(on=view.info.j).any()
