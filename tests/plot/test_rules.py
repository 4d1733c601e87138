"""Rules of figures: left-out panels, envelopes, ticks, frames of drawings, style, gaps."""

import math
from dataclasses import FrozenInstanceError
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import plot
from kempe.draw.units import Scale
from kempe.model.drawing import measured
from kempe.plot import drawing_pages, style
from kempe.plot.envelope import BINS, draw_envelope, envelope, logarithmic
from kempe.plot.panel import Curve, Panel
from kempe.plot.picture import frame
from kempe.plot.still import drawn_and_left_out, largest_values
from kempe.plot.study_gaps import joint_gaps, magnification
from kempe.plot.ticks import labels, set_ticks
from matplotlib.axes import Axes
from plot.conftest import chain

RAMP = np.linspace(0.0, 1.0, 11)


def panel(name: str, *values: np.ndarray, unit: str = "N") -> Panel:
    return Panel("F", unit, [Curve("c", one) for one in values], name=name)


def told(*panels: Panel, **largest: float) -> tuple[list[str], str]:
    kept, note = drawn_and_left_out(panels, largest, {"m": Scale(1e-3, "mm")})
    return [one.name for one in kept], note


# --- panels without information -------------------------------------------------------------------


def test_zero_is_judged_by_the_largest_value_of_its_kind() -> None:
    other = panel("b", RAMP)
    assert told(panel("a", 1e-7 * RAMP), other, N=100.0) == (["b"], "Not drawn: a (zero).")
    assert told(panel("a", 1.01e-7 * RAMP), other, N=100.0) == (["a", "b"], "")
    assert told(panel("a", 1e-7 * RAMP), other, m=100.0) == (["a", "b"], "")
    assert told(panel("a", 0.0 * RAMP), other) == (["b"], "Not drawn: a (zero).")


def test_constants_are_told_with_their_value_and_unit() -> None:
    other, flat = panel("b", RAMP), np.full(11, -0.25)
    assert told(panel("a", flat), other) == (["b"], "Not drawn: a = −0.25 N (constant).")
    assert told(panel("a", 10 * flat, unit="m"), other) == (
        ["b"],
        "Not drawn: a = −2500 mm (constant).",
    )
    nearly = 4.0 + 3.9e-6 * RAMP
    assert told(panel("a", nearly), other) == (["b"], "Not drawn: a = 4 N (constant).")
    assert told(panel("a", 4.0 + 4.1e-6 * RAMP), other) == (["a", "b"], "")
    assert told(panel("a", flat, RAMP), other)[0] == ["a", "b"]
    assert told(panel("a", flat)) == (["a"], "")
    assert told(panel("a", flat), panel("z", 0 * RAMP), panel("c", 2 * flat)) == (
        ["a", "c"],
        "Not drawn: z (zero).",
    )


