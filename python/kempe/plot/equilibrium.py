"""Figures of statics: the rest position over the start, and the path of equilibria."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.base.display_units import display
from kempe.draw.scene import scene
from kempe.draw.units import NOISE, Scale, scale
from kempe.model.measure_infos import parameter_unit
from kempe.plot import style
from kempe.plot.page import Page
from kempe.plot.picture import drawn, frame, paint

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from kempe.analyses.equilibrium_result import EquilibriumResult
    from kempe.draw.scene import Scene
    from kempe.results.state import State

#: Margins around the axes of a drawing, and their largest height, mm.
_LEFT, _RIGHT, _ABOVE, _BELOW = 19.0, 3.0, 7.0, 11.0
_HIGHEST = 150.0
#: Height of a panel, and of the title and the axis below, mm.
_PANEL, _REST = 52.0, 12.0
#: Largest number of panels.
_MOST = 4
#: The looks of the two kinds of equilibria, and of special points.
_KINDS: dict[bool, dict[str, Any]] = {
    True: {"linestyle": "-"},
    False: {"linestyle": (0, (4, 2)), "linewidth": 1.0},
}
_FOLD: dict[str, Any] = {
    "marker": "o",
    "markerfacecolor": "white",
    "markeredgecolor": "black",
    "linestyle": "none",
}
_CROSSING = {**_FOLD, "marker": "D"}


def rest_pages(result: EquilibriumResult, index_base: int) -> list[Page]:
    """The figures of an equilibrium or of a path."""
    del index_base
    rest = Page(0, "rest", "rest", partial(_rest_figure, result), key=True)
    if result.over is None:
        return [rest]
    found = []
    if result.coordinates:  # a mechanism that is held has none
        found.append(Page(0, "path", "path", partial(_path_figure, result), key=True))
    if result.effort:
        found.append(Page(0, "efforts", "efforts", partial(_effort_figure, result), key=True))
    return [*found, rest]


def rest_position(result: EquilibriumResult, *, ax: Axes | None = None) -> Axes:
    """Draw the mechanism at rest, and pale lines through the points of its bodies at the start.

    For a path, the last position is drawn over the first position and the positions of the folds.

    Args:
        result: the result of ``equilibrium``.
        ax: where to; a figure of its own when None.
    """
    with style.on(ax) as axes:
        made = drawn(axes, _framed(result), _title(result))
        metres = float(made.scene["length"]["metres"])
        for state in _earlier(result):
            for x, y in _lines(state):
                axes.plot(x / metres, y / metres, color=style.EARLIER, linewidth=1.4, zorder=0.8)
        made.name_joints()
        paint(axes, made)
        return axes


def path(result: EquilibriumResult, quantity: str, *, ax: Axes | None = None) -> Axes:
    """Draw a quantity over the parameter of a path: stable solid, unstable dashed, folds marked.

    Args:
        result: the result of ``equilibrium`` with ``over``.
        quantity: such as ``"crank.angle"``.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such quantity.
    """
    values, unit = result.quantity(quantity), result.unit_of(quantity)
    shown = Scale(np.pi / 180.0, "°") if unit == "rad" else scale(unit, float(np.ptp(values)))
    with style.on(ax) as axes:
        _over_parameter(axes, result, values, shown)
        axes.set_ylabel(shown.axis(style.verbatim(quantity)))
        return axes


def _rest_figure(result: EquilibriumResult) -> Figure:
    low, high = frame(_framed(result))
    width, height = high - low
    wide = style.WIDTH - _LEFT - _RIGHT
    tall = min(wide * float(height / width), _HIGHEST)
    wide = tall * float(width / height)
    made = style.figure(tall + _ABOVE + _BELOW, layout=None)
    axes = style.axes_at(made, (_LEFT, _BELOW, wide, tall), tall + _ABOVE + _BELOW)
    rest_position(result, ax=axes)
    return made


def _path_figure(result: EquilibriumResult) -> Figure:
    names = _told(result)[:_MOST]
    made, panels = _panels(len(names))
    for axes, name in zip(panels, names, strict=True):
        path(result, name, ax=axes)
    return _finished(made, panels, result)


def _told(result: EquilibriumResult) -> Sequence[str]:
    """The independent coordinates with names of the file; without any, the coordinates that change.

    Those of nodes inside of beams have no meaning in a figure.
    """
    bodies = result.states[0].compiled.named_bodies
    independent = [name for name in result.coordinates if name.rpartition(".")[0] in bodies]
    if independent:
        return independent
    own = [f"{name}.{part}" for name, info in bodies.items() for part in info.quantities]
    changes = [name for name in own if np.ptp(result.quantity(name)) > NOISE]
    return changes or result.coordinates


def _effort_figure(result: EquilibriumResult) -> Figure:
    names = list(result.effort)[:_MOST]
    made, panels = _panels(len(names))
    for axes, name in zip(panels, names, strict=True):
        values = result.effort[name]
        unit = "N·m" if result.unit_of_effort(name) == "N*m" else "N"
        shown = scale(unit, float(np.abs(values).max()))
        _over_parameter(axes, result, values, shown)
        axes.set_ylabel(shown.axis(f"effort of {style.verbatim(name)}"))
    return _finished(made, panels, result)


def _panels(count: int) -> tuple[Figure, list[Axes]]:
    made = style.figure(_PANEL * count + _REST)
    return made, list(made.subplots(count, 1, sharex=True, squeeze=False)[:, 0])


def _finished(made: Figure, panels: list[Axes], result: EquilibriumResult) -> Figure:
    for axes in panels[:-1]:
        axes.set_xlabel("")
    handles, labels = panels[0].get_legend_handles_labels()
    kept = dict(zip(labels, handles, strict=True))
    panels[0].set_title(style.short(_title(result), 60), loc="left")
    panels[0].legend(kept.values(), kept.keys(), loc="best")
    return made


def _over_parameter(axes: Axes, result: EquilibriumResult, y: Floats, shown: Scale) -> None:
    stable = np.asarray(result.stable, dtype=bool)
    across, divisor = _parameter(result)
    x, y = result.values / divisor, y / shown.divisor
    for part, kind in _parts(stable):
        label = "stable" if kind else "unstable"
        axes.plot(x[part], y[part], color=style.colour(0), label=label, **_KINDS[kind])
    for places, look, label in (
        (result.fold_points, _FOLD, "fold"),
        (result.branch_points, _CROSSING, "crossing of another path"),
    ):
        if places:
            chosen = list(places)
            axes.plot(x[chosen], y[chosen], label=label, **look)
    axes.set_xlabel(across)


def _parameter(result: EquilibriumResult) -> tuple[str, float]:
    """The parameter of a path with its unit, and the divisor of its values."""
    name = str(result.over)
    unit = parameter_unit(result.state.compiled, name)
    words = style.verbatim(name)
    if unit == "SI":
        return f"{words}, SI units", 1.0
    shown = display(unit)
    return (words if unit == "1" else f"{words} / {shown.symbol}"), shown.divisor


def _parts(stable: NDArray[np.bool_]) -> Iterator[tuple[slice, bool]]:
    """Runs of points of one kind; each reaches the first point of the next one."""
    ends = [*(np.flatnonzero(np.diff(stable.astype(int))) + 1), len(stable)]
    first = 0
    for end in ends:
        yield slice(first, min(int(end) + 1, len(stable))), bool(stable[first])
        first = int(end)


def _title(result: EquilibriumResult) -> str:
    title = style.short(result.state.compiled.title or "At rest", 50)
    if result.over is not None:
        return title
    return f"{title}: {'stable' if result.stable else 'not stable'}"


def _earlier(result: EquilibriumResult) -> list[State]:
    """The earlier positions, which are drawn pale."""
    if result.over is None:
        return [result.start]
    return [result.states[0], *(result.states[k] for k in result.fold_points)]


def _framed(result: EquilibriumResult) -> Scene:
    """The scene of the rest position, with room for the positions that are drawn pale."""
    found = scene(result.state)
    boxes = np.array([found["bounds"], *(scene(state)["bounds"] for state in _earlier(result))])
    boxes = boxes.reshape(len(boxes), 2, 2)
    bounds = [*boxes[:, 0].min(axis=0).tolist(), *boxes[:, 1].max(axis=0).tolist()]
    return {**found, "bounds": bounds}


def _lines(state: State) -> Iterator[tuple[Floats, Floats]]:
    """The points of each body, x and y in m."""
    for name, body in state.compiled.bodies.items():
        points = np.array(
            [
                [float(state[f"{name}.{point}.{axis}"]) for axis in ("x", "y")]
                for point in body.points
            ]
        )
        if len(points) > 1:
            yield points[:, 0], points[:, 1]
