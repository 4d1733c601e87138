"""Pages of panels: places in mm, ranges, units, legend and note, by hand from the rules of a page.

A page is 160 mm wide. Axes have 19 mm to their left, 4 mm to their right, 7 mm above them with a
title and 2.5 mm without, and 11 mm for times below.
"""

import numpy as np
import pytest
from kempe.draw.units import Scale
from kempe.plot import style
from kempe.plot.curves import _limit, add_lines
from kempe.plot.grid import Sheet, sheet_figure
from kempe.plot.legend import above_or_beside, beside
from kempe.plot.panel import Curve, Panel
from kempe.plot.time_axis import TimeAxis
from matplotlib.axes import Axes
from matplotlib.figure import Figure

T = np.linspace(0.0, 1.0, 5)


def panel(low: float, high: float, *, title: str = "", unit: str = "N", lines: int = 1) -> Panel:
    values = np.linspace(low, high, 5)
    curves = [Curve(f"c{k}", values / (1.0 + k)) for k in range(lines)]
    return Panel("F", unit, curves, title)


def drawn(sheet: Sheet, cut: float | None = None, fixed: dict[str, Scale] | None = None) -> Figure:
    with style.applied():
        return sheet_figure(sheet, T, cut, fixed or {})


def height(figure: Figure) -> float:
    return float(figure.get_figheight()) * 25.4


def boxes(figure: Figure) -> list[tuple[float, ...]]:
    """Left and lower edge, width and height of the axes, mm."""
    size = np.array([160.0, height(figure)] * 2)
    return [tuple((np.array(axes.get_position().bounds) * size).round(9)) for axes in figure.axes]


def timed(figure: Figure) -> list[bool]:
    """Whether the numbers of the times are below the axes."""
    found = [bool(axes.get_xlabel()) for axes in figure.axes]
    for axes, label in zip(figure.axes, found, strict=True):
        assert axes.xaxis.get_tick_params()["labelbottom"] == label
    return found


def test_an_odd_last_panel_has_the_width_of_the_page() -> None:
    figure = drawn(Sheet([panel(0, 1, title=f"p{k}") for k in range(3)], 2, "A note."))
    # Rows of 7 + 26 + 11 mm; a note of 4 + 2 mm.
    assert height(figure) == pytest.approx(94.0)
    assert boxes(figure) == [(19, 61, 57, 26), (99, 61, 57, 26), (19, 17, 137, 26)]
    assert timed(figure) == [True, True, True]
    (note,) = figure.texts
    assert note.get_text() == "A note."
    assert np.array(note.get_position()) * [160, 94] == pytest.approx([2.5, 1.5])


def test_times_are_below_the_last_row_only() -> None:
    figure = drawn(Sheet([panel(0, 1, title="p" * (k < 2)) for k in range(4)], 2))
    assert height(figure) == pytest.approx(7 + 26 + 2.5 + 26 + 11)
    assert boxes(figure)[1::2] == [(99, 39.5, 57, 26), (99, 11, 57, 26)]
    assert timed(figure) == [False, False, True, True]
    one_column = drawn(Sheet([panel(0, 1) for _ in range(3)], 1))
    assert height(one_column) == pytest.approx(3 * 28.5 + 11)
    assert [box[1] for box in boxes(one_column)] == [68, 39.5, 11]
    assert timed(one_column) == [False, False, True]


def test_a_panel_that_is_alone_is_high() -> None:
    figure = drawn(Sheet([panel(0, 1)], 1))
    assert height(figure) == pytest.approx(2.5 + 57 + 11)
    assert boxes(figure) == [(19, 11, 137, 57)]
    two = drawn(Sheet([panel(0, 1), panel(0, 1)], 2))
    assert boxes(two) == [(19, 11, 57, 26), (99, 11, 57, 26)]


