"""kempe against a plain NumPy/SciPy program of the same equations, in turn, on the flagship.

    python benchmarks/four_bar.py [--repeat 5] [--rtol 1e-6] [--atol 1e-9] [--json FILE]

Both integrate the 18 first-order equations of the Cartesian formulation with Baumgarte(10, 200) by
Dormand-Prince 5(4) over 15 s and report 1501 states with accelerations and multipliers. The SciPy
program is written as such programs are: functions for A, B, M, Phi, Phi_q, gamma and Q in NumPy
arrays, and a 17 x 17 solve. Times are CPU times of one process, medians of repetitions taken in
turn; the ratio is what counts.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import scipy
from scipy.integrate import solve_ivp

ROOT = Path(__file__).parents[1]
MASS = np.array([3.0, 5.0, 4.0])
LENGTH = np.array([10.0, 26.0, 18.0])
INERTIA = MASS * LENGTH**2 / 12
STIFFNESS, DAMPING, FREE_ANGLE, GRAVITY = 1e6, 1e4, np.radians(270.0), 9.81
ALPHA, BETA = 10.0, 200.0
#: Runs of kempe in each turn: one of a few milliseconds says little about the next.
RUNS = 20
#: Joints as (body i, s_i, body j, s_j); -1 is ground.
JOINTS = (
    (-1, (0.0, 0.0), 0, (-5.0, 0.0)),
    (0, (5.0, 0.0), 1, (-13.0, 0.0)),
    (1, (13.0, 0.0), 2, (-9.0, 0.0)),
    (-1, (20.0, 0.0), 2, (9.0, 0.0)),
)


def rotation(angle: float) -> np.ndarray:
    """A."""
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def rotation_derivative(angle: float) -> np.ndarray:
    """B = dA/dphi."""
    return np.array([[-np.sin(angle), -np.cos(angle)], [np.cos(angle), -np.sin(angle)]])


def constraints(q: np.ndarray) -> np.ndarray:
    """Phi = point_j - point_i of every joint."""
    phi = np.zeros(8)
    for k, (i, s_i, j, s_j) in enumerate(JOINTS):
        p_i = np.array(s_i)
        if i >= 0:
            p_i = q[3 * i : 3 * i + 2] + rotation(q[3 * i + 2]) @ p_i
        p_j = q[3 * j : 3 * j + 2] + rotation(q[3 * j + 2]) @ np.array(s_j)
        phi[2 * k : 2 * k + 2] = p_j - p_i
    return phi


def jacobian(q: np.ndarray) -> np.ndarray:
    """Phi_q."""
    phi_q = np.zeros((8, 9))
    for k, (i, s_i, j, s_j) in enumerate(JOINTS):
        rows = slice(2 * k, 2 * k + 2)
        if i >= 0:
            phi_q[rows, 3 * i : 3 * i + 2] = -np.eye(2)
            phi_q[rows, 3 * i + 2] = -rotation_derivative(q[3 * i + 2]) @ np.array(s_i)
        phi_q[rows, 3 * j : 3 * j + 2] = np.eye(2)
        phi_q[rows, 3 * j + 2] = rotation_derivative(q[3 * j + 2]) @ np.array(s_j)
    return phi_q


def acceleration_right_side(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Gamma."""
    gamma = np.zeros(8)
    for k, (i, s_i, j, s_j) in enumerate(JOINTS):
        at_j = rotation(q[3 * j + 2]) @ np.array(s_j) * v[3 * j + 2] ** 2
        at_i = np.zeros(2)
        if i >= 0:
            at_i = rotation(q[3 * i + 2]) @ np.array(s_i) * v[3 * i + 2] ** 2
        gamma[2 * k : 2 * k + 2] = at_j - at_i
    return gamma


