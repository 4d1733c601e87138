"""The searches beside other tools: each adapter has the right optimum, and the page its numbers."""

import json

import numpy as np
import optimizers
import pytest


def test_the_page_in_the_docs_matches_the_numbers() -> None:
    found = json.loads(optimizers.RESULTS.read_text("utf-8"))
    written = optimizers.PAGE.read_text("utf-8")
    assert optimizers.page(found) == written, "run python benchmarks/optimizers.py --page"


@pytest.mark.parametrize("problem", optimizers.WAYS)
def test_kempe_and_formulas_by_hand_find_the_optimum(problem: str) -> None:
    exact = optimizers.LENGTHS if problem == "path" else optimizers.SPRING
    for who in ("kempe", "SciPy by hand, least_squares"):
        runs, values = optimizers.WAYS[problem][who]()
        assert values == pytest.approx(list(exact.values()), rel=1e-6)
        assert runs < (60 if who.startswith("SciPy") else 25)


def test_the_objectives_of_the_other_tools_are_zero_at_the_optimum() -> None:
    pytest.importorskip("pylinkage")
    made, squares = optimizers.pylinkage_of_path()
    for _ in range(2):  # a call does not change the next one
        assert squares(made, optimizers.polar(optimizers.LENGTHS.values())) < 1e-20
    values = list(optimizers.LENGTHS.values())
    assert optimizers.lengths_of(optimizers.polar(values)) == pytest.approx(values)


def test_the_objective_of_exudyn_is_nearly_zero_at_the_optimum() -> None:
    pytest.importorskip("exudyn")
    assert np.sqrt(optimizers.swing_by_exudyn(optimizers.SPRING)) < 1e-4
