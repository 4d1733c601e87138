"""Cost of a step of ``kp.Stepper`` from Python: CPU time, and its ratio to a run."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import kempe as kp

ROOT = Path(__file__).parents[1]
#: Steps of 10 ms of each measurement.
STEPS = 2000


def seconds(call: Callable[[], object], times: int) -> float:
    """The least CPU time of a call in five series."""
    least = float("inf")
    for _ in range(5):
        began = time.process_time()
        for _ in range(times):
            call()
        least = min(least, (time.process_time() - began) / times)
    return least


def main() -> None:
    """Print the times for some examples."""
    print("example: a step of 10 ms; with an input and an output; a run, for each 10 ms (ratio)")
    for name in ("pendulum", "four_bar", "slider_crank", "motor_press", "slamming_door"):
        case = kp.load(ROOT / "examples" / f"{name}.toml")
        stepper, model = kp.Stepper(case.with_parameters({})), case.model
        parameter, value = next(iter(model.parameters.items()))
        quantity = f"{next(iter(stepper.state.compiled.bodies))}.x"

        def looked() -> None:
            stepper.set(parameter, value)  # noqa: B023
            stepper.step(0.01)  # noqa: B023
            _ = stepper[quantity]  # noqa: B023

        alone = seconds(lambda: stepper.step(0.01), STEPS)  # noqa: B023
        stepper.reset()
        loop = seconds(looked, STEPS // 4)
        start = case.start()

        def run() -> None:
            end = float(start.t) + 0.01 * STEPS  # noqa: B023
            kp.dynamics(model, start, t_end=end, output_step=0.01)  # noqa: B023

        each = seconds(run, 1) / STEPS
        print(
            f"{name}: {1e6 * alone:.1f} µs; {1e6 * loop:.1f} µs; {1e6 * each:.1f} µs "
            f"({alone / each:.1f})"
        )


if __name__ == "__main__":
    main()
