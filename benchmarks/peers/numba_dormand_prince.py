"""Numba: the equations and Dormand-Prince 5(4) in loops over arrays, compiled before timing.

The augmented matrix is condensed to S = Phi_q M^-1 Phi_q' in plain loops, factorised by Cholesky.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from problems.planar import Motion, Problem

from peers.setting import Setting, not_installed

NAME = "numba"
TRIED = (
    "S = Phi_q M^-1 Phi_q' in loops with Cholesky, Dormand-Prince, relaxed floating-point "
    "arithmetic; compilation, seconds, is not counted"
)
CURVE = "Numba RK45, Baumgarte"
TOLERANCES = (1e-3, 1e-6, 1e-9)
LARGEST = 25
#: Largest number of steps.
MOST_STEPS = 200_000


def missing() -> str | None:
    """The reason if Numba cannot be used."""
    return not_installed("numba", "scipy")


def version() -> str:
    """Version of Numba."""
    import numba

    return str(numba.__version__)


def settings(problem: Problem, quick: bool = False) -> list[Setting]:
    """One curve."""
    if len(problem.bodies) > LARGEST:
        return []
    return [Setting(CURVE, rtol) for rtol in (TOLERANCES[:1] if quick else TOLERANCES)]


def arrays(problem: Problem) -> tuple[Any, ...]:
    """The mechanism as arrays."""
    joints = np.array([(e.i, e.j) for e in problem.joints])
    ends = np.array([(e.s_i, e.s_j) for e in problem.joints])
    mass = np.array([(b.mass, b.inertia) for b in problem.bodies])
    torsion = [(t.j, t.stiffness, t.damping, t.free_angle) for t in problem.torsion_springs]
    springs = [(s.i, s.j, *s.s_i, *s.s_j, s.stiffness, s.free_length) for s in problem.springs]
    torques = [(t.j, t.torque) for t in problem.torques]
    tables = [
        np.array(rows, dtype=float).reshape(-1, width)
        for rows, width in ((torsion, 4), (springs, 8), (torques, 2))
    ]
    return (joints, ends, mass, problem.gravity, *tables)


def prepare(problem: Problem, setting: Setting) -> Callable[[], Any]:
    """A run: y on the grid; the first compiles."""
    from peers.numba_loops import integrate

    model = arrays(problem)
    m, n = 2 * len(problem.joints), 3 * len(problem.bodies)
    y0, rtol = np.concatenate([problem.q0, problem.v0]), setting.tolerance
    grid = np.minimum(problem.grid, problem.t_end)

    def run(grid: np.ndarray = grid) -> np.ndarray:
        work = (np.zeros((m // 2, 2, 2)), np.zeros(m), np.zeros((m, m)), np.zeros(n))
        gains, limits = problem.gains, (rtol, 1e-3 * rtol, MOST_STEPS)
        out, rows = integrate(model, y0, gains, work, grid, *limits)
        if rows < len(grid):
            raise RuntimeError(f"end not reached after {MOST_STEPS} steps")
        return np.asarray(out)

    run(grid[:2])
    return run


def motion(problem: Problem, y: np.ndarray) -> Motion:
    """The motion of a run."""
    n = 3 * len(problem.bodies)
    return Motion(problem.grid, y[:, :n].reshape(-1, n // 3, 3))
