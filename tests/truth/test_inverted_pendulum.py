"""A cart that balances a rod by a sampled controller, against SciPy from sample to sample.

The equations are those of Lagrange, with the place x of the cart and the angle θ of the rod from
the vertical, positive to the left. The mass centre of the rod is at l, its inertia J:

    (M + m) x″ - m l cos θ θ″ + m l sin θ θ′² = u
    (J + m l²) θ″ - m l cos θ x″ = m g l sin θ
"""

from __future__ import annotations

import math
from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.linalg import expm, solve_discrete_are

CART, ROD, HALF, G, PERIOD = 1.5, 0.4, 0.35, 9.81, 0.01
INERTIA = ROD * (2 * HALF) ** 2 / 12
TILT, T_END = 0.4, 2.5

Vector = NDArray[np.float64]


def rates(y: Vector, u: float) -> Vector:
    _, angle, speed, omega = y
    sine, cosine = math.sin(angle), math.cos(angle)
    mass = [[CART + ROD, -ROD * HALF * cosine], [-ROD * HALF * cosine, INERTIA + ROD * HALF**2]]
    right = [u - ROD * HALF * sine * omega**2, ROD * G * HALF * sine]
    return np.concatenate([[speed, omega], np.linalg.solve(mass, right)])


def gain() -> Vector:
    """The gain of the linear-quadratic regulator of the linear system, sampled."""
    mass = np.array([[CART + ROD, -ROD * HALF], [-ROD * HALF, INERTIA + ROD * HALF**2]])
    a = np.zeros((5, 5))
    a[:2, 2:4] = np.eye(2)
    a[2:4, 1] = np.linalg.solve(mass, [0, ROD * G * HALF])
    a[2:4, 4] = np.linalg.solve(mass, [1, 0])
    discrete = expm(a * PERIOD)
    phi, gamma = discrete[:4, :4], discrete[:4, 4:]
    weights, effort = np.diag([20.0, 10.0, 1.0, 1.0]), np.array([[0.1]])
    p = solve_discrete_are(phi, gamma, weights, effort)
    return np.linalg.solve(effort + gamma.T @ p @ gamma, gamma.T @ p @ phi)[0]


K = gain()


def reference() -> tuple[Vector, Vector]:
    """States and forces at the samples, by DOP853 from each to the next."""
    y, states, forces = np.array([0.0, TILT, 0.0, 0.0]), [], []
    for _ in range(round(T_END / PERIOD)):
        u = float(-K @ y)
        states.append(y)
        forces.append(u)
        step = solve_ivp(
            lambda _, y, u=u: rates(y, u), (0, PERIOD), y, "DOP853", rtol=1e-12, atol=1e-14
        )
        y = step.y[:, -1]
    return np.array([*states, y]), np.array(forces)


def controller(_: float, state: kp.State) -> float:
    measured = ("cart.x", "rod.angle", "cart.vx", "rod.omega")
    return float(-K @ (np.array([state[name] for name in measured]) - [0, math.pi / 2, 0, 0]))


def model() -> kp.Model:
    m = kp.Model("inverted pendulum", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("cart", mass=CART, inertia=1, points={"S": (0, 0)})
    m.bar("rod", mass=ROD, length=2 * HALF, ends=("P", "E"))
    m.translational("rail", "ground.O", "cart.S")
    m.revolute("pin", "cart.S", "rod.P")
    m.force("drive", "cart.S", force=(kp.Sampled(controller, PERIOD), 0))
    return m


@pytest.mark.parametrize(
    "method", [kp.DOP853(1e-11, 1e-13), kp.Radau(1e-10, 1e-12), kp.RK45(1e-11, 1e-13)]
)
def test_the_balanced_cart_is_that_of_scipy(method: Any) -> None:
    m = model()
    start = kp.assemble(m, {"cart.x": 0, "rod.angle": math.pi / 2 + TILT, "cart.vx": 0})
    solution = kp.dynamics(m, start, t_end=T_END, method=method, output_step=PERIOD)
    states, forces = reference()
    found = [solution[name] for name in ("cart.x", "rod.angle", "cart.vx", "rod.omega")]
    error = np.array(found).T - [0, math.pi / 2, 0, 0] - states
    assert np.abs(error).max() < 1e-8
    assert np.abs(solution["drive.fx"][:-1] - forces).max() < 1e-6
    assert np.abs(states[-1]).max() < 0.05 < np.abs(states).max()  # it does balance
