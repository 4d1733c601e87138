"""A motor with inductance has a first-order state; its motion is held against closed forms."""

from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

U, R, L, K, J = 12.0, 2.0, 0.1, 0.5, 0.01


def motor(**changes: Any) -> kp.Model:
    m = kp.Model("motor")
    m.ground.points(O=(0, 0))
    m.body("rotor", mass=1, inertia=J, points={"O": (0, 0)})
    m.revolute("shaft", "ground.O", "rotor.O")
    circuit = {"voltage": U, "resistance": R, "inductance": L, "torque_constant": K}
    fields = changes if "stall_torque" in changes else {**circuit, **changes}
    m.motor("motor", "rotor", **fields)
    return m


def truth(t: float, omega: float, current: float) -> tuple[float, float]:
    """J ω′ = K i and L i′ = U - R i - K ω by the matrix exponential."""
    matrix = np.array([[0, K / J, 0], [-K / L, -R / L, U / L], [0, 0, 0]])
    end = expm(matrix * t) @ [omega, current, 1]
    return float(end[0]), float(end[1])


@pytest.fixture(scope="module")
def solution() -> kp.Solution:
    m = motor()
    start = kp.assemble(m, {"rotor.angle": 0, "rotor.omega": 3, "motor.current": "1.5 A"})
    return kp.dynamics(m, start, t_end=0.3, method=kp.DOP853(rtol=1e-10, atol=1e-12))


