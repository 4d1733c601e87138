"""All data of the page: computed, written and read."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from benchmarks.validation import (
    adams,
    andrews,
    closed_forms,
    four_bar,
    n_four_bar,
    pendulum,
)
from benchmarks.validation.comparison import Benchmark, Comparison, Missing
from benchmarks.validation.conservation import Conserved, conserve, released
from benchmarks.validation.convergence import METHODS, Convergence, study

FILE = Path(__file__).with_name("results.json")

#: Steps of the long runs.
MILLION = 1_000_000

#: The benchmarks, in the order of the page; each file of tests/reference has one.
BENCHMARKS: tuple[Callable[[], Benchmark], ...] = (
    four_bar.benchmark,
    adams.benchmark,
    pendulum.benchmark,
    n_four_bar.benchmark,
    andrews.benchmark,
    closed_forms.benchmark,
)


@dataclass(frozen=True)
class Results:
    """All results.

    Attributes:
        benchmarks: comparisons with published results.
        convergence: observed orders.
        conservation: conservation over a million steps.
    """

    benchmarks: tuple[Benchmark, ...]
    convergence: tuple[Convergence, ...]
    conservation: tuple[Conserved, ...]

    @property
    def holds(self) -> bool:
        """Whether every number and every order is within its tolerance."""
        numbers = [c.holds for b in self.benchmarks for c in b.comparisons]
        observed = [*self.convergence, *self.conservation]
        return all(numbers) and all(one.holds for one in observed)


def computed() -> Results:
    """From runs of kempe."""
    kept = tuple(conserve(integrator, released(), MILLION) for integrator in METHODS)
    return Results(tuple(make() for make in BENCHMARKS), tuple(study()), kept)


def written(results: Results) -> str:
    """As JSON."""
    return json.dumps(asdict(results), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def read(path: Path = FILE) -> Results:
    """From JSON."""
    data = json.loads(path.read_text("utf-8"))
    return Results(
        tuple(_benchmark(b) for b in data["benchmarks"]),
        tuple(_convergence(c) for c in data["convergence"]),
        tuple(Conserved(**c) for c in data["conservation"]),
    )


def _benchmark(data: dict[str, Any]) -> Benchmark:
    comparisons = tuple(Comparison(**c) for c in data["comparisons"])
    missing = tuple(Missing(**m) for m in data["missing"])
    return Benchmark(**{**data, "comparisons": comparisons, "missing": missing})


def _convergence(data: dict[str, Any]) -> Convergence:
    return Convergence(**{k: tuple(v) if isinstance(v, list) else v for k, v in data.items()})
