"""Comparison of published numbers with those of kempe."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Comparison:
    """Numbers of one kind, represented by the pair with the largest difference.

    Attributes:
        quantity: name of the quantity.
        unit: unit of the numbers.
        count: number of compared values.
        published: the published value.
        kempe: the value of kempe.
        tolerance: largest difference allowed.
    """

    quantity: str
    unit: str
    count: int
    published: float
    kempe: float
    tolerance: float

    @property
    def difference(self) -> float:
        """Largest difference."""
        return abs(self.kempe - self.published)

    @property
    def holds(self) -> bool:
        """Whether the difference is within the tolerance."""
        return self.difference <= self.tolerance


@dataclass(frozen=True)
class Missing:
    """An entry of a reference that kempe does not reproduce yet.

    Attributes:
        what: the entry.
        reason: the reason.
    """

    what: str
    reason: str


@dataclass(frozen=True)
class Benchmark:
    """A benchmark with its comparisons.

    Attributes:
        title: title of the benchmark.
        reference: file in tests/reference.
        source: source of the published numbers.
        settings: settings of the computation with kempe.
        comparisons: the comparisons.
        missing: entries of the file that are not compared.
    """

    title: str
    reference: str
    source: str
    settings: str
    comparisons: tuple[Comparison, ...]
    missing: tuple[Missing, ...] = ()


def reference(name: str) -> dict[str, Any]:
    """A file of tests/reference."""
    text = (ROOT / "tests" / "reference" / f"{name}.json").read_text("utf-8")
    return dict(json.loads(text))


def compared(quantity: str, unit: str, published: Any, kempe: Any, tolerance: float) -> Comparison:
    """Both sets as flat arrays of equal size; entries may be texts."""
    truth = np.asarray(published, dtype=np.float64).ravel()
    found = np.asarray(kempe, dtype=np.float64).ravel()
    if truth.shape != found.shape:
        raise ValueError(f"{quantity}: {len(truth)} published, {len(found)} found")
    at = int(np.argmax(np.abs(found - truth)))
    return Comparison(quantity, unit, len(truth), float(truth[at]), float(found[at]), tolerance)
