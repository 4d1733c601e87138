"""Which peaks are marked, and where circle and text are."""

from typing import Any

import numpy as np
import pytest
from kempe.draw.units import Scale
from kempe.plot import style
from kempe.plot.panel import Curve
from kempe.plot.peaks import add_peaks, chosen_peaks, peak_text
from kempe.results.extrema import Extreme
from matplotlib.axes import Axes

SECONDS = Scale(1.0, "s")


def curve(low: float, high: float, values: tuple[float, ...] = (), colour: str = "") -> Curve:
    """A curve whose least value is at 1 s and its largest one at 2 s."""
    line = {"color": colour} if colour else {}
    ends = np.array(values or (low, high))
    return Curve("F", ends, line, Extreme(high, 2.0), Extreme(low, 1.0))


def told(curves: list[Curve], turning_points: bool = False) -> list[tuple[float, int, Any]]:
    chosen = chosen_peaks(curves, turning_points=turning_points)
    return [(extreme.value, side, colour) for extreme, side, colour in chosen]


def test_the_smaller_of_two_opposite_peaks_is_marked_from_three_tenths_on() -> None:
    first = style.line(0)["color"]
    high, low = (2.0, 1, first), (-0.6, -1, first)
    assert told([curve(-0.59, 2.0)]) == [high]
    assert told([curve(-0.6, 2.0)]) == [high, low]
    assert told([curve(-2.0, 0.59)]) == [(-2.0, -1, first)]
    assert told([curve(-2.0, 0.6)]) == [(0.6, 1, first), (-2.0, -1, first)]


def test_of_several_curves_one_peak_is_marked_on_its_side() -> None:
    small, rising, falling = curve(-1.0, 1.5, colour="g"), curve(0.0, 3.0), curve(-4.0, 2.0)
    second = style.line(1)["color"]
    assert told([small, rising]) == [(3.0, 1, second)]
    assert told([small, falling]) == [(-4.0, -1, second)]
    assert told([falling, small]) == [(-4.0, -1, style.line(0)["color"])]
    assert told([curve(-1.0, 5.0, colour="g"), falling]) == [(5.0, 1, "g")]


def test_curves_without_peaks_are_passed_over() -> None:
    constant, unknown = curve(3.0, 3.0), Curve("x", np.zeros(2))
    third = style.line(2)["color"]
    assert told([constant]) == told([unknown]) == told([]) == []
    assert told([unknown, constant, curve(0.0, 1.0)]) == [(1.0, 1, third)]


def test_turning_points_are_not_those_at_the_ends() -> None:
    assert told([curve(-1.0, 2.0, (-1.0, 0.5, 2.0))], turning_points=True) == []
    low, high = told([curve(-1.0, 2.0, (0.0, 2.0, -1.0, 0.3))], turning_points=True)
    assert (low[0], high[0]) == (2.0, -1.0)
    assert [one[0] for one in told([curve(-1.0, 2.0, (-1.0, 2.0, 0.3))], True)] == [2.0]
    assert [one[0] for one in told([curve(-1.0, 2.0, (0.3, -1.0, 2.0))], True)] == [-1.0]


@pytest.mark.parametrize(
    ("value", "t", "words"),
    [
        (-12345.0, 0.42, "−12.35 kN at 420 ms"),
        (1.0, 0.0, "0.001 kN at 0 ms"),
        (-1e-7, 1.23456, "−1·10⁻¹⁰ kN at 1235 ms"),
    ],
)
def test_a_text_has_value_and_time_with_units(value: float, t: float, words: str) -> None:
    assert peak_text(Extreme(value, t), Scale(1e3, "kN"), Scale(1e-3, "ms")) == words


def marked(*peaks: tuple[float, float, int]) -> Axes:
    """Axes of 100 mm × 40 mm from 0 to 10 s and from -5 to 5 kN with peaks in N."""
    with style.applied():
        axes = style.axes_at(style.figure(60.0, layout=None), (20.0, 10.0, 100.0, 40.0), 60.0)
        axes.set_xlim(0.0, 10.0)
        axes.set_ylim(-5.0, 5.0)
        marks = [(Extreme(1e3 * y, x), side, "#0072B2") for x, y, side in peaks]
        add_peaks(axes, marks, Scale(1e3, "kN"), SECONDS)
        axes.figure.canvas.draw()
    return axes


def test_a_circle_is_on_the_peak_and_its_text_four_points_beside_it() -> None:
    axes = marked((4.0, 3.0, 1), (6.0, -2.0, -1))
    points = 72.0 / axes.figure.dpi
    for circle, text, (x, y, side) in zip(
        axes.collections, axes.texts, ((4.0, 3.0, 1), (6.0, -2.0, -1)), strict=True
    ):
        assert [tuple(row) for row in circle.get_offsets()] == [(x, y)]
        assert circle.get_edgecolor()[0] == pytest.approx((0, 0x72 / 255, 0xB2 / 255, 1))
        assert circle.get_facecolor()[0] == pytest.approx((1, 1, 1, 1))
        assert text.get_text() == f"{y:.4g} kN at {x:.4g} s".replace("-", "−")
        box = text.get_window_extent()
        across, up = axes.transData.transform((x, y))
        assert (box.x0 + box.x1) / 2.0 == pytest.approx(across, abs=1.0)
        near = box.y0 if side > 0 else box.y1
        assert points * (near - up) == pytest.approx(4.0 * side, abs=0.6)


def test_a_text_at_an_edge_ends_two_points_beside_it() -> None:
    axes = marked((0.0, 3.0, 1), (10.0, -2.0, -1), (9.9, 0.0, 1))
    first, last, near = (text.get_window_extent() for text in axes.texts)
    inset = 2.0 * axes.figure.dpi / 72.0
    assert first.x0 - axes.bbox.x0 == pytest.approx(inset, abs=2.0)
    assert axes.bbox.x1 - last.x1 == pytest.approx(inset, abs=2.0)
    assert axes.bbox.x1 - near.x1 == pytest.approx(inset, abs=2.0)
