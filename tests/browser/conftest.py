"""A headless Chromium, and pages in it that are watched for messages, errors and requests."""

import os
import shutil
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

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
sync_api = pytest.importorskip("playwright.sync_api", reason="the package playwright is missing")


def chromium() -> str | None:
    """The browser that $CHROMIUM names, or the one of the system."""
    named = os.environ.get("CHROMIUM")
    return named or next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)


@pytest.fixture(scope="session")
def browser() -> Iterator["sync_api.Browser"]:
    path = chromium()
    if path is None:
        pytest.skip("no Chromium (Debian: apt install chromium), and $CHROMIUM names none")
    with sync_api.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield started
        started.close()


@dataclass
class Watched:
    """A page with its messages, errors and requests."""

    page: "sync_api.Page"
    messages: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def state(self) -> dict[str, object]:
        found: dict[str, object] = self.page.evaluate("kempe.state()")
        return found

    def settle(self) -> None:
        """Wait until what has changed is drawn."""
        self.page.evaluate(
            "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
        )

    def wait(self, condition: str, seconds: float = 10.0) -> None:
        """Wait for a condition; playwright's own waiting is forbidden by the policy of the page."""
        end = time.monotonic() + seconds
        while not self.page.evaluate(condition):
            assert time.monotonic() < end, condition
            self.page.wait_for_timeout(10)


Opener = Callable[..., Watched]


@pytest.fixture
def opened(browser: "sync_api.Browser", tmp_path: Path) -> Iterator[Opener]:
    """Open the player of a solution in a window of a size; what it complains of fails the test."""
    watched: list[Watched] = []

    def open_player(
        solution: kp.Solution | kp.State, width: int, height: int, **more: object
    ) -> Watched:
        path = kp.player(solution, tmp_path / "animation.html")
        context = browser.new_context(viewport={"width": width, "height": height}, **more)
        one = Watched(context.new_page())
        one.page.on("console", lambda message: one.messages.append(message.text))
        one.page.on("pageerror", lambda error: one.messages.append(str(error)))
        context.on("request", lambda request: one.requests.append(request.url))
        one.page.goto(path.as_uri())
        one.settle()
        watched.append(one)
        return one

    yield open_player
    for one in watched:
        one.page.context.close()
        assert one.messages == []
        assert len(one.requests) == 1, one.requests  # the page itself
