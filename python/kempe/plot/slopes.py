"""The figure of slopes over time: a quantity, and how far each variable moves it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.display_units import Shown, display
from kempe.draw.units import scale
from kempe.errors import ModelError
from kempe.model.measure_infos import measure_info
from kempe.model.values import instance, texts
from kempe.plot import style
from kempe.results.quantities import values_of
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Height of a panel, mm, and most panels of a figure.
_HEIGHT, _MOST = 48.0, 6


def slopes(
    solution: Solution, name: str, variables: Sequence[str] | None = None, *, change: float = 0.01
) -> Figure:
    """Draw a quantity over time with the band that a change of each variable gives.

    Args:
        solution: a run with ``slopes=``.
        name: a quantity such as ``"C.force"``, or a measure.
        variables: some variables of the slopes, a panel for each; the first six by default.
        change: relative change of each variable; the change itself of a variable that is zero.

    Returns:
        The figure, without a window.

    Raises:
        ModelError: the run has no slopes, or not these; there is no such quantity.
        NoSlopesError: a derivative does not exist.
    """
    instance(solution, Solution, "a solution, as kp.dynamics(…, slopes=[…]) returns")
    given = solution.variables_of_slopes
    if not given:
        raise ModelError(
            "the run has no slopes", hint='pass slopes=["L2"] to kp.dynamics or kp.kinematics'
        )
    names = list(given)[:_MOST] if variables is None else texts(variables, "variables")
    if not 1 <= len(names) <= _MOST:
        raise ModelError(f"variables: {len(names)}; from 1 to {_MOST} fit in a figure")
    bands = [solution.slope(name, variable) for variable in names]
    known = solution.compiled.measures.get(name) or measure_info(solution.compiled, name)
    values, of_t = values_of(solution, known), _shown(solution.variable.unit)
    unit = scale(known.unit, float(np.max(np.abs(values), initial=0.0)))
    values = values / unit.divisor
    with style.applied():
        made = style.figure(_HEIGHT * len(names))
        panels = made.subplots(len(names), 1, squeeze=False, sharex=True)[:, 0]
        t = np.asarray(solution.t) / of_t.divisor
        for axes, variable, band in zip(panels, names, bands, strict=True):
            size = change * (abs(given[variable]) or 1.0)
            half = size * band / unit.divisor
            axes.fill_between(
                t, values - half, values + half, color=style.COLOURS[1], alpha=0.35, linewidth=0.0
            )
            axes.plot(t, values, **style.line(0))
            by = f"{100 * change:g} %" if given[variable] else f"{change:g}"
            axes.set_title(f"with ± {by} of {style.short(variable)}")
            axes.set_ylabel(unit.axis(style.short(name, 16)))
            axes.margins(x=0.0)
        over = solution.variable.name
        panels[-1].set_xlabel(f"{'time t' if over == 't' else style.short(over)} / {of_t.symbol}")
    return made


def _shown(unit: str) -> Shown:
    """The display unit; degrees for angles, as in other figures."""
    return display(unit, "deg" if unit == "rad" else None)
