"""The parts of the energy over time, and the error of the energy balance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.plot import style
from kempe.plot.curves import Curve, Panel, add_lines, draw, finish
from kempe.plot.residual import logarithmic
from kempe.solution import Solution
from kempe.values import instance

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def energy(solution: Solution, *, ax: Axes | None = None, cut: float | None = None) -> Axes:
    """Draw kinetic, potential and dissipated energy, work, and T + V + dissipated - work.

    Args:
        solution: the solution.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
    """
    instance(solution, Solution, "a solution")
    found = solution.energy
    curves = [
        Curve("kinetic T", found.kinetic, style.line(0)),
        Curve("potential V", found.potential, style.line(1)),
        Curve("dissipated D", found.dissipated, style.line(2)),
        Curve("work W", found.work, style.line(3)),
        Curve("T + V + D − W", found.total, style.SUM),
    ]
    with style.on(ax) as axes:
        draw(axes, solution.t, curves, Panel("E", "J", cut=cut))
        return axes


def energy_balance(solution: Solution, *, ax: Axes | None = None, cut: float | None = None) -> Axes:
    """Draw the change of T + V + D - W, relative to the largest energy.

    Args:
        solution: the solution.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
    """
    instance(solution, Solution, "a solution")
    error = np.abs(solution.energy.balance)
    with style.on(ax) as axes:
        add_lines(axes, solution.t, [Curve("balance", error)])
        logarithmic(axes, [error])
        axes.set_ylabel("relative error / 1")
        finish(
            axes,
            solution.t,
            Panel(
                "",
                "",
                "Energy balance: change of T + V + D − W over the largest energy",
                cut,
                legend=False,
            ),
        )
        return axes
