"""The flagship: a four-bar linkage with a rotational spring-damper."""

from __future__ import annotations

from typing import Any

import kempe as kp
import numpy as np

from benchmarks.validation.comparison import ROOT, Benchmark, Comparison, compared, reference


def solved() -> tuple[kp.State, kp.Solution]:
    """The assembled start, and 15 s every 0.01 s."""
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    start = case.start()
    sol = kp.dynamics(
        case.model,
        start,
        t_end=15,
        output_step=0.01,
        method=kp.DOP853(rtol=1e-12, atol=1e-13),
        stabilization=kp.Projection(),
    )
    return start, sol


def at_start(start: kp.State, data: dict[str, Any]) -> list[Comparison]:
    """Assembly, Jacobian, accelerations, multipliers and the torque of the spring."""
    truth = data["start"]
    torque = start["spring"].torque(on="rocker")
    jacobian = np.asarray(start.matrices().Phi_q)
    printed = data["Phi_q_at_start_rounded"]
    return [
        compared("start: q", "m, rad", truth["q"], start.q, 1e-12),
        compared("start: Φ_q, printed with two digits", "-, m", printed, jacobian, 0.05),
        compared("start: a", "m/s², rad/s²", truth["a"], start.a, 1e-8),
        compared("start: λ", "N", truth["lam"], start.lam, 1e-7),
        compared(
            "start: torque of spring and damper",
            "N·m",
            truth["spring_damper_torque_on_rocker"],
            torque,
            1e-6,
        ),
    ]


def in_motion(sol: kp.Solution, data: dict[str, Any]) -> list[Comparison]:
    """Eight states up to 15 s, and two angles over the first second."""
    states = data["states"]
    at = [int(np.argmin(np.abs(sol.t - state["t"]))) for state in states]

    def column(key: str) -> Any:
        return [state[key] for state in states]

    first = data["first_second"]
    count = len(first["t"])
    return [
        compared("0.05 to 15 s: q", "m, rad", column("q"), sol.q[at], 1e-9),
        compared("0.05 to 15 s: v", "m/s, rad/s", column("v"), sol.v[at], 1e-8),
        compared("0.05 to 15 s: a", "m/s², rad/s²", column("a"), sol.a[at], 1e-6),
        compared("0.05 to 15 s: λ", "N", column("lam"), sol.lam[at], 1e-5),
        compared(
            "0.05 to 15 s: torque of spring and damper",
            "N·m",
            column("spring_damper_torque_on_rocker"),
            np.asarray(sol["spring"].torque(on="rocker"))[at],
            1e-4,
        ),
        compared(
            "first second: angle of the crank",
            "rad",
            first["crank_angle"],
            sol["crank"].angle[:count],
            1e-10,
        ),
        compared(
            "first second: angle of the rocker",
            "rad",
            first["rocker_angle"],
            sol["rocker"].angle[:count],
            1e-10,
        ),
    ]


def benchmark() -> Benchmark:
    """Start and motion."""
    data = reference("four_bar")
    start, sol = solved()
    return Benchmark(
        "Four-bar linkage with a rotational spring-damper",
        "four_bar.json",
        f"examples/four_bar.toml in another formulation: {data['method']}",
        "DOP853, rtol 1e-12, atol 1e-13, projection",
        (*at_start(start, data), *in_motion(sol, data)),
    )
