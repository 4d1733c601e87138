"""Andrews' squeezing mechanism: seven bodies, ten revolutes, a spring and a motor, 0.03 s."""

from __future__ import annotations

import numpy as np

from problems.planar import GROUND, Body, Motion, Problem, Revolute, Spring, Torque
from problems.truth import reference

NAMES = tuple(f"K{k}" for k in range(1, 8))


def andrews() -> Problem:
    """The problem; the error is the error of the seven angles at 0.03 s."""
    truth = reference("andrews")
    numbers, points = truth["parameters_SI"], truth["local_points_from_mass_centre"]
    q0 = truth["q0_cartesian"]
    at_end = {name: float(value) for name, value in truth["angles_at_0.03"].items()}
    # the angle of K2 is beta + Theta, and so on
    exact = np.array([sum(at_end[x] for x in truth["frame_angles"][n].split("+")) for n in NAMES])

    def place(text: str) -> tuple[int, tuple[float, float]]:
        body, name = text.split(".")
        if body == "ground":
            return GROUND, tuple(numbers[name])
        return NAMES.index(body), tuple(points[body][name])

    def error(motion: Motion) -> float:
        return float(np.abs(motion.q[-1, :, 2] - exact).max())

    spring = numbers["spring"]
    return Problem(
        name="andrews",
        title="Andrews' squeezer, 0.03 s",
        bodies=tuple(
            Body(name, numbers["m"][k], numbers["J"][k], tuple(q0[3 * k : 3 * k + 3]))
            for k, name in enumerate(NAMES)
        ),
        joints=tuple(
            # ground is body i, as is common
            Revolute(*min(map(place, pair.split())), *max(map(place, pair.split())))
            for pair in truth["joints"]
        ),
        t_end=0.03,
        output_step=1e-4,
        error_of="the seven angles at 0.03 s, rad",
        error=error,
        springs=(Spring(*place("ground.C"), *place("K3.D"), spring["c0"], spring["l0"]),),
        torques=(Torque(0, numbers["torque_on_K1"]),),
        gains=(1000.0, 1000.0),
        steps=(1e-4, 1e-5, 1e-6),
    )
