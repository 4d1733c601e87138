"""Degrees of freedom, Grashof's rule and assembly modes while drawing."""

from pathlib import Path

import kempe as kp
from studio.test_drawing import draw_four_bar
from studio.window import Opener

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_mobility_is_shown_and_follows_the_drawing(studio: Opener) -> None:
    one = studio()
    draw_four_bar(one)
    one.page.keyboard.press("Escape")
    side = one.page.locator(".side")
    one.wait("document.querySelector('.side').innerText.includes('Assembly modes\\n2')")
    words = side.inner_text()
    assert "Degrees of freedom\n1" in words
    assert "Redundant equations\n0" in words
    assert "turns fully: bar1" in words
    assert one.page.locator("#grashof").inner_text() == "crank-rocker"
    # a crank that is too long cannot turn
    one.page.locator(".contents button").filter(has_text="bar1").first.click()
    one.page.locator("#body-length").fill("0.5")
    one.page.locator("#body-length").press("Enter")
    one.settle()
    assert one.page.locator("#grashof").inner_text() != "crank-rocker"


def test_the_modes_are_a_click_away(studio: Opener) -> None:
    one = studio()
    path = EXAMPLES / "jansen_leg.toml"
    one.load(path.read_text(encoding="utf-8"))
    one.wait("document.querySelector('.side').innerText.includes('Assembly modes\\n')")
    case = kp.load(path)
    count = len(kp.configurations(case.model, set={"crank.angle": case.start()["crank.angle"]}))
    assert f"Assembly modes\n{count}\n" in one.page.locator(".side").inner_text()
    one.page.locator("#show-configurations").click()
    one.settle()
    assert one.page.locator("#mode-move[aria-pressed=true], #mode-move[aria-checked=true]").count()
    assert one.page.locator(".choices button").count() == count


def test_modes_with_other_joints_than_pins_are_not_searched_unasked(studio: Opener) -> None:
    one = studio()
    one.load((EXAMPLES / "planetary_gear.toml").read_text(encoding="utf-8"))
    one.page.wait_for_timeout(600)
    one.settle()  # with gears and cams, the search may take long
    assert "Assembly modes" not in one.page.locator(".side").inner_text()
    assert one.page.locator("#show-configurations").is_visible()
