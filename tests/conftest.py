"""Figures that a test opens are closed after it: Matplotlib warns from the twentieth on."""

import sys
import warnings
from collections.abc import Iterator

import pytest


@pytest.fixture(autouse=True)
def _no_figure_is_left_open() -> Iterator[None]:
    with warnings.catch_warnings():
        yield
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")
