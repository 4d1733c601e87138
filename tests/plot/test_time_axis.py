"""The time axis: when a motion is over, units, and the two parts of a compressed axis."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from kempe import plot
from kempe.draw.units import Scale
from kempe.plot import style
from kempe.plot.time_axis import TimeAxis, _rounded_up, _ticks, show_time
from matplotlib.axes import Axes

Path = Callable[[np.ndarray], np.ndarray]


def still(t: np.ndarray) -> np.ndarray:
    return np.full(len(t), 7.0)


def decay(rate: float, size: float = 1.0) -> Path:
    """It enters the band of 0.5 % after ln 200 / rate."""
    return lambda t: size * np.exp(-rate * (t - t[0]))


def swing(size: float) -> Path:
    return lambda t: size * np.sin(3.0 * t)


def motion(t: Any, *bodies: tuple[Path, Path, Path]) -> Any:
    """A motion of bodies whose x, y and angle are functions of time."""
    t = np.asarray(t, dtype=float)
    views = {
        f"b{k}": SimpleNamespace(x=x(t), y=y(t), angle=angle(t))
        for k, (x, y, angle) in enumerate(bodies)
    }
    return SimpleNamespace(t=t, compiled=SimpleNamespace(bodies=views), body=views.__getitem__)


TIMES = np.linspace(0.0, 10.0, 2001)


@pytest.mark.parametrize(
    ("rate", "until"),
    [
        (5.0, 1.5),  # ln 200 / 5 = 1.06
        (2.2, 2.5),  # 2.41
        (1.36, 4.0),  # 3.90: just 0.4 of the time
        (1.3, None),  # 4.08
        (60.0, 0.09),  # 0.0883 on outputs of 0.005 s: 0.09
    ],
)
@pytest.mark.parametrize("begin", [0.0, 2.0])
def test_a_transient_ends_at_the_band_rounded_up(
    rate: float, until: float | None, begin: float
) -> None:
    for paths in (
        (still, still, decay(rate)),
        (decay(rate), still, still),
        (still, decay(rate, -3.0), still),
    ):
        found = plot.transient(motion(TIMES + begin, paths))
        assert found == (None if until is None else pytest.approx(begin + until))


def test_the_slowest_coordinate_counts() -> None:
    quick, slow = decay(30.0), decay(3.0)  # 0.177 and 1.77 s
    for paths in ((quick, still, slow), (slow, still, quick), (quick, slow, still)):
        assert plot.transient(motion(TIMES, paths)) == 2.0
    assert plot.transient(motion(TIMES, (still, still, quick), (still, still, slow))) == 2.0
    assert plot.transient(motion(TIMES, (still, still, slow), (still, still, quick))) == 2.0


def test_coordinates_that_hardly_move_do_not_count() -> None:
    """A thousandth of the largest travel; angles and places are compared among themselves."""
    large = decay(5.0)
    assert plot.transient(motion(TIMES, (still, still, large), (still, still, swing(4e-4)))) == 1.5
    assert plot.transient(motion(TIMES, (still, still, large), (still, still, swing(6e-4)))) is None
    assert plot.transient(motion(TIMES, (large, swing(4e-4), still))) == 1.5
    assert plot.transient(motion(TIMES, (swing(4e-4), still, large))) is None


def test_short_and_lasting_motions_have_no_transient() -> None:
    assert plot.transient(motion(TIMES, (still, still, still))) is None
    assert plot.transient(motion(TIMES, (swing(1.0), still, still))) is None
    fast = (still, still, decay(1e3))
    assert plot.transient(motion([0.0, 1.0], fast)) is None
    assert plot.transient(motion([0.0, 1.0, 10.0], fast)) == 1.0
    assert plot.transient(motion([0.0, 0.0, 0.0], fast)) is None
    assert plot.transient(motion([1.0, 5.0, 1.0], fast)) is None
    # Three times within 0.5 s: the first in the band is the second one.
    assert plot.transient(motion([0.0, 0.1, 0.5], fast)) == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("value", "up"),
    [(2.13, 2.5), (2.5, 2.5), (2.51, 3.0), (0.26, 0.3), (31.0, 35.0), (9.9, 10.0), (0.0, 0.0)],
)
def test_times_are_rounded_up_to_halves_of_a_power_of_ten(value: float, up: float) -> None:
    assert _rounded_up(value) == pytest.approx(up)
    assert _rounded_up(-value) == 0.0


@pytest.mark.parametrize(
    ("t", "unit", "divisor"),
    [
        ([0.0, 0.03], "ms", 1e-3),
        ([-0.03, 0.001], "ms", 1e-3),
        ([-5.0, 0.001], "s", 1.0),
        ([0.0, 3e5], "s", 1.0),
        ([4e-5, 1e-5], "µs", 1e-6),
    ],
)
def test_the_unit_follows_the_largest_time(t: list[float], unit: str, divisor: float) -> None:
    axis = TimeAxis.of(np.array(t))
    assert (axis.first, axis.last, axis.cut) == (min(t), max(t), None)
    assert (axis.unit.unit, axis.unit.divisor) == (unit, divisor)


def test_only_a_time_within_the_axis_cuts_it() -> None:
    t = np.array([1.0, 3.0])
    assert TimeAxis.of(t, 2.0).cut == 2.0
    assert [TimeAxis.of(t, cut).cut for cut in (0.5, 1.0, 3.0, 4.0)] == [None] * 4


def axes() -> Axes:
    with style.applied():
        return style.axes_at(style.figure(60.0, layout=None), (20.0, 15.0, 120.0, 40.0), 60.0)


def shares(found: Axes, t: list[float]) -> np.ndarray:
    """Where times are along the axis, from 0 to 1."""
    dots = found.transData.transform([(one, 0.0) for one in t])
    return found.transAxes.inverted().transform(dots)[:, 0]


def test_a_plain_axis_reaches_from_the_first_to_the_last_time() -> None:
    found = axes()
    show_time(found, TimeAxis(0.25, 0.75, Scale(1e-3, "ms"), None))
    assert found.get_xlim() == (250.0, 750.0)
    assert found.get_xlabel() == "time t / ms"
    np.testing.assert_allclose(shares(found, [250.0, 500.0]), [0.0, 0.5], atol=1e-12)
    assert not found.patches
    show_time(found, TimeAxis(0.5, 0.5, Scale(1.0, "s"), None), label=False)
    assert found.get_xlim() == (0.0, 1.0)
    assert found.get_xlabel() == "time t / ms"
    words = [text.get_text() for text in found.get_xticklabels()]
    assert [float(word) for word in words] == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])


def test_a_compressed_axis_has_two_linear_parts() -> None:
    """72 % of the axis for the first 2 ms of 10 ms from 1 ms on: 3 ms is at 0.72, 7 ms at 0.86."""
    found = axes()
    show_time(found, TimeAxis(1e-3, 11e-3, Scale(1e-3, "ms"), 3e-3))
    assert found.get_xlim() == pytest.approx((1.0, 11.0))
    at = [1.0, 2.0, 3.0, 7.0, 11.0]
    np.testing.assert_allclose(shares(found, at), [0.0, 0.36, 0.72, 0.86, 1.0], atol=1e-12)
    back = found.transData.inverted().transform(found.transData.transform([(t, 0.0) for t in at]))
    np.testing.assert_allclose(back[:, 0], at, rtol=1e-12)
    assert found.get_xlabel() == "time t / ms  (grey: compressed after 3 ms)"
    (grey,) = found.patches
    assert (grey.get_x(), grey.get_x() + grey.get_width()) == pytest.approx((3.0, 11.0))
    assert grey.get_zorder() < 0.5
    ticks = [1.0, 1.5, 2.0, 2.5, 3.0, 10.0]
    assert list(found.get_xticks()) == pytest.approx(ticks)
    words = [text.get_text() for text in found.get_xticklabels()]
    assert [float(word) for word in words] == pytest.approx(ticks)


def test_ticks_after_the_cut_keep_away_from_it() -> None:
    """Steps of 0.5 s before 2 s and of 5 s after it; none up to 2 + 0.35 · 8 = 4.8 s."""
    assert _ticks(0.0, 2.0, 10.0) == [0.0, 0.5, 1.0, 1.5, 2.0, 5.0, 10.0]
    # Steps of 2 s; 4 s is before 3 + 0.35 · 4 = 4.4 s.
    assert _ticks(0.0, 3.0, 7.0) == [0.0, 1.0, 2.0, 3.0, 6.0]
