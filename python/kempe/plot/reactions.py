"""Reactions at joints and drivers over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.motion import Motion
from kempe.names import one_of
from kempe.plot import style
from kempe.plot.curves import Curve, Panel, draw
from kempe.values import instance

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.views.frames import Frame

#: How a component is written in each frame: x″ is along the joint's axis, x′ along the body's.
_PRIMES = {"global": "", "body": "′", "joint": "″"}


def reactions(
    motion: Motion,
    joint: str,
    *,
    on: str | None = None,
    frame: Frame = "global",
    quantity: str = "force",
    ax: Axes | None = None,
    cut: float | None = None,
    legend: bool = True,
) -> Axes:
    """Draw the force of a joint on a body, in components and magnitude, or its torque.

    Args:
        motion: a solution, or the motion at some times of it.
        joint: name of the joint or driver.
        on: the body; its body j when None.
        frame: "global", "body" or "joint" (Haug 6.6.8).
        quantity: "force" or "torque".
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
        legend: whether to write one.

    Raises:
        ModelError: there is no such joint, body, frame or quantity.
    """
    instance(motion, Motion, "a solution or a motion")
    view = motion.constraint(joint)
    body = view.info.j if on is None else on
    one_of("quantity", quantity, ("force", "torque"))
    force = view.force(on=body, frame=frame)
    title = f"{style.short(joint)} on {style.short(body)}, {frame} frame"
    with style.on(ax) as axes:
        if quantity == "torque":
            curves = [Curve("T", view.torque(on=body), style.SUM)]
            draw(axes, motion.t, curves, Panel("T", "N·m", title.partition(",")[0], cut, legend))
            return axes
        prime = _PRIMES[frame]
        dotted = {**style.SUM, "linestyle": ":", "linewidth": 1.1}
        curves = [
            Curve(f"$F_{{x{prime}}}$", force[..., 0], style.line(0)),
            Curve(f"$F_{{y{prime}}}$", force[..., 1], style.line(1)),
            Curve("|F|", np.hypot(force[..., 0], force[..., 1]), dotted),
        ]
        draw(axes, motion.t, curves, Panel("F", "N", title, cut, legend))
        return axes


def all_reactions(motion: Motion, *, ax: Axes | None = None, cut: float | None = None) -> Axes:
    """Draw the magnitude of the force of every joint and driver that has one.

    Args:
        motion: a solution, or the motion at some times of it.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
    """
    instance(motion, Motion, "a solution or a motion")
    curves = []
    for name, info in motion.compiled.constraints.items():
        force = motion.constraint(name).force(on=info.j)
        magnitude = np.hypot(force[..., 0], force[..., 1])
        if name in motion.compiled.joints or magnitude.any():
            curves.append(Curve(style.short(name), magnitude))
    with style.on(ax) as axes:
        draw(axes, motion.t, curves, Panel("|F|", "N", "Reactions", cut))
        return axes
