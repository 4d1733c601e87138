"""Random clicks, drags, keys and typing: no exception, no lost text, and a history both ways."""

import random
from pathlib import Path

import pytest
from sizes import FULL
from studio.window import Opener, Studio

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
KEYS = [
    *("Escape", "Enter", "Delete", "ArrowLeft", "ArrowUp", "Space", "Tab", "+", "-", "0", "3"),
    *("1", "2", "4", "Control+z", "Control+Shift+z", "Control+c", "Control+v", "Shift+ArrowRight"),
]
WORDS = [
    "0",
    "1.5",
    "-2",
    "10,5",
    "1e300",
    "abc",
    "x y",
    "[1, 2",
    "0.5*L",
    "",
    "10 rpm",
    "ä",
    "nan",
    "]",
]


class Person:
    """Acts at random; a seed repeats everything but the time that the core takes."""

    def __init__(self, one: Studio, seed: int) -> None:
        self.one = one
        self.chance = random.Random(seed)
        self.done: list[str] = []
        self.acts = [
            *(5 * [self.click_sheet]),
            *(3 * [self.drag_sheet]),
            *(3 * [self.tool]),
            *(2 * [self.press]),
            *(2 * [self.field]),
            *(2 * [self.key]),
            self.control,
            self.mode,
            self.editor,
            self.menu,
            self.wheel,
        ]

    def act(self) -> None:
        what = self.chance.choice(self.acts)
        self.done.append(what.__name__)
        what()
        live = self.one.call("document.querySelector('#mode-live').ariaChecked === 'true'")
        if self.chance.random() < 0.3 and not live:
            self.one.settle()

    def place(self) -> tuple[float, float]:
        box = self.one.page.locator("#sheet").bounding_box()
        assert box
        share = [0.05 + 0.9 * self.chance.random() for _ in range(2)]
        return box["x"] + share[0] * box["width"], box["y"] + share[1] * box["height"]

    def click_sheet(self) -> None:
        self.one.page.mouse.click(*self.place())

    def drag_sheet(self) -> None:
        mouse = self.one.page.mouse
        mouse.move(*self.place())
        mouse.down()
        mouse.move(*self.place(), steps=3)
        if self.chance.random() < 0.1:
            self.one.page.keyboard.press("Escape")
        mouse.up()

    def tool(self) -> None:
        self.any(".left .tool")

    def press(self) -> None:
        self.any(".side button:not([disabled]), .bar button:not([disabled])")

    def control(self) -> None:
        self.any(".side input[type=checkbox], .bar input[type=checkbox], #undo:not([disabled])")

    def mode(self) -> None:
        self.any("#mode-edit, #mode-move, #mode-live, #mode-read, #mode-design, #mode-edit")

    def key(self) -> None:
        self.one.page.keyboard.press(self.chance.choice(KEYS))

    def wheel(self) -> None:
        self.one.page.mouse.move(*self.place())
        self.one.page.mouse.wheel(0, self.chance.choice([-200, 200]))

    def field(self) -> None:
        words = self.chance.choice(WORDS)
        self.any(".side input[type=text], .side textarea.notation", words)

    def editor(self) -> None:
        """Type at the end of the text."""
        self.any("#tab-text")
        editor = self.one.page.locator(".cm-content")
        if editor.count():
            editor.click()
            self.one.page.keyboard.press("Control+End")
            self.one.page.keyboard.type(f"\n# {self.chance.choice(WORDS)}")
            self.one.page.wait_for_timeout(120)
        self.any("#tab-main")

    def menu(self) -> None:
        if self.chance.random() < 0.3:
            self.any("#new")
        elif self.chance.random() < 0.5:
            self.one.page.mouse.click(*self.place(), button="right")
            self.one.page.wait_for_timeout(60)
            self.any("#menu button:not([aria-disabled=true])")
        else:
            self.one.call(
                "text => kempe.load(text)", self.chance.choice(EXAMPLES).read_text("utf-8")
            )

    def any(self, selector: str, words: str | None = None) -> None:
        """Click one of the controls in view, without those that open a dialog of the system."""
        found = self.one.call(
            """selector => [...document.querySelectorAll(selector)].flatMap((one, k) => {
              const { width, height } = one.getBoundingClientRect();
              const opens = /PNG|SVG|GIF|CSV|NPZ|Compare|picture/.test(one.innerText + one.id);
              return width && height && !opens ? [k] : [];
            })""",
            selector,
        )
        if not found:
            return
        one = self.one.page.locator(selector).nth(self.chance.choice(found))
        try:
            one.click(timeout=400)
            if words is not None:
                one.fill(words, timeout=400)
                self.one.page.keyboard.press("Enter")
        except Exception as fault:  # the control has gone, or another one lies over it
            if "Timeout" not in type(fault).__name__ and "Timeout" not in str(fault):
                raise


def history(one: Studio, button: str) -> list[str]:
    """The texts from the present one to the end of the history in one direction."""
    found = [one.toml()]
    while one.page.locator(button).is_enabled():
        one.page.locator(button).click()
        one.settle()
        found.append(one.toml())
        assert len(found) < 500
    return found


@pytest.mark.parametrize("seed", range(50) if FULL else (3,))
def test_random_use_loses_nothing(fresh: Opener, seed: int) -> None:
    one = fresh()
    person = Person(one, seed)
    for _ in range(150 if FULL else 80):
        person.act()
    one.settle()
    one.page.keyboard.press("Escape")
    if one.page.locator("dialog").count():
        one.page.keyboard.press("Escape")
    one.mode("edit")
    one.page.wait_for_timeout(300)
    one.settle()
    assert one.messages == [], person.done
    last = history(one, "#redo")[-1]  # some steps may have been undone
    back = history(one, "#undo")
    forth = history(one, "#redo")
    assert forth[-1] == last
    assert forth == back[::-1]
    one.page.wait_for_timeout(400)
    one.page.reload()
    one.wait("typeof kempe === 'object' && kempe.toml().then(text => text.length > 0)", 20.0)
    one.settle()
    assert one.toml() == last
    one.requests.remove(one.page.url)
