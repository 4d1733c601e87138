"""The figure of an optimisation: its runs, its candidates, and the mechanism before and after."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.base.display_units import display
from kempe.draw.units import number
from kempe.errors import KempeError
from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.page import Page
from kempe.plot.picture import at_rest, drawn, paint

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.results.state import State
    from kempe.sweeps.problems import Optimum

#: Heights of the upper row without variables, of a variable, and of the drawings, mm.
_ABOVE, _VARIABLE, _BELOW = 60.0, 6.0, 68.0
#: Most candidates, and most variables with their bounds as numbers.
_MOST = 5
#: Ratio of objectives above which their axis is logarithmic.
_WIDE = 50.0


def optimization(result: Optimum) -> Figure:
    """Draw the runs of a search, its candidates between the bounds, and the mechanism.

    Several objectives have their front in place of the runs.

    Args:
        result: the result of ``kp.optimize``.

    Returns:
        The figure, without a window.
    """
    from kempe.sweeps.problems import Optimum

    instance(result, Optimum, "an optimum, as kp.optimize returns")
    with style.applied():
        above = _ABOVE + _VARIABLE * max(0, len(result.values) - 3)
        made = style.figure(above + _BELOW)
        upper, lower = made.subfigures(2, 1, height_ratios=(above, _BELOW))  # type: ignore[misc]
        left, right = upper.subplots(1, 2, width_ratios=(1.0, 1.1))
        (_front if result._problem.others else _history)(left, result)
        _candidates(right, result)
        _mechanisms(lower.subplots(1, 2), result)
    return made


def optimization_pages(result: Optimum) -> list[Page]:
    """The figure that ``kempe optimize`` writes."""
    return [Page(0, "optimization", "optimization", lambda: optimization(result), key=True)]


def _front(axes: Axes, result: Optimum) -> None:
    """The first two objectives of the front; a third one as colour."""
    problems = result._problem.objectives
    units = [display(one.unit) for one in problems]
    points = np.array([list(one.objectives.values()) for one in result.candidates])
    points = points / [unit.divisor for unit in units]
    colour = points[:, 2] if len(problems) > 2 else style.COLOURS[0]
    marks = axes.scatter(points[:, 0], points[:, 1], c=colour, s=14.0, zorder=3, label="front")
    labels = [
        f"{style.short(one.label, 40)} / {unit.symbol or '1'}"
        for one, unit in zip(problems, units, strict=True)
    ]
    if len(problems) > 2:
        axes.figure.colorbar(marks, ax=axes, label=labels[2])
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1])
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0))


def _history(axes: Axes, result: Optimum) -> None:
    """The objective of each run, and the best so far."""
    unit = display(result.unit)
    table = result._table
    objective = table[:, -2] / unit.divisor
    holds = table[:, -1] <= 1e-6
    good = np.isfinite(objective)
    number = np.arange(1, len(table) + 1)
    beyond = good & ~holds
    axes.plot(
        number[good & holds], objective[good & holds], ".", color=style.COLOURS[0], label="run"
    )
    if beyond.any():
        axes.plot(
            number[beyond], objective[beyond], "x", color=style.EARLIER, label="beyond a limit"
        )
    if not good.all():
        low = np.full(int((~good).sum()), 0.02)
        axes.plot(
            number[~good],
            low,
            "|",
            color=style.COLOURS[1],
            label="failed",
            transform=axes.get_xaxis_transform(),
        )
    best = _best_so_far(objective, good & holds, result._problem.sign)
    axes.plot(
        number, best, color="black", linewidth=1.0, label="best so far", drawstyle="steps-post"
    )
    shown = objective[good]
    if len(shown) and shown.min() > 0.0 and shown.max() > _WIDE * shown.min():
        axes.set_yscale("log")
    axes.set_xlabel("run")
    axes.set_ylabel(f"{style.short(result.label, 40)} / {unit.symbol or '1'}")
    axes.xaxis.get_major_locator().set_params(integer=True)  # type: ignore[call-arg]
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)


def _best_so_far(objective: Floats, holds: NDArray[np.bool_], sign: float) -> Floats:
    """The best objective up to each run; NaN before the first run within the limits."""
    held = np.where(holds, sign * objective, np.inf)
    best = sign * np.minimum.accumulate(held)
    return np.where(np.isfinite(best), best, np.nan)


def _candidates(axes: Axes, result: Optimum) -> None:
    """The candidates and the case before, between the bounds of each variable."""
    problem = result._problem
    rows = np.arange(len(problem.bounds))[::-1]
    before = list(result.before.values())
    axes.plot(problem.shares(before), rows, "|", color="black", markersize=9.0, label="before")
    for k, one in reversed(list(enumerate(result.candidates[:_MOST]))):
        shares = problem.shares(list(one.values.values()))
        label = "best" if k == 0 else "other candidates" if k == 1 else None
        axes.plot(
            shares,
            rows,
            "o",
            color=style.COLOURS[0] if k == 0 else "none",
            markeredgecolor=style.COLOURS[0] if k == 0 else style.COLOURS[1],
            markersize=5.0,
            label=label,
        )
    texts = []
    for bound in problem.bounds:
        unit = display(result.units[bound.name])
        ends = " … ".join(number(x / unit.divisor) for x in (bound.least, bound.largest))
        log = ", log" if bound.log else ""
        texts.append(f"{style.short(bound.name, 20)}\n{ends} {unit.symbol}".rstrip() + log)
    axes.set_yticks(rows, texts)
    axes.set_xlim(-0.04, 1.04)
    axes.set_ylim(-0.6, len(rows) - 0.4)
    axes.set_xticks([0.0, 0.5, 1.0], ["least", "", "largest"])
    axes.legend(loc="lower center", bbox_to_anchor=(0.4, 1.0), ncols=2)


def _mechanisms(panels: list[Axes], result: Optimum) -> None:
    """The mechanism at its start before and after, at one scale."""
    states = [_started(case) for case in (result.start, result.case)]
    scenes = [None if state is None else at_rest(state) for state in states]
    boxes = np.array([scene["bounds"] for scene in scenes if scene is not None])
    for axes, scene, title in zip(panels, scenes, ("before", "after"), strict=True):
        if scene is None:
            axes.set_axis_off()
            axes.set_title(f"{title}: cannot be assembled", loc="left")
            continue
        bounds = [*boxes.min(axis=0)[:2].tolist(), *boxes.max(axis=0)[2:].tolist()]
        points = None if result._problem.path is None else result._problem.path.points
        if points is not None:
            low, high = (
                np.minimum(bounds[:2], points.min(axis=0)),
                np.maximum(bounds[2:], points.max(axis=0)),
            )
            bounds = [*low.tolist(), *high.tolist()]
        made = drawn(axes, {**scene, "bounds": bounds}, title)
        paint(axes, made)
        if points is not None:
            scale = scene["length"]["metres"]
            axes.plot(*(points / scale).T, "+", color=style.COLOURS[1], markersize=6.0, zorder=5)


def _started(case: object) -> State | None:
    """The assembled mechanism of a case; None if it does not close."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return case.start()  # type: ignore[attr-defined,no-any-return]
        except KempeError:
            return None
