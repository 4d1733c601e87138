"""Write the page, its figures and its numbers: ``python -m benchmarks.validation``."""

from __future__ import annotations

import sys

from benchmarks.validation.convergence import PROBLEMS
from benchmarks.validation.figures import convergence
from benchmarks.validation.page import FIGURES, PAGE, page
from benchmarks.validation.results import FILE, computed, written


def main() -> int:
    """Compute, write, and print the numbers outside their tolerance."""
    results = computed()
    FILE.write_text(written(results), "utf-8")
    PAGE.write_text(page(results), "utf-8")
    for problem in PROBLEMS:
        found = [c for c in results.convergence if c.problem == problem.name]
        convergence(found, PAGE.parent / FIGURES[problem.name])
    numbers = [c for b in results.benchmarks for c in b.comparisons]
    off = [c.quantity for c in numbers if not c.holds]
    off += [f"{c.method} on {c.problem}" for c in results.convergence if not c.holds]
    off += [f"{c.method} over {c.steps} steps" for c in results.conservation if not c.holds]
    print(f"{sum(c.count for c in numbers)} numbers in {len(numbers)} rows; off: {off or 'none'}")
    return 0 if results.holds else 1


if __name__ == "__main__":
    sys.exit(main())