def test_a_page_has_a_panel_at_least() -> None:
    zeros = [panel(name, 0.0 * RAMP) for name in "abc"]
    assert told(*zeros) == (["a"], "Not drawn: b, c (zero).")
    assert told(zeros[0]) == (["a"], "")
    assert told() == ([], "")
    # A mass that moves along x only: its y and its angle are zero.
    m = kp.Model("mass", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    start = kp.assemble(m, set={"mass.x": 1.0, "mass.vx": 2.0})
    solution = kp.dynamics(m, start, t_end=1.0, output_step=0.1)
    for page in plot.pages(solution):
        found = page.figure()
        assert found.axes, page.stem
        if page.name == "y":
            assert list(found.axes[0].lines[0].get_ydata()) == pytest.approx(
                np.zeros(len(found.axes[0].lines[0].get_ydata()))
            )


def test_equal_panels_are_drawn_once() -> None:
    one, same = panel("a", RAMP, 2 * RAMP), panel("b", RAMP, 2 * RAMP + 1.9e-9)
    assert told(one, same) == (["a"], "Not drawn: b (equal to a).")
    assert told(one, panel("b", RAMP, 2 * RAMP + 2.1e-9))[0] == ["a", "b"]
    assert told(one, panel("b", RAMP + 1e-3, 2 * RAMP))[0] == ["a", "b"]
    assert told(one, panel("b", RAMP))[0] == ["a", "b"]
    assert told(one, panel("b", RAMP, 2 * RAMP, unit="J"))[0] == ["a", "b"]
    assert told(
        one, panel("z", 0 * RAMP), panel("y", 0 * RAMP), panel("k", 3 + 0 * RAMP), same
    ) == (["a"], "Not drawn: z, y (zero); k = 3 N (constant); b (equal to a).")


def test_the_largest_values_of_a_mechanism(crank: kp.Solution, six_bar: kp.Solution) -> None:
    for solution in (crank, six_bar):
        found = largest_values(solution)
        moving = [solution.body(name) for name in solution.model.bodies]
        for unit, names in (
            ("m", ("x", "y")),
            ("rad/s", ("omega",)),
            ("m/s²", ("ax", "ay")),
            ("rad", ("angle",)),
        ):
            most = max(np.abs(getattr(body, n)).max() for body in moving for n in names)
            assert found[unit] == pytest.approx(most, rel=2e-3)
        forces = [
            solution.constraint(n).force(on=i.j) for n, i in solution.model.constraints.items()
        ]
        assert found["N"] == pytest.approx(np.abs(forces).max(), rel=2e-2)
        assert found["N·m"] == pytest.approx(found["N"] * found["m"])


def test_a_strong_torque_is_the_largest_one(flagship: kp.Solution) -> None:
    """1e6 N·m/rad · 0.499 rad at the start; the forces of some 10 kN have arms below 30 m."""
    found = largest_values(flagship)
    spring = np.abs(flagship.force("spring").torque(on="rocker")).max()
    assert found["N·m"] >= spring
    assert found["N·m"] == pytest.approx(max(spring, found["N"] * found["m"]), rel=1e-3)


# --- envelopes ------------------------------------------------------------------------------------


def test_an_envelope_has_least_and_largest_value_of_each_span() -> None:
    t = np.linspace(2.0, 6.0, 9)
    y = np.array([5.0, 1.0, 2.0, 8.0, 3.0, 4.0, 9.0, 0.0, 7.0])
    middle, low, high = envelope(t, y, bins=2)
    # From 2 to 4 s and from 4 to 6 s; 4 s is in the second one.
    assert [list(one) for one in (middle, low, high)] == [[3.0, 5.0], [1.0, 0.0], [8.0, 9.0]]
    back = envelope(t[::-1], y, bins=4)
    assert list(back[0]) == [5.5, 4.5, 3.5, 2.5]
    assert list(back[2]) == [5.0, 8.0, 4.0, 9.0]
    # A span without a value is left out.
    gap = envelope(np.array([0.0, 0.1, 0.2, 4.0]), np.array([1.0, 3.0, 2.0, 5.0]), bins=3)
    assert [list(one) for one in gap[1:]] == [[1.0, 5.0], [3.0, 5.0]]
    assert gap[0] == pytest.approx([4.0 / 6.0, 4.0 * 5.0 / 6.0])
    assert all(one is other for one, other in zip(envelope(t, y, bins=9), (t, y, y), strict=True))
    assert len(envelope(np.arange(201.0), np.arange(201.0))[0]) == BINS == 200
    assert len(envelope(np.arange(200.0), np.arange(200.0))[0]) == 200


def axes() -> Axes:
    with style.applied():
        return style.axes_at(style.figure(60.0, layout=None), (20.0, 15.0, 100.0, 40.0), 60.0)


def test_a_band_is_drawn_where_values_differ() -> None:
    found, look = axes(), {"color": "#0072B2", "linestyle": "--"}
    draw_envelope(found, RAMP, RAMP, "few", look)
    assert not found.collections
    t = np.linspace(0.0, 1.0, 4001)
    draw_envelope(found, t, np.sin(700.0 * t) ** 2, "many", look)
    (band,) = found.collections
    assert band.get_alpha() == 0.18
    assert [line.get_label() for line in found.lines] == ["few", "many"]
    assert found.lines[1].get_linestyle() == "--"
    assert found.lines[1].get_ydata().min() > 0.95  # the largest of each span
    low = band.get_paths()[0].vertices[:, 1].min()
    assert low < 1e-3


@pytest.mark.parametrize(
    ("values", "most", "limits", "ticks"),
    [
        ([3e-9, 2e-5], 9, (-9, -4), [-9, -8, -7, -6, -5, -4]),
        ([1e-20, 2e-5], 9, (-13, -4), [-13, -11, -9, -7, -5]),
        ([1e-20, 2e-5], 18, (-20, -4), [-20, -17, -14, -11, -8, -5]),
        ([0.0, 0.5], 9, (-3, 0), [-3, -2, -1, 0]),
        ([0.0, 1.0, 3e-7], 9, (-7, 0), [-7, -5, -3, -1]),
    ],
)
def test_a_logarithmic_axis_has_whole_decades(
    values: list[float], most: int, limits: tuple[int, int], ticks: list[int]
) -> None:
    found = axes()
    logarithmic(found, [np.zeros(2), np.array(values)], most)
    assert found.get_yscale() == "log"
    assert np.log10(found.get_ylim()) == pytest.approx(limits)
    assert np.log10(found.get_yticks()) == pytest.approx(ticks)
    signs = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
    words = [text.get_text() for text in found.get_yticklabels()]
    assert words == [f"10{str(power).translate(signs)}" for power in ticks]
    nothing = axes()
    logarithmic(nothing, [np.zeros(3), np.empty(0)])
    assert nothing.get_yscale() == "linear"


# --- ticks, frames, style -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ticks", "words"),
    [
        ([0.0, 0.5, 1.0], ["0.0", "0.5", "1.0"]),
        ([-20.0, 0.0, 20.0], ["−20", "0", "20"]),
        ([0.25, 0.0, -0.25], ["0.25", "0.00", "−0.25"]),
        ([1e-7, 2e-7], ["0.0000001", "0.0000002"]),
        ([0.0, 1.0, 1.5], ["0.0", "1.0", "1.5"]),
        ([-0.125], ["−0.125"]),
        ([], []),
    ],
)
def test_numbers_of_ticks_have_equal_decimals(ticks: list[float], words: list[str]) -> None:
    assert labels(ticks) == words


