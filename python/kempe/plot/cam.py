"""Cams: lift, velocity, acceleration and jerk; profile; pressure angle; radius of curvature."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.design.cams import Cam
from kempe.draw.units import number, scale
from kempe.model.values import instance
from kempe.plot import style
from kempe.plot.page import Page
from kempe.plot.ticks import DEGREES, set_ticks

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Height, mm; the colours of undercut and of recommended pressure angles.
_HEIGHT, _BAD, _GOOD = 150.0, "#F6DDE4", "#E8F4EE"
_THIN: dict[str, Any] = {"color": "#888888", "linewidth": 0.7, "linestyle": "--"}
_SYMBOLS = ("s", "v", "a", "j")
#: Radii of curvature above this multiple of the base radius are beyond the axes.
_FAR = 4.0


def cam(of: Cam) -> Figure:
    """Draw diagrams of a cam and its profile.

    At the left: lift, velocity, acceleration and jerk over the angle of the cam, at its speed. At
    the right: the profile with the base circle, and the roller, edge or face at the angle 0; the
    pressure angle with the recommended range; the radius of curvature of the profile. Undercut
    angles are shaded.

    Args:
        of: the cam, of ``kp.design.cam``.

    Returns:
        The figure, without a window.
    """
    instance(of, Cam, "a cam of kp.design.cam")
    with style.applied():
        made = style.figure(_HEIGHT)
        grid = made.add_gridspec(4, 2, width_ratios=(1.0, 1.15))
        left = [made.add_subplot(grid[k, 0]) for k in range(4)]
        profile = made.add_subplot(grid[:2, 1])
        below = [made.add_subplot(grid[k, 1]) for k in (2, 3)]
        _diagrams(left, of)
        _profile(profile, of)
        _pressure(below[0], of)
        _radius(below[1], of)
        for axes in (*left, *below):
            _over_angle(axes, of, last=axes in (left[-1], below[-1]))
    return made


def cam_pages(of: Cam) -> list[Page]:
    """The figure that ``kempe cam`` writes."""
    return [Page(0, "cam", "cam", lambda: cam(of), key=True)]


def _over_angle(axes: Axes, of: Cam, *, last: bool) -> None:
    """The axis of the cam's angle, with undercut angles."""
    for first, end in of.undercut:
        axes.axvspan(np.degrees(first), np.degrees(end), color=_BAD, linewidth=0.0, zorder=0.3)
    axes.set_xlim(0.0, 360.0)
    set_ticks(axes.xaxis, DEGREES)
    axes.tick_params(labelsize=7, labelbottom=last)
    axes.yaxis.label.set_fontsize(8)
    if last:
        axes.set_xlabel("angle of the cam / °", fontsize=8)


def _diagrams(panels: list[Axes], of: Cam) -> None:
    angle, rows = of.programme.sampled()
    for order, (axes, symbol) in enumerate(zip(panels, _SYMBOLS, strict=True)):
        values = rows[order] * of.drive.speed**order
        per = "" if order == 0 else "/s" if order == 1 else f"/s{'²³'[order - 2]}"
        unit = scale(of.programme.unit + per, float(np.abs(values).max()))
        axes.plot(np.degrees(angle), values / unit.divisor, **style.line(0))
        axes.set_ylabel(unit.axis(symbol))
        if order:
            axes.axhline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
    rate = of.drive.speed / (2.0 * np.pi) * 60.0
    panels[0].set_title(f"Motion at {number(rate)} rpm", loc="left")


def _profile(axes: Axes, of: Cam) -> None:
    size = float(np.hypot(*of.pitch.T).max())
    unit = scale("m", size)
    curves = {"profile": of.profile}
    if of.closure == "groove":
        curves["outer wall"] = of.outer
    if of.closure == "conjugate":
        curves["conjugate"] = of.conjugate
    for k, (name, curve) in enumerate(curves.items()):
        axes.plot(*_closed(curve).T / unit.divisor, label=name, zorder=3.0, **style.line(k))
    around = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 181)) / unit.divisor
    base = of.follower.base * around
    axes.plot(base.real, base.imag, label="base circle", **_THIN)
    if of.follower.kind == "roller":
        axes.plot(*_closed(of.pitch).T / unit.divisor, color="#BBBBBB", lw=0.9, label="pitch curve")
        ring = of.follower.roller * around + complex(*of.pitch[0]) / unit.divisor
        axes.plot(ring.real, ring.imag, color="#C2184B", linewidth=1.0, zorder=3.2, label="roller")
    else:
        _edge(axes, of, unit.divisor)
    axes.plot(0.0, 0.0, "+", color="#000000", markersize=7.0)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(f"x / {unit.unit}", fontsize=8)
    axes.set_ylabel(f"y / {unit.unit}", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7, handlelength=1.6)
    turn = "clockwise" if of.clockwise else "counter-clockwise"
    axes.set_title(f"Profile at 0°; turns {turn}", loc="left")


def _edge(axes: Axes, of: Cam, divisor: float) -> None:
    """The tip of a knife, or a piece of a flat face, at the angle 0."""
    contact, normal = complex(of.shape.profile[0]), complex(of.shape.normal[0])
    half = 0.8 * of.follower.base
    ends = [contact - 1j * normal * half, contact + 1j * normal * half]
    if of.follower.kind == "knife":
        far = contact + 0.6 * half * normal
        ends = [far - 0.25j * half * normal, contact, far + 0.25j * half * normal]
    line = np.array(ends) / divisor
    axes.plot(line.real, line.imag, color="#C2184B", lw=1.2, zorder=3.2, label=of.follower.kind)


def _closed(curve: Floats) -> Floats:
    return np.vstack([curve, curve[:1]])


def _pressure(axes: Axes, of: Cam) -> None:
    good = 30.0 if of.follower.arm is None else 35.0
    axes.axhspan(-good, good, color=_GOOD, linewidth=0.0, zorder=0.2)
    for k, shape in enumerate(filter(None, (of.shape, of.second))):
        axes.plot(np.degrees(of.angle), np.degrees(shape.pressure), **style.line(k))
    axes.axhline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
    most = max(1.25 * good, 1.1 * np.degrees(of.largest_pressure_angle))
    axes.set_ylim(-min(most, 90.0), min(most, 90.0))
    set_ticks(axes.yaxis, DEGREES)
    axes.set_ylabel("pressure angle / °")


def _radius(axes: Axes, of: Cam) -> None:
    unit = scale("m", _FAR * of.follower.base)
    for k, shape in enumerate(filter(None, (of.shape, of.second))):
        shown = np.where(
            np.abs(shape.radius) > 10.0 * _FAR * of.follower.base, np.nan, shape.radius
        )
        axes.plot(np.degrees(of.angle), shown / unit.divisor, **style.line(k))
    axes.axhline(0.0, color="#888888", linewidth=0.7, zorder=0.5)
    far = _FAR * of.follower.base / unit.divisor
    low = float(np.nanmin(of.shape.radius)) / unit.divisor
    axes.set_ylim(max(min(1.1 * low, -0.1 * far), -far), far)
    axes.set_ylabel(f"radius / {unit.unit}")
