"""The figure of a fit: data, model, and what remains between them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.base.display_units import Shown, display
from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.page import Page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.sweeps.fits import Fit

#: Height of the panels of a quantity, mm, and most quantities in a figure.
_HEIGHT, _MOST = 68.0, 4
#: Instants of the curve of the model.
_INSTANTS = 600


def fit(result: Fit) -> Figure:
    """Draw the data, the model and the residuals of each quantity.

    Args:
        result: the result of ``kp.fit``.

    Returns:
        The figure, without a window.
    """
    from kempe.sweeps.fits import Fit

    instance(result, Fit, "a fit, as kp.fit returns")
    names = list(result.residuals)[:_MOST]
    with style.applied():
        made = style.figure(_HEIGHT * len(names))
        rows = made.subplots(
            2 * len(names), 1, squeeze=False, sharex=True, height_ratios=[3, 1] * len(names)
        )[:, 0]
        for k, name in enumerate(names):
            _quantity(rows[2 * k], rows[2 * k + 1], result, name)
        of = result._experiments[0].plan.case.analyses[result._experiments[0].plan.analysis]
        over = of.get("over")
        unit = _shown("s" if over is None else result._experiments[0].unit_of_t)
        rows[-1].set_xlabel(f"{'time t' if over is None else style.short(over)} / {unit.symbol}")
        rows[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4)
    return made


def _quantity(above: Axes, below: Axes, result: Fit, name: str) -> None:
    """The panels of a quantity: values, and residuals with two standard deviations."""
    unit = _shown(result.units[name])
    values = np.array(list(result.values.values()))
    begin = 0
    for k, one in enumerate(result._experiments):
        if name not in one.data.values:
            continue
        t, data = one.data.t[name], one.data.values[name]
        of_t = _shown(one.unit_of_t).divisor
        colour, mark = style.COLOURS[k % len(style.COLOURS)], f" {k + 1}"
        mark = mark if len(result._experiments) > 1 else ""
        above.plot(
            t / of_t, data / unit.divisor, ".", color=colour, markersize=3.0, label=f"data{mark}"
        )
        fine = np.linspace(t[0], t[-1], _INSTANTS)
        curve = one.curve(values, name, fine)
        above.plot(
            fine / of_t,
            curve / unit.divisor,
            color="black",
            linewidth=0.9,
            label="model" if begin == 0 else None,
        )
        apart = result.residuals[name][begin : begin + len(t)]
        below.plot(t / of_t, apart / unit.divisor, ".", color=colour, markersize=3.0)
        begin += len(t)
    spread = 2.0 * np.max(result.sigma[name]) / unit.divisor  # of the least certain experiment
    if np.isfinite(spread):
        below.axhspan(-spread, spread, color=style.QUIET, zorder=0)
    below.axhline(0.0, color="black", linewidth=0.7)
    symbol = unit.symbol or "1"
    above.set_ylabel(f"{style.short(name, 30)} / {symbol}")
    below.set_ylabel(f"residual / {symbol}")


def _shown(unit: str) -> Shown:
    """The display unit; degrees for angles, as in other figures."""
    return display(unit, "deg" if unit == "rad" else None)


def fit_pages(result: Fit) -> list[Page]:
    """The figure that ``kempe fit`` writes."""
    return [Page(0, "fit", "fit", lambda: fit(result), key=True)]
