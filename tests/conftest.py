"""Figures are closed after each test, one browser serves all tests, examples have no time limit.

Before its last line, pytest prints the times of the stages of `./test`.
"""

import gc
import os
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

# The limit of 200 ms for one example depends on the load of the machine.
settings.register_profile("kempe", settings.default, deadline=None)
settings.load_profile("kempe")


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """A headless Chromium. Playwright allows one at a time."""
    sync_api = pytest.importorskip(
        "playwright.sync_api", reason="the package playwright is missing"
    )
    from browser.conftest import FLAGS, chromium

    path = chromium()
    if path is None:
        missing = "no Chromium (Debian: apt install chromium), and $CHROMIUM names none"
        pytest.fail(missing) if "CI" in os.environ else pytest.skip(missing)
    with sync_api.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield started
        started.close()


@pytest.fixture(autouse=True)
def _no_figure_is_left_open() -> Iterator[None]:
    """Matplotlib warns from the twentieth on."""
    with warnings.catch_warnings():
        yield
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """With `-m alone`, files without such tests are not even imported."""
    if config.option.markexpr != "alone" or not collection_path.name.startswith("test_"):
        return None
    return True if "mark.alone" not in collection_path.read_text("utf-8") else None


def pytest_collection_finish() -> None:
    """What the collection has made lasts, so that no search for garbage need look at it."""
    gc.collect()
    gc.freeze()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print the seconds of each stage of `./test`, which writes them to a file."""
    stages = os.environ.get("KEMPE_STAGES")
    if stages:
        terminalreporter.section("seconds of the stages before")
        terminalreporter.write(Path(stages).read_text("utf-8"))
