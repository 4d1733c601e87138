"""Count the clicks and keys of five tasks in the studio, as a newcomer does them.

    python benchmarks/studio_tasks.py

The program does each task in the built page, in Chromium, only through what is visible. It prints
the numbers of clicks, drags and keys, and the time that the keystroke-level model estimates: Card,
Moran and Newell, "The keystroke-level model for user performance time with interactive systems",
Communications of the ACM 23 (1980). It needs Chromium (or $CHROMIUM) and playwright.
"""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from playwright.sync_api import sync_playwright

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Locator, Page

PAGE = Path(__file__).parents[1] / "studio" / "dist" / "index.html"
#: Times of the operators, s: a key, pointing, a press or release of the mouse, a hand that changes
#: between mouse and keyboard, and a thought before each part of a task.
KEY, POINT, BUTTON, HOME, THINK = 0.28, 1.1, 0.1, 0.4, 1.35
#: Places on the sheet, as shares of its width and height.
A, B, C, D = (0.3, 0.65), (0.36, 0.5), (0.6, 0.25), (0.65, 0.65)
PATIENCE = 30_000


@dataclass
class Count:
    """What hands and head do in one task."""

    clicks: int = 0
    drags: int = 0
    keys: int = 0
    homes: int = 0
    thoughts: int = 0
    at_keyboard: bool = field(default=False, repr=False)

    @property
    def seconds(self) -> float:
        """The time of the keystroke-level model."""
        pointed = self.clicks * (POINT + 2 * BUTTON) + self.drags * 2 * (POINT + BUTTON)
        return pointed + self.keys * KEY + self.homes * HOME + self.thoughts * THINK

    def hands_at(self, keyboard: bool) -> None:
        """Move the hand to the keyboard or to the mouse."""
        self.homes += keyboard != self.at_keyboard
        self.at_keyboard = keyboard


class Person:
    """Does what is counted; finds buttons by their words only."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.count = Count()

    def think(self) -> None:
        """Think of the next part of the task."""
        self.count.thoughts += 1

    def press(self, target: Locator) -> None:
        """Click a control."""
        self.count.hands_at(keyboard=False)
        self.count.clicks += 1
        target.click()

    def button(self, words: str) -> None:
        """Click a button by its words."""
        self.press(self.page.get_by_role("button", name=words, exact=True).first)

    def mode(self, words: str) -> None:
        """Change the mode."""
        self.press(self.page.get_by_role("radio", name=words, exact=True))

    def place(self, at: tuple[float, float]) -> tuple[float, float]:
        """Where a place of the sheet is in the window, px."""
        box = self.page.locator("canvas#sheet").bounding_box()
        assert box
        return box["x"] + at[0] * box["width"], box["y"] + at[1] * box["height"]

    def sheet(self, *places: tuple[float, float]) -> None:
        """Click places of the sheet."""
        for at in places:
            self.count.hands_at(keyboard=False)
            self.count.clicks += 1
            self.page.mouse.click(*self.place(at))
            self.page.wait_for_timeout(300)

    def drag(self, begin: tuple[float, float], end: tuple[float, float]) -> None:
        """Drag from one place of the sheet to another."""
        self.count.hands_at(keyboard=False)
        self.count.drags += 1
        self.page.mouse.move(*self.place(begin))
        self.page.mouse.down()
        self.page.mouse.move(*self.place(end), steps=5)
        self.page.mouse.up()
        self.page.wait_for_timeout(300)

    def type(self, words: str) -> None:
        """Type words and press enter."""
        self.count.hands_at(keyboard=True)
        self.count.keys += len(words) + 1
        self.page.keyboard.type(words)
        self.page.keyboard.press("Enter")

    def see(self, words: str) -> None:
        """What shows the person that the task is done; it is not counted."""
        self.page.get_by_text(words).first.wait_for(timeout=PATIENCE)


def draw_a_four_bar(one: Person) -> None:
    """Draw a four-bar linkage on an empty sheet."""
    one.think()
    one.button("New")
    one.think()
    one.button("Ground")
    one.sheet(A, D)
    one.think()
    one.button("Bar")
    one.sheet(A, B)
    one.sheet(B, C)
    one.sheet(C, D)
    one.see("1 degree of freedom")


def change_a_length(one: Person) -> None:
    """Give the coupler the length of 1.2 m."""
    one.think()
    one.button("Select and drag")
    one.sheet(middle(B, C))
    one.think()
    one.press(one.page.get_by_label("length", exact=True).first)
    one.page.keyboard.press("Control+a")
    one.count.keys += 1
    one.type("1.2")
    one.see("1.20000 m")


def see_a_coupler_curve(one: Person) -> None:
    """Turn the crank and see the path of a point of the coupler."""
    one.think()
    one.button("Add a point")
    one.think()
    one.button("Driver")
    one.sheet(middle(A, B))
    one.think()
    one.mode("Read")
    one.see("states up to")


def find_the_peak_force(one: Person) -> None:
    """Find the largest force in a pin of the run."""
    one.think()
    one.press(one.page.get_by_label("Measure a quantity").first)
    one.type("C.force")
    one.see("peak")


def send_it(one: Person) -> None:
    """Copy a link that contains the mechanism."""
    one.think()
    one.button("Share")
    one.think()
    one.button("Copy the link")
    one.see("The link was copied.")


TASKS: dict[str, Callable[[Person], None]] = {
    "draw a four-bar": draw_a_four_bar,
    "change a length": change_a_length,
    "see a coupler curve": see_a_coupler_curve,
    "find the peak force in a pin": find_the_peak_force,
    "send it to a friend": send_it,
}


def middle(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """The middle of two places."""
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2


def counted() -> dict[str, Count]:
    """Do all tasks one after the other in one window."""
    path = os.environ.get("CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        context = browser.new_context(
            viewport={"width": 1280, "height": 800},
            permissions=["clipboard-read", "clipboard-write"],
        )
        one = Person(context.new_page())
        one.page.set_default_timeout(PATIENCE)
        one.page.add_init_script("localStorage.setItem('kempe.visited', '1')")
        one.page.goto(PAGE.as_uri())
        one.see("degree of freedom")
        found = {}
        for name, task in TASKS.items():
            one.count = Count()
            task(one)
            found[name] = one.count
        browser.close()
    return found


def main() -> None:
    """Print the table of docs/studio.md."""
    print("| task | clicks | drags | keys | estimated time |")
    print("|---|---|---|---|---|")
    for name, count in counted().items():
        numbers = f"{count.clicks} | {count.drags} | {count.keys}"
        print(f"| {name} | {numbers} | {count.seconds:.0f} s |")


if __name__ == "__main__":
    main()
