"""Ticks of an axis: round numbers with equal decimals that never touch each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from kempe.model.drawing import measured

if TYPE_CHECKING:
    from matplotlib.axis import Axis

_SIZE = 8.0
#: Most ticks, and the room between two numbers in a row and in a column, points.
_MOST, _BESIDE, _ABOVE = 6, 10.0, 5.0
STEPS = (1, 2, 2.5, 5, 10)
#: Steps of angles in degrees, such as 30, 45, 60 and 90.
DEGREES = (1, 1.5, 3, 4.5, 6, 9, 10)
#: The same over more than a turn, such as 90, 180 and 360.
_TURNS = (1, 1.8, 3.6, 9, 10)


def set_ticks(axis: Axis, steps: Sequence[float] = STEPS) -> None:
    """Put ticks within the limits of a linear axis; their step is a step times a power of ten."""
    from matplotlib.ticker import MaxNLocator

    low, high = sorted(axis.get_view_interval())
    length = _length(axis)
    if steps is DEGREES and high - low > 400.0:
        steps = _TURNS
    chosen: list[float] = []
    for count in range(_MOST, 1, -1):
        ticks = MaxNLocator(count, steps=steps).tick_values(low, high)
        slack = 1e-9 * (high - low)
        chosen = [float(tick) for tick in ticks if low - slack <= tick <= high + slack]
        if _needed(axis, labels(chosen)) <= length:
            break
    axis.set_ticks(chosen, labels(chosen))


def labels(ticks: Sequence[float]) -> list[str]:
    """Numbers with as many decimals as the distances of the ticks need."""
    if len(ticks) < 2:
        return [_minus(f"{tick:.6g}") for tick in ticks]
    step = min(abs(b - a) for a, b in pairwise(ticks))
    decimals = next((k for k in range(15) if math.isclose(round(step, k), step, rel_tol=1e-6)), 15)
    return [_minus(f"{tick:.{decimals}f}") for tick in ticks]


def _minus(text: str) -> str:
    """The typographic minus sign, and no sign before a zero."""
    return text.lstrip("-") if not text.strip("-0.") else text.replace("-", "−")


def _length(axis: Axis) -> float:
    box = axis.axes.bbox
    side = box.width if _is_horizontal(axis) else box.height
    return float(side) * 72.0 / float(axis.axes.figure.dpi)


def _is_horizontal(axis: Axis) -> bool:
    return axis is axis.axes.xaxis


def _needed(axis: Axis, words: Sequence[str]) -> float:
    """Length that the numbers need, points."""
    if not _is_horizontal(axis):
        return len(words) * (_SIZE + _ABOVE)
    widths = [measured(word, _SIZE)[0] for word in words]
    return max(widths, default=0.0) * len(words) + _BESIDE * len(words)
