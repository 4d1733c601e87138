"""N windows in a row (IFToMM benchmark A02): one degree of freedom, temporarily N + 1."""

from __future__ import annotations

from functools import cache

import numpy as np

from problems.planar import GROUND, Body, Motion, Problem, Revolute

GRAVITY = 9.81
ROD = 1.0 / 12.0


@cache
def exact(windows: int, t_end: float, step: float) -> np.ndarray:
    """Angle psi of every crank on a grid: psi'' = w2 sin psi, psi(0) = 0, psi'(0) = 1/s."""
    from scipy.integrate import solve_ivp

    w2 = 3 * GRAVITY * (3 * windows + 1) / (2 * (4 * windows + 1))
    t = np.arange(round(t_end / step) + 1) * step
    found = solve_ivp(
        lambda _, y: (y[1], w2 * np.sin(y[0])),
        (0, t_end),
        (0.0, 1.0),
        method="DOP853",
        t_eval=t,
        rtol=1e-13,
        atol=1e-14,
    )
    return np.asarray(found.y[0])


def n_four_bar(windows: int, t_end: float = 10.0) -> Problem:
    """The problem for one N; the error is the error of B0, the top of the first crank."""

    def error(motion: Motion) -> float:
        # the branch on which all cranks stay parallel has a closed form for every N
        psi = exact(windows, t_end, 0.01)[: len(motion.t)]
        x, y, angle = motion.q[:, 0].T
        top = (x + 0.5 * np.cos(angle), y + 0.5 * np.sin(angle))
        return float(np.hypot(top[0] - np.sin(psi), top[1] - np.cos(psi)).max())

    upright, level = np.pi / 2, 0.0
    cranks = [
        Body(f"crank{k}", 1.0, ROD, (float(k), 0.5, upright), (0.5, 0.0, -1.0))
        for k in range(windows + 1)
    ]
    couplers = [
        Body(f"coupler{k}", 1.0, ROD, (k + 0.5, 1.0, level), (1.0, 0.0, 0.0))
        for k in range(windows)
    ]
    first, last = (-0.5, 0.0), (0.5, 0.0)
    joints = []
    for k in range(windows + 1):
        joints.append(Revolute(GROUND, (float(k), 0.0), k, first))
        if k > 0:
            joints.append(Revolute(k, last, windows + k, last))
        if k < windows:
            joints.append(Revolute(k, last, windows + 1 + k, first))
    return Problem(
        name=f"n_four_bar_{windows}",
        title=f"N-four-bar, N = {windows}, {t_end:g} s",
        bodies=tuple(cranks + couplers),
        joints=tuple(joints),
        t_end=t_end,
        output_step=0.01,
        error_of="B0 over the run, m",
        error=error,
        gravity=GRAVITY,
    )
