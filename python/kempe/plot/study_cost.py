"""Cost and accuracy of the variants of a study."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from kempe.plot import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.studies import Outcome, Study


def steps(study: Study, ax: Axes) -> None:
    """Steps over β at one tolerance."""
    good = [o for o in study.group("beta") if not o.diverged]
    beta, count = [o.variant.beta for o in good], [o.steps for o in good]
    ax.loglog(beta, count, "o-", color=style.colour(1))
    ax.set_xlabel("β / (1/s)")
    ax.set_ylabel("steps")
    told = f", {good[0].variant.method}, α = {good[0].variant.alpha:g}/s" if good else ""
    ax.set_title(style.verbatim(f"Steps of the integrator{told}"))
    ax.grid(visible=True, which="both", color="#EEEEEE")


def work_precision(study: Study, ax: Axes) -> None:
    """Time of computation against error: nearer to the lower left is better."""
    curves: dict[tuple[str, str], list[Outcome]] = {}
    for outcome in (*study.group("step"), *study.group("tolerance")):
        way = outcome.variant
        if not outcome.diverged and outcome.position_error > 0.0:
            curves.setdefault((way.scheme, way.gains), []).append(outcome)
    for k, ((scheme, gains), outcomes) in enumerate(curves.items()):
        _curve(ax, outcomes, k + 1, f"{scheme}, {gains}")
    ax.set_xlabel("position error / m")
    ax.set_ylabel("time of computation / ms")
    ax.set_title("Work and precision")
    ax.grid(visible=True, which="both", color="#EEEEEE")
    if curves:
        ax.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1, 1))


def _curve(ax: Axes, outcomes: Sequence[Outcome], number: int, label: str) -> None:
    ordered = sorted(outcomes, key=lambda o: o.position_error)
    error = [o.position_error for o in ordered]
    time = [1e3 * o.seconds for o in ordered]
    ax.loglog(error, time, "o-", color=style.colour(number), markersize=4, label=label)
