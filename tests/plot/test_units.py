"""Numbers on the axes are short."""

import re

import kempe as kp
import numpy as np
import pytest
from kempe import plot
from kempe.draw.units import axis_label, number, scale
from kempe.model.drawing import measured, place_texts
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path
from plot.clipping import clipped_lengths
from plot.conftest import ROOT


@pytest.mark.parametrize(
    ("unit", "peak", "label"),
    [
        ("N", 25e3, "F / kN"),
        ("N", 1500.0, "F / N"),
        ("N·m", 5e5, "F / kN·m"),
        ("N·m", 3e-6, "F / µN·m"),
        ("J", 4e6, "F / MJ"),
        ("Pa", 8e7, "F / MPa"),
        ("W", 12e3, "F / kW"),
        ("m", 0.01, "F / mm"),
        ("m", 0.5, "F / m"),
        ("m", 1e-12, "F / m"),
        ("m/s", 0.03, "F / (mm/s)"),
        ("m/s²", 5e3, "F / (10³ m/s²)"),
        ("rad/s²", 0.01, "F / (10⁻³ rad/s²)"),
        ("rad", 0.0, "F / °"),
        ("rad", 1e-3, "F / (10⁻³ °)"),
        ("1", 0.1, "F / 1"),
        ("1", 1e-5, "F / 10⁻⁶"),
        ("rad", 30.0, "F / °"),
        ("rad", 1e-6, "F / (10⁻⁶ °)"),
    ],
)
def test_a_unit_keeps_the_numbers_short(unit: str, peak: float, label: str) -> None:
    found = scale(unit, peak)
    assert found.axis("F") == label
    least = 0.1 if unit == "1" else 0.2
    assert peak < 1e-9 or least <= peak / found.divisor <= 2000.0


def test_a_power_of_ten_is_a_factor_of_the_number() -> None:
    assert scale("m/s²", 5e3).written(4220) == "4.22·10³ m/s²"
    assert scale("1", 1e-5).written(5e-6) == "5·10⁻⁶"
    assert scale("N", 1e3).written(500) == "500 N"


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (0.0, 4, "0"),
        (-12.345, 4, "−12.35"),
        (9999.4, 4, "9999"),
        (10000.0, 4, "10000"),
        (-123456.0, 4, "−123500"),
        (1234567.0, 4, "1235000"),
        (9999999.0, 4, "1·10⁷"),
        (-2.5e12, 2, "−2.5·10¹²"),
        (1e-4, 4, "0.0001"),
        (1.25e-5, 4, "1.25·10⁻⁵"),
        (-3e-9, 3, "−3·10⁻⁹"),
        (np.float64(1e4), 4, "10000"),
        (np.inf, 4, "inf"),
    ],
)
def test_a_number_of_a_figure_has_no_e(value: float, digits: int, text: str) -> None:
    assert number(value, digits) == text


def test_a_text_lies_on_no_line_and_no_other_text() -> None:
    anchors = np.array([[100.0, 100.0], [150.0, 100.0], [150.0, 150.0], [150.0, 152.0]])
    segments = np.array([anchors[:2], anchors[1:3]])
    sizes = np.tile([20.0, 8.0], (4, 1))
    lines = segments.reshape(-1, 4)
    centres = anchors + place_texts(anchors, sizes, lines, np.empty((0, 4)), (300.0, 300.0))
    for centre, size in zip(centres, sizes, strict=True):
        assert clipped_lengths(centre - size / 2, centre + size / 2, segments).sum() == 0.0
    for k, one in enumerate(centres):
        for other in centres[:k]:
            assert np.any(np.abs(one - other) >= sizes[0])


@pytest.mark.parametrize("bold", [False, True])
def test_widths_of_texts_are_those_of_the_font(bold: bool) -> None:
    """The font's own program adds the white edges of letters only between them, and kerning."""
    font = FontProperties(family="DejaVu Sans", size=9, weight="bold" if bold else "normal")
    for words in (
        "g = 9.81 m/s²",
        "crank · rocker",
        "0.25 mm",
        "Watt",
        "ABCDEFGHIJKLMNOPQRST",
    ):
        exact = text_to_path.get_text_width_height_descent(words, font, ismath=False)[0]
        assert measured(words, 9.0, bold=bold)[0] == pytest.approx(exact, abs=2.5)


@pytest.mark.parametrize("size", [(160.0, 26.0), (60.0, 26.0), (40.0, 15.0)])
@pytest.mark.parametrize(
    ("low", "high"),
    [(0.0, 0.03), (0.0, 15.0), (-0.0024, 0.0071), (99.99, 100.01), (1e-5, 3e-5), (0.0, 36000.0)],
)
def test_numbers_of_ticks_never_touch(size: tuple[float, float], low: float, high: float) -> None:
    from kempe.plot import style
    from kempe.plot.ticks import set_ticks
    from plot.overlaps import overlaps

    with style.applied():
        figure = style.figure(60.0, layout=None)
        axes = style.axes_at(figure, (25.0, 15.0, *size[:1], size[1]), 60.0)
        axes.set_xlim(low, high)
        axes.set_ylim(low, high)
        set_ticks(axes.xaxis)
        set_ticks(axes.yaxis)
    for axis in (axes.xaxis, axes.yaxis):
        words = [text.get_text() for text in axis.get_ticklabels()]
        assert len(set(words)) == len(words) >= 2
        for word, place in zip(words, axis.get_ticklocs(), strict=True):
            assert float(word.replace("−", "-")) == pytest.approx(place, abs=1e-9 * abs(high))
    assert overlaps(figure) == []


@pytest.mark.parametrize(
    ("end", "unit"), [(0.03, "ms"), (2e-5, "µs"), (0.5, "s"), (15.0, "s"), (36000.0, "s")]
)
def test_times_are_in_a_unit_that_keeps_them_short(end: float, unit: str) -> None:
    from kempe.plot.time_axis import TimeAxis

    assert TimeAxis.of(np.array([0.0, end])).unit.unit == unit


@pytest.mark.parametrize(
    ("units", "label"),
    [
        (["m"], "r / m"),
        (["m/s"], "r / (m/s)"),
        (["10³ N"], "r / (10³ N)"),
        (["m", "rad"], "r / (m, rad)"),
        (["N·m"], "r / N·m"),
    ],
)
def test_a_label_is_a_quantity_by_its_unit(units: list[str], label: str) -> None:
    assert axis_label("r", units) == label


def test_axes_of_benchmarks_and_validation_are_labelled_in_the_same_way() -> None:
    sources = [ROOT / "benchmarks/figures.py", ROOT / "benchmarks/validation/figures.py"]
    label = re.compile(r"(?:[xy]label=|set_[xy]label\()(?:f?\")([^\"]+)\"")
    found = [text for path in sources for text in label.findall(path.read_text("utf-8"))]
    assert len(found) >= 6
    for text in found:
        assert re.fullmatch(r"[^\[\],]+ / \S+", text), text


def test_residuals_have_display_units_if_all_constraints_have_one_unit() -> None:
    m = kp.Model("rod", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("A", "B"))
    m.revolute("pin", "ground.O", "rod.A")
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.5)

    def largest() -> float:
        drawn = [line.get_ydata() for line in plot.residual(sol).lines]
        return max(float(np.max(values)) for values in drawn)

    in_metres = largest()
    with kp.units("mm"):
        axes = plot.residual(sol)
        assert axes.get_ylabel() == "residual / (mm, mm/s)"
        # sizes of rounding errors
        assert largest() == pytest.approx(1e3 * in_metres)
