"""Cost and accuracy of the variants of a study."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kempe.base.display_units import display
from kempe.draw.units import axis_label
from kempe.plot import style
from kempe.plot.legend import beside

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.sweeps.studies import Outcome, Study

_GRID: dict[str, Any] = {"visible": True, "which": "both", "color": "#EEEEEE"}


def steps(study: Study, ax: Axes) -> None:
    """Steps over β at one tolerance."""
    good = [o for o in study.group("beta") if not o.diverged]
    beta, count = [o.variant.beta for o in good], [o.steps for o in good]
    ax.loglog(beta, count, **style.marked_line(0))
    ax.set_xlabel("β / (1/s)")
    ax.set_ylabel("steps / 1")
    told = f", {good[0].variant.method}, α = {good[0].variant.alpha:g}/s" if good else ""
    ax.set_title(style.verbatim(f"Steps of the integrator{told}"), loc="left")
    ax.grid(**_GRID)


def work_precision(study: Study, ax: Axes) -> None:
    """Evaluations of the accelerations over the error; the lower left corner is best."""
    curves: dict[tuple[str, str], list[Outcome]] = {}
    for outcome in (*study.group("step"), *study.group("tolerance")):
        way = outcome.variant
        if not outcome.diverged and outcome.position_error > 0.0:
            curves.setdefault((way.scheme, way.gains), []).append(outcome)
    metre = display("m")
    for k, ((scheme, gains), outcomes) in enumerate(curves.items()):
        ordered = sorted(outcomes, key=lambda o: o.position_error)
        ax.loglog(
            [o.position_error / metre.divisor for o in ordered],
            [o.evaluations for o in ordered],
            **style.marked_line(k),
            label=f"{scheme}, {gains}",
        )
    ax.set_xlabel(axis_label("largest position error", [metre.symbol]))
    ax.set_ylabel("evaluations of the accelerations / 1")
    ax.set_title("Work and precision", loc="left")
    ax.grid(**_GRID)
    beside(ax)
