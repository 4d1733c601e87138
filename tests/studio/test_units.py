"""Units of length in the display: typed lengths, readings, plots, arrows and ranges."""

import re
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from studio.test_arrows import drawing, show
from studio.test_reading import plot_only, shown
from studio.window import Opener, Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
CASE = EXAMPLES / "slider_crank.toml"


def choose(one: Studio, unit: str) -> None:
    one.page.locator("#length-unit").select_option(unit)
    one.settle()


def length(one: Studio) -> float:
    a, b = one.tree()["bodies"]["bar1"]["through"].values()
    return float(np.hypot(b[0] - a[0], b[1] - a[1]))


def test_lengths_are_typed_and_shown_in_mm(studio: Opener) -> None:
    one = studio()
    one.page.locator("#new").click()
    one.settle()
    choose(one, "mm")
    one.tool("bar")
    one.click(-0.5, 0.0)
    one.page.get_by_label("Length / mm", exact=True).fill("370")
    one.click(0.4, 0.0)
    assert length(one) == pytest.approx(0.37, abs=1e-12)
    one.page.keyboard.press("Escape")
    one.page.wait_for_timeout(400)
    facts = one.page.locator(".properties .facts").inner_text()
    assert re.search(r"Length now\s+370\.000 mm", facts), facts
    one.page.locator("#body-length").fill("250")
    one.page.locator("#body-length").press("Enter")
    one.settle()
    assert length(one) == pytest.approx(0.25, abs=1e-12)
    choose(one, "m")
    assert one.page.locator("#body-length").input_value() == "0.250000"
    one.page.locator("#body-length").fill("0.3")
    one.page.locator("#body-length").press("Enter")
    one.settle()
    assert length(one) == pytest.approx(0.3, abs=1e-12)


def test_a_typed_length_with_a_unit_or_a_formula_means_what_it_says(studio: Opener) -> None:
    one = studio()
    one.page.locator("#new").click()
    one.settle()
    choose(one, "mm")
    one.tool("bar")
    one.click(-0.5, 0.0)
    one.page.get_by_label("Length / mm", exact=True).fill("0.2*2")
    one.click(0.4, 0.0)
    assert length(one) == pytest.approx(0.4, abs=1e-12)
    one.page.keyboard.press("Escape")
    for text, expected in (("35 cm", 0.35), ("0.15 + 0.3", 0.45), ("500", 0.5)):
        one.page.locator("#body-length").fill(text)
        one.page.locator("#body-length").press("Enter")
        one.settle()
        assert length(one) == pytest.approx(expected, abs=1e-12), text


def test_a_length_that_is_typed_before_the_unit_changes_has_the_new_unit(studio: Opener) -> None:
    one = studio()
    one.page.locator("#new").click()
    one.settle()
    one.tool("bar")
    one.click(-0.5, 0.0)
    one.page.get_by_label("Length / m", exact=True).fill("300")
    one.page.wait_for_timeout(300)
    choose(one, "mm")
    one.click(0.4, 0.0)
    assert length(one) == pytest.approx(0.3, abs=1e-12)


def test_plots_and_arrows_are_in_mm(one: Studio, tmp_path: Path) -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    solution = kp.load(CASE).run()["coasting"]
    try:
        choose(one, "mm")
        for name, unit in (("slider.x", "mm"), ("slider.vx", "mm/s"), ("slider.ax", "mm/s²")):
            plot_only(one, name)
            peak = np.abs(solution[name]).max()
            assert abs(shown(one, "peak", name)) == pytest.approx(1000 * peak, rel=1e-3)
            entry = one.page.locator(".legend li").filter(has_text=name).last
            assert entry.locator(".value").inner_text().endswith(f" {unit}")
            assert re.search(rf"\d {unit}$", entry.locator(".now").inner_text())  # by the plot
        show(one, 0.4, "Velocities")
        one.page.wait_for_timeout(500)
        k = int(np.abs(solution.t - 0.4).argmin())
        speed = 1000 * float(np.hypot(solution["crank.A.vx"][k], solution["crank.A.vy"][k]))
        picture = drawing(one, tmp_path)
        assert f">{speed:.0f} mm/s crank.A<" in picture
        assert re.search(r">\d+ mm</text>", picture)  # the scale
    finally:
        choose(one, "m")
        one.page.get_by_label("Velocities", exact=True).uncheck()


def test_a_range_is_written_in_mm(one: Studio) -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    x = one.quantity("slider.x")
    one.mode("read")
    try:
        choose(one, "mm")
        one.page.locator("#analysis").select_option("over a quantity")
        one.page.locator("#over").select_option("slider.x")
        one.page.locator("#over-first").fill(f"{1000 * x:.6f}")
        one.page.locator("#over-last").fill(f"{1000 * x - 10:.6f}")
        one.page.locator("#run").click()
        one.settle()
        found = one.call("kempe.values(['slider.x'])")["rows"][0]
        assert [found[0], found[-1]] == pytest.approx([x - 0.01, x], abs=1e-8)
    finally:
        choose(one, "m")
