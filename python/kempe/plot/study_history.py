"""Residual and error of the variants of a study over time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe.arrays import Floats
from kempe.plot import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.solution import Solution
    from kempe.studies import Outcome, Study

#: Below it there is nothing to see on a logarithmic axis, m.
FLOOR = 1e-16


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

    def error(solution: Solution) -> Floats:
        count = min(len(solution.t), len(reference.t))
        apart = (solution.q[:count] - reference.q[:count]).reshape(count, -1, 3)
        found: Floats = np.hypot(apart[:, :, 0], apart[:, :, 1]).max(axis=1, initial=0.0)
        return found

    _draw(ax, _shown(study), error)
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
        t = outcome.solution.t[: len(y)]
        ax.plot(t, y, color=style.colour(k + 1), linewidth=1.2, label=outcome.variant.gains)
    ax.set_yscale("log")
    ax.set_xlabel("t / s")
    ax.grid(visible=True, color="#EEEEEE")
    if outcomes:
        ax.legend(title=outcomes[0].variant.method, fontsize=9)
