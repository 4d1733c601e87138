"""Open chains of bars in the plane by Lagrange's equations in their angles.

A mass is at Σ_j c_j exp(i q_j), as a complex number; bars may turn with inertias of their own.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

G = 9.81


def motion(
    masses: np.ndarray,
    reach: np.ndarray,
    inertias: np.ndarray,
    start: np.ndarray,
    t: np.ndarray,
) -> np.ndarray:
    """Angles at the times t, (n_q, n_t), of a chain that is released from rest.

    Args:
        masses: of the points, kg.
        reach: c, the share of each angle in each point, (n_masses, n_q), m.
        inertias: about the mass centre, of the bar of each angle, kg·m².
        start: angles at t = 0, rad.
        t: times, s.
    """
    found = solve_ivp(
        _rates(masses, reach, inertias),
        (t[0], t[-1]),
        np.concatenate([start, np.zeros_like(start)]),
        method="DOP853",
        t_eval=t,
        rtol=1e-12,
        atol=1e-13,
    )
    angles: np.ndarray = found.y
    return angles


def _rates(
    masses: np.ndarray, reach: np.ndarray, inertias: np.ndarray
) -> Callable[[float, np.ndarray], np.ndarray]:
    n = len(inertias)

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        angles, omega = y[:n], y[n:]
        arms = reach * np.exp(1j * angles)  # ∂r/∂q = i arms
        weighed = arms * masses[:, None]
        mass = (np.conj(arms).T @ weighed).real + np.diag(inertias)
        free = -(arms @ omega**2) + 1j * G  # acceleration without that of the angles, minus g
        effort = -(np.conj(1j * weighed).T @ free).real
        return np.concatenate([omega, np.linalg.solve(mass, effort)])

    return rates
