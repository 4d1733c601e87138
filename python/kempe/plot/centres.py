"""The instantaneous centres of all pairs of bodies over the mechanism."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.design.centres import instant_centre
from kempe.design.polygons import state_at
from kempe.draw.items import upright
from kempe.draw.scene import scene
from kempe.errors import ModelError
from kempe.plot import style
from kempe.plot.configuration import instant
from kempe.plot.coupler_curves import over
from kempe.plot.picture import drawn, paint
from kempe.results.solution import Solution
from kempe.results.state import State

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT = 120.0
#: Centres farther than this multiple of the size of the mechanism are named in the title only.
_FAR = 2.5
_LOOK: dict[str, Any] = {
    "color": "#C2184B",
    "markersize": 5.0,
    "markerfacecolor": "white",
    "zorder": 5.0,
}


def instant_centres(
    solution_or_state: Solution | State,
    t: float | None = None,
    *,
    ax: Axes | None = None,
    index_base: int = 1,
) -> Axes:
    """Draw the instantaneous centres of all bodies at an instant.

    The centre of bodies 1 and 2 is P12, ground is 0; bodies are numbered in the drawing. Centres
    far away or at infinity are named in the title.

    Args:
        solution_or_state: a solution or a state.
        t: the instant in a solution, s; its first when None.
        ax: where to; a figure of its own when None.
        index_base: number of the first body.

    Raises:
        ModelError: the instant is not within the solution.
    """
    state = state_at(solution_or_state, t)
    made = scene(state)
    low, high = np.array(made["bounds"]).reshape(2, 2)
    middle, size = (low + high) / 2.0, float((high - low).max()) or 1.0
    near, far = dict[str, Floats](), list[str]()
    for name, place in _centres(state, index_base).items():
        if np.isfinite(place).all() and np.abs(place - middle).max() <= _FAR * size:
            near[name] = place
        else:
            far.append(name)
    made = over(made, np.array([*near.values()] or [middle]))
    with style.on(ax, _HEIGHT) as axes:
        told = f"; far away or at infinity: {', '.join(far)}" if far else ""
        display = drawn(axes, made, f"Instantaneous centres, {instant(state)}{told}")
        display.number_bodies(index_base)
        points, words = _together([*near.values()], [*near], 1e-6 * size)
        for point, word in zip(points, words, strict=True):
            display.name("joint", word, upright(0, [float(x) for x in point]))
        paint(axes, display)
        if points:
            axes.plot(*(np.array(points).T / made["length"]["metres"]), "o", **_LOOK)
        return axes


def _centres(state: State, index_base: int) -> dict[str, Floats]:
    """The centre of each pair of bodies in relative motion."""
    numbers = {
        name: body.shown_number - 1 + index_base if body.number else 0
        for name, body in state.compiled.all_bodies.items()
        if body.is_shown
    }
    found = {}
    for i, j in combinations(numbers, 2):
        try:
            place = np.asarray(instant_centre(state, i, j).position)
        except ModelError:  # at rest against each other
            continue
        comma = "," if max(numbers.values()) > 9 else ""
        found[f"P{numbers[i]}{comma}{numbers[j]}"] = place
    return found


def _together(
    places: list[Floats], names: list[str], near: float
) -> tuple[list[Floats], list[str]]:
    """One text for the centres at one place."""
    points, words = list[Floats](), list[str]()
    for place, name in zip(places, names, strict=True):
        k = next((k for k, at in enumerate(points) if np.hypot(*(at - place)) <= near), None)
        if k is None:
            points.append(place)
            words.append(name)
        else:
            words[k] += f", {name}"
    return points, words
