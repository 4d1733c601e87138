"""Position, velocity and acceleration of a body over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from kempe.base.names import one_of
from kempe.model.compiled import ACCELERATIONS, COORDINATES, RATES
from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.curves import draw
from kempe.plot.panel import Curve, Panel, curve, times
from kempe.plot.time_axis import TimeAxis, show_time
from kempe.results.motion import Motion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

    from kempe.base.arrays import Floats
    from kempe.model.compiled import BodyInfo

#: Quantity → symbol and SI unit.
QUANTITIES = {
    "x": ("x", "m"),
    "y": ("y", "m"),
    "angle": ("φ", "rad"),
    "vx": ("$v_x$", "m/s"),
    "vy": ("$v_y$", "m/s"),
    "omega": ("ω", "rad/s"),
    "ax": ("$a_x$", "m/s²"),
    "ay": ("$a_y$", "m/s²"),
    "alpha": ("α", "rad/s²"),
}


def positions(
    motion: Motion,
    body: str,
    quantity: str | None = None,
    *,
    ax: Axes | None = None,
    cut: float | None = None,
    index_base: int = 1,
) -> Axes:
    """Draw x and y of a body over time, and its angle on a separate axis to the right.

    A point mass has no angle.

    Args:
        motion: a solution, drawn on its interpolant, or the motion at some times.
        body: its name.
        quantity: one of "x", "y" and "angle" alone, with its turning points marked.
        ax: where to; a figure of its own when None.
        cut: time after which the time axis is compressed, s, as ``transient`` finds it.
        index_base: number of the first body.

    Returns:
        The axes; the axes of the angle are their twin.

    Raises:
        ModelError: there is no such body or quantity.
    """
    return _draw(
        motion, body, _chosen(quantity, COORDINATES), ax=ax, cut=cut, index_base=index_base
    )


def velocities(
    motion: Motion,
    body: str,
    quantity: str | None = None,
    *,
    ax: Axes | None = None,
    cut: float | None = None,
    index_base: int = 1,
) -> Axes:
    """Draw vx, vy and omega of a body over time; otherwise as ``positions``."""
    return _draw(motion, body, _chosen(quantity, RATES), ax=ax, cut=cut, index_base=index_base)


def accelerations(
    motion: Motion,
    body: str,
    quantity: str | None = None,
    *,
    ax: Axes | None = None,
    cut: float | None = None,
    index_base: int = 1,
) -> Axes:
    """Draw ax, ay and alpha of a body over time; otherwise as ``positions``."""
    return _draw(
        motion, body, _chosen(quantity, ACCELERATIONS), ax=ax, cut=cut, index_base=index_base
    )


def body_title(info: BodyInfo, index_base: int = 1) -> str:
    """Number and name of a body, such as "2 coupler"; ground and nodes of beams have no number."""
    name = style.short(info.name)
    return f"{info.shown_number - 1 + index_base} {name}" if info.shown_number else name


def body_panel(motion: Motion, body: str, quantity: str, index_base: int) -> Panel:
    """One quantity of a body."""
    info = motion.body(body).info
    title = body_title(info, index_base)
    line = {"color": style.colour(max(1, info.number)), "linestyle": "-"}
    symbol, unit = QUANTITIES[quantity]
    unit = motion.variable.rate(unit)
    return Panel(
        symbol,
        unit,
        [_curve(motion, body, quantity, line)],
        title,
        f"{title} {symbol}",
        turning_points=quantity in COORDINATES,
        variable=motion.variable,
    )


def _curve(motion: Motion, body: str, quantity: str, line: Mapping[str, Any]) -> Curve:
    def values(at: Motion) -> Floats:
        found: Floats = getattr(at.body(body), quantity)
        return found

    return curve(motion, QUANTITIES[quantity][0], values, line)


def _chosen(quantity: str | None, known: Sequence[str]) -> Sequence[str]:
    return known if quantity is None else (one_of("quantity", quantity, known),)


def _draw(
    motion: Motion,
    body: str,
    names: Sequence[str],
    *,
    ax: Axes | None,
    cut: float | None,
    index_base: int,
) -> Axes:
    instance(motion, Motion, "a solution or a motion")
    info = motion.body(body).info
    with style.on(ax) as axes:
        if len(names) == 1:
            panel = body_panel(motion, body, names[0], index_base)
            draw(axes, times(motion), panel, cut=cut)
        else:
            title = body_title(info, index_base)
            _draw_all(axes, motion, body, names[: info.count or None], title=title, cut=cut)
        return axes


def _draw_all(
    axes: Axes, motion: Motion, body: str, names: Sequence[str], *, title: str, cut: float | None
) -> None:
    """Draw both translations on the axes, and the rotation, if any, on their twin."""
    x, y, *turn = (_curve(motion, body, name, style.line(k)) for k, name in enumerate(names))
    t, unit = times(motion), motion.variable.rate(QUANTITIES[names[0]][1])
    both = Panel(f"{x.label}, {y.label}", unit, [x, y], title, variable=motion.variable)
    draw(axes, t, both, cut=cut)
    lines = [*axes.lines]
    if turn:
        unit = motion.variable.rate(QUANTITIES[names[2]][1])
        still = unit == "rad"
        panel = Panel(turn[0].label, unit, turn, turning_points=still, variable=motion.variable)
        lines += _draw_turning(axes, t, panel, cut)
    axes.legend(handles=lines, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=3)


def _draw_turning(axes: Axes, t: Floats, panel: Panel, cut: float | None) -> Sequence[Line2D]:
    """An angle or its rate on a twin of the axes; returns its lines."""
    twin = axes.twinx()
    twin.grid(visible=False)
    twin.spines["right"].set_visible(True)
    draw(twin, t, panel)
    show_time(twin, TimeAxis.of(t, cut, panel.variable), label=False)
    return [*twin.lines]
