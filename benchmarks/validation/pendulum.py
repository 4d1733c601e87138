"""Pendulums, compared with elliptic integrals."""

from __future__ import annotations

from typing import Any

import kempe as kp
import numpy as np

from benchmarks.validation.comparison import Benchmark, Comparison, compared, reference

METHOD = kp.DOP853(rtol=1e-13, atol=1e-14)


def point() -> kp.Model:
    """A point mass on a massless rod of 1 m."""
    m = kp.Model("point pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("bob", mass=1, inertia=0, points={"P": (0, 0)})
    m.distance("rod", "ground.O", "bob.P", length=1)
    return m


def uniform_rod() -> kp.Model:
    """A uniform rod of 1 m."""
    m = kp.Model("rod", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2.5, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    return m


def simulated(model: kp.Model, start: kp.State, t_end: float, step: float) -> kp.Solution:
    """Simulate with tight tolerances."""
    return kp.dynamics(
        model,
        start,
        t_end=t_end,
        output_step=step,
        method=METHOD,
        stabilization=kp.Projection(tolerance=1e-14),
        max_steps=1_000_000,
        dense_output=False,
    )


def positions(table: dict[str, Any]) -> list[Comparison]:
    """The point mass released from horizontal, up to 2000 s."""
    m = point()
    start = kp.assemble(m, set={"bob.y": 0, "bob.angle": 0}, guess={"bob.x": -1})
    found = []
    for step, times, tolerance in (
        (0.01, ["0.5", "1", "2", "5", "9.99", "10", "20"], 1e-10),
        (100, ["100", "1000", "2000"], 1e-7),
    ):
        sol = simulated(m, start, float(times[-1]), step)
        at = [int(np.argmin(np.abs(sol.t - float(t)))) for t in times]
        truth = [[table[t]["x"], table[t]["y"]] for t in times]
        what = f"point mass: position, {times[0]} to {times[-1]} s"
        found.append(compared(what, "m", truth, sol.q[at, :2], tolerance))
    return found


def period(sol: kp.Solution, swing: np.ndarray, rate: np.ndarray) -> float:
    """Four times the time to the lowest point, the zero of `swing`, by cubic interpolation."""
    k = int(np.argmax(swing <= 0)) - 1
    h = sol.t[k + 1] - sol.t[k]
    a, b, da, db = swing[k], swing[k + 1], rate[k] * h, rate[k + 1] * h
    cubic = np.array([da + db - 2 * (b - a), 3 * (b - a) - 2 * da - db, da, a])
    roots = np.roots(cubic)
    real = roots[np.abs(roots.imag) < 1e-9].real
    theta = float(real[(real >= -1e-9) & (real <= 1 + 1e-9)][0])
    return 4.0 * float(sol.t[k] + theta * h)


def periods_of_rod(table: dict[str, Any]) -> Comparison:
    """A uniform rod released at the amplitude."""
    m, found = uniform_rod(), []
    for degrees, expected in table.items():
        start = kp.assemble(m, set={"rod.angle": f"({degrees} - 90)*deg"})
        sol = simulated(m, start, 0.3 * float(expected), 1e-3 * float(expected))
        rod = sol["rod"]
        found.append(period(sol, rod.angle + np.pi / 2, rod.omega))
    return compared("uniform rod: periods, 1° to 179°", "s", list(table.values()), found, 1e-9)


def periods_of_point(table: dict[str, Any]) -> Comparison:
    """The point mass released at the amplitude; x is zero at the lowest point."""
    m, found = point(), []
    for degrees, expected in table.items():
        x, y = np.sin(np.radians(float(degrees))), -np.cos(np.radians(float(degrees)))
        start = kp.assemble(m, set={"bob.angle": 0}, guess={"bob.x": float(x), "bob.y": float(y)})
        sol = simulated(m, start, 0.3 * float(expected), 1e-3 * float(expected))
        bob = sol["bob"]
        found.append(period(sol, bob.x, bob.vx))
    return compared("point mass: periods, 1° to 179°", "s", list(table.values()), found, 1e-9)


def reactions() -> list[Comparison]:
    """The pin of a uniform rod released from horizontal, over its weight."""
    m = uniform_rod()
    sol = simulated(m, kp.assemble(m, set={"rod.angle": 0}), 0.48, 0.01)
    below = -sol["rod"].angle
    force = sol["pin"].force(on="rod", frame="global") / (2.5 * 9.81)
    towards = np.column_stack([-np.cos(below), np.sin(below)])
    upward = np.column_stack([np.sin(below), np.cos(below)])
    along, across = (force * towards).sum(axis=1), (force * upward).sum(axis=1)
    return [
        compared("rod: force along it, over the weight", "-", 2.5 * np.sin(below), along, 1e-11),
        compared("rod: force across it, over the weight", "-", np.cos(below) / 4, across, 1e-11),
    ]


def benchmark() -> Benchmark:
    """Positions, periods and reactions."""
    data = reference("pendulum")
    found = positions(data["point"])
    found.append(
        periods_of_point(data["large_amplitude_period_s_of_point_pendulum_L1_by_amplitude_deg"])
    )
    found.append(
        periods_of_rod(data["large_amplitude_period_s_of_uniform_rod_L1_by_amplitude_deg"])
    )
    found += reactions()
    return Benchmark(
        "Pendulums",
        "pendulum.json",
        f"{data['problem']}; {data['method']}",
        "DOP853, rtol 1e-13, atol 1e-14, projection to 1e-14; point mass on a distance joint",
        tuple(found),
    )
