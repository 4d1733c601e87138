"""The drawings of the mechanism on pages of the height that they need."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.draw.scene import scene
from kempe.plot import style
from kempe.plot.configuration import configuration
from kempe.plot.mechanism import mechanism
from kempe.plot.page import Page
from kempe.plot.picture import frame

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kempe.solution import Solution
    from kempe.state import State

#: Margins beside, above and below the axes, mm.
_BESIDE, _ABOVE = 16.0, 18.0
_HIGHEST = 170.0


def of_mechanism(solution: Solution) -> Page:
    """The mechanism with its dimensions."""
    state = solution.initial

    def draw(figure: Figure) -> None:
        mechanism(state, ax=figure.add_subplot())

    return Page(0, "mechanism", "mechanism", _height(state), draw)


def of_configuration(name: str, state: State, index_base: int) -> Page:
    """Where all bodies are at one time."""

    def draw(figure: Figure) -> None:
        axes = configuration(state, ax=figure.add_subplot(), index_base=index_base)
        title = f"{name.capitalize()} configuration, {axes.get_title('left')}"
        axes.set_title(title, loc="left")

    return Page(0, name, name, _height(state), draw)


def _height(state: State) -> float:
    """Height at which the drawing fills the width of the page, within limits, mm."""
    low, high = frame(scene(state))
    width, height = high - low
    return min((style.WIDTH - _BESIDE) * float(height / width) + _ABOVE, _HIGHEST)
