"""Residual and error of the variants of a study over time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.display_units import display
from kempe.draw.units import axis_label
from kempe.plot import style
from kempe.plot.envelope import BINS, envelope, logarithmic
from kempe.plot.legend import beside
from kempe.plot.time_axis import TimeAxis, show_time
from kempe.sweeps.studies.outcome import differences

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.results.solution import Solution
    from kempe.sweeps.studies import Outcome, Study

#: Least value of the logarithmic axis, in its unit.
FLOOR = 1e-16
_DECADES = 18
#: Distance of the markers of a curve, as a fraction of its length.
_MARKED = 0.12


def residual_history(study: Study, ax: Axes) -> None:
    """Largest |Φ| over time for the variants of stabilization."""
    _draw(ax, _shown(study), lambda solution: solution.drift.position)
    ax.set_ylabel("max |Φ| / (m, rad)")
    ax.set_title("Residual of the constraints", loc="left")


def error_history(study: Study, ax: Axes) -> None:
    """Largest difference of any body's position from the most accurate run over time."""
    reference = study.reference.solution
    if reference is None:
        return

    metre = display("m")
    _draw(ax, _shown(study), lambda sol: differences(sol, reference)[1] / metre.divisor)
    ax.set_ylabel(axis_label("position error", [metre.symbol]))
    title = f"Difference from {study.reference.variant.name}"
    ax.set_title(style.verbatim(title), loc="left")


def _shown(study: Study) -> Sequence[Outcome]:
    """The variants of stabilization at the finer of their tolerances."""
    group = study.group("stabilization")
    finest = min((o.variant.number for o in group), default=0.0)
    return [o for o in group if o.variant.number == finest and o.solution is not None]


def _draw(ax: Axes, outcomes: Sequence[Outcome], value: Callable[[Solution], Floats]) -> None:
    """The envelopes of a quantity, different in colour, dashes and marker."""
    solved = [outcome.solution for outcome in outcomes if outcome.solution is not None]
    if not solved:
        return
    time = TimeAxis.of(np.concatenate([solution.t for solution in solved]))
    drawn: list[Floats] = []
    for k, (outcome, solution) in enumerate(zip(outcomes, solved, strict=True)):
        y = np.maximum(value(solution), FLOOR)
        t, _, y = envelope(solution.t[: len(y)] / time.unit.divisor, y)
        # The markers of different curves are at different places.
        marks = (_MARKED * (k % 7) / 7.0, _MARKED)
        ax.plot(t, y, **style.marked_line(k), markevery=marks, label=outcome.variant.gains)
        drawn.append(y)
    logarithmic(ax, drawn, most=_DECADES)
    show_time(ax, time)
    beside(ax, f"{outcomes[0].variant.method}\nlargest of each\n{100 / BINS:g} % of the time")
