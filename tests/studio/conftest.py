"""The built page of the studio in Chromium, watched for messages, errors and requests."""

import functools
import http.server
import os
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from kempe.studio import sources
from kempe.studio.page import read
from studio.window import VISITED, Studio

sync_api = pytest.importorskip("playwright.sync_api", reason="the package playwright is missing")

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "studio" / "dist" / "index.html"
#: The case with which a page begins.
FIRST = ROOT / "examples" / "four_bar.toml"
#: Files are chosen and downloaded as in browsers without access to files.
NO_PICKERS = "delete window.showOpenFilePicker; delete window.showSaveFilePicker"


@pytest.fixture(scope="session")
def built() -> None:
    """The page of the studio was built from the present sources."""
    if not PAGE.exists():
        pytest.skip("studio/dist/index.html is missing; tools/build_studio.sh builds it")
    if read(PAGE).sources != sources.checksum():
        refuse = pytest.fail if os.environ.get("CI") else pytest.skip
        refuse("studio/dist/index.html is not of the present sources; run tools/build_studio.sh")


def opened(
    browser: "sync_api.Browser",
    link: str = "",
    page: Path = PAGE,
    *,
    first: bool = False,
    **more: Any,
) -> Studio:
    """The studio in a window of its own, which notes messages, errors and requests.

    At the `first` visit, a mechanism moves.
    """
    context = browser.new_context(**more)
    context.add_init_script(NO_PICKERS)
    if not first:
        context.add_init_script(VISITED)
    one = Studio(context.new_page())
    one.page.on("console", lambda message: one.messages.append(message.text))
    one.page.on("pageerror", lambda error: one.messages.append(str(error)))
    one.page.on("dialog", lambda dialog: one.messages.append(dialog.message))
    context.on("request", lambda request: one.requests.append(request.url))
    one.page.goto(page.as_uri() + link)
    one.wait("typeof kempe === 'object' && kempe.state().then(state => state !== null)", 20.0)
    if not first:
        one.settle()
    return one


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture(scope="module")
def site() -> Iterator[str]:
    """The page at an address of http."""
    handler = functools.partial(Quiet, directory=str(PAGE.parent))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}/index.html"
    server.shutdown()
    server.server_close()


def ready(page: "sync_api.Page") -> Studio:
    """The studio in a page that was opened or loaded again, when it is ready."""
    one = Studio(page)
    one.wait("typeof kempe === 'object' && kempe.state().then(state => state !== null)", 20.0)
    one.settle()
    page.wait_for_timeout(300)
    return one


def check_silence(one: Studio, pages: int) -> None:
    """Nothing was complained of, and nothing was requested but the page itself, `pages` times."""
    assert one.messages == []
    outside = [url for url in one.requests if not url.startswith(("blob:", "data:"))]
    assert len(outside) == pages, outside


@pytest.fixture
def fresh(
    built: None,  # noqa: ARG001 - without the page no browser is started
    browser: "sync_api.Browser",
) -> Iterator[Callable[..., Studio]]:
    """Open the studio in a new window of a size; its complaints and requests fail the test."""
    windows: list[Studio] = []

    def open_studio(width: int = 1280, height: int = 800, **more: Any) -> Studio:
        size = {"width": width, "height": height}
        windows.append(opened(browser, viewport=size, **more))
        return windows[-1]

    yield open_studio
    for one in windows:
        one.page.context.close()
        check_silence(one, 1)


@pytest.fixture(scope="session")
def lasting(
    built: None,  # noqa: ARG001
    browser: "sync_api.Browser",
) -> Iterator[Studio]:
    """One window for all tests that load a case of their own."""
    one = opened(browser, viewport={"width": 1280, "height": 800}, accept_downloads=True)
    yield one
    one.page.context.close()


def reset(lasting: Studio, width: int = 1280, height: int = 800) -> Studio:
    """The lasting window as it opens: in *Edit*, with the first example."""
    lasting.page.set_viewport_size({"width": width, "height": height})
    lasting.page.keyboard.press("Escape")
    if lasting.page.locator("#guide-leave").count():
        lasting.page.locator("#guide-leave").click()
    lasting.load(FIRST.read_text(encoding="utf-8"))
    lasting.page.locator("#tab-main").click()
    lasting.page.locator("#length-unit").select_option("m")
    lasting.settle()
    lasting.left = False
    return lasting


@pytest.fixture
def studio(lasting: Studio) -> Iterator[Callable[..., Studio]]:
    """The lasting window in a size, as it opens."""
    lasting.messages.clear()
    lasting.requests.clear()

    def open_studio(width: int = 1280, height: int = 800) -> Studio:
        reset(lasting, width, height)
        lasting.left = True
        return lasting

    yield open_studio
    check_silence(lasting, 0)


@pytest.fixture
def one(lasting: Studio) -> Iterator[Studio]:
    """The lasting window in *Edit* without its text; its complaints and requests fail the test."""
    if lasting.left:
        reset(lasting)
    lasting.mode("edit")
    lasting.page.locator("#tab-main").click()
    lasting.messages.clear()
    lasting.requests.clear()
    yield lasting
    check_silence(lasting, 0)
