"""Repeated calls: the cache changes neither results nor errors."""

import json
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from decimal import Decimal
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.analyses import request_cache
from kempe.model.model import Model
from kempe.results.solution import Solution
from kempe.results.state import State

GRID: dict[str, Any] = {"t_end": 0.1, "output_step": 0.005}


@pytest.fixture(autouse=True)
def nothing_kept() -> Iterator[None]:
    request_cache._kept.clear()
    yield
    request_cache._kept.clear()


def numbers(sol: Solution) -> tuple[bytes, ...]:
    return tuple(x.tobytes() for x in (sol.t, sol.q, sol.v, sol.a, sol.lam, sol.energy.total))


def anew(model: Model, start: State, **wanted: Any) -> Solution:
    """The same call with a fresh model and an empty cache."""
    request_cache._kept.clear()
    fresh = Model.from_tree(model.tree())
    return kp.dynamics(fresh, start, **wanted)


def message(model: Model, start: State, **wanted: Any) -> str:
    with pytest.raises(kp.ModelError) as refused:
        kp.dynamics(model, start, **wanted)
    return str(refused.value)


@pytest.mark.parametrize("method", [kp.DOP853(rtol=1e-5), kp.Radau(), kp.Auto(), kp.RK4(1e-3)])
def test_the_same_asked_again_gives_the_same_bits(model: Model, start: State, method: Any) -> None:
    first, again = (kp.dynamics(model, start, method=method, **GRID) for _ in range(2))
    assert len(request_cache._kept) == 1
    assert numbers(first) == numbers(again)
    assert numbers(again) == numbers(anew(model, start, method=method, **GRID))


def test_what_differs_is_not_taken_for_the_same(model: Model, start: State) -> None:
    ways: list[dict[str, Any]] = [
        {"method": kp.DOP853()},
        {"method": kp.RK45()},
        {"method": kp.RK45(rtol=1e-4)},
        {"method": kp.RK45(), "stabilization": None},
        {"method": kp.RK45(), "stabilization": kp.Baumgarte()},
        {"method": kp.RK45(), "stabilization": kp.Baumgarte(5.0, 100.0)},
        {"method": kp.RK45(max_step=1e-2)},
        {"method": kp.RK45(first_step=1e-2)},
        {"method": kp.RK45(), "dense_output": False},
    ]
    for _ in range(2):
        for way in ways:
            sol = kp.dynamics(model, start, **GRID, **way)
            kept = dict(request_cache._kept)
            fresh = anew(model, start, **GRID, **way)
            request_cache._kept.update(kept)
            assert numbers(sol) == numbers(fresh)
            assert (sol.dense is None) == (fresh.dense is None)
            assert sol.statistics["evaluations"] == fresh.statistics["evaluations"]
            assert sol.compiled.case == fresh.compiled.case


def test_the_end_is_that_of_the_call(model: Model, start: State) -> None:
    for t_end in (0.1, 0.05, 1, np.float64(0.07), np.array(0.03), "0.02*2"):
        sol = kp.dynamics(model, start, t_end=t_end, output_step=0.01)
        fresh = anew(model, start, t_end=t_end, output_step=0.01)
        kp.dynamics(model, start, t_end=0.1, output_step=0.01)
        assert numbers(sol) == numbers(fresh)
        assert json.loads(sol.compiled.case) == json.loads(fresh.compiled.case)
    for wrong in (float("nan"), float("inf"), True, None, "", "nothing", Decimal(1)):
        told = message(model, start, t_end=wrong, output_step=0.01)
        request_cache._kept.clear()
        assert told == message(model, start, t_end=wrong, output_step=0.01)
        kp.dynamics(model, start, t_end=0.1, output_step=0.01)


def test_options_changed_after_use_count_as_they_are(model: Model, start: State) -> None:
    method = kp.RK45(rtol=1e-8)
    kp.dynamics(model, start, method=method, **GRID)
    object.__setattr__(method, "rtol", 1e-3)
    sol = kp.dynamics(model, start, method=method, **GRID)
    assert numbers(sol) == numbers(anew(model, start, method=kp.RK45(rtol=1e-3), **GRID))

    held = np.array(1e-8)
    method = kp.RK45(rtol=held)  # type: ignore[arg-type]
    kp.dynamics(model, start, method=method, **GRID)
    held[...] = 1e-3
    assert numbers(kp.dynamics(model, start, method=method, **GRID)) == numbers(sol)


def test_numbers_that_are_equal_are_not_all_the_same(model: Model, start: State) -> None:
    kp.dynamics(model, start, method=kp.RK45(max_step=1.0), **GRID)
    for wrong in (True, Decimal(1)):
        told = message(model, start, method=kp.RK45(max_step=wrong), **GRID)  # type: ignore[arg-type]
        assert "is not a real number" in told
    for zero in (0.0, -0.0):
        way = {"method": kp.RK45(), "stabilization": kp.Baumgarte(zero, 10.0)}
        sol = kp.dynamics(model, start, **GRID, **way)
        assert f'"alpha": {zero}' in sol.compiled.case
    kp.dynamics(model, start, max_steps=1000, **GRID)
    sol = kp.dynamics(model, start, max_steps=1000.0, **GRID)  # type: ignore[arg-type]
    assert '"max_steps": 1000.0' in sol.compiled.case


def test_a_wrong_option_is_refused_each_time(model: Model, start: State) -> None:
    for wrong in (kp.RK45(rtol=-1.0), kp.RK45(rtol="nothing"), kp.RK45(rtol=float("nan")), "rk45"):
        first, again = (message(model, start, method=wrong, **GRID) for _ in range(2))
        assert first == again
        kp.dynamics(model, start, method=kp.RK45(), **GRID)
        assert message(model, start, method=wrong, **GRID) == first


def test_formulas_are_of_the_model_that_is_asked(model: Model, start: State) -> None:
    other = model.with_parameters({"k": 5e6})
    method = kp.RK45(rtol=1e-3, max_step="k*2e-10")
    runs = [kp.dynamics(m, start, method=method, **GRID) for m in (model, other, model)]
    steps = [sol.statistics["steps"] for sol in runs]
    assert steps[0] == steps[2] > 2 * steps[1]
    assert numbers(runs[1]) == numbers(anew(other, start, method=method, **GRID))


def test_no_more_are_kept_than_few(model: Model, start: State) -> None:
    for k in range(request_cache._MOST + 3):
        kp.dynamics(model, start, t_end=0.001, method=kp.RK45(rtol=1e-3 * (k + 1)))
    assert len(request_cache._kept) <= request_cache._MOST


def test_threads_get_what_they_ask_for(model: Model, start: State) -> None:
    rtols = [10.0 ** -(3 + k % 6) for k in range(48)]

    def run(rtol: float) -> tuple[bytes, ...]:
        return numbers(kp.dynamics(model, start, method=kp.DOP853(rtol=rtol), **GRID))

    def alone(rtol: float) -> tuple[bytes, ...]:
        return numbers(anew(model, start, method=kp.DOP853(rtol=rtol), **GRID))

    single = {rtol: alone(rtol) for rtol in rtols}
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(run, rtols)) == [single[rtol] for rtol in rtols]