def test_one_legend_is_above_all_panels() -> None:
    figure = drawn(Sheet([panel(0, 1), panel(0, 1, lines=5), panel(0, 1)], 1, legend=True))
    # Five names make two rows of 5 mm.
    assert height(figure) == pytest.approx(10 + 3 * 28.5 + 11)
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == [f"c{k}" for k in range(5)]
    assert legend._ncols == 4
    figure.canvas.draw()
    box = legend.get_window_extent().transformed(figure.transFigure.inverted())
    assert box.x1 * 160.0 == pytest.approx(156.0, abs=2.5)
    assert (1.0 - box.y1) * height(figure) == pytest.approx(0.0, abs=2.5)
    four = drawn(Sheet([panel(0, 1, lines=3)], 1, legend=True))
    assert height(four) == pytest.approx(5 + 2.5 + 57 + 11)
    assert four.legends[0]._ncols == 3
    assert not drawn(Sheet([panel(0, 1, lines=3)], 1)).legends


def test_a_long_note_has_several_lines_from_the_bottom() -> None:
    words = " ".join(["word"] * 40)
    figure = drawn(Sheet([panel(0, 1)], 1, words))
    lines = sorted(figure.texts, key=lambda text: -text.get_position()[1])
    assert " ".join(text.get_text() for text in lines) == words
    assert len(lines) == 3
    assert max(len(text.get_text()) for text in lines) == 94  # 19 words; 20 have 99 letters
    assert height(figure) == pytest.approx(70.5 + 3 * 4 + 2)
    places = [text.get_position()[1] * height(figure) for text in lines]
    assert places == pytest.approx([9.5, 5.5, 1.5])
    assert drawn(Sheet([], 1, "Nothing.")).texts[0].get_text() == "Nothing."


def test_panels_of_one_unit_share_a_scale_and_on_request_a_range() -> None:
    sheet = [panel(0, 1), panel(-3000, 500), panel(0, 0.02, unit="m")]
    apart = drawn(Sheet(sheet, 1)).axes
    labels = [axes.get_ylabel() for axes in apart]
    assert labels == ["F / kN", "F / kN", "F / mm"]
    assert apart[0].get_ylim() != apart[1].get_ylim()
    together = drawn(Sheet(sheet, 1, shared=True)).axes
    # 17 points of 26 mm are kept free above and below −3 to 0.5 kN.
    room = 17.0 / (26.0 / 25.4 * 72.0)
    whole = 3.5 / (1.0 - 2.0 * room)
    for axes in together[:2]:
        assert axes.get_ylim() == pytest.approx((-3.0 - room * whole, 0.5 + room * whole))
    fixed = drawn(Sheet(sheet, 1), fixed={"m": Scale(0.01, "cm")}).axes
    assert fixed[2].get_ylabel() == "F / cm"
    np.testing.assert_allclose(fixed[2].lines[0].get_ydata(), np.linspace(0, 2, 5))


def test_all_panels_are_compressed_after_the_same_time() -> None:
    figure = drawn(Sheet([panel(0, 1), panel(0, 1)], 1), cut=0.25)
    for axes in figure.axes:
        share = axes.transAxes.inverted().transform(axes.transData.transform((0.25, 0.0)))[0]
        assert share == pytest.approx(0.72)


def axes(high: float = 40.0) -> Axes:
    with style.applied():
        return style.axes_at(style.figure(90.0, layout=None), (20.0, 15.0, 100.0, high), 90.0)


ROOM = 17.0 / (40.0 / 25.4 * 72.0)  # for a peak, of axes of 40 mm


@pytest.mark.parametrize(
    ("span", "sides", "shared", "below", "above"),
    [
        ((-1.0, 3.0), [], False, 0.06, 0.06),
        ((-1.0, 3.0), [1], False, 0.06, ROOM),
        ((-1.0, 3.0), [-1], False, ROOM, 0.06),
        ((-1.0, 3.0), [-1, 1], False, ROOM, ROOM),
        ((-1.0, 3.0), [], True, ROOM, ROOM),
    ],
)
def test_the_range_leaves_room_for_peaks(
    span: tuple[float, float], sides: list[int], shared: bool, below: float, above: float
) -> None:
    found = axes()
    _limit(found, span, 0.5, sides, shared)
    low, high = found.get_ylim()
    share = [(2.0 * span[0] - low) / (high - low), (high - 2.0 * span[1]) / (high - low)]
    assert share == pytest.approx([below, above])