@pytest.mark.parametrize(("more", "count"), [(0.1, 6), (-0.1, 3)])
def test_as_many_ticks_as_have_room(more: float, count: int) -> None:
    """Six numbers from 0 to 5 need 13 points each in a column; in a row 10 points more than wide.

    Where six do not fit, there are the three numbers 0, 2 and 4.
    """
    wide = measured("0", 8.0)[0]
    size = [(6.0 * room + more) * 25.4 / 72.0 for room in (wide + 10.0, 13.0)]
    with style.applied():
        found = style.axes_at(style.figure(60.0, layout=None), (20.0, 15.0, *size), 60.0)
        for axis, limits in ((found.xaxis, found.set_xlim), (found.yaxis, found.set_ylim)):
            limits(0.0, 5.0)
            set_ticks(axis)
            step = 1.0 if count == 6 else 2.0
            assert list(axis.get_ticklocs()) == [k * step for k in range(count)]


@pytest.mark.parametrize(
    ("bounds", "low", "high"),
    [
        # 10 m wide: 17 % of 10 m on each side; the height is 45 % of the width at least.
        ((0, 0, 10, 0), (-1.7, -3.015), (11.7, 3.015)),
        ((0, -4, 10, 6), (-1.7, -5.7), (11.7, 7.7)),
        ((1, 2, 1, 2), (0.83, 1.83), (1.17, 2.17)),
        ((0, 0, 0, 10), (-3.015, -1.7), (3.015, 11.7)),
    ],
)
def test_a_drawing_has_room_around_it(bounds: Any, low: Any, high: Any) -> None:
    found = frame({"bounds": bounds})
    assert found[0] == pytest.approx(low)
    assert found[1] == pytest.approx(high)


