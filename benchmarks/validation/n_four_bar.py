"""N windows of parallelograms, which pass singular positions."""

from __future__ import annotations

from typing import Any

import kempe as kp
import numpy as np

from benchmarks.validation.comparison import (
    Benchmark,
    Comparison,
    Missing,
    compared,
    reference,
)
from examples import n_four_bar

#: Vertical force of the pins on the cranks at the start, N: on ground, then those above.
REACTIONS = {1: ([13.715, 13.715], 4.405), 2: ([13.715, 18.12, 13.715], 4.405)}
T_END = 20.0
#: Half of it, the span of most comparisons of this benchmark.
HALF = 10.0
#: Enough for 20 s; at a singular position that cannot be passed, the step collapses.
STEPS = 10_000


def solved(model: kp.Model, start: kp.State) -> tuple[kp.Solution, str | None]:
    """The motion over 20 s, or up to a failure with its reason."""
    try:
        return (
            kp.dynamics(
                model,
                start,
                t_end=T_END,
                output_step=0.05,
                method=kp.DOP853(rtol=1e-8, atol=1e-11),
                stabilization=kp.Projection(),
                max_steps=STEPS,
                dense_output=False,
            ),
            None,
        )
    except (kp.SingularityError, kp.IntegrationError) as error:
        return error.solution, type(error).__name__


def at_start(n: int, start: kp.State, truth: dict[str, Any]) -> list[Comparison]:
    """Rates, energy and reactions."""
    sol = kp.dynamics(start.model, start, t_end=0)
    energy = float(sol.energy.kinetic[0] + sol.energy.potential[0])
    published = float(truth["initial_energy_J(V=0 at ground line)"])
    found = [compared(f"N = {n}: energy at the start", "J", published, energy, 1e-10 * n)]
    if n in REACTIONS:
        below, above = REACTIONS[n]
        pins = [start[f"A{k}"].force(on=f"crank{k}", frame="global") for k in range(n + 1)]
        expected = [[0.0, force] for force in below]
        found.append(compared(f"N = {n}: pins on ground, on the cranks", "N", expected, pins, 1e-9))
        upper = [
            start[f"{j}{k}"].force(on=f"coupler{k}", frame="global") for k in range(n) for j in "BC"
        ]
        expected = [[0.0, above]] * (2 * n)
        found.append(compared(f"N = {n}: upper pins, on the couplers", "N", expected, upper, 1e-9))
    return found


def in_motion(
    n: int, sol: kp.Solution, table: dict[str, Any]
) -> tuple[list[Comparison], list[str]]:
    """B0 and its velocity at the published times; the times that were not reached.

    The error grows with every singular position, of which there are ten in 10 s. The tolerance for
    20 s is therefore ten times that for 10 s.
    """
    crank = sol["crank0"]
    here = np.column_stack([crank.x, crank.y, crank.vx, crank.vy]) * 2.0
    reached = [t for t in table if float(t) <= float(sol.t[-1]) + 1e-9]
    found = []
    for times, allowed in (
        ([t for t in reached if float(t) <= HALF], 1e-7),
        ([t for t in reached if float(t) > HALF], 1e-6),
    ):
        if not times:
            continue
        at = [int(np.argmin(np.abs(sol.t - float(t)))) for t in times]
        span = f"{times[0]} to {times[-1]} s"
        position = [[table[t]["x"], table[t]["y"]] for t in times]
        velocity = [[table[t]["vx"], table[t]["vy"]] for t in times]
        rate = f"N = {n}: velocity of B0, {span}"
        found += [
            compared(f"N = {n}: B0, {span}", "m", position, here[at, :2], allowed),
            compared(rate, "m/s", velocity, here[at, 2:], 10 * allowed),
        ]
    return found, [t for t in table if t not in reached]


def benchmark() -> Benchmark:
    """One, two and forty windows."""
    data = reference("n_four_bar")
    found: list[Comparison] = []
    missing: list[Missing] = []
    for name, truth in data["N"].items():
        n = int(name)
        model = n_four_bar.windows(n)
        start = n_four_bar.upright(model, n)
        sol, stopped = solved(model, start)
        found += at_start(n, start, truth)
        motion, later = in_motion(n, sol, truth["B0"])
        found += motion
        if later:
            what = f"N = {n}: B0 at {', '.join(later)} s"
            missing.append(Missing(what, f"{stopped} at t = {sol.t[-1]:.2f} s"))
    return Benchmark(
        "N-four-bar",
        "n_four_bar.json",
        f"{data['problem']}. Truth: {data['exact']}",
        "DOP853, rtol 1e-8, atol 1e-11, projection",
        tuple(found),
        tuple(missing),
    )
