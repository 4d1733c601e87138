"""Torque of a force element over time: its parts and their sum."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.motion import Motion
from kempe.plot import style
from kempe.plot.curves import Curve, Panel, draw
from kempe.values import instance

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def torques(
    motion: Motion,
    force: str,
    *,
    on: str | None = None,
    ax: Axes | None = None,
    cut: float | None = None,
) -> Axes:
    """Draw the torque of every part of a force element on a body, and their sum.

    Args:
        motion: a solution, or the motion at some times of it.
        force: name of the element, such as a torsion spring.
        on: the body; its body j when None.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.

    Raises:
        ModelError: there is no such element, or it does not act on that body.
    """
    instance(motion, Motion, "a solution or a motion")
    view = motion.force(force)
    body = view.info.j if on is None else on
    total = Curve("sum", view.torque(on=body), style.SUM)
    parts = [
        Curve(style.short(part), view.torque(on=body, part=part), style.line(k + 1))
        for k, part in enumerate(view.parts)
    ]
    title = f"{style.short(force, 16)} on {style.short(body, 14)}"
    with style.on(ax) as axes:
        curves = [*parts, total] if len(parts) > 1 else [total]
        draw(axes, motion.t, curves, Panel("T", "N·m", title, cut))
        return axes
