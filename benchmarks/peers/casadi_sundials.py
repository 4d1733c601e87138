"""CasADi: the equations written by hand as expressions, CVODES, and IDAS on the DAE of index 1.

S = Phi_q M^-1 Phi_q' is factorised symbolically. CVODES integrates y' = f(y) in sparse code without
branches, with exact Jacobians. IDAS solves M a + Phi_q' lam = Q and Phi_q a = gamma with the
algebraic variables a and lam.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from problems.planar import GROUND, Motion, Pair, Problem

from peers.setting import Setting, not_installed

NAME = "casadi"
TRIED = (
    "CVODES (Adams and BDF, Newton and functional iteration) with symbolic LDL of S, and IDAS on"
    " index 1; interpreted and compiled by the C compiler (-O3), the compilation not counted"
)
CURVES: dict[str, dict[str, Any]] = {
    "CasADi CVODES BDF": {"plugin": "cvodes", "linear_multistep_method": "bdf"},
    "CasADi CVODES BDF compiled": {
        "plugin": "cvodes",
        "linear_multistep_method": "bdf",
        "jit": True,
    },
    "CasADi CVODES Adams compiled": {
        "plugin": "cvodes",
        "linear_multistep_method": "adams",
        "nonlinear_solver_iteration": "functional",
        "jit": True,
    },
    "CasADi IDAS": {"plugin": "idas"},
}
TOLERANCES = (1e-4, 1e-6, 1e-7, 1e-8, 1e-9)
#: Bodies above which expressions and compilation take minutes.
LARGEST = 25


def missing() -> str | None:
    """The reason if CasADi cannot be used."""
    return not_installed("casadi")


def version() -> str:
    """Version of CasADi."""
    import casadi

    return str(casadi.__version__)


def settings(problem: Problem, quick: bool = False) -> list[Setting]:
    """Curves of CVODES and IDAS."""
    if len(problem.bodies) > LARGEST:
        return []
    tolerances = TOLERANCES[:1] if quick else TOLERANCES
    return [Setting(curve, rtol, CURVES[curve]) for curve in CURVES for rtol in tolerances]


class Expressions:
    """Phi, Phi_q, gamma-hat, Q as expressions in q and v."""

    def __init__(self, problem: Problem) -> None:
        import casadi as ca

        n = 3 * len(problem.bodies)
        self.q, self.v = ca.SX.sym("q", n), ca.SX.sym("v", n)
        self.mass = ca.DM([x for b in problem.bodies for x in (b.mass, b.mass, b.inertia)])
        phi = [self.point(e.j, e.s_j) - self.point(e.i, e.s_i) for e in problem.joints]
        self.phi = ca.vertcat(*phi)
        self.phi_q = ca.jacobian(self.phi, self.q)
        rate = self.phi_q @ self.v
        alpha, beta = problem.gains
        gamma = -ca.jtimes(rate, self.q, self.v)
        self.gamma = gamma - 2 * alpha * rate - beta**2 * self.phi
        self.force = self.forces(problem)

    def point(self, body: int, s: Pair) -> Any:
        """R + A s'."""
        import casadi as ca

        if body == GROUND:
            return ca.DM(s)
        x, y, angle = (self.q[3 * body + k] for k in range(3))
        c, si = ca.cos(angle), ca.sin(angle)
        return ca.vertcat(x + c * s[0] - si * s[1], y + si * s[0] + c * s[1])

    def forces(self, problem: Problem) -> Any:
        """Q."""
        import casadi as ca

        force = ca.SX.zeros(self.q.shape[0])
        for k, body in enumerate(problem.bodies):
            force[3 * k + 1] = -body.mass * problem.gravity
        for t in problem.torsion_springs:
            at = 3 * t.j + 2
            force[at] -= t.stiffness * (self.q[at] - t.free_angle) + t.damping * self.v[at]
        for torque in problem.torques:
            force[3 * torque.j + 2] += torque.torque
        for s in problem.springs:
            length = ca.norm_2(self.point(s.j, s.s_j) - self.point(s.i, s.s_i))
            energy = s.stiffness * (length - s.free_length) ** 2 / 2
            force -= ca.gradient(energy, self.q)
        return force


def problem_of(e: Expressions, plugin: str) -> dict[str, Any]:
    """The problem for the integrator."""
    import casadi as ca

    y = ca.vertcat(e.q, e.v)
    if plugin == "idas":
        a, lam = ca.SX.sym("a", e.q.shape[0]), ca.SX.sym("lam", e.phi.shape[0])
        newton = e.mass * a + e.phi_q.T @ lam - e.force
        algebraic = ca.vertcat(newton, e.phi_q @ a - e.gamma)
        return {"x": y, "z": ca.vertcat(a, lam), "ode": ca.vertcat(e.v, a), "alg": algebraic}
    scaled = e.phi_q / ca.repmat(e.mass.T, e.phi.shape[0], 1)
    factors = ca.ldl(scaled @ e.phi_q.T)
    lam = ca.ldl_solve(scaled @ e.force - e.gamma, *factors)
    return {"x": y, "ode": ca.vertcat(e.v, (e.force - e.phi_q.T @ lam) / e.mass)}


def consistent(equations: dict[str, Any], y0: np.ndarray) -> np.ndarray:
    """The algebraic variables at the start; they enter linearly."""
    import casadi as ca

    x, z, algebraic = equations["x"], equations["z"], equations["alg"]
    linear = ca.Function("linear", [x, z], [ca.jacobian(algebraic, z), algebraic])
    matrix, rest = linear(y0, 0)
    return np.asarray(np.linalg.solve(np.array(matrix), -np.array(rest)).ravel())


@cache
def scratch() -> TemporaryDirectory[str]:
    """A folder for compiled code, until the program ends."""
    return TemporaryDirectory()


@contextmanager
def compiling() -> Iterator[None]:
    """Run the compiler in its own folder, because it writes files to the current one."""
    before = Path.cwd()
    os.chdir(scratch().name)
    try:
        yield
    finally:
        os.chdir(before)


def prepare(problem: Problem, setting: Setting) -> Callable[[], Any]:
    """A run: y on the grid."""
    import casadi as ca

    options: dict[str, Any] = dict(setting.options)
    plugin = options.pop("plugin")
    options |= {
        "reltol": setting.tolerance,
        "abstol": 1e-3 * setting.tolerance,
        "max_num_steps": 100_000,
    }
    if options.get("jit"):
        options |= {"compiler": "shell", "jit_options": {"flags": ["-O3"]}}
    equations = problem_of(Expressions(problem), plugin)
    grid = np.minimum(problem.grid, problem.t_end)
    with compiling():
        solver = ca.integrator("solver", plugin, equations, 0.0, grid[1:], options)
    start = {"x0": np.concatenate([problem.q0, problem.v0])}
    if plugin == "idas":
        start["z0"] = consistent(equations, start["x0"])

    def run() -> np.ndarray:
        return np.column_stack([start["x0"], np.array(solver(**start)["xf"])])

    return run


def motion(problem: Problem, y: np.ndarray) -> Motion:
    """The motion of a run."""
    n = 3 * len(problem.bodies)
    return Motion(problem.grid, y[:n].T.reshape(-1, n // 3, 3))
