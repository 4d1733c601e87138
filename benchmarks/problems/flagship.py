"""The flagship: a closed four-bar linkage with a rotational spring-damper, released from rest."""

from __future__ import annotations

import numpy as np

from problems.planar import GROUND, Body, Motion, Problem, Revolute, TorsionSpring
from problems.truth import reference

MASS = (3.0, 5.0, 4.0)
LENGTH = (10.0, 26.0, 18.0)
NAMES = ("crank", "coupler", "rocker")


def flagship() -> Problem:
    """The problem; the error is the error of the rocker angle over the first second."""
    truth = reference("four_bar")
    q0 = truth["start"]["q"]
    angle = np.array(truth["first_second"]["rocker_angle"])

    def error(motion: Motion) -> float:
        return float(np.abs(motion.q[: len(angle), 2, 2] - angle).max())

    return Problem(
        name="flagship",
        title="Flagship four-bar, 15 s",
        bodies=tuple(
            Body(name, m, m * length**2 / 12, tuple(q0[3 * k : 3 * k + 3]))
            for k, (name, m, length) in enumerate(zip(NAMES, MASS, LENGTH, strict=True))
        ),
        joints=(
            Revolute(GROUND, (0.0, 0.0), 0, (-5.0, 0.0)),
            Revolute(0, (5.0, 0.0), 1, (-13.0, 0.0)),
            Revolute(1, (13.0, 0.0), 2, (-9.0, 0.0)),
            Revolute(GROUND, (20.0, 0.0), 2, (9.0, 0.0)),
        ),
        t_end=15.0,
        output_step=0.01,
        error_of="rocker angle over the first second, rad",
        error=error,
        gravity=9.81,
        also={"angle_error": angle_error},
        torsion_springs=(TorsionSpring(2, 1e6, 1e4, np.radians(270.0)),),
    )


def angle_error(motion: Motion) -> float:
    """Largest error of any angle at any listed state, rad."""
    worst = 0.0
    for state in reference("four_bar")["states"]:
        row = int(np.argmin(np.abs(motion.t - state["t"])))
        difference = motion.q[row, :, 2] - np.array(state["q"])[2::3]
        worst = max(worst, float(np.abs(difference).max()))
    return worst
