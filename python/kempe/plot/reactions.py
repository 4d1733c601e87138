"""Reactions at joints and drivers over time."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.names import one_of
from kempe.draw.units import Scale, scale
from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.curves import draw
from kempe.plot.panel import Curve, Panel, curve, times
from kempe.plot.peaks import peak_text
from kempe.plot.remarked import NO_BOUND, note
from kempe.plot.still import NOTHING
from kempe.plot.time_axis import TimeAxis
from kempe.results.extrema import Extreme
from kempe.results.motion import Motion
from kempe.results.remarks import remark, unbounded_at

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.base.arrays import Floats
    from kempe.results.views.frames import ReactionFrame

#: Symbols of the axes in each frame: x″ is the axis of the joint, x′ the axis of the body.
_PRIMES = {"global": "", "body": "′", "joint": "″"}
#: Largest number of peaks in a legend.
_MOST_PEAKS = 16


def reactions(
    motion: Motion,
    joint: str,
    *,
    on: str | None = None,
    frame: ReactionFrame = "global",
    quantity: str = "force",
    ax: Axes | None = None,
    cut: float | None = None,
    legend: bool = True,
) -> Axes:
    """Draw the force of a joint on a body, in components and magnitude, or its torque.

    Args:
        motion: a solution, drawn on its interpolant, or the motion at some times.
        joint: name of the joint or driver.
        on: the body; its body j when None.
        frame: "global", "body", "joint" (Haug 6.6.8), "i", "j" or "radial", where x is along the
            radius and y to its left; see ``ConstraintView.reaction``.
        quantity: "force" or "torque".
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
        legend: whether to write one.

    Raises:
        ModelError: there is no such joint, body, frame or quantity.
    """
    instance(motion, Motion, "a solution or a motion")
    body = motion.constraint(joint).info.j if on is None else on
    one_of("quantity", quantity, ("force", "torque"))
    if quantity == "torque":
        panel = torque_panel(motion, joint, body)
    else:
        panel = force_panel(motion, joint, body, frame)
    with style.on(ax) as axes:
        draw(axes, times(motion), replace(panel, legend=legend), cut=cut)
        return axes


def force_panel(
    motion: Motion, joint: str, body: str, frame: ReactionFrame, *, remarked: bool = True
) -> Panel:
    """Components and magnitude of the force of a joint on a body in a frame.

    ``remarked``: whether the title says that it is not unique, and where it has no bound.
    """

    def force(at: Motion) -> Floats:
        return at.constraint(joint).force(on=body, frame=frame)

    prime = _PRIMES.get(frame, "")
    dotted = {**style.SUM, "linestyle": ":", "linewidth": 1.1}
    curves = [
        curve(motion, f"$F_{{x{prime}}}$", lambda at: force(at)[..., 0], style.line(0)),
        curve(motion, f"$F_{{y{prime}}}$", lambda at: force(at)[..., 1], style.line(1)),
        curve(motion, "|F|", lambda at: np.hypot(*force(at).T), dotted),
    ]
    title = f"{_beside(joint, body)}, {frame} frame"
    panel = Panel("F", "N", curves, title, title, variable=motion.variable)
    return _remarked(panel, motion, joint, "force") if remarked else panel


def torque_panel(motion: Motion, joint: str, body: str, *, remarked: bool = True) -> Panel:
    """Torque of a joint on a body about the joint point; ``remarked`` as for a force."""
    line = curve(motion, "T", lambda at: at.constraint(joint).torque(on=body), style.SUM)
    title = _beside(joint, body)
    panel = Panel("T", "N·m", [line], title, f"torque of {title}", variable=motion.variable)
    return _remarked(panel, motion, joint, "torque") if remarked else panel


def _remarked(panel: Panel, motion: Motion, joint: str, part: str) -> Panel:
    """A panel with the remarks on the force or torque of a joint."""
    title = panel.title + remark(motion.constraint(joint).choice)
    below = note(unbounded_at(motion, joint, [part]), motion.variable)
    return replace(panel, title=title, note=below)


def _peak(high: Extreme, most: float, unit: Scale, time: Scale) -> str:
    """The largest value of a reaction; zero if it is a rounding error of the largest of all."""
    return unit.written(0.0) if high.value <= NOTHING * most else peak_text(high, unit, time)


def _beside(joint: str, body: str) -> str:
    """A title for a panel of half the width of a page."""
    longest = style.LONGEST_NAME if len(joint) + len(body) <= 18 else 8
    return f"{style.short(joint, longest)} on {style.short(body, longest)}"


def _magnitude(joint: str, at: Motion) -> Floats:
    """Magnitude of the force of a joint on its body j."""
    view = at.constraint(joint)
    found: Floats = np.hypot(*view.force(on=view.info.j).T)
    return found


def all_reactions(
    motion: Motion,
    *,
    ax: Axes | None = None,
    cut: float | None = None,
    most: int | None = None,
) -> Axes:
    """Draw the magnitude of the force of every joint and driver that exerts a force.

    The legend gives the largest magnitudes with their times. A dagger marks forces that have no
    bound beside singular positions; the line below the title gives the times of these positions.

    Args:
        motion: a solution, drawn on its interpolant, or the motion at some times.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
        most: largest number of curves, those with the largest peaks; all when None.
    """
    instance(motion, Motion, "a solution or a motion")
    found: list[tuple[Curve, tuple[float, ...]]] = []
    for name in motion.compiled.constraints:
        label = f"{style.short(name)}{remark(motion.constraint(name).choice)}"
        one = curve(motion, label, partial(_magnitude, name), style.line(len(found)))
        if name in motion.compiled.joints or one.values.any():
            times_of = tuple(unbounded_at(motion, name, ["force"]))
            found.append(
                (replace(one, label=f"{label}{f' {NO_BOUND}' if times_of else ''}"), times_of)
            )
    of, title = motion.variable, "Reactions"
    if most is not None and len(found) > most:
        title = f"The {most} largest of {len(found)} reactions"
        places = sorted(range(len(found)), key=lambda k: found[k][0].span[1], reverse=True)
        found = [found[k] for k in sorted(places[:most])]
    curves = [replace(one, line=style.line(k)) for k, (one, _) in enumerate(found)]
    poles = {time for _, times_of in found for time in times_of}
    told = note(sorted(poles), of)
    below = f"{NO_BOUND} {told}" if poles else told
    panel = Panel("|F|", "N", curves, title, "reactions", variable=of, note=below)
    unit, time = scale("N", panel.peak), TimeAxis.of(times(motion), None, of).unit
    with_peaks = [
        replace(one, label=f"{one.label}: {_peak(one.high, panel.peak, unit, time)}")
        if one.high is not None and len(curves) <= _MOST_PEAKS
        else one
        for one in curves
    ]
    with style.on(ax) as axes:
        shown = [replace(one, marked=False) for one in with_peaks]
        draw(axes, times(motion), replace(panel, curves=shown, legend=True), cut=cut)
        return axes
