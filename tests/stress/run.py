"""Many random runs and their outcomes.

    PYTHONPATH=tests python -m stress.run --runs 100000 --processes 2

prints the outcomes, the longest run, the largest gaps, and every fault with its number. ``--only
4711`` repeats the run with this number. The exit code is 1 if there is a fault.
"""

import argparse
import json
import multiprocessing
import sys
from collections import Counter
from dataclasses import asdict
from functools import partial
from pathlib import Path

import numpy as np
from stress.trial import Outcome, run


def say(text: str) -> None:
    print(text, flush=True)


def gaps(outcomes: list[Outcome]) -> None:
    """Quantiles of the gaps of the successes, by stabilization."""
    families = {"Projection": "Projection", "Baumgarte": "Baumgarte", "none": "stabilization=None"}
    for name, mark in families.items():
        found = [o.gap for o in outcomes if o.ended == "success" and mark in o.options]
        if not found:
            continue
        at = " ".join(f"{q:g}: {np.quantile(found, q):.1e}" for q in (0.5, 0.9, 0.99, 1))
        open_ = sum(not gap <= 1e-8 for gap in found)
        say(f"gaps, {name:<10} {len(found):>7} successes, quantiles {at}; above 1e-8: {open_}")


def report(outcomes: list[Outcome]) -> int:
    """Print the results and return the number of faults."""
    for kind in sorted({o.kind for o in outcomes}):
        ended = Counter(o.ended for o in outcomes if o.kind == kind)
        say(f"{kind:<14} " + ", ".join(f"{name} {n}" for name, n in ended.most_common()))
    gaps(outcomes)
    longest = max(outcomes, key=lambda o: o.seconds)
    say(f"longest: run {longest.number}, {longest.seconds:.2f} s ({longest.ended})")
    faulty = [o for o in outcomes if o.faults]
    for o in faulty[:50]:
        say(f"FAULT run {o.number}, {o.kind}, {o.options}: {'; '.join(o.faults)} {o.message}")
    say(f"{len(outcomes)} runs, {len(faulty)} with faults")
    return len(faulty)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--runs", type=int, default=100_000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=4)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--only", type=int)
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    if asked.only is not None:
        say(json.dumps(asdict(run(asked.seed, asked.only)), indent=2))
        return 0
    numbers = range(asked.first, asked.first + asked.runs)
    outcomes: list[Outcome] = []
    with multiprocessing.Pool(asked.processes) as pool:
        for outcome in pool.imap_unordered(partial(run, asked.seed), numbers, chunksize=50):
            outcomes.append(outcome)
            if len(outcomes) % 10_000 == 0:
                say(f"… {len(outcomes)}, faults so far {sum(bool(o.faults) for o in outcomes)}")
    if asked.json:
        asked.json.write_text(json.dumps([asdict(o) for o in outcomes]), "utf-8")
    return 1 if report(outcomes) else 0


if __name__ == "__main__":
    sys.exit(main())
