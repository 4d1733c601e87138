"""The figure of a comparison: both courses of some quantities, and what is between them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.display_units import display
from kempe.base.names import one_of
from kempe.model.values import instance, texts
from kempe.plot import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.sweeps.fits import Comparison

#: Height of the panels of a quantity, mm, most quantities in a figure, and most times as points.
_HEIGHT, _MOST, _POINTS = 62.0, 4, 60


def comparison(result: Comparison, quantities: Sequence[str] | None = None) -> Figure:
    """Draw both courses of each quantity, and the difference below.

    Args:
        result: the result of ``kp.compare``.
        quantities: the quantities; by default the four with the largest relative differences.

    Returns:
        The figure, without a window.
    """
    from kempe.sweeps.fits import Comparison

    instance(result, Comparison, "a comparison, as kp.compare returns")
    if quantities is None:
        names = sorted(result.quantities, key=lambda name: -result.relative[name])[:_MOST]
    else:
        names = list(texts(quantities, "quantities"))
    for name in names:
        one_of("quantity of the comparison", name, result.quantities)
    variable = result.solution.variable
    shown = display(variable.unit, "deg" if variable.unit == "rad" else None)
    with style.applied():
        made = style.figure(_HEIGHT * len(names))
        rows = made.subplots(
            2 * len(names), 1, squeeze=False, sharex=True, height_ratios=[3, 1] * len(names)
        )[:, 0]
        for k, name in enumerate(names):
            _quantity((rows[2 * k], rows[2 * k + 1]), result, name, shown.divisor)
        what = "time t" if variable.name == "t" else style.short(variable.name)
        rows[-1].set_xlabel(f"{what} / {shown.symbol}")
        rows[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)
    return made


def _quantity(panels: tuple[Axes, Axes], result: Comparison, name: str, of_t: float) -> None:
    one, (above, below) = result.quantities[name], panels
    unit = display(one.unit, "deg" if one.unit == "rad" else None)
    t, symbol = one.t / of_t, unit.symbol or "1"
    few = len(t) <= _POINTS
    mark = {"marker": ".", "markersize": 3.5, "linestyle": "none"} if few else {"linewidth": 2.2}
    above.plot(t, one.reference / unit.divisor, color=style.COLOURS[0], label="reference", **mark)
    above.plot(t, one.found / unit.divisor, color="black", linewidth=0.9, label="solution")
    below.plot(t, one.difference / unit.divisor, color=style.COLOURS[1], linewidth=0.9)
    below.axhline(0.0, color="black", linewidth=0.7)
    above.set_ylabel(f"{style.short(name, 30)} / {symbol}")
    below.set_ylabel(f"difference / {symbol}")
    if not np.any(one.difference):
        below.set_ylim(-1.0, 1.0)
