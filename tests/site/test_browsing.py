"""A browser opens every page of the site on desktop and phone, and searches it from a file too."""

import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest
from sizes import only_full

#: One process builds the site.
pytestmark = [pytest.mark.xdist_group("site"), only_full]

WINDOWS = {"desktop": (1360, 900), "phone": (390, 844)}


def size(window: str) -> dict[str, int]:
    width, height = WINDOWS[window]
    return {"width": width, "height": height}


def is_wide(page: Any) -> bool:
    """Whether the page is wider than the window."""
    wide: bool = page.evaluate("document.documentElement.scrollWidth > innerWidth")
    return wide


def lost_formulas(page: Any) -> int:
    """The number of formulas that are typeset, but too narrow to be seen."""
    lost: int = page.evaluate(
        """() => [...document.querySelectorAll("mjx-container > svg")]
          .filter((one) => one.getBoundingClientRect().width < 3).length"""
    )
    return lost


def pages(site: Path) -> list[Path]:
    """All pages, except that for wrong addresses; the gallery shows the players."""
    return sorted(
        path
        for path in site.rglob("*.html")
        if path.name != "404.html" and path.parent.name != "players"
    )


class Watched:
    """A page of the browser, with what it complains of."""

    def __init__(self, browser: Any, window: str, allowed: str) -> None:
        self.context = browser.new_context(viewport=size(window))
        self.page = self.context.new_page()
        self.complaints: list[str] = []
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("requestfailed", self._failed)
        self.context.on("request", lambda request: self._requested(request.url, allowed))

    def _failed(self, request: Any) -> None:
        if request.failure != "net::ERR_ABORTED":  # the next page was opened
            self.complaints.append(f"{request.url}: {request.failure}")

    def _requested(self, url: str, allowed: str) -> None:
        if not url.startswith((allowed, "data:", "blob:")):
            self.complaints.append(url)


@pytest.fixture
def server(site: Path) -> Iterator[str]:
    """The address of a server of the site."""
    handler = partial(SimpleHTTPRequestHandler, directory=str(site))

    server = ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()


def test_every_page_opens(site: Path, browser: Any, server: str) -> None:
    """On the desktop, then in the window of a phone: no message, no other host, no wide page.

    Formulas are visible in both.
    """
    watched = Watched(browser, "desktop", allowed=server)
    page, wide, lost = watched.page, [], []
    for path in pages(site):
        name = path.relative_to(site).as_posix()
        page.set_viewport_size(size("desktop"))
        page.goto(f"{server}{name}")
        if "arithmatex" in path.read_text("utf-8"):
            page.wait_for_selector("mjx-container", state="attached")
        for window in WINDOWS:
            page.set_viewport_size(size(window))
            wide += [f"{name} on a {window}"] if is_wide(page) else []
            lost += [f"{name} on a {window}"] if lost_formulas(page) else []
        assert not watched.complaints, name
    watched.context.close()
    assert not wide
    assert not lost


@pytest.mark.parametrize("window", WINDOWS)
@pytest.mark.parametrize("from_server", [False, True])
def test_the_search_finds_the_weld(
    site: Path, browser: Any, server: str, window: str, from_server: bool
) -> None:
    root = server if from_server else f"{site.as_uri()}/"
    watched = Watched(browser, window, allowed=root)
    page = watched.page
    page.goto(f"{root}index.html")
    if window == "phone":
        page.click("label.md-header__button[for=__search]")
    page.click("input.md-search__input")
    page.wait_for_selector("text=Type to start searching")
    page.keyboard.type("weld")
    page.wait_for_selector(".md-search-result__item a")
    found = page.eval_on_selector_all(".md-search-result__item a", "all => all.map(a => a.href)")
    assert any("/elements/weld.html" in address for address in found[:3]), found
    page.click(".md-search-result__item a")
    page.wait_for_load_state()
    assert "weld" in page.inner_text("article").lower()
    assert not watched.complaints
    watched.context.close()


def test_the_copy_button_takes_the_commands_only(site: Path, browser: Any) -> None:
    watched = Watched(browser, "desktop", allowed=site.as_uri())
    watched.page.goto(f"{site.as_uri()}/start.html")
    text = watched.page.evaluate(
        """() => {
          const all = [...document.querySelectorAll("pre code")];
          const code = all.find((one) => one.innerText.includes("kempe check swing"));
          code.setAttribute("data-md-copying", "");
          return code.innerText;
        }"""
    )
    commands = [line for line in text.splitlines() if line]
    assert commands == ["./kempe check swing.toml", "./kempe run swing.toml --quiet"]
    watched.context.close()
