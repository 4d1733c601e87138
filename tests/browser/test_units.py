"""The page writes numbers as the figures do."""

from typing import Any

import kempe as kp
import pytest
from browser.test_player import module
from house.places import ROOT
from kempe.draw.units import scale

UNITS = ("m", "m/s", "m/s²", "N", "N·m", "J", "A", "rad/s")
PEAKS = (3e-8, 0.004, 0.1, 0.19, 0.2, 1.0, 1.99, 2.0, 50.0, 999.0, 1999.0, 2000.0, 4.5e6, 3e11)


@pytest.fixture(scope="module")
def numbers(browser: Any) -> Any:
    page = browser.new_page()
    page.add_script_tag(content=module("draw/numbers"))
    yield page
    page.close()


@pytest.mark.parametrize("unit", UNITS)
def test_units_of_axes_are_those_of_the_figures(numbers: Any, unit: str) -> None:
    for peak in PEAKS:
        told = numbers.evaluate("([peak, unit]) => scaled(peak, unit)", [peak, unit])
        expected = scale(unit, peak)
        assert told["unit"] == expected.unit, peak
        assert told["factor"] == pytest.approx(expected.divisor)
        label = numbers.evaluate("unit => axisLabel('x', unit)", told["unit"])
        assert label == expected.axis("x")


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.0, "N", "0 N"),
        (-35.128, "m", "−35.1 m"),
        (1395.5, "N", "1396 N"),
        (2512.0, "N", "2.51 kN"),
        (0.0123, "m", "12.3 mm"),
        (123456.0, "m/s²", "123·10³ m/s²"),
    ],
)
def test_quantities(numbers: Any, value: float, unit: str, text: str) -> None:
    assert numbers.evaluate("([value, unit]) => quantity(value, unit)", [value, unit]) == text


@pytest.mark.parametrize(
    ("value", "peak", "text"),
    [
        (1.23456, 9.9, "1.2346"),
        (-0.00752, 0.7, "−0.00752"),
        (25.0, 5e4, "25"),
        (0.0, 1.0, "0"),
        (float("nan"), 1.0, "–"),
    ],
)
def test_decimals_follow_from_the_peak(numbers: Any, value: float, peak: float, text: str) -> None:
    told = numbers.evaluate("([value, peak]) => fixed(value ?? NaN, peak)", [value, peak])
    assert told == text


@pytest.mark.parametrize(
    ("value", "text"),
    [(12.3456, "12.35"), (-1.5e-7, "−1.500·10⁻⁷"), (0.0, "0"), (1e6, "1.000·10⁶")],
)
def test_significant_digits(numbers: Any, value: float, text: str) -> None:
    assert numbers.evaluate("value => significant(value)", value) == text


def test_rates_and_forces_over_a_quantity_have_their_units_and_a_note(opened: Any) -> None:
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    ends = ["70 deg", "90 deg"]
    turned = kp.kinematics(case.model, case.start(), over="crank.angle", range=ends, n=21)
    watched = opened(turned, 1280, 720)
    plot = watched.page.locator(".plot").first
    plot.locator(".quantity").select_option(label="Angular velocity")
    watched.settle()
    assert watched.state()["plots"][0]["label"] == "ω / (°/°)"
    condition = "with inertia and damping at 1 rad/s"
    assert condition not in {one["text"] for one in watched.texts(".plot canvas")}
    plot.locator(".quantity").select_option(label="Reaction force")
    watched.settle()
    assert condition in {one["text"] for one in watched.texts(".plot canvas")}
    watched.page.check("#show-velocities")
    watched.settle()
    assert any("m/rad" in one["text"] for one in watched.state()["arrows"])
    assert f"forces {condition}" not in {one["text"] for one in watched.texts("#drawing")}
    watched.page.check("#show-reactions")
    watched.settle()
    assert f"forces {condition}" in {one["text"] for one in watched.texts("#drawing")}
