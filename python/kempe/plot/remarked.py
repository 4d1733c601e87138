"""Titles with remarks: below a title, a small line says where the values have no bound."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.draw.palette import verbatim
from kempe.remarks import remark
from kempe.variable import Variable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

#: The signs of values that are not unique, and of values without bound.
NOT_UNIQUE, NO_BOUND = "*", "†"
#: Size of the line below a title, and its distance from the axes, points.
_SIZE, _GAP = 7.5, 4.0


def note(times: Sequence[float], variable: Variable) -> str:
    """The line below a title, from the times beside which values have no bound; or empty."""
    return verbatim(remark(unique=True, times=times, variable=variable).removeprefix(", "))


def titled(axes: Axes, title: str, below: str = "") -> None:
    """Write a title to the left, and a small line below it, if there is one."""
    axes.set_title(f"{title}\n" if below else title, loc="left")
    if below:
        axes.annotate(
            below,
            (0.0, 1.0),
            xycoords="axes fraction",
            xytext=(0.0, _GAP),
            textcoords="offset points",
            fontsize=_SIZE,
            annotation_clip=False,
        )
