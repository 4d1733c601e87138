"""Cost of a gradient of a final value, in runs of the same case: CPU time, medians of several."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from pathlib import Path

import kempe as kp

ROOT = Path(__file__).parents[1]
REPEATS = 9


def seconds(work: Callable[[], object]) -> float:
    """The median CPU time of a call, s."""
    found = []
    for _ in range(REPEATS):
        begin = time.process_time()
        work()
        found.append(time.process_time() - begin)
    return statistics.median(found)


def main() -> None:
    """Print the ratios for the four-bar linkage, by number of variables."""
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    names = ["k", "c", "L2", "G", "L1", "L3", "crank.angle"]
    measure = ["rocker.angle.final"]
    run = seconds(lambda: kp.sweep(case, {"k": [1e6]}, measure, workers=1))
    print(f"run: {1e3 * run:.2f} ms")
    for count in (1, 3, 4, 7):
        chosen = names[:count]
        taken = seconds(lambda chosen=chosen: kp.gradient(case, measure, chosen))  # type: ignore[misc]
        print(f"{count} variables: {taken / run:.1f} runs")


if __name__ == "__main__":
    main()
