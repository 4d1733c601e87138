"""Make the pictures of the studio in docs/images/ from the built page.

    python tools/studio_figures.py

It needs Chromium (or $CHROMIUM) and playwright. tools/build_studio.sh builds the page.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any

from playwright.sync_api import sync_playwright

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "studio" / "dist" / "index.html"
IMAGES = ROOT / "docs" / "images"
DESKTOP = {"width": 1280, "height": 800}
PHONE = {"width": 390, "height": 780}
#: Simulated time at which the first picture is taken, s.
LIVE = 1.3


def opened(browser: Browser, size: dict[str, int], **more: Any) -> Page:
    """The page in a window of its own, when the core is ready."""
    page = browser.new_page(viewport=size, **more)
    page.add_init_script("localStorage.setItem('kempe.visited', '1')")
    page.goto(PAGE.as_uri())
    wait(page, "typeof kempe === 'object' && kempe.state().then(state => state !== null)")
    return page


def wait(page: Page, condition: str) -> None:
    """Wait for a condition; the policy of the page forbids the waiting of playwright itself."""
    while not page.evaluate(condition):
        page.wait_for_timeout(20)


def load(page: Page, example: str) -> None:
    """Open an example from the gallery, which fits it into the drawing."""
    page.locator("#gallery").click()
    page.locator(f"[data-example={example}]").click()
    page.evaluate("kempe.settled()")


def enter(page: Page, mode: str) -> None:
    """Switch to a mode and hide its hint."""
    page.locator(f"#mode-{mode}").click()
    page.locator("#hint button").click()


def save(page: Page, name: str) -> None:
    """Take a picture of the window when everything is drawn."""
    page.mouse.move(0, 0)
    page.wait_for_timeout(300)
    page.screenshot(path=IMAGES / f"{name}.png")


def live(page: Page) -> None:
    """The four-bar linkage in motion."""
    enter(page, "live")
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


def move(page: Page) -> None:
    """A garage door while its arm is dragged, with its assembly modes."""
    load(page, "garage_door")
    enter(page, "move")
    page.locator("#find-configurations").click()
    page.evaluate("kempe.settled()")
    joint = page.evaluate("kempe.screen([1.8794, 0.6840])")
    page.mouse.move(*joint)
    page.mouse.down()
    page.mouse.move(*page.evaluate("kempe.screen([1.5, 1.32])"), steps=10)
    page.evaluate("kempe.settled()")
    page.wait_for_timeout(300)
    page.screenshot(path=IMAGES / "studio_move.png")
    page.mouse.up()


def run(page: Page, example: str, share: float) -> None:
    """Read an example, at a share of its run."""
    load(page, example)
    enter(page, "read")
    wait(page, "document.querySelector('#scrub') !== null")
    slide = """(e, share) => {
      e.value = Number(e.min) + share * (e.max - e.min);
      e.dispatchEvent(new Event("input", { bubbles: true }));
    }"""
    page.locator("#scrub").evaluate(slide, share)
    page.evaluate("kempe.settled()")


def read(page: Page) -> None:
    """All forces on one body of the squeezer, and a plot of the force of its spring."""
    run(page, "squeezer", 0.3)
    for kind in ("Reactions", "Forces"):
        page.get_by_label(kind, exact=True).check()
    page.locator("#on-body").select_option("K3")
    page.get_by_label("Add plot").select_option("spring.force")
    for _ in range(page.locator(".plot").first.locator(".legend li").count()):
        page.locator(".plot").first.locator(".legend li button").first.click()
    page.get_by_label("Add plot").select_option("B.force")
    page.get_by_role("button", name="Zoom in (+)").click()
    save(page, "studio_read")


def on_phone(page: Page) -> None:
    """The drawing above the panel, in a narrow window."""
    load(page, "slider_crank")
    enter(page, "move")
    save(page, "studio_phone")


def dark(page: Page) -> None:
    """Paths of the points of a leg, in dark colours."""
    run(page, "jansen_leg", 0.3)
    page.get_by_role("button", name="Zoom in (+)").click()
    save(page, "studio_dark")


def design(page: Page) -> None:
    """Three poses of a coupler, and the first four-bar that takes them."""
    poses = '[-0.4, 0.2, "0 deg"], [0, 0.4, "30 deg"], [0.4, 0.3, "75 deg"]'
    page.evaluate(
        "text => kempe.load(text)",
        f'kempe = 1\n\n[synthesis]\ntask = "motion"\nposes = [{poses}]\n',
    )
    enter(page, "design")
    wait(page, "document.querySelector('#take') !== null")
    page.get_by_role("button", name="Zoom in (+)").click()
    save(page, "studio_design")


def main() -> None:
    """Write all pictures."""
    path = os.environ.get("CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        page = opened(browser, DESKTOP)
        live(page)
        guide(page)
        move(opened(browser, DESKTOP))
        read(opened(browser, DESKTOP))
        design(opened(browser, DESKTOP))
        phone = opened(browser, PHONE, device_scale_factor=2, has_touch=True, is_mobile=True)
        on_phone(phone)
        dark(opened(browser, DESKTOP, color_scheme="dark"))
        browser.close()


if __name__ == "__main__":
    main()
