"""All linkages with change points, by every method at every tolerance: a line for each run."""

import kempe as kp
import numpy as np
from singular.one_coordinate import places
from singular.test_change_points import LINKAGES, off, solved


def line(name: str, by: str, digits: int) -> str:
    """Distance from the branch, error and energy imbalance, or the reason of a failure."""
    run = f"{name:24} {by:7} 1e-{digits:<3}"
    try:
        sol = solved(name, by, 10.0**-digits)
    except (kp.SingularityError, kp.IntegrationError) as error:
        return f"{run} {error}"
    found = places(sol.q)
    astray = np.abs(found - LINKAGES[name]().branch.places(sol["crank"].angle)).max()
    imbalance = np.abs(sol.energy.balance).max()
    return f"{run} astray {astray:.1e}  error {off(name, sol):.1e}  energy {imbalance:.1e}"


def main() -> None:
    """Print all runs."""
    for name in LINKAGES:
        for by in ("dop853", "rk45", "auto"):
            for digits in range(3, 11):
                print(line(name, by, digits), flush=True)


if __name__ == "__main__":
    main()
