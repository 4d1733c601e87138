"""Springs with damping, preload and one side against closed forms, through the public interface."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

TIGHT = kp.DOP853(rtol=1e-12, atol=1e-14)
MASS, INERTIA = 2.0, 0.4


def swing(t: np.ndarray, x0: float, v0: float, mass: float, c: float, k: float) -> np.ndarray:
    """x of m x″ + c x′ + k x = 0, underdamped."""
    decay = c / (2 * mass)
    rate = np.sqrt(k / mass - decay**2)
    return np.exp(-decay * t) * (
        x0 * np.cos(rate * t) + (v0 + decay * x0) / rate * np.sin(rate * t)
    )


def mass_on_a_line(**fields: Any) -> kp.Model:
    m = kp.Model("mass")
    m.ground.points(O=(0, 0))
    m.body("mass", mass=MASS, inertia=1, points={"P": (0, 0)})
    m.spring_damper("tie", "ground.O", "mass.P", **fields)
    return m


@pytest.mark.parametrize("preload", [0.0, 7.0, -3.0])
def test_a_translational_spring_damper_with_preload(preload: float) -> None:
    m = mass_on_a_line(stiffness=50, damping=1.2, free_length=1.5, preload=preload)
    start = kp.assemble(m, {"mass.x": 1.7, "mass.y": 0, "mass.vx": 0.8})
    sol = kp.dynamics(m, start, t_end=3, output_step=0.01, method=TIGHT)
    rest = 1.5 - preload / 50
    assert_allclose(
        sol["mass"].x, rest + swing(sol.t, 1.7 - rest, 0.8, MASS, 1.2, 50), rtol=0, atol=1e-9
    )
    pull = 50 * (sol["mass"].x - 1.5) + 1.2 * sol["mass"].vx + preload
    assert_allclose(sol["tie"].force(on="mass")[:, 0], -pull, rtol=0, atol=1e-9)
    assert_allclose(sol.energy.balance, 0, atol=1e-9)


@pytest.mark.parametrize("preload", [0.0, 1.1, -0.6])
def test_a_rotational_spring_damper_with_preload(preload: float) -> None:
    m = kp.Model("rotor")
    m.ground.points(O=(0, 0))
    m.body("rotor", mass=1, inertia=INERTIA, points={"O": (0, 0)})
    m.revolute("pin", "ground.O", "rotor.O")
    fields = {"stiffness": 9, "damping": 0.3, "free_angle": 0.5, "preload": preload}
    m.torsion_spring("spring", "ground", "rotor", **fields)
    start = kp.assemble(m, {"rotor.angle": 1.2, "rotor.omega": -2})
    sol = kp.dynamics(m, start, t_end=3, output_step=0.01, method=TIGHT)
    rest = 0.5 - preload / 9
    truth = rest + swing(sol.t, 1.2 - rest, -2, INERTIA, 0.3, 9)
    assert_allclose(sol["rotor"].angle, truth, rtol=0, atol=1e-9)
    torque = 9 * (truth - 0.5) + 0.3 * sol["rotor"].omega + preload
    assert_allclose(sol["spring"].torque(on="rotor"), -torque, rtol=0, atol=1e-8)
    assert_allclose(sol.energy.balance, 0, atol=1e-9)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("only", ["tension", "compression"])
@pytest.mark.parametrize("damping", [0.0, 2.0])
def test_a_cord_with_a_preload_against_its_sense(only: Any, damping: float, size: float) -> None:
    """A preload of -8 N at 50 N/m is a play of 0.16 m: without damping, the cord begins there.

    With damping, the force in the play is what the damping has more than the preload. Energies are
    those of the force of the formula, integrated by a method of the test.
    """
    sense = {"tension": 1.0, "compression": -1.0}[only]
    stiffness, length, speed = 50.0, 1.0 * size, 2.0 * size
    preload = -8.0 * sense * size
    fields = {"stiffness": stiffness, "damping": damping, "free_length": length, "only": only}
    m = mass_on_a_line(preload=preload, **fields)
    start = {"mass.x": length - sense * 0.1 * size, "mass.y": 0, "mass.vx": sense * speed}
    method = kp.DOP853(rtol=1e-12, atol=1e-14 * size)
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=1.2, output_step=0.01, method=method)

    def force(stretch: float, rate: float) -> float:
        """In the only sense, with the elongation in this sense."""
        whole = stiffness * stretch + damping * rate - 8.0 * size
        return max(0.0, whole) if stretch > 0 else 0.0

    def slopes(_: float, y: Any) -> Any:
        pull = force(y[0], y[1])
        spring = max(0.0, stiffness * y[0] - 8.0 * size)
        return [y[1], -pull / MASS, (pull - spring) * y[1] / size]

    options = {"rtol": 1e-11, "atol": 1e-13 * size, "max_step": 2e-3, "t_eval": sol.t}
    truth = solve_ivp(slopes, (0, 1.2), [-0.1 * size, speed, 0.0], **options).y
    stretch = sense * (sol["mass"].x - length)
    assert_allclose(stretch, truth[0], rtol=0, atol=2e-7 * size)
    lost = sol.energy.dissipated
    assert_allclose(lost, truth[2] * size, rtol=0, atol=2e-6 * size * size)
    stored = np.maximum(0.0, stiffness * stretch - 8.0 * size) ** 2 / (2 * stiffness)
    assert_allclose(sol.energy.potential, stored, rtol=0, atol=1e-9 * size * size)
    assert np.diff(lost).min() >= -1e-9 * size * size
    assert_allclose(sol.energy.balance, 0, atol=1e-9)


@pytest.mark.parametrize("method", [TIGHT, kp.Radau(rtol=1e-11, atol=1e-13)])
def test_a_mass_bounces_on_a_cord(method: Any) -> None:
    """Free flight to the end of the cord, half an oscillation on it, and free flight back."""
    m = mass_on_a_line(stiffness=50, free_length=1, only="tension")
    start = kp.assemble(m, {"mass.x": 0.5, "mass.y": 0, "mass.vx": 2})
    sol = kp.dynamics(m, start, t_end=1.2, output_step=0.01, method=method)
    on = sol.t - 0.25  # at 2 m/s over 0.5 m
    contact = np.pi / 5
    stretched = 0.4 * np.sin(5 * on)
    truth = 1 + np.where(on < 0, 2 * on, np.where(on < contact, stretched, -2 * (on - contact)))
    assert_allclose(sol["mass"].x, truth, rtol=0, atol=1e-9)
    assert_allclose(sol["mass"].vx[-1], -2, atol=1e-9)


def test_a_bushing_swings_with_three_frequencies() -> None:
    """Rates of 2, 3 and 5 rad/s along its axes and about it, the last one damped."""
    m = kp.Model("bushing")
    m.ground.points(O=(0.5, 0.2))
    m.body("block", mass=MASS, inertia=INERTIA, points={"P": (0, 0)})
    stiffness, damping = (4 * MASS, 9 * MASS, 25 * INERTIA), (0, 0, 2 * INERTIA)
    m.bushing("mount", "ground.O", "block.P", stiffness=stiffness, damping=damping)
    start = kp.assemble(m, {"block.x": 0.8, "block.y": 0.1, "block.angle": 0.3})
    sol = kp.dynamics(m, start, t_end=4, output_step=0.01, method=TIGHT)
    t, block = sol.t, sol["block"]
    assert_allclose(block.x, 0.5 + 0.3 * np.cos(2 * t), rtol=0, atol=1e-9)
    assert_allclose(block.y, 0.2 - 0.1 * np.cos(3 * t), rtol=0, atol=1e-9)
    turned = swing(t, 0.3, 0, INERTIA, 2 * INERTIA, 25 * INERTIA)
    assert_allclose(block.angle, turned, rtol=0, atol=1e-9)
    assert_allclose(sol.energy.balance, 0, atol=1e-9)
