"""The drawings of the mechanism on pages of the height that they need."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.draw.scene import scene
from kempe.draw.units import Scale
from kempe.plot import style
from kempe.plot.configuration import configuration
from kempe.plot.mechanism import mechanism
from kempe.plot.page import Page
from kempe.plot.picture import frame

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.results.solution import Solution
    from kempe.results.state import State

#: Margins around the axes, and their largest height, mm.
_LEFT, _RIGHT, _ABOVE, _BELOW = 19.0, 3.0, 7.0, 11.0
_HIGHEST = 150.0


def of_mechanism(state: State) -> Page:
    """The mechanism with its dimensions."""

    def draw() -> Figure:
        figure, axes = _paper(state)
        mechanism(state, ax=axes)
        return figure

    return Page(0, "mechanism", "mechanism", draw)


def of_configuration(name: str, state: State, index_base: int) -> Page:
    """The positions of all bodies at one time."""

    def draw() -> Figure:
        figure, axes = _paper(state)
        configuration(state, ax=axes, index_base=index_base)
        axes.set_title(f"{name.capitalize()} configuration, {axes.get_title('left')}", loc="left")
        return figure

    return Page(0, name, name, draw)


def unit_of_length(solution: Solution) -> Scale:
    """The unit of lengths in the drawings."""
    unit = scene(solution.initial)["length"]
    return Scale(unit["metres"], unit["unit"])


def _paper(state: State) -> tuple[Figure, Axes]:
    """A figure, and axes in it of the height at which the drawing fills the width, mm."""
    low, high = frame(scene(state))
    width, height = high - low
    wide = style.WIDTH - _LEFT - _RIGHT
    tall = min(wide * float(height / width), _HIGHEST)
    wide = tall * float(width / height)
    made = style.figure(tall + _ABOVE + _BELOW, layout=None)
    return made, style.axes_at(made, (_LEFT, _BELOW, wide, tall), tall + _ABOVE + _BELOW)
