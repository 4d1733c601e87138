"""The path of a point over the mechanism, with its length, its area and its cusps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.design.coupler_curve import CouplerCurve
from kempe.design.coupler_curve import coupler_curve as curve_of
from kempe.design.places import Place
from kempe.draw.scene import Scene, scene
from kempe.draw.units import Scale, number, scale
from kempe.plot import style
from kempe.plot.picture import drawn, paint
from kempe.results.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Number of parts into which the marks on the curve divide the motion.
_MARKS = 24
_HEIGHT = 110.0
_CURVE: dict[str, Any] = {"color": "#C2184B", "linewidth": 1.5, "zorder": 3.2}


def coupler_curve(solution: Solution, point: Place, *, ax: Axes | None = None) -> Axes:
    """Draw the path of a point over the mechanism at its start.

    Dots divide the motion into 24 parts of equal time, or of equal steps of the driven quantity.
    Diamonds mark cusps.

    Args:
        solution: the motion, such as a turn of the crank.
        point: a named point, "coupler.P", or a body with coordinates, ``("coupler", (0.1, 0.2))``.
        ax: where to; a figure of its own when None.

    Raises:
        ModelError: there is no such point, or it does not move.
    """
    curve = curve_of(solution, point)
    made = over(scene(solution.initial), curve.position)
    with style.on(ax, _HEIGHT) as axes:
        display = drawn(axes, made, title(curve))
        unit = made["length"]["metres"]
        x, y = curve.position.T / unit
        axes.plot(x, y, **_CURVE)
        places = np.linspace(0, len(x) - 1, _MARKS + 1).round().astype(int)
        axes.plot(x[places], y[places], ".", color="#C2184B", markersize=4.0, zorder=3.3)
        if len(curve.cusps):
            cx, cy = curve.cusp_positions.T / unit
            look: dict[str, Any] = {"color": "#C2184B", "markerfacecolor": "white", "zorder": 3.4}
            axes.plot(cx, cy, "D", markersize=4.5, **look)
        display.name_joints()
        paint(axes, display)
        return axes


def over(made: Scene, path: Floats) -> Scene:
    """A scene whose limits contain a path too."""
    low, high = np.array(made["bounds"]).reshape(2, 2)
    finite = path[np.isfinite(path).all(axis=1)]
    low = np.minimum(low, finite.min(axis=0, initial=np.inf))
    high = np.maximum(high, finite.max(axis=0, initial=-np.inf))
    return {**made, "bounds": [*map(float, low), *map(float, high)]}


def title(curve: CouplerCurve) -> str:
    """Such as ``Path of coupler.P: length 1.23 m, area −0.45 m²``."""
    unit = scale("m", curve.length)
    told = [f"length {number(curve.length / unit.divisor)} {unit.unit}"]
    if curve.area is not None:
        told.append(f"area {_area(curve, unit)}")
    if len(curve.cusps):
        told.append(f"{len(curve.cusps)} cusp{'s' if len(curve.cusps) > 1 else ''}")
    return f"Path of {style.short(curve.point, 40)}: {', '.join(told)}"


def _area(curve: CouplerCurve, unit: Scale) -> str:
    area = curve.area or 0.0
    if abs(area) < 1e-9 * curve.length**2:  # a rounding error of a line that runs back on itself
        area = 0.0
    return f"{number(area / unit.divisor**2)} {unit.unit}²"
