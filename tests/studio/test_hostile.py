"""Hostile cases and links give a message: no dialog, no request, no page that hangs."""

import time
from pathlib import Path

import pytest
from studio.hostile import LARGE, links, texts
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
#: Notes the longest time for which the page did not react, ms.
WATCH = """() => {
  window.longest = 0;
  let last = performance.now();
  setInterval(() => {
    const now = performance.now();
    window.longest = Math.max(window.longest, now - last - 20);
    last = now;
  }, 20);
}"""
#: What the payloads would leave if one of them ran or were drawn as markup.
HARM = """() => [
  document.querySelector("#page :is(img, script, iframe, style, b[onmouseover])"),
  document.querySelector("#page a[href^=javascript], #page svg[onload]"),
  {}.polluted,
  Object.keys(Object.prototype).length || null,
].filter((one) => one != null).length"""


def test_there_are_a_hundred_payloads() -> None:
    assert (
        len({name for name, _ in texts()}) + len({name for name, _ in links()}) + len(LARGE) >= 100
    )


@pytest.mark.alone  # it measures how long the page does not react
def test_hostile_payloads_give_messages(one: Studio) -> None:
    good = (EXAMPLES / "pendulum.toml").read_text(encoding="utf-8")
    one.load(good)
    one.page.locator("#tab-text").click()
    one.call(WATCH)
    silent, slow, harmful = [], [], []

    def check(name: str, began: float) -> None:
        one.settle()
        blocked = one.call("window.longest")
        if not one.message().strip():
            silent.append(name)
        if blocked > 1000:
            slow.append((name, round(blocked), round(time.monotonic() - began, 1)))
        if one.call(HARM):
            harmful.append(name)
        one.call("void (window.longest = 0)")

    for name, text in texts():
        began = time.monotonic()
        one.load(text)
        check(name, began)
    for name, formula in LARGE.items():
        began = time.monotonic()
        one.call(f"void kempe.load({formula})")
        check(name, began)
    for name, link in links():
        one.load(good)
        began = time.monotonic()
        one.call("link => { location.hash = link }", link)
        check(f"link: {name}", began)
    assert (silent, slow, harmful) == ([], [], [])
    one.load(good)
    assert one.state()["q"]
