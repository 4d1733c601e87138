"""Pages of a headless Chromium that are watched for messages, errors and requests."""

import os
import shutil
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import kempe as kp
import pytest

FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
#: Records where each canvas has texts since it was cleared, px from its corner.
RECORDER = """
  window.written = new Map();
  const { fillText, clearRect, drawImage } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.clearRect = function (...box) {
    written.set(this.canvas, []);
    return clearRect.apply(this, box);
  };
  CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...more) {
    const size = this.measureText(text);
    const at = this.getTransform().transformPoint(new DOMPoint(x, y));
    const scale = window.devicePixelRatio;
    const [cx, cy] = [at.x / scale, at.y / scale];
    const [left, right] = [cx - size.actualBoundingBoxLeft, cx + size.actualBoundingBoxRight];
    const [top, bottom] = [cy - size.actualBoundingBoxAscent, cy + size.actualBoundingBoxDescent];
    if (!written.has(this.canvas)) written.set(this.canvas, []);
    written.get(this.canvas).push({ text, left, right, top, bottom });
    return fillText.call(this, text, x, y, ...more);
  };
  CanvasRenderingContext2D.prototype.drawImage = function (image, ...more) {
    written.get(this.canvas).push(...written.get(image));
    return drawImage.call(this, image, ...more);
  };
"""
sync_api = pytest.importorskip("playwright.sync_api", reason="the package playwright is missing")


def chromium() -> str | None:
    """The browser that $CHROMIUM names, or the one of the system."""
    named = os.environ.get("CHROMIUM")
    return named or next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)


@dataclass
class Watched:
    """A page with its messages, errors and requests."""

    page: "sync_api.Page"
    messages: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def state(self) -> dict[str, object]:
        found: dict[str, object] = self.page.evaluate("kempe.state()")
        return found

    def choose(self, quantity: str, subject: str | None = None, plot: int = 0) -> None:
        """Plot a quantity of a subject, by their labels."""
        card = self.page.locator(".plot").nth(plot)
        card.locator(".quantity").select_option(label=quantity)
        if subject is not None:
            card.locator(".subject").select_option(label=subject)
        self.settle()

    def values(self, plot: int = 0) -> dict[str, str]:
        """Names and texts of the legend of a plot."""
        entries = self.page.locator(".plot").nth(plot).locator(".legend li").all()
        return {
            one.locator(".name").get_attribute("title"): one.locator(".value").inner_text()
            for one in entries
        }

    def seek(self, t: float) -> None:
        self.page.evaluate(f"kempe.seek({t!r})")
        self.settle()

    def texts(self, selector: str) -> list[dict[str, Any]]:
        """Texts on a canvas with their places, px from its corner."""
        found: list[dict[str, Any]] = self.page.evaluate(
            "selector => written.get(document.querySelector(selector))", selector
        )
        return found

    def settle(self) -> None:
        """Wait until what has changed is drawn, also where a change of size follows from it."""
        self.page.evaluate(
            """new Promise(done => {
              let frames = 4;
              const next = () => (frames-- ? requestAnimationFrame(next) : done());
              next();
            })"""
        )

    def wait(self, condition: str, seconds: float = 10.0) -> None:
        """Wait for a condition; playwright's own waiting is forbidden by the policy of the page."""
        end = time.monotonic() + seconds
        while not self.page.evaluate(condition):
            assert time.monotonic() < end, condition
            self.page.wait_for_timeout(10)


Opener = Callable[..., Watched]


@pytest.fixture(scope="session")
def pages() -> dict[str, Watched]:
    """Pages that tests leave to each other, by the options of their contexts."""
    return {}


@pytest.fixture
def opened(
    browser: "sync_api.Browser", pages: dict[str, Watched], tmp_path: Path
) -> Iterator[Opener]:
    """Open the player of a solution in a window of a size; what it complains of fails the test."""
    watched: dict[str, Watched] = {}

    def open_player(
        solution: kp.Solution | kp.State, width: int, height: int, **more: object
    ) -> Watched:
        path = kp.player(solution, tmp_path / f"animation{len(watched)}.html")
        kind = repr(more)
        if kind in watched:  # a second window beside the first
            kind = f"{kind}, {len(watched)}"
        if kind not in pages:
            pages[kind] = new_page(browser, **more)
        one = watched[kind] = pages[kind]
        one.messages.clear()
        one.requests.clear()
        one.page.set_viewport_size({"width": width, "height": height})
        one.page.goto(path.as_uri())
        one.settle()
        return one

    yield open_player
    for one in watched.values():
        one.page.goto("about:blank")  # nothing runs on
        assert one.messages == []
        outside = [url for url in one.requests if not url.startswith(("blob:", "about:"))]
        assert len(outside) == 1, outside  # the page itself


def new_page(browser: "sync_api.Browser", **more: Any) -> Watched:
    """A page that notes its messages, errors and requests, and the texts on its canvases."""
    context = browser.new_context(**more)
    context.add_init_script(RECORDER)
    one = Watched(context.new_page())
    one.page.on("console", lambda message: one.messages.append(message.text))
    one.page.on("pageerror", lambda error: one.messages.append(str(error)))
    context.on("request", lambda request: one.requests.append(request.url))
    return one
