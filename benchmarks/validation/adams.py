"""MSC ADAMS: a rod pendulum, free and with a rotational spring-damper."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import kempe as kp
import numpy as np

from benchmarks.validation.comparison import Benchmark, Comparison, compared, reference


def rod(spring: bool) -> kp.Model:
    """The rod, 2 m from its pin."""
    m = kp.Model("rod", gravity=(0, -9.80665))
    m.ground.points(O=(0, 0))
    m.body("rod", mass=1, inertia=0.1, points={"O": (-2, 0)})
    m.revolute("pin", "ground.O", "rod.O")
    if spring:
        m.torsion_spring("spring", "ground", "rod", stiffness=200, damping=10)
    return m


def case(name: str, rows: list[dict[str, Any]]) -> Iterator[Comparison]:
    """One of the two, at the times of ADAMS."""
    m = rod(spring="spring" in name)
    start = kp.assemble(m, set={"rod.angle": 0})
    sol = kp.dynamics(
        m,
        start,
        t_end=5,
        output_step=0.5,
        method=kp.DOP853(rtol=1e-12, atol=1e-13),
        stabilization=kp.Projection(),
    )
    at = [int(np.argmin(np.abs(sol.t - row["t"]))) for row in rows]
    force = sol["pin"].force(on="ground", frame="global")[at]
    what = "with spring-damper" if "spring" in name else "free"

    def column(key: str) -> Any:
        return [row[key] for row in rows]

    yield compared(f"{what}: position, as printed", "m", column("adams_pos"), sol.q[at, :2], 1e-5)
    yield compared(f"{what}: velocity, as printed", "m/s", column("adams_vel"), sol.v[at, :2], 1e-3)
    yield compared(f"{what}: force on ground, as printed", "N", column("adams_Rforce"), force, 2e-3)
    yield compared(f"{what}: q recomputed", "m, rad", column("q"), sol.q[at], 1e-9)
    yield compared(f"{what}: v recomputed", "m/s, rad/s", column("v"), sol.v[at], 1e-9)
    yield compared(f"{what}: a recomputed", "m/s², rad/s²", column("a"), sol.a[at], 1e-8)
    yield compared(f"{what}: force recomputed", "N", column("Rforce"), force, 1e-8)


def benchmark() -> Benchmark:
    """Both cases."""
    data = reference("adams")
    found = [c for name, about in data["cases"].items() for c in case(name, about["rows"])]
    return Benchmark(
        "Rod pendulum of MSC ADAMS",
        "adams.json",
        data["problem"] + "; the printed numbers carry ADAMS' own error, up to 1e-3 in forces",
        "DOP853, rtol 1e-12, atol 1e-13, projection",
        tuple(found),
    )
