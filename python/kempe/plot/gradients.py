"""The figure of a gradient: relative slopes as bars."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from math import isfinite
from typing import TYPE_CHECKING

from kempe.draw.units import number
from kempe.errors import ModelError
from kempe.model.values import instance, texts
from kempe.plot import style
from kempe.plot.page import Page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.sweeps import Gradient
    from kempe.sweeps.gradients.result import Slope

#: Most panels of a figure.
_MOST = 4
#: Height of a panel without bars, and of a bar, mm.
_PANEL, _BAR = 18.0, 6.0
#: Hatching of a bar with a remark.
_HATCH = "////"
#: In place of a bar.
_NONE = "no derivative"
#: Part of the largest slope of a panel below which a slope is a rounding error, written as 0.
_ROUNDING = 1e-10
#: Room for numbers beside the bars, as a share of the width.
_ROOM = 0.2


def gradient(result: Gradient, measures: Sequence[str] | None = None) -> Figure:
    """Draw the relative slopes of measures as bars, the largest at the top.

    A relative slope of 2 means that 1 % more of the variable gives 2 % more of the measure. A
    hatched bar has a remark, such as that its slope is one-sided.

    Args:
        result: the result of ``kp.gradient``.
        measures: some of its measures, a panel for each; the first four by default.

    Returns:
        The figure, without a window.

    Raises:
        ModelError: there is no such measure, or there are more than four.
    """
    from kempe.sweeps import Gradient

    instance(result, Gradient, "a gradient, as kp.gradient returns")
    names = list(result.measures)[:_MOST] if measures is None else texts(measures, "measures")
    if not 1 <= len(names) <= _MOST:
        raise ModelError(f"measures: {len(names)}; from 1 to {_MOST} fit in a figure")
    with style.applied():
        made = style.figure(len(names) * (_PANEL + _BAR * len(result.variables)))
        panels = made.subplots(len(names), 1, squeeze=False)[:, 0]
        for axes, name in zip(panels, names, strict=True):
            _bars(axes, name, result.ranked(name)[::-1])
        panels[-1].set_xlabel("relative slope / 1")
    return made


def _bars(axes: Axes, measure: str, ordered: Sequence[Slope]) -> None:
    """A panel: a bar for each variable, from below."""
    lengths = [one.relative if isfinite(one.relative) else 0.0 for one in ordered]
    largest = max(map(abs, lengths), default=0.0)
    bars = axes.barh(range(len(ordered)), lengths, color=style.COLOURS[0], height=0.6)
    axes.set_yticks(range(len(ordered)), [style.short(one.variable) for one in ordered])
    for bar, one in zip(bars, ordered, strict=True):
        if one.remark and isfinite(one.relative):
            bar.set(hatch=_HATCH, facecolor="white", edgecolor=style.COLOURS[0])
        axes.annotate(
            _beside(one, _ROUNDING * largest),
            (bar.get_width(), bar.get_y() + bar.get_height() / 2.0),
            (-3 if bar.get_width() < 0.0 else 3, 0),
            ha="right" if bar.get_width() < 0.0 else "left",
            va="center",
            textcoords="offset points",
            fontsize=8.0,
        )
    low, high = min([0.0, *lengths]), max([0.0, *lengths])
    high = high if high > low else 1.0
    room = _ROOM * (high - low)
    axes.set_xlim(low - room if low < 0.0 else 0.0, high + room)
    axes.axvline(0.0, color="black", linewidth=0.7)
    axes.grid(visible=False, axis="y")
    axes.set_title(style.short(measure), loc="left")


def _beside(one: Slope, least: float) -> str:
    """The number beside a bar, 0 below the least one, or the words in its place."""
    if isfinite(one.relative):
        return number(one.relative if abs(one.relative) > least else 0.0, 3)
    return "the measure is 0" if isfinite(one.value) else _NONE


def gradient_pages(result: Gradient) -> list[Page]:
    """The figures of a gradient that ``kempe gradient`` writes, four measures in each."""
    names = list(result.measures)
    parts = [names[k : k + _MOST] for k in range(0, len(names), _MOST)]
    return [
        Page(k, "gradient", f"gradient of {', '.join(part)}", partial(gradient, result, part))
        for k, part in enumerate(parts)
    ]