@pytest.mark.parametrize(("wide", "tall"), [(3.0, 0.1), (1.0, 1.5)])
def test_a_drawing_fills_the_width_of_its_page_if_it_is_not_too_high(
    wide: float, tall: float
) -> None:
    m = kp.Model(gravity=(0, 0))
    m.body("plate", mass=1, inertia=1, points={"P": (0, 0), "Q": (wide, 0), "R": (wide, tall)})
    state = kp.assemble(m, set={"plate.x": 0, "plate.y": 0, "plate.angle": 0})
    low, high = frame(kp.scene(state))
    sides = high - low
    made = drawing_pages.of_configuration("first", state, 1).figure()
    size = np.array([made.get_figwidth(), made.get_figheight()]) * 25.4
    left, bottom, width, height = np.array(made.axes[0].get_position().bounds) * [*size, *size]
    scale = min(138.0 / sides[0], 150.0 / sides[1])
    assert (width, height) == pytest.approx(tuple(scale * sides))
    assert (left, bottom) == pytest.approx((19.0, 11.0))
    assert size == pytest.approx((160.0, height + 18.0))
    assert made.axes[0].get_title("left") == "First configuration, t = 0 s"


def test_lines_differ_in_colour_or_dashes() -> None:
    looks = [style.line(k) for k in range(50)]
    assert [look["color"] for look in looks[:8]] == [*style.COLOURS, style.COLOURS[0]]
    assert [look["linestyle"] for look in looks[:7]] == list(style.DASHES)
    for k, look in enumerate(looks[:49]):
        assert look not in looks[:k]
    assert looks[49] == looks[0]
    marked = [style.marked_line(k) for k in range(11)]
    for part in ("color", "linestyle", "marker"):
        assert len({str(one[part]) for one in marked[:10]}) == 10
    assert marked[10] == marked[0]


def test_a_figure_has_the_sizes_of_print() -> None:
    found = axes()
    figure = found.figure
    assert figure.get_figwidth() * 25.4 == pytest.approx(160.0)
    assert style.figure().get_figheight() * 25.4 == pytest.approx(75.0)
    assert figure.dpi == 200
    assert np.array(found.get_position().bounds) * [160, 60, 160, 60] == pytest.approx(
        [20, 15, 100, 40]
    )
    with style.applied():
        title = found.set_title("t", loc="left")
    assert title.get_fontsize() == found.xaxis.label.get_fontsize() == 9.0
    assert found.xaxis.get_ticklabels()[0].get_fontsize() == 8.0
    assert found.yaxis.get_ticklabels()[0].get_fontsize() == 8.0
    with style.applied():
        (line,) = found.plot([0, 1], [0, 1], marker="o")
    assert (line.get_linewidth(), line.get_markersize()) == (1.2, 4.0)
    assert not found.spines["top"].get_visible()
    assert not found.spines["right"].get_visible()
    assert line.figure is figure
    # Labels are 6.3 mm below and 14.3 mm to the left of the axes.
    assert found.xaxis.label.get_position()[0] == 0.5
    assert found.yaxis.label.get_position()[0] * 100.0 == pytest.approx(-14.3)
    x, y = found.xaxis.label.get_position()
    assert (x, y * 40.0) == pytest.approx((0.5, -6.3))


def test_a_page_cannot_change() -> None:
    with pytest.raises(FrozenInstanceError):
        plot.Page(1, "x", "x", style.figure).name = "y"  # type: ignore[misc]
    assert not plot.Page(1, "x", "x", style.figure).key


