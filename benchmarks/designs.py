"""The same problems of design by kempe and by SciPy by hand: runs, seconds and result.

    PYTHONPATH=tests .venv/bin/python benchmarks/designs.py

By hand means that each value of the objective is a run of the case, and slopes are differences.
The last line is the memory that 10 000 runs of a search add.
"""

from __future__ import annotations

import resource
import time
from collections.abc import Callable

import kempe as kp
import numpy as np
from design_problems.machines import lamp, slider_crank
from scipy.optimize import minimize

#: Runs of the search whose memory is measured.
RUNS = 10_000


def by_hand(case: kp.Case, names: list[str], of: str) -> Callable[..., float]:
    """An objective that runs the case, with the number of its calls."""

    def objective(values: np.ndarray) -> float:
        objective.calls += 1  # type: ignore[attr-defined]
        lists = {name: [x] for name, x in zip(names, values.tolist(), strict=True)}
        return float(kp.sweep(case, lists, [of])[of][0])

    objective.calls = 0  # type: ignore[attr-defined]
    return objective


def compare(title: str, made: tuple[kp.Case, dict[str, float]], of: str) -> None:
    """Print a line for each way to solve a problem."""
    case, exact = made
    names = list(exact)
    size = max(abs(x) for x in exact.values())
    bounds = {name: (0.0, 10 * (abs(exact[name]) or 0.1)) for name in names}
    begin = [case.model.parameters[name] for name in names]
    print(title)

    def line(who: str, runs: int, seconds: float, values: list[float]) -> None:
        error = max(abs(x - exact[n]) for n, x in zip(names, values, strict=True)) / size
        print(f"  {who:34} {runs:6} runs  {seconds:8.3f} s  error {error:.1e}")

    start = time.perf_counter()
    best = kp.optimize(case, bounds, minimize=of)
    line("kempe, exact slopes", best.runs, time.perf_counter() - start, list(best.values.values()))
    for who in ("SLSQP", "Nelder-Mead"):
        objective = by_hand(case, names, of)
        start = time.perf_counter()
        found = minimize(objective, begin, bounds=list(bounds.values()), method=who)
        seconds = time.perf_counter() - start
        line(f"SciPy by hand, {who}", objective.calls, seconds, list(found.x))  # type: ignore[attr-defined]


def memory() -> None:
    """Print the memory that a long search adds."""
    case, exact = lamp(1, 1, 9.81)
    bounds = {"k": (0, 10 * exact["k"]), "free": (-1, 1)}
    kp.optimize(case, bounds, minimize="over.effort.rms")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    done, seed, kept = 0, 0, []
    while done < RUNS:
        kept.append(
            kp.optimize(
                case, bounds, minimize="over.effort.rms", starts=256, seed=seed, method="slsqp"
            )
        )
        done, seed = done + kept[-1].runs, seed + 1
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(f"memory of {done} runs: {(after - before) / 1024:.1f} MB")


if __name__ == "__main__":
    compare("balanced lamp", lamp(1, 1, 9.81), "over.effort.rms")
    compare("spring of a slider-crank", slider_crank(1, 1, 1), "drive.effort.rms")
    memory()
