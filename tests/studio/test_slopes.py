"""Parameters as sliders, and the slopes of a chosen number beside them."""

import re
from pathlib import Path

import kempe as kp
import pytest
from studio.hands import Hands
from studio.window import Opener, Studio

CASE = Path(__file__).parents[2] / "examples" / "classics" / "crank_exercise.toml"


def opened(studio: Opener) -> tuple[Studio, Hands]:
    one = studio()
    one.load(CASE.read_text("utf-8").partition("[exercise]")[0])
    if not one.page.locator("#slope-measure").is_visible():
        one.page.locator(".sliders summary").click()
    one.settle()
    return one, Hands(one)


def slopes(hands: Hands, measure: str) -> dict[str, str]:
    hands.one.page.locator("#slope-measure").fill(measure)
    hands.press("#slopes")
    hands.one.wait("document.querySelector('#slopes').textContent === 'Slopes'", 30.0)
    hands.one.settle()
    return {name: hands.one.page.locator(f"#slope-{name}").inner_text() for name in ("r", "l", "n")}


def test_slopes_are_those_of_python(studio: Opener) -> None:
    one, hands = opened(studio)
    shown = slopes(hands, "motor.effort.rms")
    found = kp.gradient(kp.load(CASE), ["motor.effort.rms"], ["r", "l", "n"])
    value = found.measures["motor.effort.rms"]
    assert "motor.effort.rms" in one.page.locator("#slopes-of").inner_text()
    for name, step in (("r", 1e-3), ("l", 1e-3), ("n", 0.01 * 31.41592653589793)):
        percent = 100.0 * found["motor.effort.rms", name] * step / value
        assert "%" in shown[name], shown
        said = float(re.match(r"[+−]?[\d.]+", shown[name])[0].replace("−", "-"))  # type: ignore[index]
        assert said == pytest.approx(percent, rel=0.06), name
    assert shown["r"].endswith("% per mm")
    assert shown["n"].endswith("% per 1 %")
    exact = one.call("kempe.slopes('motor.effort.rms')")
    for row in exact["slopes"]:
        own = found["motor.effort.rms", row["name"]]
        assert row["slope"] == pytest.approx(own, rel=1e-9)
    assert exact["value"] == pytest.approx(value, rel=1e-9)


def test_a_slider_changes_the_text_as_one_step(studio: Opener) -> None:
    one, hands = opened(studio)
    slopes(hands, "motor.effort.rms")
    slider = one.page.locator("#slider-l")
    box = slider.bounding_box()
    assert box
    y = box["y"] + box["height"] / 2
    one.page.mouse.move(box["x"] + box["width"] / 2, y)
    one.page.mouse.down()
    one.page.mouse.move(box["x"] + 0.9 * box["width"], y, steps=6)
    one.page.mouse.up()
    one.settle()
    text = one.tree()["parameters"]["l"]
    assert text.endswith(" mm")
    assert 250.0 < float(text.split()[0]) < 300.0
    assert "compute the slopes again" in one.page.locator("#slopes-of").inner_text()
    hands.press("#undo")
    assert one.tree()["parameters"]["l"] == "200 mm"
    one.page.get_by_label("Largest l / m").fill("0.4")
    one.page.get_by_label("Largest l / m").press("Enter")
    assert slider.get_attribute("max") == "0.4"


def test_what_has_no_slopes_says_so(studio: Opener) -> None:
    one, hands = opened(studio)
    slopes(hands, "motor.effort.most")
    assert "no statistic 'most'" in one.page.locator("#slopes-of").inner_text()
    shown = slopes(hands, "motor.effort.rms")  # the remedy
    assert "%" in shown["r"]


def test_a_parameter_of_the_analysis_itself_has_no_slope(studio: Opener, tmp_path: Path) -> None:
    """The end of the motion depends on the speed, which slopes at fixed times would leave out."""
    one = studio()
    text = CASE.read_text("utf-8").partition("[exercise]")[0]
    one.load(text.replace("t_end = 0.2", 't_end = "pi/n"'))
    path = tmp_path / "case.toml"
    path.write_text(one.toml(), "utf-8")
    found = kp.gradient(kp.load(path), ["motor.effort.rms"], ["r", "l", "n"])
    slopes = {row["name"]: row for row in one.call("kempe.slopes('motor.effort.rms')")["slopes"]}
    assert slopes["n"]["slope"] is None
    assert "an analysis depends on it" in slopes["n"]["remark"]
    for name in ("r", "l"):
        own = found["motor.effort.rms", name]
        assert slopes[name]["slope"] == pytest.approx(own, rel=1e-9)
