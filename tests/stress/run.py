"""Many random runs and their outcomes.

    PYTHONPATH=tests python -m stress.run --runs 100000 --processes 2

prints the outcomes, the longest run, the largest gaps, and every fault with its number. ``--only
4711`` repeats the run with this number. The exit code is 1 if there is a fault.
"""

import sys
from collections import Counter

import numpy as np
from stress import command
from stress.command import say
from stress.trial import Outcome, run


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


def report(outcomes: list[Outcome]) -> None:
    """Print the results by kind of mechanism."""
    for kind in sorted({o.kind for o in outcomes}):
        ended = Counter(o.ended for o in outcomes if o.kind == kind)
        say(f"{kind:<14} " + ", ".join(f"{name} {n}" for name, n in ended.most_common()))
    gaps(outcomes)


def told(o: Outcome) -> str:
    return f"{o.kind}, {o.options}: {'; '.join(o.faults)} {o.message}"


if __name__ == "__main__":
    sys.exit(command.main(__doc__ or "", run, report, told))