@pytest.mark.parametrize(("count", "columns"), [(4, 1), (5, 2)])
def test_more_than_four_panels_have_two_columns(count: int, columns: int) -> None:
    solution = chain([f"l{k}" for k in range(count)])
    made = plot.select(plot.pages(solution), ["y"])[0].figure()
    assert len(made.axes) == count
    assert len({round(one.get_position().x0, 6) for one in made.axes}) == columns


@pytest.mark.parametrize(
    ("count", "names"),
    [(12, ["y"]), (13, ["y_1", "y_2"]), (25, ["y_1", "y_2", "y_3"])],
)
def test_a_page_has_at_most_twelve_panels(count: int, names: list[str]) -> None:
    from kempe.plot.time_pages import TimePages

    solution = chain([f"l{k}" for k in range(count)])
    pages = TimePages(solution, Scale(1.0, "m"), None, 1).of_coordinate("y")
    assert [page.name for page in pages] == names
    drawn = [one.get_title("left") for page in pages for one in page.figure().axes]
    assert drawn == [f"{k + 1} l{k}" for k in range(count)]
    sizes = [len(page.figure().axes) for page in pages]
    assert max(sizes) - min(sizes) <= 1


# --- gaps of joints -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("gap", "size", "factor"),
    [
        (0.0085, 25.0, 500.0),  # 6.25 / 0.0085 = 735
        (0.25, 1.0, 1.0),
        (0.26, 1.0, 0.5),
        (1e-3, 1.0, 200.0),  # 250
        (5e-3, 2.0, 100.0),
        (0.0, 25.0, 1.0),
        (-1.0, 25.0, 1.0),
        (math.inf, 25.0, 1.0),
        (math.nan, 25.0, 1.0),
    ],
)
def test_gaps_are_magnified_to_a_quarter_of_the_drawing(
    gap: float, size: float, factor: float
) -> None:
    assert magnification(gap, size) == pytest.approx(factor)


@pytest.mark.parametrize("turned", [0.0, 0.1])
@pytest.mark.parametrize("along", [0.4, -0.4, 0.0])
@pytest.mark.parametrize("across", [0.01, -0.02])
def test_the_gap_of_a_joint_is_what_it_forbids(along: float, across: float, turned: float) -> None:
    """A rail at 0.3 rad with a slider so far along it and to its left, a pin, and a rod of 2 m."""
    m = kp.Model(gravity=(0, 0))
    m.ground.points(O=(1, 2))
    m.body("slider", mass=1, inertia=1, points={"B": (0, 0)})
    m.body("arm", mass=1, inertia=1, points={"B": (0, 0), "C": (0, 1)})
    m.translational("guide", "ground.O", "slider.B", axes=(0.3, 0.1))
    m.revolute("pin", "slider.B", "arm.B")
    m.distance("rod", "ground.O", "arm.C", length=2.0)
    u, n = np.array([math.cos(0.3), math.sin(0.3)]), np.array([-math.sin(0.3), math.cos(0.3)])
    at = np.array([1.0, 2.0]) + along * u + across * n
    q = np.array([*at, 0.2 + turned, *(at + np.array([0.003, -0.004])), 0.0])
    state = kp.State(m, 0.0, q, np.zeros(6))
    begin, gaps = joint_gaps(state)
    np.testing.assert_allclose(begin, [[1.0, 2.0] + along * u, at, [1.0, 2.0]])
    to_end = at + np.array([0.003, 0.996]) - [1.0, 2.0]
    length = math.hypot(*to_end)
    expected = [across * n, [0.003, -0.004], (length - 2.0) * to_end / length]
    np.testing.assert_allclose(gaps, expected, atol=1e-12)
    phi = state.constraint("guide").residual[0]
    assert abs(phi) == pytest.approx(abs(across))
