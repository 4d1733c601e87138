"""Several pins in bushes at once, on two bodies, against an integration of the tests' own."""

from functools import cache
from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.special import lambertw

#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e2, 0.01)]
END, INERTIAS = 0.3, (0.4, 0.7)
#: Points (x, y) of ground and of two bodies, whose origins are at (0, 0) and (2, 0).
PLACES = {"ground": {"O": (-0.5, 0.0), "Q": (2.5, 0.1)}}
PLACES |= {"a": {"O": (-0.5, 0.004), "M": (0.6, 0.2)}, "b": {"M": (-1.4, 0.2), "Q": (0.5, 0.096)}}
#: Bush, pin, radius, clearance, coefficient and speed of friction, and the law.
JOINTS: dict[str, tuple[Any, ...]] = {
    "first": ("ground.O", "a.O", 0.3, 0.01, 0.4, 0.1, {"k": 4e3, "damping": 0.3}),
    "middle": ("b.M", "a.M", 0.2, 0.012, 0.0, 0.0, {"young": 2e4, "damping": 0.2}),
    "last": ("b.Q", "ground.Q", 0.25, 0.02, 0.3, 0.05, {"k": 9e3, "damping": 0.5}),
}
WEAR, RATES = 1e-3, (0.3, -0.2)


def model(scale: tuple[float, float, float]) -> tuple[kp.Model, dict[str, float]]:
    mass, size, rate = scale
    force = mass * size * rate**2
    m = kp.Model("clearances", gravity=(0, -size * rate**2))

    def points(body: str) -> dict[str, tuple[float, float]]:
        return {name: (x * size, y * size) for name, (x, y) in PLACES[body].items()}

    m.ground.points(**points("ground"))
    start = {}
    for body, inertia, x, omega in zip("ab", INERTIAS, (0, 2), RATES, strict=True):
        m.body(body, mass=mass, inertia=inertia * mass * size**2, points=points(body))
        at = {"x": x * size, "y": 0, "angle": 0, "vx": 0, "vy": 0, "omega": omega * rate}
        start |= {f"{body}.{name}": value for name, value in at.items()}
    for name, (bush, pin, radius, clearance, mu, speed, law) in JOINTS.items():
        fields: dict[str, Any] = {
            "damping": law["damping"] / (size * rate),
            "wear": WEAR * size**2 / force,
        }
        if "k" in law:
            fields |= {"stiffness": law["k"] * force / size**1.5}
        else:
            young = law["young"] * force / size**2
            fields |= {"law": "hertz", "young": young, "poisson": 0.3, "width": 0.5 * size}
        if mu:
            fields |= {"friction": mu, "velocity": speed * size * rate}
        m.clearance(name, bush, pin, radius=radius * size, clearance=clearance * size, **fields)
    return m, start


def elastic(law: dict[str, float], depth: float, clearance: float) -> float:
    """The force at a depth without damping. Hertz: depth = f (ln(4 c / f) - 1)."""
    if depth <= 0:
        return 0.0
    if "k" in law:
        return law["k"] * float(depth**1.5)
    f = -depth / float(lambertw(-depth * np.e / (4 * clearance), -1).real)
    return float(np.pi * law["young"] / (2 * (1 - 0.3**2)) * 0.5 * f)


def rates(_: float, y: np.ndarray) -> np.ndarray:
    """Coordinates, rates, and for each joint the sliding distance, the worn volume and the heat."""
    q, v = y[:6].reshape(2, 3), y[6:12].reshape(2, 3)
    push, more = np.array([[0.0, -1.0, 0.0]] * 2), []

    def centre(point: str) -> tuple[int, np.ndarray]:
        body, _, name = point.partition(".")
        s = np.array(PLACES[body][name])
        if body == "ground":
            return -1, s
        k = "ab".index(body)
        c, n = np.cos(q[k, 2]), np.sin(q[k, 2])
        return k, q[k, :2] + np.array([c * s[0] - n * s[1], n * s[0] + c * s[1]])

    def speed(body: int, at: np.ndarray) -> np.ndarray:
        if body < 0:
            return np.zeros(2)
        arm = at - q[body, :2]
        return v[body, :2] + v[body, 2] * np.array([-arm[1], arm[0]])

    for bush, pin, radius, clearance, mu, scale, law in JOINTS.values():
        (i, at_i), (j, at_j) = centre(bush), centre(pin)
        size = np.hypot(*(at_j - at_i))
        out = (at_j - at_i) / size
        rate = out @ (speed(j, at_j) - speed(i, at_i))
        spring = elastic(law, size - clearance, clearance)
        normal = max(0.0, spring * (1 + law["damping"] * rate))
        # friction acts in the middle of the depth; without friction, the pitch point slides
        place = at_i + out * (
            (radius + size + radius - clearance) / 2 if mu else radius * size / clearance
        )
        along = np.array([-out[1], out[0]])
        sliding = along @ (speed(j, place) - speed(i, place))
        rub = -mu * normal * np.tanh(sliding / scale) if mu else 0.0
        force = rub * along - normal * out
        for body, sign in ((i, -1), (j, 1)):
            if body >= 0:
                arm = place - q[body, :2]
                push[body] += sign * np.array([*force, arm[0] * force[1] - arm[1] * force[0]])
        slid = abs(sliding) if normal > 0 else 0.0
        more += [slid, WEAR * normal * slid, (normal - spring) * rate - rub * sliding]
    push[:, 2] /= INERTIAS
    return np.concatenate([y[6:12], push.ravel(), more])


@cache
def own_motion() -> np.ndarray:
    y0 = np.zeros(21)
    y0[3], y0[8], y0[11] = 2.0, RATES[0], RATES[1]
    return solve_ivp(rates, (0, END), y0, rtol=1e-8, atol=1e-11, max_step=3e-3).y[:, -1]


@pytest.mark.parametrize("scale", SCALES)
def test_three_pins_in_their_bushes(scale: tuple[float, float, float]) -> None:
    mass, size, rate = scale
    m, at = model(scale)
    sol = kp.dynamics(m, kp.assemble(m, at), t_end=END / rate, method=kp.DOP853(rtol=1e-9))
    units, own = np.array([size, size, 1.0] * 2), own_motion()
    found = [sol[f"{b}.{name}"][-1] for b in "ab" for name in ("x", "y", "angle")] / units
    assert_allclose(found, own[:6], atol=1e-6)
    found = [sol[f"{b}.{name}"][-1] for b in "ab" for name in ("vx", "vy", "omega")] / units / rate
    assert_allclose(found, own[6:12], atol=1e-5)
    assert sum(len(sol.events[f"{name}.hit"].t) for name in JOINTS) >= 4
    for name, (slid, worn, heat) in zip(JOINTS, own[12:].reshape(3, 3), strict=True):
        assert_allclose(sol[f"{name}.sliding_distance"][-1] / size, slid, rtol=1e-5)
        assert_allclose(sol[f"{name}.wear_volume"][-1] / size**3, worn, rtol=1e-5)
        unit = mass * (size * rate) ** 2
        assert_allclose(sol.dissipated(name)[-1] / unit, heat, rtol=1e-5)
