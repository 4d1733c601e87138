"""Extreme values on the interpolant agree with closed forms, whatever the output times are."""

import math
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.results.extrema import Extreme, largest, least, peak
from kempe.results.fine import fine, fine_energies

EXAMPLES = Path(__file__).parents[2] / "examples"
G = 9.81


def swing(release: float = math.radians(30.0), output_step: float = 0.17) -> kp.Solution:
    """A rod of 1 m and 2 kg, released from rest at an angle from the vertical."""
    m = kp.Model("pendulum", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    start = kp.assemble(m, set={"rod.angle": -math.pi / 2 - release})
    method = kp.DOP853(rtol=1e-10, atol=1e-12)
    return kp.dynamics(m, start, t_end=1.5, output_step=output_step, method=method)


def example(name: str, **fields: object) -> kp.Solution:
    case = kp.load(EXAMPLES / f"{name}.toml")
    return case.with_analysis(next(iter(case.analyses)), **fields).run()[0]


def agm(a: float, b: float) -> float:
    while abs(a - b) > 1e-15:
        a, b = (a + b) / 2.0, math.sqrt(a * b)
    return a


def test_a_pendulum_is_fastest_at_the_bottom() -> None:
    """ω² = 3 g (1 - cos α)/L, and the pin carries m g + m ω² L/2, a quarter of a period later."""
    solution, alpha = swing(), math.radians(30.0)
    omega = math.sqrt(3.0 * G * (1.0 - math.cos(alpha)))
    quarter = math.pi / 2.0 / agm(1.0, math.cos(alpha / 2.0)) / math.sqrt(1.5 * G)
    high = largest(solution, lambda motion: motion.body("rod").omega)
    assert high == pytest.approx((omega, quarter), abs=1e-6)
    assert high.value == pytest.approx(omega, rel=1e-9)
    low = least(solution, lambda motion: motion.body("rod").omega)
    assert low == pytest.approx((-omega, 3.0 * quarter), abs=1e-6)
    force = largest(
        solution,
        lambda motion: np.linalg.norm(motion.constraint("pin").force(on="rod"), axis=1),
    )
    assert force.value == pytest.approx(2.0 * (G + omega**2 / 2.0), rel=1e-8)
    assert min(abs(force.t - quarter), abs(force.t - 3.0 * quarter)) < 1e-4
    coarse = np.abs(solution["rod"].omega).max()
    assert coarse < 0.999 * omega  # the outputs miss the peak


def test_kinetic_energy_between_outputs() -> None:
    solution, alpha = swing(), math.radians(30.0)
    t, energy = fine_energies(solution)
    assert t.shape == energy.kinetic.shape
    assert energy.kinetic.max() == pytest.approx(2.0 * G / 2.0 * (1 - math.cos(alpha)), rel=1e-5)
    np.testing.assert_allclose(energy.total, energy.total[0], atol=1e-8)


def test_a_slider_turns_back_at_the_sum_and_the_difference_of_the_lengths() -> None:
    solution = example("slider_crank", output_step=0.011)
    high = largest(solution, lambda motion: motion.body("slider").x)
    low = least(solution, lambda motion: motion.body("slider").x)
    assert (high.value, low.value) == pytest.approx((0.4, 0.2), abs=1e-8)
    turned = [float(solution(at.t)["crank"].angle) / math.pi % 2.0 for at in (high, low)]
    assert [min(turned[0], 2.0 - turned[0]), turned[1]] == pytest.approx([0.0, 1.0], abs=1e-3)


def test_a_rocker_turns_back_where_crank_and_coupler_are_in_line() -> None:
    solution = example("six_bar", output_step=0.05)
    for found, reach in (
        (least(solution, lambda motion: motion.body("plate").angle), 0.4),
        (largest(solution, lambda motion: motion.body("plate").angle), 0.2),
    ):
        expected = math.pi - math.acos((0.3**2 + 0.2**2 - reach**2) / (2 * 0.3 * 0.2))
        assert found.value == pytest.approx(expected, abs=1e-7)


def test_a_peak_keeps_its_sign_and_is_never_below_an_output() -> None:
    solution = example("four_bar", t_end=1.0, output_step=0.003)
    for name, info in solution.model.constraints.items():
        values = solution.constraint(name).force(on=info.j)[:, 0]
        found = peak(
            solution, lambda motion, n=name, on=info.j: motion.constraint(n).force(on=on)[:, 0]
        )
        k = int(np.abs(values).argmax())
        assert abs(found.value) >= abs(values[k])
        assert found.value == pytest.approx(values[k], rel=5e-3)
        assert found.t == pytest.approx(solution.t[k], abs=0.003)


def test_the_first_of_equal_values_counts() -> None:
    def steady(motion: kp.Motion) -> np.ndarray:
        return 3.0 * (1.0 + 1e-15 * np.sin(1e4 * motion.t))

    assert peak(swing(), steady) == Extreme(pytest.approx(3.0), 0.0)


def test_without_interpolant_the_outputs_are_searched() -> None:
    case = kp.load(EXAMPLES / "pendulum.toml").with_analysis("swing", dense_output=False)
    solution = case.run()[0]
    assert fine(solution) is solution
    k = int(solution["rod"].omega.argmax())
    found = largest(solution, lambda motion: motion.body("rod").omega)
    assert found == (solution["rod"].omega[k], solution.t[k])


def test_fine_instants_follow_the_steps_and_not_the_outputs() -> None:
    one, other = swing(output_step=0.17), swing(output_step=0.5)
    np.testing.assert_array_equal(fine(one).t, fine(other).t)
    steps = one.dense.t
    assert set(steps) <= set(fine(one).t)
    assert len(fine(one).t) == 32 * (len(steps) - 1) + 1
    assert fine(one) is fine(one)


@pytest.mark.parametrize("damping", [0.0, 0.3])
def test_an_extreme_value_at_the_start_has_its_time(damping: float) -> None:
    """A mass of 2 kg on a spring of 50 N/m, stretched by 0.1 m: a(0) = -2.5 m/s²."""
    m = kp.Model("mass", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    m.spring_damper("s", "ground.O", "mass.P", stiffness=50, damping=damping, free_length=1)
    start = kp.assemble(m, set={"mass.x": 1.1})
    for method in (kp.RK45(), kp.Radau(), kp.DOP853(rtol=1e-9, atol=1e-12)):
        solution = kp.dynamics(m, start, t_end=3.0, output_step=0.13, method=method)
        low = least(solution, lambda motion: motion.body("mass").ax)
        assert low == (pytest.approx(-2.5, rel=1e-7), 0.0)
        assert largest(solution, lambda motion: motion.body("mass").x).t == 0.0
        late = largest(solution, lambda motion: motion.body("mass").ax)
        assert late.t == pytest.approx(math.pi / 5.0, abs=2e-2)


def test_a_peak_at_the_start_of_the_example_is_there() -> None:
    solution = example("pendulum")
    for name in ("ax", "ay", "alpha"):
        for extreme in (largest, least):
            t = extreme(solution, lambda motion, name=name: getattr(motion.body("rod"), name)).t
            assert t == 0.0 or t > 0.01
