"""How far the joints open, drawn on the linkage and magnified so that it can be seen."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from kempe.arrays import Floats
from kempe.plot import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.solution import Solution
    from kempe.state import State
    from kempe.studies import Study

#: The largest gap is drawn about this long, as a share of the drawing.
LENGTH = 0.15


def gaps(study: Study, ax: Axes) -> None:
    """The linkage where the joints of the classical weak stabilization are widest open.

    Each joint has an arrow from its point on body i to its point on body j, magnified by the factor
    in the title.
    """
    chosen = [
        o
        for o in study.group("stabilization")
        if o.solution is not None
        and not o.diverged
        and (o.variant.alpha, o.variant.beta) == (1, 20)
    ]
    if not chosen or chosen[0].solution is None:
        ax.set_title("no variant to draw")
        return
    outcome, solution = chosen[0], chosen[0].solution
    state = state_at(solution, int(solution.drift.position.argmax()))
    drawn = [outline(state, name) for name in state.model.bodies]
    corners = np.vstack(drawn)
    size = float(max(corners.max(axis=0) - corners.min(axis=0))) or 1.0
    begin, along = joint_gaps(state)
    factor = magnification(float(np.hypot(*along.T).max(initial=0.0)), size)
    for info, line in zip(state.model.bodies.values(), drawn, strict=True):
        ax.plot(*line.T, color=style.colour(info.number), linewidth=2.0)
    ax.plot(*begin.T, "o", color="black", markerfacecolor="white", markersize=5)
    for name, point, gap in zip(state.model.joints, begin, along, strict=True):
        end = point + factor * gap
        ax.annotate("", end, point, arrowprops={"arrowstyle": "->", "color": "#CC0000", "lw": 1.5})
        told = style.verbatim(f"{name}: {1e3 * float(np.hypot(*gap)):.3g} mm")
        ax.annotate(told, point, xytext=(8, -16), textcoords="offset points", fontsize=9)
        ax.update_datalim([end])
    ax.set_aspect("equal", adjustable="datalim")
    ax.margins(0.15)
    ax.set_xlabel("x / m")
    ax.set_ylabel("y / m")
    when = f"t = {float(state.t):.3g} s, gaps magnified {factor:g} times"
    ax.set_title(style.verbatim(f"{outcome.variant.name}\n{when}"), fontsize=10)


def joint_gaps(state: State) -> tuple[Floats, Floats]:
    """Points of the joints on body i, and from there to the points on body j, (n, 2) each, m.

    Along a slide the points may be apart; only what the joint forbids counts as its gap.
    """
    begin, along = [], []
    for info in state.model.joints.values():
        at_i = state.body(info.i).at(info.point_i).position
        gap = state.body(info.j).at(info.point_j).position - at_i
        units = [unit for _, unit in info.equations]
        if units.count("m") < 2:  # a slide: the normal distance is Φ itself
            gap = _across(gap, float(state.constraint(info.name).residual[0]))
        begin.append(at_i)
        along.append(gap)
    return np.array(begin).reshape(-1, 2), np.array(along).reshape(-1, 2)


def _across(apart: Floats, normal: float) -> Floats:
    """The part of a distance that is normal to the slide, from its known length."""
    length = float(np.hypot(*apart))
    if length <= abs(normal):
        return apart
    sine = normal / length
    cosine = math.sqrt(1.0 - sine**2)
    direction = np.array([[cosine, sine], [-sine, cosine]]) @ (apart / length)
    return normal * np.array([-direction[1], direction[0]])


def magnification(largest: float, size: float) -> float:
    """1, 2 or 5 times a power of ten that brings the largest gap to a visible length."""
    if largest <= 0.0 or not math.isfinite(largest):
        return 1.0
    wanted = LENGTH * size / largest
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(factor * power for factor in (1.0, 2.0, 5.0) if factor * power <= wanted)


def state_at(solution: Solution, k: int) -> State:
    """The k-th output as a state."""
    from kempe.state import State

    return State(solution.model, float(solution.t[k]), solution.q[k], solution.v[k])


def outline(state: State, name: str) -> Floats:
    """The corners of a body, closed where there are more than two, (n, 2), m."""
    body = state.body(name)
    names = list(state.model.bodies[name].points)
    corners = [body.point(point).position for point in names] or [body.r]
    return np.array([*corners, corners[0]] if len(corners) > 2 else corners)
