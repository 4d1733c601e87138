"""Work outlives a reload, the way back, a new case and another tab; a file is written again."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from studio.conftest import PAGE, ready
from studio.window import VISITED, Opener, Studio

if TYPE_CHECKING:
    from playwright.sync_api import Browser


@pytest.fixture(params=["file", "http"])
def window(request: pytest.FixtureRequest, built: None, browser: "Browser") -> Iterator[Studio]:  # noqa: ARG001
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.add_init_script(VISITED)
    page = context.new_page()
    page.goto(PAGE.as_uri() if request.param == "file" else request.getfixturevalue("site"))
    yield ready(page)
    context.close()


def draw_a_bar(one: Studio) -> str:
    """Draw on an empty sheet, as a person would; returns the text."""
    one.page.locator("#new").click()
    one.settle()
    one.tool("bar")
    one.click(-0.4, -0.2)
    one.click(0.3, 0.1)
    one.page.keyboard.press("Escape")
    one.page.keyboard.press("Escape")
    one.page.wait_for_timeout(300)
    assert "bar1" in one.toml()
    return one.toml()


def test_text_history_view_and_mode_come_back_after_a_reload(window: Studio) -> None:
    one = window
    first = one.toml()
    text = draw_a_bar(one)
    one.page.mouse.move(*one.screen(0.1, 0.1))
    one.page.mouse.wheel(0, -300)
    one.mode("move")
    one.page.wait_for_timeout(400)
    places = [one.screen(0, 0), one.screen(0.3, 0.1)]
    one.page.reload()
    one = ready(one.page)
    assert one.toml() == text
    assert one.page.locator("#mode-move").get_attribute("aria-checked") == "true"
    assert [one.screen(0, 0), one.screen(0.3, 0.1)] == [pytest.approx(at, abs=0.5) for at in places]
    one.mode("edit")
    one.page.keyboard.press("Control+z")
    one.settle()
    assert "bar1" not in one.toml()
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.toml() == first
    one.page.keyboard.press("Control+Shift+z")
    one.page.keyboard.press("Control+Shift+z")
    one.settle()
    assert one.toml() == text


def test_work_comes_back_after_leaving_the_page_and_after_a_crash(window: Studio) -> None:
    one = window
    text = draw_a_bar(one)
    one.page.goto("about:blank")
    one.page.go_back()
    one = ready(one.page)
    assert one.toml() == text
    # a crash runs no code of the page: what is kept by then must be all
    one.call("addEventListener('pagehide', event => event.stopImmediatePropagation(), true)")
    one.page.keyboard.press("Control+z")
    one.settle()
    one.page.wait_for_timeout(300)
    before = one.toml()
    one.page.reload()
    assert ready(one.page).toml() == before != text


# under load, Chromium does not always pass the calls of tabs between pages from a disk
@pytest.mark.parametrize("window", ["http"], indirect=True)
def test_a_duplicated_tab_is_a_copy_and_says_so(window: Studio) -> None:
    one = window
    text = draw_a_bar(one)
    with one.page.context.expect_page() as opened:
        one.page.evaluate("void window.open(location.href)")  # with a copy of the tab's storage
    other = ready(opened.value)
    assert other.toml() == text
    # the other tab has to answer first
    other.wait("document.querySelector('#message').innerText.includes('copy of another open tab')")
    assert "copy of another" not in one.message()
    other.page.keyboard.press("Control+z")
    other.settle()
    one.page.reload()
    assert ready(one.page).toml() == text
    other.page.reload()
    other = ready(other.page)
    assert "bar1" not in other.toml()
    assert "copy" not in other.message()


def test_a_new_and_an_opened_case_can_be_undone(studio: Opener) -> None:
    one = studio()
    first = one.toml()
    text = draw_a_bar(one)
    one.page.locator("#gallery").click()
    one.page.locator("[data-example=pendulum]").click()
    one.settle()
    assert "Pendulum" in one.toml()
    one.page.locator("#undo").click()
    one.settle()
    assert one.toml() == text
    assert one.page.locator("#undo").is_enabled()
    for _ in range(2):
        one.page.locator("#undo").click()
        one.settle()
    assert one.toml() == first
    for _ in range(3):
        one.page.locator("#redo").click()
        one.settle()
    assert "Pendulum" in one.toml()


FILES = """
window.written = {};
const handle = name => ({
  name,
  getFile: async () => new File([window.written[name]], name),
  createWritable: async () => {
    let text = "";
    const close = async () => { window.written[name] = text; };
    return { write: async more => { text += more; }, close };
  },
});
window.showSaveFilePicker = async ({ suggestedName }) => {
  window.asked = (window.asked ?? 0) + 1;
  if (window.closes) throw new DOMException("closed", "AbortError");
  return handle(window.picks ?? suggestedName);
};
window.showOpenFilePicker = async () => [handle("mine.toml")];
"""


def test_a_file_is_written_in_its_place(fresh: Opener) -> None:
    one = fresh()
    one.call(f"() => {{ {FILES} }}")
    one.page.keyboard.press("Control+s")
    one.settle()
    assert one.call("window.written['mechanism.toml']") == one.toml()
    assert "Saved in mechanism.toml" in one.message()
    draw_a_bar(one)  # New begins without the file
    one.call("() => { window.closes = true }")
    one.page.keyboard.press("Control+s")
    one.settle()
    assert "closed" not in one.message()
    one.call("() => { window.closes = false; window.picks = 'bar.toml' }")
    one.page.keyboard.press("Control+s")
    one.page.keyboard.press("Control+s")
    one.settle()
    assert one.call("window.asked") == 3  # the file is known then
    assert one.call("window.written['bar.toml']") == one.toml()
    one.call(
        "text => { window.written['mine.toml'] = text }",
        Path(PAGE.parents[2] / "examples" / "pendulum.toml").read_text(),
    )
    one.page.keyboard.press("Control+o")
    one.page.wait_for_timeout(200)
    one.settle()
    one.page.keyboard.press("Control+s")
    one.settle()
    assert one.call("window.asked") == 3
    assert "Saved in mine.toml" in one.message()
