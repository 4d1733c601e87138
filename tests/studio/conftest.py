"""The built page of the studio in a headless Chromium, watched for messages, errors and requests."""

import os
import shutil
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

sync_api = pytest.importorskip("playwright.sync_api", reason="the package playwright is missing")

PAGE = Path(__file__).parents[2] / "studio" / "dist" / "index.html"
FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"]


@dataclass
class Studio:
    """A window with the studio, driven as a person would."""

    page: "sync_api.Page"
    messages: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def call(self, expression: str) -> Any:
        return self.page.evaluate(expression)

    def load(self, text: str) -> dict[str, Any]:
        found: dict[str, Any] = self.page.evaluate("text => kempe.load(text)", text)
        return found

    def toml(self) -> str:
        found: str = self.page.evaluate("kempe.toml()")
        return found

    def state(self) -> dict[str, Any]:
        found: dict[str, Any] = self.page.evaluate("kempe.state()")
        return found

    def quantity(self, name: str) -> float:
        found: float = self.page.evaluate("name => kempe.quantity(name).then(x => x.value)", name)
        return found

    def screen(self, x: float, y: float) -> tuple[float, float]:
        px, py = self.page.evaluate("at => kempe.screen(at)", [x, y])
        return px, py

    def click(self, x: float, y: float) -> None:
        self.page.mouse.click(*self.screen(x, y))
        self.settle()

    def tool(self, name: str) -> None:
        self.page.locator(f".left [data-type={name}]").click()

    def mode(self, name: str) -> None:
        self.page.locator(f"#mode-{name}").click()
        self.settle()

    def message(self) -> str:
        found: str = self.page.locator("#message").inner_text()
        return found

    def settle(self) -> None:
        """Wait until the core has answered what was sent before, and the answer is drawn."""
        for _ in range(3):
            self.page.evaluate("kempe.state().then(() => new Promise(requestAnimationFrame))")
            self.page.wait_for_timeout(40)

    def wait(self, condition: str, seconds: float = 10.0) -> None:
        """Wait for a condition; playwright's own waiting is forbidden by the policy of the page."""
        end = time.monotonic() + seconds
        while not self.page.evaluate(condition):
            assert time.monotonic() < end, condition
            self.page.wait_for_timeout(20)


Opener = Callable[..., Studio]


@pytest.fixture(scope="session")
def chromium() -> Iterator["sync_api.Browser"]:
    if not PAGE.exists():
        pytest.skip("studio/dist/index.html is missing; build it with npm run build in studio/")
    path = os.environ.get("CHROMIUM") or next(
        filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None
    )
    if path is None:
        pytest.skip("there is no Chromium; set $CHROMIUM to its path")
    with sync_api.sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield launched
        launched.close()


@pytest.fixture
def studio(chromium: "sync_api.Browser") -> Iterator[Opener]:
    """Open the studio in a window of a size; what it complains of, or requests, fails the test."""
    opened: list[Studio] = []

    def open_studio(width: int = 1280, height: int = 800, link: str = "", **more: Any) -> Studio:
        context = chromium.new_context(viewport={"width": width, "height": height}, **more)
        one = Studio(context.new_page())
        one.page.on("console", lambda message: one.messages.append(message.text))
        one.page.on("pageerror", lambda error: one.messages.append(str(error)))
        one.page.on("dialog", lambda dialog: one.messages.append(dialog.message))
        context.on("request", lambda request: one.requests.append(request.url))
        one.page.goto(PAGE.as_uri() + link)
        one.wait("typeof kempe === 'object' && kempe.state().then(state => state !== null)", 20.0)
        one.settle()
        opened.append(one)
        return one

    yield open_studio
    for one in opened:
        one.page.context.close()
        assert one.messages == []
        outside = [url for url in one.requests if not url.startswith(("blob:", "data:"))]
        assert len(outside) == 1, outside  # the page itself
