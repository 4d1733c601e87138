"""Scatter of runs past change points: every linkage by DOP853 at 16 similar tolerances."""

import argparse

import kempe as kp
import numpy as np
from singular.test_change_points import LINKAGES, off, solved


def main() -> None:
    """Print a line for each linkage, and one for all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rtol", type=float, nargs="?", default=1e-10)
    parser.add_argument("--method", choices=["dop853", "rk45", "auto"], default="dop853")
    asked = parser.parse_args()
    everything, stopped = [], 0
    for name in LINKAGES:
        errors = []
        for rtol in asked.rtol * 0.7 * 2.2 ** (np.arange(16) / 16):
            try:
                errors.append(off(name, solved(name, asked.method, rtol)))
            except (kp.SingularityError, kp.IntegrationError):
                stopped += 1
        everything += errors
        print(f"{name:24} median {np.median(errors):.1e}  worst {max(errors):.1e}", flush=True)
    above = np.sum(np.array(everything) > 1e-3)
    print(f"{len(everything) + stopped} runs: {above} off by more than 1e-3, {stopped} stopped")


if __name__ == "__main__":
    main()
