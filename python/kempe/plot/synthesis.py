"""The linkages that synthesis found, and Burmester's curves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.units import scale
from kempe.errors import ModelError
from kempe.model.given import value
from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.page import Page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.synthesis import Burmester, Candidate, Found

#: Most candidates of a figure, those in a row, and the height of a row, mm.
MOST, _ACROSS, _ROW = 9, 3, 56.0
_TASK: dict[str, Any] = {"color": "#C2184B", "zorder": 4.0}
_LINK: dict[str, Any] = {"color": "#000000", "linewidth": 1.2, "solid_capstyle": "round"}
_PIN: dict[str, Any] = {"color": "#000000", "markerfacecolor": "white", "zorder": 3.2}
#: Length of the axes of a pose, as a part of the size of the task.
_AXIS = 0.12


def synthesis(found: Found, *, most: int = MOST) -> Figure:
    """Draw the best candidates at the first position, with the task and the path of P.

    Args:
        found: the result of ``kp.synthesis.motion``, ``path`` or ``function``.
        most: largest number of candidates.

    Returns:
        The figure, without a window.

    Raises:
        ModelError: there are no candidates.
    """
    from kempe.synthesis import Found

    instance(found, Found, "a result of kp.synthesis")
    if not len(found):
        hint = "ask for defects='tell', or relax a limit"
        raise ModelError("there are no candidates to draw", hint=hint)
    shown = list(found[:most])
    across = min(_ACROSS, len(shown))
    down = -(-len(shown) // across)
    with style.applied():
        made = style.figure(_ROW * down + (4.0 if down == 1 else 0.0))
        panels = made.subplots(down, across, squeeze=False).ravel()
        for k, (axes, one) in enumerate(zip(panels, shown, strict=False), 1):
            _panel(axes, found, one, k)
        for axes in panels[len(shown) :]:
            axes.set_axis_off()
    return made


def synthesis_pages(found: Found) -> list[Page]:
    """The figure that ``kempe synthesis`` writes."""
    return [Page(0, "synthesis", "synthesis", lambda: synthesis(found), key=True)]


def _panel(axes: Axes, found: Found, one: Candidate, number: int) -> None:
    from kempe.synthesis import SliderCrank

    unit = scale("m", one.size)
    places = one.positions(200) / unit.divisor
    path = places[-1]
    axes.plot(*path.T, color=style.COLOURS[0], linewidth=1.0, zorder=2.5)
    _task(axes, found, unit.divisor)
    at = {name: np.array(point) / unit.divisor for name, point in one.points.items()}
    for names in one.outline.values():
        corners = [at[name] for name in names if name in at]
        if len(corners) > 2:
            axes.add_patch(_plate(corners))
        else:
            axes.plot(*np.array(corners).T, zorder=3.0, **_LINK)
    if isinstance(one, SliderCrank):
        axes.plot(*places[1].T, color="#7F7F7F", linewidth=3.0, alpha=0.5, zorder=2.4)
    for name in (name for name in at if name != "P"):
        if name in "ODG":
            axes.plot(*at[name], "^", color="#000000", markersize=6.0, zorder=3.1)
        else:
            axes.plot(*at[name], "o", markersize=4.0, **_PIN)
        axes.annotate(
            name,
            tuple(at[name].tolist()),
            (3, 3),
            textcoords="offset points",
            fontsize=7,
            zorder=5.0,
        )
    angle = np.degrees(one.transmission_angle)
    told = f"{number}: {one.type}" + (f", {angle:.0f}°" if one.turns else "")
    axes.set_title(told + (f"\n{one.defects[0]}" if one.defects else ""), fontsize=8)
    axes.set_aspect("equal", adjustable="datalim")
    axes.tick_params(labelsize=7)
    axes.set_xlabel(f"x / {unit.unit}", fontsize=7, labelpad=1)
    axes.set_ylabel(f"y / {unit.unit}", fontsize=7, labelpad=1)


def _plate(corners: list[Floats]) -> Any:
    from matplotlib.patches import Polygon

    at = np.array(corners)
    around = at - at.mean(axis=0)
    order = np.argsort(np.arctan2(around[:, 1], around[:, 0]))
    return Polygon(at[order], facecolor="#DCE6F2", edgecolor="#000000", lw=1.0, zorder=2.8)


def _task(axes: Axes, found: Found, divisor: float) -> None:
    """Dots at the points of the task, or the axes of the moving frame at its poses."""
    at = np.column_stack([found.task.real, found.task.imag]) / divisor
    axes.plot(*at.T, ".", markersize=5.0, **_TASK)
    if found.poses is not None:
        _frames(axes, at, [pose[2] for pose in found.poses])


def _frames(axes: Axes, at: Floats, angles: Sequence[Any]) -> None:
    size = _AXIS * np.ptp(at, axis=0).max()
    for place, angle in zip(at, angles, strict=True):
        turned = value(angle, "angle", "rad")
        for k, shade in enumerate(("#C2184B", "#E58CA8")):
            way = size * np.array([np.cos(turned + k * np.pi / 2), np.sin(turned + k * np.pi / 2)])
            axes.plot(*np.array([place, place + way]).T, color=shade, linewidth=1.0, zorder=3.9)


def burmester(curves: Burmester, *, ax: Axes | None = None) -> Axes:
    """Draw the circle-point curve at the first pose, the centre-point curve and the poses.

    Args:
        curves: the result of ``kp.synthesis.burmester``.
        ax: where to; a figure of its own when None.
    """
    from kempe.synthesis import Burmester

    instance(curves, Burmester, "the curves that kp.synthesis.burmester returns")
    at = curves.poses[:, :2]
    middle, half = at.mean(axis=0), 4.0 * max(np.ptp(at, axis=0).max(), 1e-300)
    unit = scale("m", half)
    x, y = (np.linspace(c - half, c + half, 401) for c in middle)
    grid = np.meshgrid(x, y)
    with style.on(ax, 110.0) as axes:
        for k, kind in enumerate(("circle", "centre")):
            level = curves.level(kind, *grid)
            look: dict[str, Any] = {"colors": style.COLOURS[k], "linestyles": style.DASHES[k]}
            axes.contour(x / unit.divisor, y / unit.divisor, level, [0.0], linewidths=1.3, **look)
            axes.plot([], [], label=f"{kind} points", **style.line(k))
        axes.plot(*at.T / unit.divisor, ".", markersize=5.0, label="poses", **_TASK)
        _frames(axes, at / unit.divisor, curves.poses[:, 2].tolist())
        axes.set_aspect("equal")
        axes.set_xlabel(f"x / {unit.unit}")
        axes.set_ylabel(f"y / {unit.unit}")
        axes.legend(loc="upper right", frameon=True)
    return axes
