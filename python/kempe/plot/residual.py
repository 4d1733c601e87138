"""The residual of the constraints over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.base.display_units import Shown, display
from kempe.draw.units import axis_label
from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.curves import finish
from kempe.plot.envelope import draw_envelope, envelope, logarithmic
from kempe.plot.panel import Panel
from kempe.plot.time_axis import TimeAxis
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def residual(solution: Solution, *, ax: Axes | None = None, cut: float | None = None) -> Axes:
    """Draw the envelopes of the largest |Φ| and |Φ_q q̇ + Φ_t| on a logarithmic axis.

    The values are in display units if all constraints have the same unit, otherwise in SI units.

    Args:
        solution: the solution.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
    """
    instance(solution, Solution, "a solution")
    drift = solution.drift
    units = list(dict.fromkeys(solution.compiled.row_units())) or ["m"]
    time = TimeAxis.of(solution.t, cut, solution.variable)
    t = solution.t / time.unit.divisor
    shown = [[display(of) for of in (unit, f"{unit}/s")] for unit in units]
    if len(units) > 1:
        shown = [[Shown(unit), Shown(f"{unit}/s")] for unit in units]
    drawn = {
        "position, max |Φ|": drift.position / shown[0][0].divisor,
        "velocity, max |dΦ/dt|": drift.velocity / shown[0][1].divisor,
    }
    with style.on(ax) as axes:
        for k, (label, values) in enumerate(drawn.items()):
            draw_envelope(axes, t, values, label, style.line(k))
        logarithmic(axes, [envelope(t, values)[2] for values in drawn.values()])
        axes.set_ylabel(axis_label("residual", [of[k].symbol for k in (0, 1) for of in shown]))
        finish(axes, time, Panel("", "", [], "Constraints", legend=True))
        return axes
