"""Energy and constraint violation over very many steps: the four-bar linkage without its spring.

    python -m benchmarks.validation.conservation [--method DOP853] [--steps 1000000] [--angle -60]

The linkage is released from rest with the crank at -60° and swings through 83° without damping. The
period is twice the time to the other turning point, where the rate of the crank is zero in a run of
DOP853 at rtol 1e-13. The step is constant, a hundredth of the period. The states are projected onto
the constraints after every step. The results are the largest |Φ| and the largest change of the
energy relative to the largest kinetic energy, at two thousand times in different phases of the
motion.
"""

from __future__ import annotations

import argparse
import json
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import kempe as kp
import numpy as np

from benchmarks.validation.convergence import METHODS, Integrator, free_four_bar

#: Steps per period.
STEPS = 100
#: Reported states.
STATES = 2000
#: Largest |Φ| allowed, m.
CLOSED = 1e-10
#: Largest drift allowed, for the methods with a limit.
KEPT = {"DOP853": 1e-9}


@dataclass(frozen=True)
class Conserved:
    """Conservation in one run.

    Attributes:
        method: name of the method.
        period: period of the motion, s.
        steps: number of steps.
        residual: largest |Φ|, m.
        drift: largest change of the energy over the largest kinetic energy.
        seconds: wall time.
    """

    method: str
    period: float
    steps: int
    residual: float
    drift: float
    seconds: float

    @property
    def holds(self) -> bool:
        """Whether constraint violation and energy drift are within their limits."""
        return self.residual <= CLOSED and self.drift <= KEPT.get(self.method, np.inf)


def released(degrees: float = -60) -> kp.State:
    """The state at rest with the crank at this angle."""
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    return kp.assemble(free_four_bar(), set={"crank.angle": f"{degrees}*deg"}, guess=guess)


def period(start: kp.State) -> float:
    """Twice the time until the crank is at rest again, by bisection of the interpolant."""
    method = kp.DOP853(rtol=1e-13, atol=1e-13)
    sol = kp.dynamics(start.model, start, t_end=30, output_step=0.01, method=method)
    rate = np.asarray(sol["crank"].omega)
    sign = np.sign(rate[1])
    first = 1 + int(np.argmax(rate[1:] * sign <= 0))
    low, high = float(sol.t[first - 1]), float(sol.t[first])
    for _ in range(60):
        middle = (low + high) / 2
        if sol(middle)["crank"].omega * sign > 0:
            low = middle
        else:
            high = middle
    return 2 * low


def conserve(integrator: Integrator, start: kp.State, steps: int) -> Conserved:
    """Conservation in a run with this number of steps."""
    turn = period(start)
    h = turn / STEPS
    begin = time.perf_counter()
    sol = kp.dynamics(
        start.model,
        start,
        t_end=steps * h,
        output_step=steps * h / (STATES + 1 / np.e),
        method=integrator.method(h),
        stabilization=kp.Projection(),
        max_steps=steps,
        dense_output=False,
    )
    seconds = time.perf_counter() - begin
    return Conserved(
        integrator.name,
        turn,
        int(sol.statistics["steps"]),
        float(sol.drift.position.max()),
        float(np.abs(sol.energy.balance).max()),
        seconds,
    )


def main() -> None:
    """Run and report."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    names = [integrator.name for integrator in METHODS]
    parser.add_argument("--method", choices=names, default="DOP853")
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--angle", type=float, default=-60)
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    integrator = next(i for i in METHODS if i.name == asked.method)
    found = conserve(integrator, released(asked.angle), asked.steps)
    print(
        f"{found.method}, {found.steps} steps of 1/{STEPS} of a period of {found.period:.6f} s: "
        f"residual {found.residual:.1e} m, energy drift {found.drift:.1e}, {found.seconds:.1f} s"
    )
    if asked.json:
        asked.json.write_text(json.dumps(asdict(found), indent=2) + "\n", "utf-8")


if __name__ == "__main__":
    main()
