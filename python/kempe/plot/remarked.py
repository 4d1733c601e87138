"""Titles with remarks: a small line below a title says where the values have no bound.

Labels of sweeps have a sign instead, and a small line above the axes gives its meaning.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.draw.palette import verbatim
from kempe.results.remarks import remark, remark_of_variants
from kempe.results.variable import Variable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from kempe.sweeps import SweepResult

#: The signs of values that are not unique, and of values without bound.
NOT_UNIQUE, NO_BOUND = "*", "†"
#: Size of the line below a title, and its distance from the axes, points.
SIZE, _GAP = 7.5, 4.0


def note(times: Sequence[float], variable: Variable) -> str:
    """The line below the title of a figure of forces; or empty.

    It gives the times beside which values have no bound, and over a driven quantity, whether the
    forces contain inertia and damping.
    """
    unbounded = remark(times=times, variable=variable).removeprefix(", ")
    return verbatim(", ".join(filter(None, (variable.condition, unbounded))))


def titled(axes: Axes, title: str, below: str = "") -> None:
    """Write a title to the left, and a small line below it, if there is one."""
    axes.set_title(title, loc="left", pad=_GAP + 1.6 * SIZE if below else None)
    if below:
        axes.annotate(
            below,
            (0.0, 1.0),
            xycoords="axes fraction",
            xytext=(0.0, _GAP),
            textcoords="offset points",
            fontsize=SIZE,
            annotation_clip=False,
        )


def signed(result: SweepResult, column: str) -> str:
    """The name of a column of a sweep, with the remark or the sign of a measure that has one."""
    name = column + remark(result.choices.get(column, ""))
    return f"{name} {NO_BOUND}" if column in result.unbounded else name


def explained(axes: Axes, result: SweepResult, measure: str) -> None:
    """Write the meaning of the sign of a measure above the right end of the axes."""
    if measure not in result.unbounded:
        return
    axes.annotate(
        meaning(result, measure),
        (1.0, 1.0),
        xycoords="axes fraction",
        xytext=(0.0, _GAP),
        textcoords="offset points",
        ha="right",
        fontsize=SIZE,
        annotation_clip=False,
    )


def meaning(result: SweepResult, measure: str) -> str:
    """The line with the sign of a measure that has no bound in some variants; or empty."""
    passed = len(result.unbounded.get(measure, ()))
    told = remark_of_variants(unbounded=passed, count=int(result.succeeded.sum()))
    return told.replace(", ", f"{NO_BOUND} ", 1)
