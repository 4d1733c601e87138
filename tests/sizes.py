"""Sizes of tests: a sample by default, all cases with KEMPE_FULL=1, which `./test full` sets."""

import os
from collections.abc import Sequence
from typing import TypeVar

import pytest

FULL = os.environ.get("KEMPE_FULL") == "1"
#: For a test whose fact another test shows too, on fewer cases or more cheaply.
only_full = pytest.mark.skipif(not FULL, reason="a larger number of cases: KEMPE_FULL=1")

T = TypeVar("T")


def some(cases: Sequence[T], number: int) -> list[T]:
    """A number of the cases, evenly spread; all of them in full size."""
    if FULL or number >= len(cases):
        return list(cases)
    return [cases[k * len(cases) // number] for k in range(number)]


def count(usual: int, full: int) -> int:
    """The usual number of random cases, or the one in full size."""
    return full if FULL else usual
