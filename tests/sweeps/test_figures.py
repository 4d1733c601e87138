"""The figures of a sweep show its numbers."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from matplotlib.axes import Axes
from sweeps.conftest import flagship


@pytest.fixture(scope="module")
def grid() -> kp.SweepResult:
    given = {"L2": [25, 26, 47], "k": {"from": 1e5, "to": 1e7, "n": 4, "scale": "log"}}
    return kp.sweep(flagship(0.05), given, ["pin.max", "rocker.angle.final"])


@pytest.fixture(scope="module")
def cloud() -> kp.SweepResult:
    given = {
        "L2": {"normal": [26, 0.05]},
        "k": {"normal": [1e6, 1e4]},
        "c": {"uniform": [1e4, 2e4]},
    }
    return kp.sweep(flagship(0.05), given, ["pin.max"], design="latin", n=60)


def test_lines_are_over_the_first_variable(grid: kp.SweepResult) -> None:
    result = kp.sweep(flagship(0.05), {"k": [2e6, 1e6], "L2": [25, 26]}, ["pin.max"])
    axes = kp.plot.sweep_lines(result, "pin.max")
    assert axes.get_xlabel() == "k" and axes.get_ylabel() == "pin.max / kN"
    lines = axes.get_lines()
    assert [line.get_label() for line in lines] == ["25", "26"]
    np.testing.assert_array_equal(lines[1].get_xdata(), [1e6, 2e6])
    np.testing.assert_array_equal(lines[1].get_ydata(), result["pin.max"][[3, 1]] / 1e3)
    with pytest.raises(kp.ModelError, match="sweep_map"):
        kp.plot.sweep_lines(
            kp.sweep(
                flagship(0.02), {"k": [1e6], "L2": [25 + x / 20 for x in range(11)]}, ["pin.max"]
            ),
            "pin.max",
        )
    assert len(grid) == 12


def test_variants_of_lines_that_failed_are_crosses() -> None:
    """Couplers over 37 do not reach, for both stiffnesses; 26 does."""
    both = kp.sweep(flagship(0.02), {"L2": [47, 26, 50], "k": [1e4, 1e6]}, ["pin.max"])
    axes = kp.plot.sweep_lines(both, "pin.max")
    lines = axes.get_lines()
    crosses = [line for line in lines if line.get_marker() == "x"]
    assert [list(line.get_xdata()) for line in crosses] == [[47, 50], [47, 50], []]
    heights = [set(line.get_ydata()) for line in crosses[:2]]
    assert heights[0] != heights[1] and max(map(max, heights)) < 0.2
    assert all(line.get_transform() == axes.get_xaxis_transform() for line in crosses[:2])
    courses = [line for line in lines if line.get_marker() != "x"]
    assert [line.get_color() for line in crosses[:2]] == [one.get_color() for one in courses]
    assert np.isnan(np.asarray(courses[0].get_ydata())).tolist() == [False, True, True]
    legend = axes.get_legend()
    assert legend is not None
    words = [text.get_text() for text in legend.get_texts()]
    assert words == ["10000", "1000000", "failed: 4"]
    one = kp.sweep(flagship(0.02), {"L2": [26, 47]}, ["pin.max"])
    legend = kp.plot.sweep_lines(one, "pin.max").get_legend()
    assert legend is not None and [t.get_text() for t in legend.get_texts()] == ["failed: 1"]
    good = kp.plot.sweep_lines(kp.sweep(flagship(0.02), {"L2": [25, 26]}, ["pin.max"]), "pin.max")
    assert len(good.get_lines()) == 1 and good.get_legend() is None


def test_a_map_of_a_grid_has_its_cells(grid: kp.SweepResult) -> None:
    axes = kp.plot.sweep_map(grid, "pin.max")
    mesh = axes.collections[0]
    shown = np.ma.getdata(mesh.get_array()).reshape(4, 3)
    good = grid["pin.max"].reshape(3, 4).T / 1e3
    np.testing.assert_array_equal(shown[:, :2], good[:, :2])
    assert np.ma.getmaskarray(mesh.get_array()).reshape(4, 3)[:, 2].all()
    assert axes.get_yscale() == "log"
    crosses = axes.get_lines()[0]
    np.testing.assert_array_equal(crosses.get_xdata(), [47] * 4)


def test_a_map_of_other_designs_has_points(cloud: kp.SweepResult) -> None:
    axes = kp.plot.sweep_map(cloud, "pin.max", y="c")
    assert axes.get_xlabel() == "L2" and axes.get_ylabel() == "c"
    points = axes.collections[0]
    np.testing.assert_array_equal(points.get_offsets()[:, 1], cloud["c"])
    np.testing.assert_allclose(points.get_array(), cloud["pin.max"] / 1e3)


def test_a_histogram_counts_every_variant(cloud: kp.SweepResult) -> None:
    axes = kp.plot.sweep_histogram(cloud, "pin.max", bins=7)
    heights = [bar.get_height() for bar in axes.patches]
    assert len(heights) == 7 and sum(heights) == 60
    assert axes.get_title(loc="left").endswith("60 variants")


def widths(axes: Axes) -> list[float]:
    return [bar.get_width() for bar in axes.patches]


def test_contributions_are_bars(cloud: kp.SweepResult) -> None:
    from kempe.sweeps.contributions import contributions

    shares = contributions(cloud, "pin.max")
    assert widths(kp.plot.sweep_contributions(cloud)) == pytest.approx(
        sorted(100 * x for x in shares.values())
    )
    found = kp.tolerances(flagship(0.02), {"L2": 0.05, "k": 1e4}, "pin.max", n=8)
    axes = kp.plot.sweep_contributions(found)
    assert sum(widths(axes)) == pytest.approx(100)
    assert "first order" in axes.get_xlabel()


def test_a_scatter_matrix_has_every_pair(cloud: kp.SweepResult) -> None:
    made: Any = kp.plot.sweep_scatter(cloud)
    assert len(made.axes) == 16
    np.testing.assert_array_equal(made.axes[12].get_lines()[0].get_xdata(), cloud["L2"])
    np.testing.assert_array_equal(made.axes[12].get_lines()[0].get_ydata(), cloud["pin.max"])
    for k, name in enumerate(("L2", "k", "c")):  # a histogram from the least to the largest value
        bars = made.axes[5 * k].patches
        ends = [bar.get_x() for bar in bars] + [bars[-1].get_x() + bars[-1].get_width()]
        np.testing.assert_allclose(
            ends, np.linspace(cloud[name].min(), cloud[name].max(), 8), rtol=1e-12
        )
        assert [bar.get_height() for bar in bars] == np.histogram(cloud[name], 7)[0].tolist()
    with pytest.raises(kp.ModelError, match="unknown column"):
        kp.plot.sweep_scatter(cloud, ["L3"])


def test_pages_fit_the_sweep(grid: kp.SweepResult, cloud: kp.SweepResult, tmp_path: Any) -> None:
    names = [page.name for page in kp.plot.sweep_pages(grid)]
    assert names == ["map_pin_max", "map_rocker_angle_final"]
    names = [page.name for page in kp.plot.sweep_pages(cloud)]
    assert names == ["histogram_pin_max", "contributions_pin_max", "scatter"]
    written = kp.plot.save(kp.plot.sweep_pages(cloud), tmp_path, "png")
    assert all(path.stat().st_size > 1000 for path in written)
