"""Figures of a sweep: lines, maps, histograms and contributions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.display_units import display
from kempe.base.names import entry
from kempe.draw.units import Scale, axis_label, number, scale
from kempe.errors import ModelError
from kempe.plot import style
from kempe.plot.legend import beside
from kempe.plot.remarked import explained, meaning, signed, titled

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from kempe.sweeps import SweepResult, Tolerances
    from kempe.sweeps.variables import Variable

#: Most lines of one figure.
_LINES = 10
#: The colours of a map from low to high: even in lightness, for any colour vision and in print.
MAP = "cividis"
#: The cross of a variant that failed, in lines.
_CROSS: dict[str, Any] = {"marker": "x", "linestyle": "", "markersize": 4.0, "markeredgewidth": 0.8}
#: A range from one positive value to this multiple of it has colours of a logarithmic scale.
_WIDE = 100.0


def sweep_lines(result: SweepResult, measure: str, *, ax: Axes | None = None) -> Axes:
    """Draw a measure over the first variable; with two variables, a line for each second value.

    A variant that failed is a gap of its line, with a cross of the same colour below.

    Args:
        result: the result of ``kp.sweep``.
        measure: a measure of it.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such measure, or the variables do not fit such a figure.
    """
    values, shown = _scaled(result, measure)
    first, *others = result.variables
    x = in_unit(result, first.name)[0]
    of_lines, unit = in_unit(result, others[0].name) if others else (np.empty(0), "")
    lines = np.unique(of_lines)
    if len(others) > 1 or len(lines) > _LINES:
        raise ModelError(
            f"sweep_lines draws one variable, and up to {_LINES} values of a second",
            hint="use sweep_map or sweep_scatter",
        )
    with style.on(ax) as axes:
        chosen = [of_lines == level for level in lines] if others else [np.full(len(x), True)]
        for k, rows in enumerate(chosen):
            label = number(float(lines[k])) if others else ""
            _line(axes, x[rows], values[rows], k, label)
            _failed(axes, x[rows & ~result.succeeded], k)
        _axis(axes, "x", result, first)
        axes.set_ylabel(shown.axis(style.verbatim(signed(result, measure))))
        explained(axes, result, measure)
        failed = int((~result.succeeded).sum())
        if failed:
            axes.plot([], [], color="black", label=f"failed: {failed}", **_CROSS)
        if others:
            beside(axes)
            title = _labelled(style.short(others[0].name), unit)
            axes.get_legend().set_title(title)  # type: ignore[union-attr]
        elif failed:
            axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2)
        return axes


def _failed(axes: Axes, x: Floats, k: int) -> None:
    """Crosses near the lower edge, a row for each line, for its variants that failed."""
    if len(x):
        low, across = np.full(len(x), 0.03 * (k + 1)), axes.get_xaxis_transform()
        axes.plot(x, low, color=style.line(k)["color"], transform=across, **_CROSS)


def _line(axes: Axes, x: Floats, y: Floats, k: int, label: str = "") -> None:
    """One line; a variant that failed is a gap."""
    order = np.argsort(x, kind="stable")
    few = {"marker": style.MARKERS[k % len(style.MARKERS)]} if len(x) <= 30 else {}
    axes.plot(x[order], y[order], label=label, **{**style.line(k), **few})


def sweep_map(
    result: SweepResult,
    measure: str,
    x: str | None = None,
    y: str | None = None,
    *,
    ax: Axes | None = None,
) -> Axes:
    """Draw a measure over two variables as colours; variants that failed are crosses.

    A full grid is drawn as cells, any other design as points.

    Args:
        result: the result of ``kp.sweep``.
        measure: a measure of it.
        x: the variable to the right; the first one by default.
        y: the other variable; the second one by default.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such measure or variable.
    """
    names = [variable.name for variable in result.variables]
    if len(names) < 2:
        raise ModelError("sweep_map needs two variables", hint="use sweep_lines")
    across = _variable(result, x or next(name for name in names if name != y))
    up = _variable(result, y or next(name for name in names if name != across.name))
    values, shown = _scaled(result, measure)
    px, py = in_unit(result, across.name)[0], in_unit(result, up.name)[0]
    with style.on(ax, 100.0) as axes:
        drawn = _cells(axes, result, values, across, up) if len(names) == 2 else None
        if drawn is None:
            good = result.succeeded
            drawn = axes.scatter(px[good], py[good], c=values[good], s=9.0, **_colours(values))
        failed = ~result.succeeded
        if failed.any():
            axes.plot(
                px[failed],
                py[failed],
                "x",
                color="#C2184B",
                markersize=2.5,
                markeredgewidth=0.6,
                label=f"failed: {int(failed.sum())}",
            )
            axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2)
        _axis(axes, "x", result, across)
        _axis(axes, "y", result, up)
        axes.grid(visible=False)
        bar = axes.figure.colorbar(drawn, ax=axes, pad=0.02)
        bar.set_label(shown.axis(style.verbatim(signed(result, measure))))
        explained(axes, result, measure)
        return axes


def _cells(axes: Axes, result: SweepResult, values: Floats, across: Variable, up: Variable) -> Any:
    """The cells of a full grid; None for another design."""
    xs, at_x = np.unique(in_unit(result, across.name)[0], return_inverse=True)
    ys, at_y = np.unique(in_unit(result, up.name)[0], return_inverse=True)
    if len(xs) * len(ys) != len(result) or min(len(xs), len(ys)) < 2:
        return None
    table = np.full((len(ys), len(xs)), np.nan)
    table[at_y, at_x] = values
    edges = _edges(xs, across), _edges(ys, up)
    return axes.pcolormesh(*edges, np.ma.masked_invalid(table), rasterized=True, **_colours(values))


def _colours(values: Floats) -> dict[str, Any]:
    """The colours of a map: of a logarithmic scale for positive values over two decades."""
    from matplotlib.colors import LogNorm

    good = values[np.isfinite(values)]
    wide = len(good) > 0 and good.min() > 0.0 and good.max() > _WIDE * good.min()
    return {"cmap": MAP, "norm": LogNorm(good.min(), good.max()) if wide else None}


def _edges(levels: Floats, variable: Variable) -> Floats:
    """The borders of cells: halfway between the values on their scale."""
    on = np.log(levels) if variable.is_log else levels
    half = np.diff(on) / 2.0
    found = np.concatenate([[on[0] - half[0]], on[:-1] + half, [on[-1] + half[-1]]])
    return np.asarray(np.exp(found) if variable.is_log else found)


def sweep_histogram(
    result: SweepResult, measure: str, *, bins: int | None = None, ax: Axes | None = None
) -> Axes:
    """Draw how often the values of a measure occur, with mean and standard deviation.

    Args:
        result: the result of ``kp.sweep``.
        measure: a measure of it.
        bins: number of bars; about the square root of the number of variants by default.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such measure.
    """
    values, shown = _scaled(result, measure)
    good = values[np.isfinite(values)]
    with style.on(ax) as axes:
        if len(good):
            count = bins or int(np.clip(np.sqrt(len(good)), 5, 60))
            axes.hist(good, count, color=style.COLOURS[0], edgecolor="white", linewidth=0.4)
            mean, deviation = float(good.mean()), float(good.std())
            axes.axvline(mean, color="black", linewidth=1.0)
            for side in (-1.0, 1.0):
                axes.axvline(mean + side * deviation, color="black", linewidth=0.8, linestyle="--")
            told = f"{number(mean, 5)} ± {number(deviation, 3)} {shown.unit}, {len(good)} variants"
            titled(axes, style.verbatim(told), meaning(result, measure))
        axes.set_xlabel(shown.axis(style.verbatim(signed(result, measure))))
        axes.set_ylabel("variants / 1")
        return axes


def sweep_contributions(
    result: SweepResult | Tolerances, measure: str | None = None, *, ax: Axes | None = None
) -> Axes:
    """Draw the contribution of each variable to the scatter of a measure as bars.

    Args:
        result: the result of ``kp.sweep`` or ``kp.tolerances``.
        measure: a measure of a sweep; the first one by default.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such measure.
    """
    from kempe.sweeps import Tolerances
    from kempe.sweeps.contributions import contributions

    shares: Mapping[str, float]
    if isinstance(result, Tolerances):
        sample, name = result.sample, result.measure
        shares, told = result.contributions, "first order"
    else:
        sample, name = result, measure or result.measures[0]
        shares, told = contributions(result, name), "share of the variance"
    ordered = sorted(shares.items(), key=lambda item: item[1])
    with style.on(ax, max(35.0, 20.0 + 8.0 * len(ordered))) as axes:
        places = np.arange(len(ordered))
        axes.barh(places, [100.0 * x for _, x in ordered], color=style.COLOURS[0], height=0.6)
        axes.set_yticks(places, [style.short(label) for label, _ in ordered])
        for place, (_, x) in zip(places, ordered, strict=True):
            axes.annotate(
                f"{number(100.0 * x, 3)} %",
                (100.0 * x, place),
                (3, 0),
                va="center",
                textcoords="offset points",
                fontsize=8.0,
            )
        axes.set_xlim(0.0, 100.0)
        shown = style.verbatim(signed(sample, name))
        axes.set_xlabel(f"contribution to {shown} ({told}) / %")
        explained(axes, sample, name)
        axes.grid(visible=False, axis="y")
        return axes


def _variable(result: SweepResult, name: str) -> Variable:
    return entry("variable", name, {variable.name: variable for variable in result.variables})


def _scaled(result: SweepResult, measure: str) -> tuple[Floats, Scale]:
    """The values of a measure in the unit of its axis."""
    unit = entry("measure of the sweep", measure, result.units)
    values = result[measure]
    peak = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
    if unit == "rad":
        shown = display("rad", "°")
        return values / shown.divisor, Scale(shown.divisor, shown.symbol)
    shown_as = scale(unit, peak) if unit not in ("", "1") else Scale(1.0, "1")
    return values / shown_as.divisor, shown_as


def in_unit(result: SweepResult, column: str) -> tuple[Floats, str]:
    """A column in its display unit, and this unit; in SI units where none was chosen."""
    values, shown = result[column], display(result.units[column])
    return values / shown.divisor, shown.symbol


def _labelled(name: str, unit: str) -> str:
    return axis_label(name, [unit]) if unit else name


def _axis(axes: Axes, which: str, result: SweepResult, variable: Variable) -> None:
    """Label and scale of the axis of a variable, in its display unit."""
    label = _labelled(style.short(variable.name), in_unit(result, variable.name)[1])
    getattr(axes, f"set_{which}label")(label)
    if variable.is_log:
        getattr(axes, f"set_{which}scale")("log")
