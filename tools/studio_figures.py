"""Make the pictures of the studio in docs/images/ from the built page.

    python tools/studio_figures.py

It needs Chromium (or $CHROMIUM) and playwright. tools/build_studio.sh builds the page.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from playwright.sync_api import sync_playwright

if TYPE_CHECKING:
    from playwright.sync_api import Page

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "studio" / "dist" / "index.html"
IMAGES = ROOT / "docs" / "images"
#: Simulated time at which the first picture is taken, s.
LIVE = 1.3


def wait(page: Page, condition: str) -> None:
    """Wait for a condition; the policy of the page forbids the waiting of playwright itself."""
    while not page.evaluate(condition):
        page.wait_for_timeout(20)


def live(page: Page) -> None:
    """The four-bar linkage in motion."""
    page.locator("#mode-live").click()
    page.locator("#hint button").click()
    wait(page, f"kempe.state().then(({{ t }}) => t > {LIVE})")
    page.screenshot(path=IMAGES / "studio.png")


def guide(page: Page) -> None:
    """The first build at its third step."""
    page.locator("#mode-edit").click()
    page.locator("#new").click()
    page.locator("#guide-begin").click()
    for step in (1, 2):
        wait(page, f"document.querySelector('.guide strong')?.innerText === '{step}/8'")
        page.locator(".tool.next").first.click()
        for _ in range(2):
            page.keyboard.press("Space")
            page.evaluate("kempe.settled()")
    wait(page, "document.querySelector('.guide strong')?.innerText === '3/8'")
    page.evaluate("new Promise(requestAnimationFrame)")
    page.screenshot(path=IMAGES / "studio_guide.png")


def main() -> None:
    """Write all pictures."""
    path = os.environ.get("CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.goto(PAGE.as_uri())
        wait(page, "typeof kempe === 'object' && kempe.state().then(state => state !== null)")
        live(page)
        guide(page)
        browser.close()


if __name__ == "__main__":
    main()
