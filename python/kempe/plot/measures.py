"""A measure over time, with its mean."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.names import entry
from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.curves import draw
from kempe.plot.panel import Curve, Panel, curve, times
from kempe.plot.remarked import note
from kempe.results.motion import Motion
from kempe.results.quantities import measure_values as values
from kempe.results.remarks import choice_of, measure_unbounded_at, remark

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Units of axes are printed with these signs.
_PRINTED = str.maketrans({"*": "·"})


def measure(motion: Motion, name: str, *, ax: Axes | None = None, cut: float | None = None) -> Axes:
    """Draw a measure over time.

    Args:
        motion: a solution, drawn on its interpolant, or the motion at some times. Measures of
            energies are drawn at the outputs.
        name: name of the measure.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.

    Raises:
        ModelError: there is no such measure.
    """
    instance(motion, Motion, "a solution or a motion")
    info = entry("measure", name, motion.compiled.measures)
    panel = measure_panel(motion, name)
    t = np.atleast_1d(motion.t) if info.is_of_run else times(motion)
    with style.on(ax) as axes:
        draw(axes, t, panel, cut=cut)
        return axes


def measure_panel(motion: Motion, name: str) -> Panel:
    """A measure over time."""
    info = entry("measure", name, motion.compiled.measures)
    if info.is_of_run:
        line = Curve(name, values(motion, name), style.line(0))
    else:
        line = curve(motion, name, partial(values, name=name), style.line(0))
    unit = motion.variable.rate(info.unit).replace("^2", "²").translate(_PRINTED)
    told = remark(choice_of(motion, name))
    title = f"{style.short(name, 24)} = {style.short(info.expression, 60 - len(told))}{told}"
    below = note(measure_unbounded_at(motion, info), motion.variable) if info.solves else ""
    named, of = f"measure {name}", motion.variable
    return Panel(style.short(name, 12), unit, [line], title, named, variable=of, note=below)
