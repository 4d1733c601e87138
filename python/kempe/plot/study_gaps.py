"""The gaps of the joints, drawn on the linkage at a visible magnification."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.display_units import display
from kempe.draw.items import PIN, arrow_head, fill, line, on_body
from kempe.draw.scene import scene
from kempe.draw.units import number
from kempe.plot import style
from kempe.plot.picture import drawn, paint

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.model.compiled import ConstraintInfo
    from kempe.results.solution import Solution
    from kempe.results.state import State
    from kempe.sweeps.studies import Study

#: Approximate drawn length of the largest gap, as a fraction of the drawing.
LENGTH = 0.25
#: A gap below this fraction of the largest gap is not drawn.
_CLOSED = 1e-3
_WIDTH, _HEAD = 2.2, 10.0  # of an arrow, points


def gaps(study: Study, ax: Axes) -> None:
    """The linkage when the gaps of the joints with the classical weak stabilization are largest.

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
    begin, along = joint_gaps(state)
    shown = scene(state)
    low, high = np.array(shown["bounds"]).reshape(2, 2)
    largest = float(np.hypot(*along.T).max(initial=0.0))
    factor = magnification(largest, float((high - low).max()))
    time, unit = display("s"), display("m", "mm")
    instant = f"t = {number(float(state.t) / time.divisor, 3)} {time.symbol}"
    when = f"{instant}, gaps magnified {factor:g} times"
    made = drawn(ax, shown, style.verbatim(f"{outcome.variant.name}\n{when}"))
    for name, point, gap in zip(state.compiled.joints, begin, along, strict=True):
        length = float(np.hypot(*gap))
        if length <= _CLOSED * largest:
            continue
        angle = float(np.arctan2(gap[1], gap[0]))
        frame = on_body(0, [float(x) for x in point], turn=angle)
        shaft = [[0.0, 0.0, 0.0, 0.0], [factor * length, 0.0, -0.6 * _HEAD, 0.0]]
        head = [[factor * length, 0.0, *at] for at in arrow_head((0.0, 0.0), 0.0, _HEAD)]
        edge = [[factor * length, 0.0, *at] for at in arrow_head((1.5, 0.0), 0.0, _HEAD + 4.0)]
        made.add([line(name, frame, shaft, "paper", _WIDTH + 2.0, layer=PIN)])
        made.add([fill(name, frame, edge, "paper", layer=PIN)])
        made.add([line(name, frame, shaft, "reaction", _WIDTH, layer=PIN)])
        made.add([fill(name, frame, head, "reaction", layer=PIN)])
        made.name("joint", f"{name}: {number(length / unit.divisor, 3)} {unit.symbol}", frame)
    paint(ax, made)


def joint_gaps(state: State) -> tuple[Floats, Floats]:
    """Points of the joints on body i, and from there to the points on body j, (n, 2) each, m.

    The points of a slide may have a distance along it. The gap is only the displacement that the
    joint forbids, from the nearest point of the rail to the point on body j.
    """
    begin, along = [], []
    for info in state.compiled.joints.values():
        at_i = state.body(info.i).at(info.point_i).position
        at_j = state.body(info.j).at(info.point_j).position
        gap = _forbidden(state, info, at_j - at_i)
        begin.append(at_j - gap if _is_slide(info) else at_i)
        along.append(gap)
    return np.array(begin).reshape(-1, 2), np.array(along).reshape(-1, 2)


def _forbidden(state: State, info: ConstraintInfo, apart: Floats) -> Floats:
    """The part of the distance of the joint's points that its equations do not allow."""
    if _is_slide(info):  # across the rail
        angle = float(state.body(info.i).angle) + info.axis_i
        normal = np.array([-np.sin(angle), np.cos(angle)])
        return normal * float(normal @ apart)
    if [name for name, _ in info.equations] == ["length"]:  # Φ = (d² - l²) / 2l gives the length l
        phi, d = float(state.constraint(info.name).residual[0]), float(np.hypot(*apart))
        excess: Floats = (d - (math.hypot(phi, d) - phi)) * apart / (d or 1.0)
        return excess
    return apart


def _is_slide(info: ConstraintInfo) -> bool:
    return any(name == "normal" for name, _ in info.equations)


def magnification(largest: float, size: float) -> float:
    """1, 2 or 5 times a power of ten that brings the largest gap to a visible length."""
    if largest <= 0.0 or not math.isfinite(largest):
        return 1.0
    wanted = LENGTH * size / largest
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(factor * power for factor in (1.0, 2.0, 5.0) if factor * power <= wanted)


def state_at(solution: Solution, k: int) -> State:
    """The k-th output as a state."""
    from kempe.results.state import State

    return State(
        solution.compiled, float(solution.t[k]), solution.q[k], solution.v[k], z=solution.z[k]
    )
