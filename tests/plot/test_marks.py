"""Marks of events in figures over time, and the horizontal axis of design figures."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import plot
from kempe.draw.units import Scale
from kempe.plot.abscissa import Abscissa, abscissa
from kempe.plot.marks import mark_events
from kempe.results.variable import TIME, Variable
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D


def rod(law: str, t_end: float, **options: Any) -> kp.Solution:
    """A driven rod."""
    m = kp.Model("rod")
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    m.coordinate_driver("motor", "rod.angle", value=law)
    return kp.dynamics(m, kp.assemble(m), t_end=t_end, **options)


def marked(sol: kp.Solution, left: float, right: float, *heights: float) -> Figure:
    """Panels with a curve between two numbers of the axis, and below them one without a curve."""
    figure = Figure()
    for height in heights:
        axes = figure.add_axes((0.1, height, 0.8, 0.15))
        axes.plot([left, right], [1.0, 2.0])
        axes.set_xlim(left, right)
    figure.add_axes((0.1, 0.05, 0.8, 0.1))
    mark_events(figure, sol)
    figure.draw_without_rendering()
    return figure


def lines(axes: Axes) -> list[Line2D]:
    return axes.lines[1:] if axes.lines else []


def test_an_event_has_lines_in_all_panels_and_its_name_at_the_first_in_the_upper_one() -> None:
    sol = rod("t", 1.0, events={"half": "sin(2*pi*t/0.5 - 0.5)"})
    times = [0.25 * (k + 0.5 / np.pi) for k in range(4)]
    figure = marked(sol, 0.0, 1.0, 0.3, 0.6)
    low, high, empty = figure.axes
    for axes in (low, high):
        assert [float(line.get_xdata()[0]) for line in lines(axes)] == pytest.approx(times)
        assert {line.get_linestyle() for line in lines(axes)} == {"-"}
        for line in lines(axes):  # thinner than the curve and below it
            assert line.get_linewidth() < axes.lines[0].get_linewidth()
            assert line.zorder < axes.lines[0].zorder
    assert not empty.lines
    assert [len(axes.texts) for axes in figure.axes] == [0, 1, 0]
    name = high.texts[0]
    box, inside = name.get_window_extent(), high.get_window_extent()
    at = high.transData.transform((times[0], 1.0))[0]
    points = 72.0 / figure.dpi
    assert name.get_text() == "half"
    beside = (box.x0 - at) * points
    assert 0.0 < beside < 4.0
    assert (inside.y1 - box.y1) * points == pytest.approx(beside)  # as far from the upper edge
    assert box.height > 1.5 * box.width  # it is written upwards
    assert name.get_color() == lines(high)[0].get_color()


def test_marks_follow_the_unit_of_the_axis_and_stay_within_it() -> None:
    sol = rod("100*t", 0.01, events={"third": "t - 0.01/3"})
    figure = marked(sol, 10.0, 0.0, 0.5)  # in ms, from right to left
    (line,) = lines(figure.axes[0])
    assert float(line.get_xdata()[0]) == pytest.approx(10.0 / 3.0)
    assert figure.axes[0].texts[0].xy[0] == pytest.approx(10.0 / 3.0)
    assert not lines(marked(sol, 4.0, 10.0, 0.5).axes[0])
    assert not lines(marked(sol, 0.0, 3.0, 0.5).axes[0])


@pytest.mark.parametrize("count", [40, 41])
def test_an_event_that_occurs_more_than_forty_times_is_not_drawn(count: int) -> None:
    sol = rod("t", (count - 0.5) / 100, events={"often": "sin(100*pi*(t - 0.001))"})
    assert len(sol.events["often"].t) == count
    axes = marked(sol, 0.0, 1000.0, 0.5).axes[0]
    assert len(lines(axes)) == len(axes.texts) * 40 == (40 if count == 40 else 0)


def test_a_figure_without_curves_has_no_marks() -> None:
    figure = marked(rod("t", 1.0, events={"half": "t - 0.5"}), 0.0, 1.0)
    assert all(not axes.lines and not axes.texts for axes in figure.axes)


# --- the horizontal axis of design figures --------------------------------------------------------


def test_a_number_on_the_axis_is_interpolated_in_its_unit_in_both_directions_of_time() -> None:
    t, degrees = np.array([0.0, 1.0, 3.0]), Scale(np.pi / 180, "°")
    for order in (slice(None), slice(None, None, -1)):
        axis = Abscissa(Variable("a", "rad"), t[order], np.radians([-10, 20, 40])[order], degrees)
        assert axis.shown == pytest.approx(np.array([-10.0, 20.0, 40.0])[order])
        assert axis.at(2.0) == pytest.approx(30.0)
        assert axis.words(2.0) == "30°"
        assert axis.words(0.0) == "−10°"
        assert axis.words(1 / 3 + 1e-7) == "0°"  # a zero is found to rounding
        assert axis.words(1 / 3 + 1e-4) == "0.003°"


def test_a_number_of_another_unit_is_apart_from_it() -> None:
    t = np.array([0.0, 0.004])
    assert Abscissa(TIME, t, t, Scale(1e-3, "ms")).words(0.0025) == "2.5 ms"
    assert Abscissa(TIME, t, t, Scale(1e-3, "ms")).words(4e-3 * 1.5e-6) == "6·10⁻⁶ ms"


@pytest.mark.parametrize(
    ("law", "over", "chosen"),
    [
        ("2*t", None, "rod.angle"),
        ("-2*t", None, "rod.angle"),
        ("sin(4*t)", None, "t"),
        ("sin(4*t)", "rod.angle", "rod.angle"),
        ("2*t", "t", "t"),
        ("0.7", None, "t"),
    ],
)
def test_the_axis_is_the_angle_of_a_crank_that_turns_in_one_direction(
    law: str, over: str | None, chosen: str
) -> None:
    sol = rod(law, 1.0)
    axis = abscissa(sol, over)
    assert axis.variable.name == chosen
    expected = axis.t if chosen == "t" else sol(axis.t)["rod.angle"]
    np.testing.assert_array_equal(axis.values, expected)
    divisor, unit = (1.0, "s") if chosen == "t" else (np.pi / 180, "°")
    assert (axis.unit.divisor, axis.unit.unit) == (pytest.approx(divisor), unit)
    axes = plot.effort(sol, "motor", over=over)
    ends = np.array([axis.shown.min(), axis.shown.max()])
    assert sorted(axes.get_xlim()) == pytest.approx(sorted(ends), abs=1e-9)


def test_two_drivers_or_a_released_one_leave_the_time() -> None:
    m = kp.Model("two")
    m.ground.points(O=(0, 0))
    for k, law in enumerate(("t", "2*t")):
        m.bar(f"rod{k}", mass=1, length=1, ends=("O", "P"))
        m.revolute(f"pin{k}", "ground.O", f"rod{k}.O")
        m.coordinate_driver(f"motor{k}", f"rod{k}.angle", value=law)
    start = kp.assemble(m)
    assert abscissa(kp.dynamics(m, start, t_end=0.1)).variable == TIME
    assert abscissa(rod("t", 1.0, release=["motor"])).variable == TIME