def test_rate_and_current_agree_with_the_closed_form(solution: kp.Solution) -> None:
    for k in (0, len(solution.t) // 2, -1):
        omega, current = truth(float(solution.t[k]), 3.0, 1.5)
        assert solution["rotor"].omega[k] == pytest.approx(omega, abs=1e-7)
        assert solution["motor"].current[k] == pytest.approx(current, abs=1e-7)
    between = solution(0.1234)
    assert_allclose(between.z, [truth(0.1234, 3.0, 1.5)[1]], atol=1e-6)


@pytest.mark.parametrize(
    "method", [kp.RK45(rtol=1e-9, atol=1e-11), kp.Radau(rtol=1e-9, atol=1e-11), kp.Auto()]
)
def test_every_kind_of_method_integrates_the_current(method: Any) -> None:
    m = motor()
    sol = kp.dynamics(m, kp.assemble(m, {"rotor.angle": 0}), t_end=0.3, method=method)
    assert_allclose([sol["rotor"].omega[-1], sol.final.z[0]], truth(0.3, 0.0, 0.0), atol=1e-5)


def test_the_torque_is_that_of_the_current(solution: kp.Solution) -> None:
    torque = solution["motor"].torque(on="rotor")
    assert_allclose(torque, K * solution["motor"].current, rtol=1e-12)
    assert_allclose(solution["rotor"].alpha, torque / J, rtol=1e-9)


def test_the_energy_of_the_circuit_balances(solution: kp.Solution) -> None:
    t, energy = solution.t, solution.energy
    current, omega = solution.z[:, 0], solution["rotor"].omega
    assert_allclose(energy.kinetic, J * omega**2 / 2, rtol=1e-12)
    assert_allclose(energy.potential, L * current**2 / 2, rtol=1e-12)
    fine = np.linspace(0, 0.3, 20_001)
    i = np.array([truth(float(s), 3.0, 1.5)[1] for s in fine[::20]])
    assert energy.dissipated[-1] == pytest.approx(np.trapezoid(R * i**2, fine[::20]), rel=1e-5)
    assert energy.work_of_forces[-1] == pytest.approx(np.trapezoid(U * i, fine[::20]), rel=1e-5)
    assert_allclose(energy.balance, energy.balance[0], atol=1e-7)
    assert t[-1] == 0.3


def test_without_inductance_the_current_follows_the_voltage() -> None:
    m = motor(inductance=0.0, voltage="12 - 20*t")
    sol = kp.dynamics(m, kp.assemble(m, {"rotor.angle": 0}), t_end=0.3)
    assert sol.z.shape == (len(sol.t), 0)
    current = (U - 20 * sol.t - K * sol["rotor"].omega) / R
    assert_allclose(sol["motor"].torque(on="rotor"), K * current, atol=1e-12)


def test_tables_and_archives_contain_the_current(solution: kp.Solution, tmp_path: Path) -> None:
    assert_allclose(solution.to_dataframe()["motor.current"], solution.z[:, 0])
    assert solution.to_dataframe().attrs["units"]["motor.current"] == "A"
    solution.save(tmp_path / "run.npz")
    again = kp.load_solution(tmp_path / "run.npz")
    np.testing.assert_array_equal(again.z, solution.z)


def test_a_run_continues_with_the_current() -> None:
    m = motor()
    first = kp.dynamics(m, kp.assemble(m, {"rotor.angle": 0}), t_end=0.1)
    second = kp.dynamics(m, first.final, t_end=0.3)
    assert_allclose([second["rotor"].omega[-1], second.final.z[0]], truth(0.3, 0, 0), atol=1e-5)


def test_impossible_values_are_refused() -> None:
    with pytest.raises(kp.ModelError, match="resistance"):
        motor(resistance=0).compile()
    with pytest.raises(kp.ModelError, match="inductance"):
        motor(inductance=-1).compile()
    with pytest.raises(kp.ModelError, match=r"motor\.amps|'motor'"):
        kp.assemble(motor(), {"motor.amps": 1})


def modes(omega: float, current: float) -> tuple[np.ndarray, np.ndarray]:
    """Rates and amplitudes of i = Σ bₖ exp(λₖ t), whose steady value is zero."""
    rates, vectors = np.linalg.eig(np.array([[0, K / J], [-K / L, -R / L]]))
    return rates, vectors[1] * np.linalg.solve(vectors, [omega - U / K, current])


def test_a_tight_tolerance_meets_the_closed_form_and_the_energies() -> None:
    """Rate and current, and the integrals of U i and R i², by the modes of the circuit."""
    m = motor()
    start = kp.assemble(m, {"rotor.angle": 0, "rotor.omega": 3, "motor.current": "1.5 A"})
    tight = kp.DOP853(rtol=1e-13, atol=1e-15)
    sol = kp.dynamics(m, start, t_end=0.5, output_step=0.01, method=tight)
    expected = np.array([truth(float(t), 3.0, 1.5) for t in sol.t])
    assert_allclose(sol["rotor"].omega, expected[:, 0], rtol=0, atol=1e-9)
    assert_allclose(sol["motor"].current, expected[:, 1], rtol=0, atol=1e-9)
    rates, parts = modes(3.0, 1.5)
    charge = (parts / rates * np.expm1(np.outer(sol.t, rates))).sum(axis=1).real
    sums = np.add.outer(rates, rates)
    heat = (
        R
        * np.einsum(
            "ij,tij->t", np.outer(parts, parts) / sums, np.expm1(sums * sol.t[:, None, None])
        ).real
    )
    energy = sol.energy
    assert_allclose(energy.work_of_forces, U * charge, rtol=0, atol=1e-9)
    assert_allclose(energy.dissipated, heat, rtol=0, atol=1e-9)
    # electrical = mechanical + stored in the coil + heat
    mechanical = J * (sol["rotor"].omega ** 2 - 9) / 2
    stored = L * (sol["motor"].current ** 2 - 1.5**2) / 2
    assert_allclose(U * charge, mechanical + stored + heat, rtol=0, atol=1e-9)
    assert_allclose(energy.balance, 0, atol=1e-9)


@pytest.mark.parametrize("load", [0.0, 0.6, 1.5, 4.0])
def test_under_load_it_settles_on_the_line_of_torque_over_speed(load: float) -> None:
    """Torque K (U - K ω) / R: the stall torque K U / R falls to zero at the free speed U / K."""
    stall, free = K * U / R, U / K
    for m in (motor(), motor(stall_torque=stall, free_speed=free)):
        m.torque("load", "rotor", torque=-load)
        tight = kp.Radau(rtol=1e-11, atol=1e-13)
        sol = kp.dynamics(m, kp.assemble(m, {"rotor.angle": 0}), t_end=4, method=tight)
        omega = free * (1 - load / stall)
        assert sol["rotor"].omega[-1] == pytest.approx(omega, abs=1e-9)
        assert sol["motor"].torque(on="rotor")[-1] == pytest.approx(load, abs=1e-9)
    assert sol["rotor"].alpha[-1] == pytest.approx(0, abs=1e-7)
