"""Small and enlarged windows, reduced motion, print, and the menu of a thing."""

import pytest
from studio.test_palette import CASE
from studio.window import Finger, Opener, Studio


def reached(one: Studio, selector: str) -> tuple[float, float]:
    """Width and height of the part of an element that can be scrolled into the window."""
    size: tuple[float, float] = one.call(
        """selector => {
          const element = document.querySelector(selector);
          element.scrollIntoView({ block: "nearest" });
          const box = element.getBoundingClientRect();
          const width = Math.min(box.right, innerWidth) - Math.max(box.left, 0);
          const height = Math.min(box.bottom, innerHeight) - Math.max(box.top, 0);
          return [width, height];
        }""",
        selector,
    )
    return size


#: Names of modes and marks of the drawing that are wider than their place.
CUT = """[...document.querySelectorAll(".modes button, .chips")]
  .filter(one => one.scrollWidth > one.clientWidth + 1).map(one => one.innerText)"""


@pytest.mark.parametrize(
    ("width", "height"),
    [
        (320, 568),
        (320, 256),  # 400 % of 1280 × 1024
        (640, 400),  # 200 % of 1280 × 800
        (683, 384),
        (568, 320),
        (740, 360),
        (932, 430),
    ],
)
def test_every_panel_is_reachable(studio: Opener, width: int, height: int) -> None:
    one = studio(width, height)
    for mode in ("edit", "move", "live", "read"):
        one.mode(mode)
        one.page.wait_for_timeout(60)
        assert one.call("document.documentElement.scrollWidth") <= width, mode
        assert width < 640 or one.call(CUT) == [], mode
        for selector, least in {
            "#sheet": 120,
            ".side .tab-body": 110,
            "header": 20,
            "footer": 20,
        }.items():
            w, h = reached(one, selector)
            assert w >= min(220, width - 20), (mode, selector, w)
            assert h >= least, (mode, selector, h)
        one.page.locator("#tab-text").click()
        one.page.locator(".cm-content").wait_for()
        one.page.locator("#tab-main").click()
    one.mode("edit")
    one.page.locator("#tab-insert").click()
    one.page.locator(".side [data-type=bar]").wait_for()
    one.page.locator("#tab-main").click()


def test_nothing_moves_before_play_with_reduced_motion(fresh: Opener) -> None:
    one = fresh(reduced_motion="reduce")
    one.mode("live")
    one.page.wait_for_timeout(500)
    assert one.state()["t"] == 0
    one.page.locator("#live-play").click()
    one.wait("kempe.state().then(({ t }) => t > 0.05)")


def test_the_print_has_the_drawing_without_controls(fresh: Opener) -> None:
    one = fresh()
    one.page.emulate_media(media="print")
    one.page.wait_for_timeout(100)
    hidden = ["header nav", ".modes", ".left", ".bar", ".tabs", ".units"]
    assert [name for name in hidden if one.page.locator(name).first.is_visible()] == []
    box = one.page.locator("#sheet").bounding_box()
    assert box
    assert box["height"] > 300
    assert one.page.locator("h1").is_visible()
    one.page.emulate_media(media="screen")


def entries(one: Studio) -> dict[str, str]:
    """The entries of the menu, with the reasons of those that are not possible."""
    found = {}
    for button in one.page.locator("#menu button").all():
        label, _, why = button.inner_text().partition("\n")
        found[label] = why
    return found


def test_a_right_click_offers_what_is_possible_and_why_the_rest_is_not(one: Studio) -> None:
    one.load(CASE)
    one.page.mouse.click(*one.screen(-0.4, -0.2), button="right")
    one.settle()
    found = entries(one)
    assert found["Drive it"] == ""
    assert found["Pin here"] == "Only one body has a point here."
    one.page.locator("#menu button").filter(has_text="Drive it").click()
    one.settle()
    assert one.tree()["drivers"]["driver1"]["coordinate"] == "left.angle"
    one.page.mouse.click(*one.screen(-0.4, -0.2), button="right")
    one.settle()
    assert "cannot be driven here" in entries(one)["Drive it"]
    one.page.keyboard.press("ArrowDown")
    one.page.keyboard.press("Escape")
    assert one.page.locator("#menu").count() == 0
    one.page.mouse.click(*one.screen(-0.5, 0.0), button="right")  # a pin
    one.settle()
    assert entries(one)["Pin here"] == "The bodies are pinned here."
    one.page.locator("#menu button").filter(has_text="Delete").click()
    one.settle()
    assert list(one.tree()["joints"]) == ["B"]
    one.page.mouse.click(*one.screen(-0.5, 0.0), button="right")
    one.settle()
    one.page.locator("#menu button").filter(has_text="Pin here").click()
    one.settle()
    joint = list(one.tree()["joints"].values())[1]
    assert {joint["i"], joint["j"]} == {"ground.A", "left.A"}
    one.page.mouse.click(*one.screen(0.0, 0.4), button="right")
    one.settle()
    assert entries(one)["Paste"] in ("", "Nothing was copied.")  # by an earlier test, or none
    one.page.locator("#menu button").filter(has_text="Fixed point here").click()
    one.settle()
    assert len(one.tree()["bodies"]["ground"]["points"]) == 3


def test_a_long_press_opens_the_menu(fresh: Opener) -> None:
    one = fresh(390, 844, has_touch=True)
    one.load(CASE)
    finger = Finger(one)
    finger.down(*one.screen(-0.4, -0.2))
    one.page.wait_for_timeout(700)
    finger.up()
    one.settle()
    assert "Drive it" in entries(one)
    assert one.page.locator("#menu").get_attribute("aria-label") == "left"
