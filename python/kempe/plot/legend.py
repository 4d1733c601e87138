"""The place of a legend, outside the area of the lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def above_or_beside(axes: Axes) -> None:
    """Above the panel to the right, or beside it if there are many lines; none for one line."""
    handles, labels = axes.get_legend_handles_labels()
    if len(labels) > 5 or sum(map(len, labels)) > 60:
        beside(axes)
    elif len(labels) > 1:
        axes.legend(
            handles,
            labels,
            loc="lower right",
            bbox_to_anchor=(1.0, 0.98),
            ncols=len(labels),
            columnspacing=1.2,
            borderaxespad=0.2,
        )


def beside(axes: Axes, title: str | None = None) -> None:
    """To the right of the panel."""
    labels = axes.get_legend_handles_labels()[1]
    if labels:
        axes.legend(
            title=title,
            title_fontsize=8.0,
            loc="upper left",
            bbox_to_anchor=(1.0, 1.02),
            ncols=1 + len(labels) // 16,
        )
