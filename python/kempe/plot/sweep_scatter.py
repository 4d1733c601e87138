"""All variables and measures of a sweep over each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.display_units import chosen_for
from kempe.draw.units import axis_label
from kempe.errors import ModelError
from kempe.model.values import texts
from kempe.plot import style
from kempe.plot.remarked import NO_BOUND, SIZE, signed
from kempe.plot.sweeps import in_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kempe.sweeps import SweepResult

#: Most columns of a scatter matrix.
_MOST = 6


def sweep_scatter(result: SweepResult, columns: Sequence[str] | None = None) -> Figure:
    """Draw columns over each other, with a histogram of each on the diagonal.

    Only variants that succeeded are drawn.

    Args:
        result: the result of ``kp.sweep``.
        columns: variables and measures; the first six by default.

    Returns:
        The figure, without a window.

    Raises:
        ModelError: there is no such column, or there are more than six.
    """
    names = list(result.columns[:_MOST] if columns is None else texts(columns, "columns"))
    if not 1 <= len(names) <= _MOST:
        raise ModelError(f"columns: {len(names)}; from 1 to {_MOST} fit on a page")
    good = result.succeeded
    data = [in_unit(result, name)[0][good] for name in names]
    logarithmic = {variable.name for variable in result.variables if variable.is_log}
    with style.applied():
        made = style.figure(40.0 + 20.0 * len(names))
        panels = made.subplots(len(names), len(names), sharex="col", squeeze=False)
        for row, up in enumerate(names):
            for column, across in enumerate(names):
                axes = panels[row, column]
                if across in logarithmic:
                    axes.set_xscale("log")
                if row == column:
                    finite = data[row][np.isfinite(data[row])]
                    edges = _edges(finite, is_log=up in logarithmic)
                    axes.hist(finite, edges, color=style.EARLIER)
                    axes.set_yticks([])
                else:
                    if up in logarithmic:
                        axes.set_yscale("log")
                    axes.plot(data[column], data[row], ".", color=style.COLOURS[0], markersize=1.5)
                if column == 0:
                    axes.set_ylabel(_label(result, up))
                else:
                    axes.tick_params(labelleft=False)
                if row == len(names) - 1:
                    axes.set_xlabel(_label(result, across))
        if result.unbounded.keys() & names:
            told = f"{NO_BOUND} without bound in some variants"
            made.suptitle(told, x=0.99, ha="right", fontsize=SIZE)
    return made


def _label(result: SweepResult, column: str) -> str:
    """The name of a column with its remark, and with its unit where one was chosen."""
    chosen, name = chosen_for(result.units[column]), style.short(column)
    name += signed(result, column).removeprefix(column).replace(", ", ",\n")  # panels are small
    return axis_label(name, [chosen.symbol]) if chosen else name


def _edges(values: Floats, *, is_log: bool) -> Floats:
    if not len(values):
        return np.array([0.0, 1.0])
    count = int(np.clip(np.sqrt(len(values)), 5, 40)) + 1
    low, high = float(values.min()), float(values.max())
    if not high > low:
        return np.array([low - 0.5, low + 0.5])
    return np.geomspace(low, high, count) if is_log else np.linspace(low, high, count)
