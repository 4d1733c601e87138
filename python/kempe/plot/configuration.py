"""The configuration of the mechanism at one time, bodies numbered and joints named."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.base.display_units import display
from kempe.draw.scene import scene
from kempe.draw.units import number
from kempe.plot import style
from kempe.plot.picture import drawn, paint
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.results.state import State


def configuration(
    solution_or_state: Solution | State,
    t: float | None = None,
    *,
    ax: Axes | None = None,
    index_base: int = 1,
) -> Axes:
    """Draw the positions of all bodies, with numbers and names.

    Args:
        solution_or_state: the solution or the state.
        t: the time within a solution, s; the first time when None.
        ax: where to; a figure of its own when None.
        index_base: number of the first body.

    Raises:
        ModelError: the time is outside of the solution.
    """
    state = state_at(solution_or_state, t)
    with style.on(ax) as axes:
        made = drawn(axes, scene(state), instant(state))
        made.number_bodies(index_base, names=True)
        made.name_joints()
        paint(axes, made)
        return axes


def instant(state: State) -> str:
    """The time of a state, or the value of its driven quantity, such as ``crank.angle = 30°``."""
    of = state.variable
    if of.is_time:
        return f"t = {number(float(state.t), 6)} s"
    shown = display(of.unit, "deg") if of.unit == "rad" else display(of.unit)
    gap = "" if shown.symbol == "°" else " "
    value = number(float(state.t) / shown.divisor, 6)
    return f"{style.verbatim(of.name)} = {value}{gap}{shown.symbol}"


def state_at(solution_or_state: Solution | State, t: float | None) -> State:
    """A given state, or the state of a solution at a time, by default the first time."""
    if not isinstance(solution_or_state, Solution):
        return solution_or_state
    for state in (solution_or_state.initial, solution_or_state.final):
        if t is None or t == float(state.t):
            return state
    found: State = solution_or_state(t)  # type: ignore[arg-type, assignment]
    return found
