"""The first build: led step by step, by mouse, by keys and on a phone."""

import math

import pytest
from studio.window import Opener, Studio


def step(one: Studio) -> str:
    """The number of the present step, such as "2/8"; empty if the card is not there."""
    found = one.page.locator(".guide strong")
    return found.inner_text() if found.count() else ""


def at_step(one: Studio, number: int) -> None:
    one.wait(f"document.querySelector('.guide strong')?.innerText === '{number}/8'")


def begin(one: Studio) -> None:
    one.page.locator("#new").click()
    one.settle()
    one.page.locator("#guide-begin").click()
    at_step(one, 1)


def next_tool(one: Studio) -> None:
    """Choose what is marked as next: on a phone the tab first."""
    if one.page.locator(".tab-insert.next").is_visible():
        one.page.locator(".tab-insert.next").click()
    one.page.locator(".tool.next").last.click()


def click(one: Studio, *places: tuple[float, float]) -> None:
    for place in places:
        one.click(*place)


def build(one: Studio) -> None:
    """All steps at places of one's own, none of them where a mark is."""
    begin(one)
    next_tool(one)
    click(one, (-0.5, -0.2))
    assert step(one) == "1/8"  # one fixed point is not enough
    click(one, (0.3, -0.2))
    at_step(one, 2)
    next_tool(one)
    click(one, (-0.5, -0.2), (-0.4, 0.0))
    at_step(one, 3)
    click(one, (-0.4, 0.0), (0.2, 0.5))
    at_step(one, 4)
    click(one, (0.2, 0.5), (0.3, -0.2))
    at_step(one, 5)
    next_tool(one)
    click(one, (-0.45, -0.1))
    at_step(one, 6)
    one.page.locator("#mode-move.next").click()
    one.settle()
    one.page.mouse.move(*one.screen(-0.4, 0.0))
    one.page.mouse.down()
    one.page.mouse.move(*one.screen(-0.5, 0.05), steps=4)
    at_step(one, 7)
    one.page.mouse.up()
    one.page.locator("#mode-live.next").click()
    at_step(one, 8)
    one.page.locator("#mode-read.next").click()
    one.wait("document.querySelector('.curves') !== null")


@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_every_step_goes_on_when_it_is_done_at_any_place(
    studio: Opener, size: tuple[int, int]
) -> None:
    one = studio(*size)
    build(one)
    tree = one.tree()
    assert len(tree["bodies"]) == 4
    assert len(tree["joints"]) == 4
    assert len(tree["drivers"]) == 1
    one.page.locator("#guide-leave").click()
    assert step(one) == ""


def test_the_first_build_works_by_keys(studio: Opener) -> None:
    one = studio()
    keys = one.page.keyboard
    one.page.locator("#new").press("Enter")
    one.settle()
    one.page.locator("#guide-begin").press("Enter")
    at_step(one, 1)
    for number, clicks in ((2, 2), (3, 2), (4, 2), (5, 2), (6, 1)):
        if one.page.locator(".tool.next").count():
            one.page.locator(".tool.next").press("Enter")
        for _ in range(clicks):
            keys.press("Space")
            one.settle()
        at_step(one, number)
    crank = list(one.tree()["bodies"].values())[1]["through"].values()
    fixed = one.tree()["bodies"]["ground"]["points"].values()
    expected = math.hypot(0.15, 0.25) * math.dist(*fixed)
    assert math.dist(*crank) == pytest.approx(expected, rel=0.15)  # snapped to the grid
    keys.press("2")
    one.settle()
    for _ in range(6):
        keys.press("ArrowLeft")
        one.settle()
    at_step(one, 7)
    keys.press("3")
    at_step(one, 8)


def test_a_place_is_moved_by_arrows_and_clicked_with_space(studio: Opener) -> None:
    one = studio()
    one.page.locator("#new").click()
    one.settle()
    one.page.locator(".left [data-type=ground]").press("Enter")
    for key in ["ArrowRight"] * 3 + ["ArrowUp"] * 2 + ["Space"]:
        one.page.keyboard.press(key)
    one.settle()
    ((x, y),) = one.tree()["bodies"]["ground"]["points"].values()
    assert (x, y) == pytest.approx((0.15, 0.1), abs=1e-9)  # steps of 5 cm


def test_steps_are_skipped_and_undo_brings_the_old_drawing_back(studio: Opener) -> None:
    one = studio()
    before = one.toml()
    one.page.locator("#help").click()
    one.page.locator("#help-guide").click()
    at_step(one, 1)
    assert list(one.tree()["bodies"]) == ["ground"]
    for number in range(2, 9):
        one.page.locator("#guide-skip").click()
        at_step(one, number)
    one.page.locator("#guide-leave").click()
    assert step(one) == ""
    one.page.locator("#undo").click()
    one.settle()
    assert one.toml() == before


Box = dict[str, float]


def box(one: Studio, name: str) -> Box:
    found = one.page.locator(name).bounding_box()
    assert found
    return dict(found)


def within(x: float, y: float, outer: Box) -> bool:
    right, low = outer["x"] + outer["width"], outer["y"] + outer["height"]
    return outer["x"] <= x <= right and outer["y"] <= y <= low


@pytest.mark.parametrize("size", [(1280, 800), (390, 844), (844, 390)])
def test_the_card_is_on_the_sheet_and_does_not_cover_its_marks(
    studio: Opener, size: tuple[int, int]
) -> None:
    one = studio(*size)
    begin(one)
    cards = [box(one, ".guide")]
    next_tool(one)
    for _ in range(2):
        cards.append(box(one, ".guide"))
        one.page.keyboard.press("Space")  # clicks the next mark
        one.settle()
    sheet = box(one, "#sheet")
    for card in cards:
        assert within(card["x"], card["y"], sheet)
        assert within(card["x"] + card["width"], card["y"] + card["height"], sheet)
    for place in one.tree()["bodies"]["ground"]["points"].values():
        assert within(*one.screen(*place), sheet)
        assert not any(within(*one.screen(*place), card) for card in cards)
