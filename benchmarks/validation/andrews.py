"""Andrews' squeezing mechanism."""

from __future__ import annotations

import kempe as kp
import numpy as np
from kempe.analyses.options import Option
from kempe.model.compiled import CompiledModel

from benchmarks.validation.comparison import ROOT, Benchmark, compared, reference

T_END = 0.03
METHOD = kp.DOP853(rtol=1e-11, atol=1e-12)


def case() -> kp.Case:
    """The mechanism from the example."""
    return kp.load(ROOT / "examples" / "squeezer.toml")


def run(model: kp.Model | CompiledModel, start: kp.State, method: Option = METHOD) -> kp.Solution:
    """The motion up to the time of the reference."""
    return kp.dynamics(
        model,
        start,
        t_end=T_END,
        output_step=T_END,
        method=method,
        stabilization=kp.Projection(),
        dense_output=False,
    )


def angles(sol: kp.Solution) -> dict[str, float]:
    """The seven angles of the benchmark from those of the bodies."""
    k1, k2, k3, k4, k5, k6, k7 = (float(sol[f"K{k}"].angle[-1]) for k in range(1, 8))
    return {
        "beta": k1,
        "Theta": k2 - k1,
        "gamma": k3,
        "Phi": k4 - k5,
        "delta": k5,
        "Omega": k6 - k7,
        "epsilon": k7,
    }


def benchmark() -> Benchmark:
    """Start and end."""
    data = reference("andrews")
    squeezer = case()
    start = squeezer.start()
    sol = run(squeezer.model, start)
    truth = data[f"angles_at_{T_END}"]
    found = [compared("assembled start, q", "m, rad", data["q0_cartesian"], start.q, 1e-12)]
    found += [
        compared(f"{name} at {T_END} s", "rad", np.float64(truth[name]), angle, 1e-10)
        for name, angle in angles(sol).items()
    ]
    return Benchmark(
        "Andrews' squeezing mechanism",
        "andrews.json",
        f"{data['problem']}; reference: {data['reference']}",
        f"DOP853, rtol 1e-11, atol 1e-12, projection; {sol.statistics['steps']} steps",
        tuple(found),
    )
