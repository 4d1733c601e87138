"""Energies of single force elements: closed forms, and sums equal to those of the mechanism."""

import math
from pathlib import Path

import kempe as kp
import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"


def oscillator(damping: float | str = 3.0, stiffness: float | str = 50.0) -> kp.Model:
    """A mass of 2 kg on a spring of 1 m along a rail."""
    m = kp.Model("oscillator", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    at = ("ground.O", "mass.P")
    m.spring_damper("s", *at, stiffness=stiffness, damping=damping, free_length=1)
    return m


def released(m: kp.Model, **options: object) -> kp.Solution:
    """From rest, 0.1 m from the relaxed spring."""
    method = kp.DOP853(rtol=1e-12, atol=1e-14)
    start = kp.assemble(m, set={"mass.x": 1.1})
    return kp.dynamics(m, start, t_end=2.0, **{"output_step": 0.013, "method": method, **options})


def test_a_damped_oscillator() -> None:
    """x = A e^(-δt) (cos ωt + δ/ω sin ωt): the spring stores k x²/2, the rest is dissipated."""
    sol = released(oscillator())
    delta = 3.0 / 4.0
    omega = math.sqrt(25.0 - delta**2)
    decay = 0.1 * np.exp(-delta * sol.t)
    x = decay * (np.cos(omega * sol.t) + delta / omega * np.sin(omega * sol.t))
    v = -decay * 25.0 / omega * np.sin(omega * sol.t)
    np.testing.assert_allclose(sol["s.energy"], 25.0 * x**2, atol=1e-9 * 0.25)
    lost = 0.25 - 25.0 * x**2 - v**2
    np.testing.assert_allclose(sol["s.dissipated"], lost, atol=1e-9 * 0.25)
    assert sol["s.dissipated"][0] == 0.0
    assert sol.force("s").energy == pytest.approx(sol["s.energy"])
    rate = sol.force("s").force(on="mass", part="damping")[:, 0] * sol["mass.vx"]
    np.testing.assert_allclose(np.gradient(lost, sol.t)[1:-1], -rate[1:-1], atol=2e-3)


def test_the_elements_of_the_flagship_add_up() -> None:
    sol = kp.load(EXAMPLES / "four_bar.toml").run()[0]
    lost = sum(sol[f"{name}.dissipated"] for name in sol.compiled.forces)
    assert sol.energy.dissipated[-1] > 0.0
    np.testing.assert_allclose(lost, sol.energy.dissipated, atol=1e-6 * sol.energy.scale)
    bodies = sol.compiled.bodies
    weight = sum(
        9.81 * info.mass * sol.body(name).at(info.center).position[:, 1]
        for name, info in bodies.items()
    )
    stored = sum(sol[f"{name}.energy"] for name in sol.compiled.forces)
    np.testing.assert_allclose(weight + stored, sol.energy.potential, atol=1e-9 * sol.energy.scale)


def test_a_motor_loses_heat_and_stores_energy_in_its_coil() -> None:
    m = kp.Model("motor", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("rotor", mass=1, inertia=0.01, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "rotor.O")
    values = {"voltage": 12, "resistance": 2, "inductance": 0.05, "torque_constant": 0.1}
    m.motor("motor", "rotor", **values)
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.5, output_step=0.01, method=kp.DOP853(rtol=1e-10))
    current = sol["motor.current"]
    np.testing.assert_allclose(sol["motor.energy"], 0.025 * current**2, rtol=1e-12)
    np.testing.assert_allclose(sol["motor.dissipated"], sol.energy.dissipated, rtol=1e-7, atol=1e-9)
    assert sol["motor.dissipated"][-1] > 1.0


def test_a_law_takes_the_potential_and_keeps_the_dissipation() -> None:
    sol = released(oscillator("3*(1 + t)", "50*(1 + t)"))
    assert not sol["s.energy"].any()
    np.testing.assert_allclose(sol["s.dissipated"], sol.energy.dissipated, atol=1e-9)


def test_dissipated_energy_belongs_to_a_solution_with_an_interpolant() -> None:
    sol = released(oscillator())
    assert sol(0.5)["s.energy"] == pytest.approx(25.0 * (float(sol(0.5)["mass.x"]) - 1.0) ** 2)
    with pytest.raises(kp.ModelError, match="quantity of s"):
        sol(0.5)["s.dissipated"]
    with pytest.raises(kp.ModelError, match="belongs to a solution"):
        _ = sol(0.5).force("s").dissipated
    bare = released(oscillator(), dense_output=False)
    with pytest.raises(kp.ModelError, match="dense_output=True"):
        _ = bare.force("s").dissipated
    assert "s.dissipated" not in bare.to_dataframe(frames=()).columns


@pytest.mark.parametrize("method", [kp.DOP853(rtol=1e-10), kp.Radau(rtol=1e-9)], ids=str)
def test_a_run_stops_where_friction_has_dissipated_an_energy(method: kp.DOP853 | kp.Radau) -> None:
    """The pin of a pendulum carries a load that varies; the sum agrees with that of reports."""
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("bar", mass=3, length=1.2, ends=("O", "P"))
    m.revolute("pin", "ground.O", "bar.O")
    m.friction("rubs", "pin", kinetic=0.2, radius=0.05, velocity=1e-2)
    m.torsion_spring("damper", "ground", "bar", stiffness=0, damping=0.3)
    sol = kp.dynamics(m, kp.assemble(m), t_end=10, method=method, stop="rubs.dissipated > 2.5")
    assert sol.status == 1 and 0.5 < sol.t[-1] < 10
    assert sol["rubs.dissipated"][-1] == pytest.approx(2.5, rel=1e-9)
    both = sol["rubs.dissipated"] + sol["damper.dissipated"]
    np.testing.assert_allclose(both, sol.energy.dissipated, rtol=1e-5, atol=1e-6)
