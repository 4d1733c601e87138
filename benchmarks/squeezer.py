"""Andrews' squeezing mechanism to t = 0.03 s, called from Python.

    python -m benchmarks.squeezer [--repeat 25]

For each tolerance, the program prints the largest error of the seven angles against
tests/reference, the steps, the evaluations, and the median CPU times of a call and of the core.
"""

from __future__ import annotations

import argparse
import statistics
import time

import kempe as kp

from benchmarks.validation.andrews import T_END, angles, case, run
from benchmarks.validation.comparison import reference

TOLERANCES = (1e-8, 1e-9, 1e-10, 1e-11, 1e-12)


def error(sol: kp.Solution) -> float:
    """Largest error of an angle, rad."""
    truth = reference("andrews")[f"angles_at_{T_END}"]
    return max(abs(float(truth[name]) - angle) for name, angle in angles(sol).items())


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--repeat", type=int, default=25)
    asked = parser.parse_args()
    squeezer = case()
    start = squeezer.start()
    model = start.model
    print("method    rtol    error    steps  evaluations  ms called  ms in the core")
    for method in (kp.RK45, kp.DOP853):
        for rtol in TOLERANCES:
            called, inside = [], []
            for _ in range(asked.repeat):
                begin = time.process_time()
                sol = run(model, start, method(rtol=rtol, atol=max(0.1 * rtol, 1e-12)))
                called.append(1e3 * (time.process_time() - begin))
                inside.append(1e3 * sol.statistics["seconds"])
            took = sol.statistics
            print(
                f"{method.__name__:<7} {rtol:7.0e} {error(sol):8.1e} {took['steps']:8d}"
                f" {took['evaluations']:12d} {statistics.median(called):10.2f}"
                f" {statistics.median(inside):15.2f}"
            )


if __name__ == "__main__":
    main()
