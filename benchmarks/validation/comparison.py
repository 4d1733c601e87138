"""A published number beside kempe's."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Comparison:
    """Numbers of one kind; of many, the pair that differs most.

    Attributes:
        quantity: what they are.
        unit: their unit.
        count: how many were compared.
        published: the published one.
        kempe: kempe's.
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
        """Whether it is within the tolerance."""
        return self.difference <= self.tolerance


@dataclass(frozen=True)
class Missing:
    """An entry of a reference that kempe does not give yet.

    Attributes:
        what: the entry.
        reason: why not.
    """

    what: str
    reason: str


@dataclass(frozen=True)
class Benchmark:
    """A benchmark with what was compared.

    Attributes:
        title: what it is.
        reference: file in tests/reference.
        source: where its numbers are from.
        settings: how kempe computed its own.
        comparisons: number by number.
        missing: what is in the file and not compared.
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
    """Equally many numbers of each, in any shape, also as text."""
    truth = np.asarray(published, dtype=np.float64).ravel()
    found = np.asarray(kempe, dtype=np.float64).ravel()
    if truth.shape != found.shape:
        raise ValueError(f"{quantity}: {len(truth)} published, {len(found)} found")
    at = int(np.argmax(np.abs(found - truth)))
    return Comparison(quantity, unit, len(truth), float(truth[at]), float(found[at]), tolerance)
