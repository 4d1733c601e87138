"""Residual and error of the variants of a study over time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe.arrays import Floats
from kempe.plot import style
from kempe.studies.outcome import differences

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.solution import Solution
    from kempe.studies import Outcome, Study

#: Least value of the logarithmic axis, m.
FLOOR = 1e-16
#: Spans of time of which the largest value is drawn.
BINS = 200


def residual_history(study: Study, ax: Axes) -> None:
    """Largest |Φ| over time for the variants of stabilization."""
    _draw(ax, _shown(study), lambda solution: solution.drift.position)
    ax.set_ylabel("largest residual / m, rad")
    ax.set_title("Residual of the constraints")


def error_history(study: Study, ax: Axes) -> None:
    """Largest difference of any body's position from the most accurate run over time."""
    reference = study.reference.solution
    if reference is None:
        return

    _draw(ax, _shown(study), lambda solution: differences(solution, reference)[1])
    ax.set_ylabel("position error / m")
    ax.set_title(style.verbatim(f"Difference from {study.reference.variant.name}"))


def _shown(study: Study) -> Sequence[Outcome]:
    """The variants of stabilization at the finer of their tolerances."""
    group = study.group("stabilization")
    finest = min((o.variant.number for o in group), default=0.0)
    return [o for o in group if o.variant.number == finest and o.solution is not None]


def _draw(ax: Axes, outcomes: Sequence[Outcome], value: Callable[[Solution], Floats]) -> None:
    for k, outcome in enumerate(outcomes):
        if outcome.solution is None:
            continue
        y = np.maximum(value(outcome.solution), FLOOR)
        t, y = envelope(outcome.solution.t[: len(y)], y)
        ax.plot(t, y, **style.line(k), linewidth=1.3, label=outcome.variant.gains)
    ax.set_yscale("log")
    ax.set_xlabel("t / s")
    ax.grid(visible=True, color="#EEEEEE")
    if outcomes:
        title = f"{outcomes[0].variant.method}\nlargest of each\n{100 / BINS:g} % of the time"
        ax.legend(
            title=title, fontsize=8, title_fontsize=8, loc="upper left", bbox_to_anchor=(1, 1)
        )


def envelope(t: Floats, y: Floats) -> tuple[Floats, Floats]:
    """The largest value in each of BINS spans of time; an oscillation becomes one clear line."""
    if len(t) <= BINS:
        return t, y
    edges = np.linspace(0, len(t), BINS + 1).astype(int)[:-1]
    return t[edges], np.maximum.reduceat(y, edges)
