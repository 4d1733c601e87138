"""Garage doors and 40 random linkages through change points, by every method: a table of passes."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from functools import cache
from typing import Any

import kempe as kp
import numpy as np
from singular.one_coordinate import places
from singular.random_linkages import random_linkages

T_END = 2.0
GRID = np.arange(201) * 0.01
#: Each method, and the largest error of any x (m), y, cosine or sine over the run that its
#: tolerance or step explains.
METHODS: dict[str, tuple[Any, float]] = {
    "rk45": (kp.RK45(rtol=1e-8, atol=1e-11), 1e-4),
    "dop853": (kp.DOP853(rtol=1e-8, atol=1e-11), 1e-4),
    "rk4, step 1 ms": (kp.RK4(step=1e-3), 1e-4),
    "radau": (kp.Radau(rtol=1e-8, atol=1e-11), 1e-4),
    "radau, step 1 ms": (kp.Radau(step=1e-3), 1e-4),
    "generalized-α": (kp.GeneralizedAlpha(rtol=1e-6, atol=1e-9), 2e-2),
    "generalized-α, step 1 ms": (kp.GeneralizedAlpha(step=1e-3), 2e-2),
    "auto": (kp.Auto(), 1e-4),
}
#: Largest distance from the branch at the same crank angle; on another it is 0.1 and more.
ASTRAY = 1e-4


@dataclass(frozen=True)
class Outcome:
    """Outcome of a run: `error` and distance from the branch, or the reason of a stop."""

    error: float = np.nan
    astray: float = np.nan
    stopped: str = ""


LINKAGES = random_linkages()


@cache
def truth(name: str) -> np.ndarray:
    """Places of the bodies of a linkage by the differential equation of one coordinate."""
    linkage = LINKAGES[name]
    return linkage.branch.places(linkage.branch.motion(linkage.s0, linkage.rate, GRID))


def compared(name: str, method: Any) -> Outcome:
    """Runs a linkage and compares it with its branch."""
    linkage = LINKAGES[name]
    try:
        sol = kp.dynamics(
            linkage.model, linkage.start(), t_end=T_END, output_step=0.01, method=method
        )
    except (kp.SingularityError, kp.IntegrationError) as error:
        return Outcome(stopped=str(error))
    found, first = places(sol.q), sol[linkage.branch.bodies[0].name].angle
    astray = np.abs(found - linkage.branch.places(first)).max()
    return Outcome(float(np.abs(found - truth(name)).max()), float(astray))


def verdict(outcome: Outcome, allowed: float) -> str:
    """Whether a run passed, stopped, or is wrong."""
    if outcome.stopped:
        return "stopped"
    right = outcome.error < allowed and outcome.astray < ASTRAY
    return "passed" if right else "wrong"


def main() -> None:
    """Print a line for each run that did not pass, and the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("methods", nargs="*", help="parts of names of methods; default: all")
    asked = parser.parse_args().methods
    chosen = {n: m for n, m in METHODS.items() if not asked or any(a in n for a in asked)}
    table = {}
    for by, (method, allowed) in chosen.items():
        outcomes = {name: compared(name, method) for name in LINKAGES}
        verdicts = {name: verdict(o, allowed) for name, o in outcomes.items()}
        for name, found in verdicts.items():
            if found != "passed":
                print(f"{by:26}{name:28}{found:9}{outcomes[name]}", flush=True)
        errors = [o.error for o in outcomes.values() if not o.stopped] or [np.nan]
        counts = [list(verdicts.values()).count(x) for x in ("passed", "stopped", "wrong")]
        table[by] = (*counts, np.median(errors), max(errors))
    print(f"{'method':26}{'passed':>8}{'stopped':>9}{'wrong':>7}{'median error':>14}{'worst':>9}")
    for by, (passed, stopped, wrong, median, worst) in table.items():
        print(f"{by:26}{passed:8}{stopped:9}{wrong:7}{median:14.1e}{worst:9.1e}")


if __name__ == "__main__":
    main()
