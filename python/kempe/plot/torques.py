"""Torque of a force element over time: its parts and their sum."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.curves import draw
from kempe.plot.panel import Panel, curve, times
from kempe.plot.remarked import note
from kempe.results.motion import Motion

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.base.arrays import Floats


def torques(
    motion: Motion,
    force: str,
    *,
    on: str | None = None,
    ax: Axes | None = None,
    cut: float | None = None,
) -> Axes:
    """Draw the torque of every part of a force element on a body, and their sum.

    Parts that are zero at all times are left out.

    Args:
        motion: a solution, drawn on its interpolant, or the motion at some times.
        force: name of the element, such as a torsion spring.
        on: the body; its body j when None.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.

    Raises:
        ModelError: there is no such element, or it does not act on that body.
    """
    instance(motion, Motion, "a solution or a motion")
    panel = torque_panel(motion, force, on)
    with style.on(ax) as axes:
        draw(axes, times(motion), panel, cut=cut)
        return axes


def torque_panel(motion: Motion, force: str, on: str | None = None) -> Panel:
    """The torque of a force element on a body, its body j when None."""
    view = motion.force(force)
    body = view.info.j if on is None else on

    def torque(at: Motion, part: str | None) -> Floats:
        return at.force(force).torque(on=body, part=part)

    total = curve(motion, "sum", partial(torque, part=None), style.SUM)
    parts = [
        curve(motion, style.short(part), partial(torque, part=part), style.line(k + 1))
        for k, part in enumerate(view.parts)
    ]
    acting = [part for part in parts if part.values.any()]
    title = f"{style.short(force, 16)} on {style.short(body, 14)}"
    curves = [*acting, total] if len(acting) > 1 else [total]
    named = f"torque of {title}"
    of = motion.variable
    return Panel("T", "N·m", curves, title, named, legend=True, variable=of, note=note((), of))
