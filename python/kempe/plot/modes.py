"""Modes: their shapes over the mechanism at rest, and their eigenvalues."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.analyses.mode_shape import ModeShape
from kempe.analyses.modes import ModesResult
from kempe.draw.items import Item
from kempe.draw.oscillation import bounds_of
from kempe.draw.scene import Scene, scene
from kempe.draw.units import number
from kempe.plot import style
from kempe.plot.page import Page
from kempe.plot.picture import drawn

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Most shapes that are drawn, and those among the key figures.
_MOST, _KEY = 12, 3
#: Share of white of the mechanism at rest.
_RESTING = 0.55


def mode_pages(result: ModesResult, _: int = 1) -> list[Page]:
    """The figures of modes: the shape of each, and the eigenvalues."""
    moving = [k for k in range(len(result.eigenvalues)) if np.any(result.shapes[k])]

    def page(k: int) -> Page:
        about = f"shape of mode {k + 1}"
        return Page(0, f"mode_{k + 1}", about, lambda: _shape(result.shape(k)), k < _KEY)

    pages = [page(k) for k in moving[:_MOST]]
    if len(result.eigenvalues):
        pages.append(Page(0, "eigenvalues", "eigenvalues", lambda: _eigenvalues(result)))
    return pages


def mode_shape(shape: ModeShape, *, ax: Axes | None = None) -> Axes:
    """Draw a mode: the mechanism at one end of its motion, and at rest in grey.

    Args:
        shape: ``modes.shape(0)``.
        ax: where to; a figure of its own when None.
    """
    with style.on(ax) as axes:
        scenes = [scene(state) for state in (shape.state, shape.at(0.0))]
        bounds = bounds_of(scenes)
        for shown, resting in zip(scenes, (True, False), strict=True):
            _paint(axes, {**shown, "bounds": bounds}, _title(shape), resting=resting)
        return axes


def _paint(axes: Axes, shown: Scene, title: str, *, resting: bool) -> None:
    from kempe.draw.painter import Painting

    made = drawn(axes, shown, title)
    found: list[Item] = made.finish()
    if resting:
        white = [_RESTING + (1.0 - _RESTING) * item["tint"] for item in found]
        pairs = zip(found, white, strict=True)
        found = [{**item, "colour": "quiet", "tint": tint} for item, tint in pairs]
    Painting(axes, found, made.first, shown["length"]["metres"])


def _title(shape: ModeShape) -> str:
    s, about = shape.eigenvalue, f"Mode {shape.number + 1}"
    if s.imag > 0.0:
        ratio = -s.real / abs(s) + 0.0
        return f"{about}: {number(s.imag / (2.0 * np.pi))} Hz, damping ratio {number(ratio, 3)}"
    return f"{about}: s = {number(s.real)} 1/s"


def _shape(shape: ModeShape) -> Figure:
    with style.on(None) as axes:
        mode_shape(shape, ax=axes)
        found: Figure = axes.figure  # type: ignore[assignment]
        return found


def _eigenvalues(result: ModesResult) -> Figure:
    """All eigenvalues in the complex plane."""
    with style.on(None) as axes:
        s = result.eigenvalues
        pairs = np.concatenate([s, s[s.imag > 0.0].conj()])
        axes.axvline(0.0, color="#888888", linewidth=0.8)
        axes.plot(pairs.real, pairs.imag, "x")
        axes.set_title("Eigenvalues", loc="left")
        axes.set_xlabel("real part / (1/s)")
        axes.set_ylabel("imaginary part / (rad/s)")
        found: Figure = axes.figure  # type: ignore[assignment]
        return found
