"""A plain NumPy/SciPy program of the same equations, in the usual style.

It has functions for A, B, M, Phi, Phi_q, gamma and Q with NumPy arrays. A dense solver solves the
augmented equations (Haug 6.3.18) with Baumgarte's right-hand side (7.3.8), and `solve_ivp`
integrates them. The results include accelerations and multipliers.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from problems.planar import GROUND, Motion, Pair, Problem

from peers.setting import Setting, not_installed

NAME = "scipy"
TRIED = (
    "RK45, DOP853 and LSODA of solve_ivp; RK45 and DOP853 are shown: on the squeezer LSODA "
    "took longer than both for a larger error"
)
CURVES = {"scipy RK45, Baumgarte": "RK45", "scipy DOP853, Baumgarte": "DOP853"}
TOLERANCES = (1e-3, 1e-5, 1e-6, 1e-9)
#: Bodies above which a dense solve in each evaluation takes minutes.
LARGEST = 25


def missing() -> str | None:
    """The reason if SciPy cannot be used."""
    return not_installed("scipy")


def version() -> str:
    """Versions of SciPy and NumPy."""
    import scipy

    return f"{scipy.__version__}, NumPy {np.__version__}"


def settings(problem: Problem, quick: bool = False) -> list[Setting]:
    """Curves of SciPy."""
    if len(problem.bodies) > LARGEST:
        return []
    curves = list(CURVES)[:1] if quick else list(CURVES)
    return [
        Setting(curve, rtol, {"method": CURVES[curve], "rtol": rtol, "atol": 1e-3 * rtol})
        for curve in curves
        for rtol in (TOLERANCES[:1] if quick else TOLERANCES)
    ]


def rotation(angle: float) -> np.ndarray:
    """A."""
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def rotation_derivative(angle: float) -> np.ndarray:
    """B = dA/dphi."""
    return np.array([[-np.sin(angle), -np.cos(angle)], [np.cos(angle), -np.sin(angle)]])


def point(q: np.ndarray, body: int, s: Pair) -> np.ndarray:
    """R + A s'."""
    if body == GROUND:
        return np.array(s)
    return np.asarray(q[3 * body : 3 * body + 2] + rotation(q[3 * body + 2]) @ np.array(s))


def point_jacobian(q: np.ndarray, body: int, s: Pair) -> np.ndarray:
    """[I, B s'], of the point by the coordinates of its body."""
    return np.column_stack([np.eye(2), rotation_derivative(q[3 * body + 2]) @ np.array(s)])


class Equations:
    """The matrices of one mechanism."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.n, self.m = 3 * len(problem.bodies), 2 * len(problem.joints)
        self.M = np.diag([x for b in problem.bodies for x in (b.mass, b.mass, b.inertia)])
        self.alpha, self.beta = problem.gains

    def constraints(self, q: np.ndarray) -> np.ndarray:
        """Phi = point_j - point_i of every joint."""
        ends = [(point(q, e.i, e.s_i), point(q, e.j, e.s_j)) for e in self.problem.joints]
        return np.concatenate([j - i for i, j in ends])

    def jacobian(self, q: np.ndarray) -> np.ndarray:
        """Phi_q."""
        phi_q = np.zeros((self.m, self.n))
        for k, e in enumerate(self.problem.joints):
            rows = slice(2 * k, 2 * k + 2)
            for sign, body, s in ((-1, e.i, e.s_i), (1, e.j, e.s_j)):
                if body != GROUND:
                    phi_q[rows, 3 * body : 3 * body + 3] = sign * point_jacobian(q, body, s)
        return phi_q

    def acceleration_right_side(self, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Gamma."""
        gamma = np.zeros(self.m)
        for k, e in enumerate(self.problem.joints):
            for sign, body, s in ((-1, e.i, e.s_i), (1, e.j, e.s_j)):
                if body != GROUND:
                    angle, omega = q[3 * body + 2], v[3 * body + 2]
                    gamma[2 * k : 2 * k + 2] += sign * rotation(angle) @ np.array(s) * omega**2
        return gamma

    def forces(self, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Q: gravity, springs and torques."""
        force = np.zeros(self.n)
        for k, body in enumerate(self.problem.bodies):
            force[3 * k + 1] = -body.mass * self.problem.gravity
        for t in self.problem.torsion_springs:
            at = 3 * t.j + 2
            force[at] -= t.stiffness * (q[at] - t.free_angle) + t.damping * v[at]
        for torque in self.problem.torques:
            force[3 * torque.j + 2] += torque.torque
        for s in self.problem.springs:
            line = point(q, s.j, s.s_j) - point(q, s.i, s.s_i)
            length = np.linalg.norm(line)
            pull = -s.stiffness * (length - s.free_length) * line / length
            for sign, body, at in ((-1, s.i, s.s_i), (1, s.j, s.s_j)):
                if body != GROUND:
                    columns = slice(3 * body, 3 * body + 3)
                    force[columns] += sign * point_jacobian(q, body, at).T @ pull
        return force

    def solve(
        self, q: np.ndarray, v: np.ndarray, alpha: float = 0.0, beta: float = 0.0
    ) -> np.ndarray:
        """Accelerations and multipliers."""
        phi_q = self.jacobian(q)
        gamma = self.acceleration_right_side(q, v)
        gamma = gamma - 2 * alpha * phi_q @ v - beta**2 * self.constraints(q)
        matrix = np.block([[self.M, phi_q.T], [phi_q, np.zeros((self.m, self.m))]])
        return np.linalg.solve(matrix, np.concatenate([self.forces(q, v), gamma]))

    def right_side(self, _: float, y: np.ndarray) -> np.ndarray:
        """Derivative of y = (q, v)."""
        q, v = y[: self.n], y[self.n :]
        return np.concatenate([v, self.solve(q, v, self.alpha, self.beta)[: self.n]])


def prepare(problem: Problem, setting: Setting) -> Callable[[], Any]:
    """A run: states on the grid, with accelerations and multipliers."""
    from scipy.integrate import solve_ivp

    equations = Equations(problem)
    y0 = np.concatenate([problem.q0, problem.v0])
    grid = np.minimum(problem.grid, problem.t_end)

    def run() -> Any:
        span = (0, problem.t_end)
        found = solve_ivp(equations.right_side, span, y0, t_eval=grid, **setting.options)
        if not found.success:
            raise RuntimeError(found.message)
        for y in found.y.T:
            equations.solve(y[: equations.n], y[equations.n :])
        return found

    return run


def motion(problem: Problem, found: Any) -> Motion:
    """The motion of a run."""
    n = 3 * len(problem.bodies)
    return Motion(found.t, found.y[:n].T.reshape(-1, n // 3, 3))
