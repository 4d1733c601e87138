"""By how much the constraints are not met, over time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from kempe.arrays import Floats
from kempe.draw.units import Scale, power_of_ten
from kempe.plot import style
from kempe.plot.curves import Curve, Panel, add_lines, finish
from kempe.solution import Solution
from kempe.values import instance

if TYPE_CHECKING:
    from matplotlib.axes import Axes


#: Least value of the axis: the resolution of the numbers.
_LOWEST = 1e-18


def residual(solution: Solution, *, ax: Axes | None = None, cut: float | None = None) -> Axes:
    """Draw the largest |Φ| and the largest |Φ_q q̇ + Φ_t| on a logarithmic axis.

    Args:
        solution: the solution.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
    """
    instance(solution, Solution, "a solution")
    drift = solution.drift
    units = list(dict.fromkeys(solution.compiled.row_units())) or ["m"]
    curves = [
        Curve("position, max |Φ|", drift.position),
        Curve("velocity, max |dΦ/dt|", drift.velocity),
    ]
    with style.on(ax) as axes:
        add_lines(axes, solution.t, curves)
        logarithmic(axes, [curve.values for curve in curves])
        rates = [Scale(1.0, f"{unit}/s").axis("").strip(" /") for unit in units]
        axes.set_ylabel(f"residual / {', '.join([*units, *rates])}")
        finish(axes, solution.t, Panel("", "", "Constraints", cut))
        return axes


def logarithmic(axes: Axes, drawn: list[Floats]) -> None:
    """A logarithmic axis that leaves out zeros; linear where there is nothing else."""
    positive = [values[values > 0.0] for values in drawn]
    lowest = min((float(values.min()) for values in positive if len(values)), default=None)
    if lowest is None:
        return
    highest = max(float(values.max()) for values in positive if len(values))
    # Whole decades, three at least: their numbers are short.
    bottom = math.floor(math.log10(max(lowest, _LOWEST)))
    top = max(math.ceil(math.log10(highest)), bottom + 3)
    axes.set_yscale("log", nonpositive="mask")
    axes.set_ylim(10.0**bottom, 10.0**top)
    step = math.ceil((top - bottom) / 6)
    powers = range(bottom, top + 1, step)
    axes.set_yticks([10.0**power for power in powers], [power_of_ten(power) for power in powers])
    axes.minorticks_off()
