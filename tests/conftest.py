"""Figures are closed after each test, one browser serves all tests, examples have no time limit."""

import os
import sys
import warnings
from collections.abc import Iterator
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
