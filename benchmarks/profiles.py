"""Compare the times of runs of two builds of kempe.

    python benchmarks/profiles.py OTHER [--runs 15]

OTHER is a folder with the package `kempe` and its extension, such as `python/` of another checkout
that was set up with `KEMPE_PROFILE=release ./kempe --version`. The examples run in alternation in
processes of their own. The table has the medians of the ratios: the package that is imported here,
divided by the other one.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
EXAMPLES = ("four_bar", "six_bar", "slider_crank", "squeezer", "cam_roller")
#: Runs in a process; the least time counts.
WITHIN = 5
_CODE = """
import json, sys, time
import kempe as kp
times = {}
for name in sys.argv[2:]:
    case = kp.load(f"{sys.argv[1]}/{name}.toml")
    case.run()
    best = float("inf")
    for _ in range(WITHIN):
        begin = time.process_time()
        case.run()
        best = min(best, time.process_time() - begin)
    times[name] = best
print(json.dumps(times))
""".replace("WITHIN", str(WITHIN))


def times(package: Path) -> dict[str, float]:
    """The least time of each example in s, in a process with the given package."""
    command = [sys.executable, "-c", _CODE, str(ROOT / "examples"), *EXAMPLES]
    environment = {**os.environ, "PYTHONPATH": str(package)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    found: dict[str, float] = json.loads(done.stdout)
    return found


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("other", type=Path)
    parser.add_argument("--runs", type=int, default=15)
    asked = parser.parse_args()
    ratios: dict[str, list[float]] = {name: [] for name in EXAMPLES}
    for _ in range(asked.runs):
        here, there = times(ROOT / "python"), times(asked.other)
        for name in EXAMPLES:
            ratios[name].append(here[name] / there[name])
    for name, all_of_it in ratios.items():
        print(f"| {name} | {statistics.median(all_of_it):.2f} |")


if __name__ == "__main__":
    main()
