"""Thirty and more named mechanisms: mobility by their geometry, and the table in the docs."""

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from mobility.named import NAMED, table


def test_there_are_thirty() -> None:
    assert len(NAMED) >= 30


@pytest.mark.parametrize("name", NAMED)
def test_mobility_of_a_named_mechanism(name: str) -> None:
    drawn = NAMED[name]
    model = drawn.model(name)
    state = drawn.state(model)
    assert np.abs(state.residuals[0]).max() < 1e-12
    found = kp.mobility(model, state)
    # the velocities of points of rigid bodies, without the equations of kempe
    rows = drawn.jacobian()
    n, m = 3 * (len(drawn.bodies) - 1), len(rows)
    rank = np.linalg.matrix_rank(rows)
    assert (model.compile().n_q, model.compile().n_rows) == (n, m)
    assert found.gruebler == n - m
    assert found.rank == rank
    assert found.degrees_of_freedom == n - rank == drawn.freedom
    assert len(found.redundant) == m - rank
    assert not found.singular
    assert {loop.kind for loop in found.four_bars} == drawn.loops()
    assert bool(found.locked) == (drawn.freedom == 0)
    assert not found.loose


def test_grashofs_rule_of_the_known_four_bars() -> None:
    kinds = {
        "Crank-rocker": "crank-rocker",
        "Drag link": "double crank",
        "Four-bar with short coupler": "double rocker",
        "Chebyshev's lambda linkage": "crank-rocker",
        "Chebyshev's straight line": "double rocker",
        "Roberts's straight line": "triple rocker",
        "Watt's straight line": "triple rocker",
        "Parallelogram": "change point",
        "Antiparallelogram": "change point",
        "Kite": "change point",
    }
    for name, kind in kinds.items():
        model = NAMED[name].model(name)
        (loop,) = kp.mobility(model, NAMED[name].state(model)).four_bars
        assert loop.kind == kind, name


def test_the_table_in_the_documentation() -> None:
    assert table() in (ROOT / "docs/mobility.md").read_text("utf-8")
