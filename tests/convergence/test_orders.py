"""Every integrator converges with its theoretical order, in coordinates and multipliers."""

import pytest
from kempe import _core
from kempe.analyses.options import Option

from benchmarks.validation.convergence import (
    HALVINGS,
    METHODS,
    PROBLEMS,
    TOLERANCE,
    Integrator,
    Problem,
    converge,
    slope,
)


@pytest.mark.parametrize("integrator", METHODS, ids=lambda integrator: integrator.name)
@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda problem: problem.name)
def test_the_observed_order_agrees_with_theory(problem: Problem, integrator: Integrator) -> None:
    found = converge(problem, integrator)
    assert len(found.steps) == HALVINGS + 1 >= 4
    for observed, theory in zip(found.orders, found.theory, strict=True):
        assert abs(observed - theory) <= TOLERANCE, (observed, found)
    # above the level of rounding, where the slope is meaningful
    assert min(*found.q, *found.lam) > 2e-14, found


def test_every_method_is_studied() -> None:
    import json

    known = {table["name"] for table in json.loads(_core.catalogue())["methods"]}
    studied: set[str] = {_kind(integrator.method(0.1)) for integrator in METHODS}
    assert studied == known - {"auto"}  # it is a choice among the others


def _kind(method: Option) -> str:
    return method.kind


def test_the_slope_of_a_power() -> None:
    steps = (0.4, 0.2, 0.1)
    assert slope(steps, tuple(3 * h**5 for h in steps)) == pytest.approx(5)
