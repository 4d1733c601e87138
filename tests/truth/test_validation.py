"""The validation page agrees with the results of kempe."""

import json

import pytest

from benchmarks.validation.comparison import ROOT, Benchmark, Comparison, compared
from benchmarks.validation.convergence import PROBLEMS
from benchmarks.validation.page import FIGURES, PAGE, page, row
from benchmarks.validation.results import BENCHMARKS, MILLION, read, written

COMMITTED = read()
AGAIN = "run python -m benchmarks.validation"


def test_the_page_matches_the_numbers() -> None:
    assert page(COMMITTED) == PAGE.read_text("utf-8"), AGAIN
    assert json.loads(written(COMMITTED)) == json.loads(written(read()))
    assert all((PAGE.parent / FIGURES[problem.name]).exists() for problem in PROBLEMS), AGAIN


def test_the_numbers_are_within_their_tolerances() -> None:
    assert COMMITTED.holds
    assert all(kept.steps == MILLION for kept in COMMITTED.conservation)


def test_every_reference_has_its_benchmark() -> None:
    files = {path.name for path in (ROOT / "tests" / "reference").glob("*.json")}
    assert {b.reference for b in COMMITTED.benchmarks} == files


@pytest.mark.parametrize("number", range(len(BENCHMARKS)))
def test_the_numbers_are_reproduced(number: int) -> None:
    committed, found = COMMITTED.benchmarks[number], BENCHMARKS[number]()
    assert all(c.holds for c in found.comparisons), [c for c in found.comparisons if not c.holds]
    assert _asked(found) == _asked(committed), AGAIN


def _asked(b: Benchmark) -> list[tuple[str, int, float]]:
    """The comparison without the pair of numbers, which depends on rounding."""
    return [(c.quantity, c.count, c.tolerance) for c in b.comparisons]


def test_a_wrong_number_is_reported() -> None:
    off = compared("x", "m", [1.0, 2.0], [1.0, 2.1], 1e-3)
    assert off == Comparison("x", "m", 2, 2.0, 2.1, 1e-3)
    assert not off.holds
    assert "1.0e-01 **off**" in row(off)
