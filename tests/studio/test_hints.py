"""Hints for what is used for the first time."""

from typing import TYPE_CHECKING

from studio.conftest import ready
from studio.window import VISITED, Opener, Studio

if TYPE_CHECKING:
    from playwright.sync_api import Browser


def hint(one: Studio) -> str:
    found = one.page.locator("#hint")
    return found.inner_text() if found.count() else ""


def test_each_mode_and_kind_of_tool_has_its_hint_once(fresh: Opener) -> None:
    one = fresh()
    found = [hint(one)]
    for use in ("bar", "ground", "torsion_spring", "body", "point_mass"):
        one.tool(use)
        found.append(hint(one))
    for mode in ("move", "live", "read"):
        one.mode(mode)
        found.append(hint(one))
    assert all(found)
    assert len(set(found)) == 9
    for mode in ("edit", "move", "live", "read"):
        one.mode(mode)
        assert hint(one) == ""


def test_a_hint_is_dismissed_and_stays_so_after_a_reload(
    built: None,  # noqa: ARG001
    browser: "Browser",
    site: str,
) -> None:
    # by http, because a browser writes the storage of a page from a disk when it likes
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.add_init_script(VISITED)
    page = context.new_page()
    page.goto(site)
    one = ready(page)
    assert hint(one)
    one.page.locator("#hint button").click()
    assert hint(one) == ""
    one.page.reload()
    assert hint(ready(one.page)) == ""
    context.close()


def test_without_storage_hints_are_remembered_while_the_page_is_open(fresh: Opener) -> None:
    one = fresh()
    one.page.add_init_script(
        "Object.defineProperty(window, 'localStorage', { get() { throw new Error('none'); } })"
    )
    one.page.reload()
    one.wait("typeof kempe === 'object' && kempe.state().then(state => state !== null)", 20.0)
    one.requests.remove(one.page.url)  # the page was loaded twice
    assert hint(one)
    one.page.locator("#hint button").click()
    assert hint(one) == ""
    one.mode("move")
    assert hint(one)


def test_a_hint_covers_neither_the_drawing_nor_a_control(fresh: Opener) -> None:
    for window in ((1280, 800), (390, 844)):
        one = fresh(*window)
        box = one.page.locator("#hint").bounding_box()
        assert box
        others = one.page.locator("canvas#sheet, header button, .tabs button, .tab-body input")
        for other in others.all():
            its = other.bounding_box()
            if not its:
                continue
            apart = [
                its[at] >= box[at] + box[size] or box[at] >= its[at] + its[size]
                for at, size in (("x", "width"), ("y", "height"))
            ]
            assert any(apart), other