def forces(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Q: gravity and the rotational spring-damper."""
    force = np.zeros(9)
    for body in range(3):
        force[3 * body + 1] = -MASS[body] * GRAVITY
    force[8] += -STIFFNESS * (q[8] - FREE_ANGLE) - DAMPING * v[8]
    return force


def mass_matrix() -> np.ndarray:
    """M."""
    return np.diag([x for m, j in zip(MASS, INERTIA, strict=True) for x in (m, m, j)])


def accelerations_and_multipliers(
    q: np.ndarray, v: np.ndarray, alpha: float = 0.0, beta: float = 0.0
) -> np.ndarray:
    """The augmented equations (Haug 6.3.18) with Baumgarte's right side (7.3.8)."""
    phi_q = jacobian(q)
    gamma = acceleration_right_side(q, v) - 2 * alpha * phi_q @ v - beta**2 * constraints(q)
    matrix = np.block([[mass_matrix(), phi_q.T], [phi_q, np.zeros((8, 8))]])
    return np.linalg.solve(matrix, np.concatenate([forces(q, v), gamma]))


def right_side(_: float, y: np.ndarray) -> np.ndarray:
    """Derivative of y = (q, v)."""
    return np.concatenate([y[9:], accelerations_and_multipliers(y[:9], y[9:], ALPHA, BETA)[:9]])


def with_scipy(y0: np.ndarray, rtol: float, atol: float) -> np.ndarray:
    """The rocker's angle every 0.01 s; accelerations and multipliers are computed with it."""
    t = np.linspace(0, 15, 1501)
    solution = solve_ivp(right_side, (0, 15), y0, rtol=rtol, atol=atol, t_eval=t)
    for y in solution.y.T:
        accelerations_and_multipliers(y[:9], y[9:])
    return np.asarray(solution.y[8])


def with_kempe(model: kp.Model, start: kp.State, rtol: float, atol: float) -> np.ndarray:
    """The same with kempe, called from Python."""
    solution = kp.dynamics(
        model,
        start,
        t_end=15,
        output_step=0.01,
        method=kp.RK45(rtol=rtol, atol=atol),
        stabilization=kp.Baumgarte(alpha=ALPHA, beta=BETA),
        dense_output=False,
    )
    return np.asarray(solution["rocker"].angle)


def timed(run: Any) -> tuple[float, np.ndarray]:
    """CPU seconds and result of a call."""
    begin = time.process_time()
    result = run()
    return time.process_time() - begin, result


def measure(repeat: int, rtol: float, atol: float) -> dict[str, Any]:
    """Both programs in turn."""
    case = kp.load(ROOT / "examples/four_bar.toml")
    start = case.start()
    y0 = np.concatenate([start.q, start.v])
    reference = json.loads((ROOT / "tests/reference/four_bar.json").read_text("utf-8"))
    truth = np.array(reference["first_second"]["rocker_angle"])
    times: dict[str, list[float]] = {"kempe": [], "scipy": []}
    errors: dict[str, float] = {}
    with_kempe(case.model, start, rtol, atol)  # warm
    programs = (
        ("scipy", 1, lambda: with_scipy(y0, rtol, atol)),
        ("kempe", RUNS, lambda: with_kempe(case.model, start, rtol, atol)),
    )
    for _ in range(repeat):
        for name, runs, run in programs:
            for _ in range(runs):
                seconds, angle = timed(run)
                times[name].append(seconds)
            errors[name] = float(np.abs(angle[:101] - truth).max())
    medians = {name: statistics.median(values) for name, values in times.items()}
    return {
        "rtol": rtol,
        "atol": atol,
        "repeat": repeat,
        "seconds": medians,
        "error_rad": errors,
        "ratio": medians["scipy"] / medians["kempe"],
        "versions": {"kempe": kp.__version__, "scipy": scipy.__version__, "numpy": np.__version__},
    }


def main() -> None:
    """Print the comparison."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--rtol", type=float, default=1e-6)
    parser.add_argument("--atol", type=float, default=1e-9)
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    found = measure(asked.repeat, asked.rtol, asked.atol)
    print(f"flagship, 15 s, rtol {asked.rtol:g}, atol {asked.atol:g}, {asked.repeat} runs in turn")
    for name, seconds in found["seconds"].items():
        error = found["error_rad"][name]
        print(f"  {name:<6} {1e3 * seconds:10.2f} ms   error {error:.1e} rad over the first second")
    print(f"  ratio of medians {found['ratio']:.0f}")
    if asked.json:
        asked.json.write_text(json.dumps(found, indent=2) + "\n", "utf-8")


if __name__ == "__main__":
    main()