def test_the_range_of_constants_and_of_low_axes() -> None:
    found = axes()
    _limit(found, (-9e-10, 5e-10), 1e-3, [], False)
    assert found.get_ylim() == pytest.approx((-1.0 - 2 * 0.06 / 0.88, 1.0 + 2 * 0.06 / 0.88))
    _limit(found, (-4.0, -4.0 + 3.9e-6), 1.0, [], False)
    room = 0.8 * 0.06 / 0.88
    assert found.get_ylim() == pytest.approx((-4.4 - room, -3.6 + room), abs=1e-5)
    _limit(found, (-4.0, -4.0 + 4.1e-6), 1.0, [], False)
    assert np.diff(found.get_ylim()) == pytest.approx(4.1e-6 / 0.88)
    low = axes(10.0)
    _limit(low, (0.0, 3.0), 1.0, [1, -1], False)
    assert low.get_ylim() == pytest.approx((-3.5, 6.5))  # at most 35 % above and below


def test_few_times_are_drawn_as_points() -> None:
    for count, marker in ((1, "o"), (2, "o"), (3, "None")):
        found, t = axes(), np.linspace(0.0, 0.02, count)
        curves = [Curve("a", 2.0 * t, {"color": "r"}), Curve("b", 3.0 * t)]
        add_lines(found, t, curves, time=TimeAxis.of(t + 0.0), divisor=0.1)
        one, other = found.lines
        assert one.get_marker() == other.get_marker() == marker
        np.testing.assert_allclose(one.get_ydata(), 20.0 * t)
        np.testing.assert_allclose(other.get_ydata(), 30.0 * t)
        unit = 1.0 if count == 1 else 1e-3
        np.testing.assert_allclose(one.get_xdata(), t / unit)
        assert (one.get_color(), other.get_color()) == ("r", style.line(1)["color"])
        assert other.get_linestyle() == style.line(1)["linestyle"]


@pytest.mark.parametrize(
    ("labels", "place"),
    [
        (["a"], "none"),
        (["a", "b"], "above"),
        (list("abcde"), "above"),
        (list("abcdef"), "beside"),
        (["x" * 30, "y" * 30], "above"),
        (["x" * 30, "y" * 31], "beside"),
    ],
)
def test_a_legend_is_above_or_beside_the_panel(labels: list[str], place: str) -> None:
    found = axes()
    for label in labels:
        found.plot([0, 1], [0, 1], label=label)
    above_or_beside(found)
    legend = found.get_legend()
    if place == "none":
        assert legend is None
        return
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == labels
    assert legend._ncols == (len(labels) if place == "above" else 1)
    found.figure.canvas.draw()
    box = legend.get_window_extent().transformed(found.transAxes.inverted())
    if place == "above":
        assert box.y0 == pytest.approx(1.0, abs=0.06)
        assert box.x1 == pytest.approx(1.0, abs=0.06)
    else:
        assert box.x0 == pytest.approx(1.0, abs=0.06)
        assert box.y1 == pytest.approx(1.0, abs=0.08)


@pytest.mark.parametrize(("count", "columns"), [(1, 1), (15, 1), (16, 2), (32, 3)])
def test_a_long_legend_beside_has_columns(count: int, columns: int) -> None:
    found = axes()
    for k in range(count):
        found.plot([0, 1], [0, 1], label=str(k))
    beside(found, "head")
    legend = found.get_legend()
    assert legend is not None
    assert legend._ncols == columns
    assert legend.get_title().get_text() == "head"
    empty = axes()
    beside(empty)
    assert empty.get_legend() is None
