"""The figures of the page: error over step for each problem."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from kempe.plot import style

from benchmarks.validation.convergence import Convergence

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MARKERS = "osD^vP*X"
PANELS = (("q", "coordinates q"), ("lam", "multipliers λ"))


def convergence(found: list[Convergence], path: Path) -> None:
    """Errors of q and λ over the step, with the slopes of theory."""
    with style.applied():
        made = style.figure()
        made.set_figheight(1.45 * made.get_figheight())
        axes = made.subplots(1, len(PANELS), sharey=True)
        for ax, (key, title) in zip(axes, PANELS, strict=True):
            for number, one in enumerate(found):
                draw(ax, one, key, number)
            ax.set(xscale="log", yscale="log", xlabel="step h / s", title=title)
            # below the panel: the curves fill it from corner to corner
            ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2))
        axes[0].set_ylabel("largest relative error / 1")
        style.save(made, path.with_suffix(""))


def draw(ax: Axes, one: Convergence, key: str, number: int) -> None:
    """Plot the errors of one method, and the theoretical slope through the last one."""
    at = 0 if key == "q" else 1
    steps, errors = np.array(one.steps), np.array(getattr(one, key))
    label = f"{one.method}: {one.orders[at]:.2f}, theory {one.theory[at]:g}"
    colour = style.colour(number + 1)
    ax.plot(steps, errors, MARKERS[number % len(MARKERS)], color=colour, label=label)
    theory = errors[-1] * (steps / steps[-1]) ** one.theory[at]
    ax.plot(steps, theory, linewidth=0.8, color=colour)
