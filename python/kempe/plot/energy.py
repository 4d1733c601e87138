"""The parts of the energy over time, and the error of the energy balance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.curves import draw, finish
from kempe.plot.envelope import draw_envelope, envelope, logarithmic
from kempe.plot.panel import Curve, Panel
from kempe.plot.time_axis import TimeAxis
from kempe.results.fine import fine_energies
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def energy(solution: Solution, *, ax: Axes | None = None, cut: float | None = None) -> Axes:
    """Draw kinetic, potential and dissipated energy, work, and T + V + dissipated - work.

    Dissipated energy and work are left out where they are zero.

    Args:
        solution: the solution, drawn on its interpolant.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
    """
    instance(solution, Solution, "a solution")
    t, found = fine_energies(solution)
    curves = [
        Curve("kinetic T", found.kinetic, style.line(0)),
        Curve("potential V", found.potential, style.line(1)),
        Curve("dissipated D", found.dissipated, style.line(2)),
        Curve("work W", found.work, style.line(3)),
        Curve("T + V + D − W", found.total, style.SUM),
    ]
    acting = [one for one in curves if one.values.any()] or curves[:1]
    with style.on(ax) as axes:
        draw(axes, t, Panel("E", "J", acting, legend=True, variable=solution.variable), cut=cut)
        return axes


def energy_balance(solution: Solution, *, ax: Axes | None = None, cut: float | None = None) -> Axes:
    """Draw the change of T + V + D - W, relative to the largest energy, as an envelope.

    Args:
        solution: the solution.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
    """
    instance(solution, Solution, "a solution")
    error = np.abs(solution.energy.balance)
    time = TimeAxis.of(solution.t, cut, solution.variable)
    t = solution.t / time.unit.divisor
    with style.on(ax) as axes:
        draw_envelope(axes, t, error, "balance", style.line(0))
        logarithmic(axes, [envelope(t, error)[2]])
        axes.set_ylabel("relative error / 1")
        title = "Energy balance: change of T + V + D − W over the largest energy"
        finish(axes, time, Panel("", "", [], title))
        return axes
