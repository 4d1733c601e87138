"""The energy balance is relative to the energies of the run, at every scale."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import plot
from kempe.report import summary


def damped_rod(mass: float, stiffness: float, damping: float) -> tuple[kp.Model, kp.State]:
    """A rod of 1 m on a pin with a torsional spring-damper, released at half a radian."""
    m = kp.Model("rod")
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=mass, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    m.torsion_spring("spring", "ground", "rod", stiffness=stiffness, damping=damping)
    return m, kp.assemble(m, {"rod.angle": 0.5})


@pytest.mark.parametrize("mass", [1.0, 1e-6, 1e-12])
def test_strong_damping_dissipates_far_more_than_there_is_kinetic_energy(mass: float) -> None:
    stiffness, damping = 4.0, 1e3
    m, start = damped_rod(mass, stiffness, damping)
    sol = kp.dynamics(m, start, t_end=1000, output_step=10)
    # φ = 0.5 exp(-k t / c) without inertia; the spring loses k (φ0² - φ²) / 2 to the damper
    angle = 0.5 * np.exp(-stiffness / damping * sol.t)
    np.testing.assert_allclose(sol["rod"].angle, angle, atol=1e-5)
    lost = 0.5 * stiffness * (0.25 - angle**2)
    np.testing.assert_allclose(sol.energy.dissipated, lost, atol=1e-4)
    assert sol.energy.scale == pytest.approx(lost[-1], rel=1e-4)
    assert sol.energy.kinetic.max() < 1e-5 * sol.energy.scale
    assert np.abs(sol.energy.balance).max() < 1e-6


def test_the_scale_is_the_largest_energy_that_is_exchanged(solution: kp.Solution) -> None:
    energy = solution.energy
    parts = energy.potential, energy.dissipated, energy.work_of_drivers, energy.work_of_forces
    largest = max(energy.kinetic.max(), *(part.max() - part.min() for part in parts))
    assert energy.scale == largest
    np.testing.assert_array_equal(energy.balance, (energy.total - energy.total[0]) / largest)


def test_a_pendulum_has_the_scale_of_its_fall() -> None:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    sol = kp.dynamics(m, kp.assemble(m, {"rod.angle": 0}), t_end=3, output_step=1e-3)
    # from level to hanging, the centre falls by 0.5 m
    assert sol.energy.scale == pytest.approx(2 * 9.81 * 0.5, rel=1e-5)


@pytest.mark.parametrize("mass", [1.0, 1e6])
def test_rest_is_balanced(mass: float) -> None:
    """A hanging chain: its energies change by rounding errors."""
    m = kp.Model("chain", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    end = "ground.O"
    for number in range(3):
        m.bar(f"link{number}", mass=mass, length=1, ends=("P", "Q"))
        m.revolute(f"J{number}", end, f"link{number}.P")
        end = f"link{number}.Q"
    hanging = {f"link{number}.angle": "-90*deg" for number in range(3)}
    sol = kp.dynamics(m, kp.assemble(m, hanging), t_end=5)
    assert np.abs(sol.energy.balance).max() < 1e-6


def rods(scale: float) -> tuple[kp.Model, kp.State]:
    """Three point masses on massless rods; gravity is scaled so that times stay."""
    m = kp.Model("rods", gravity=(0, -9.81 * scale))
    m.ground.points(O=(0, 0))
    end, x, y, held, guess = "ground.O", 0.0, 0.0, {}, {}
    for number, angle in enumerate((-0.3, 0.4, 1.2)):
        m.point_mass(f"bob{number}", mass=1 + number)
        m.distance(f"rod{number}", end, f"bob{number}.P", length=scale)
        x, y = x + scale * np.cos(angle), y + scale * np.sin(angle)
        held[f"bob{number}.x"], guess[f"bob{number}.y"] = x, y
        end = f"bob{number}.P"
    return m, kp.assemble(m, held, guess)


def test_nanometres_keep_their_digits_and_their_balance() -> None:
    """The motion was wrong, not the balance: 1e-11 m is a hundredth of the rods."""
    grid = {"t_end": 3, "output_step": 0.1}
    metre = kp.dynamics(*rods(1.0), **grid)
    nanometre = kp.dynamics(*rods(1e-9), **grid)
    np.testing.assert_allclose(nanometre.q / 1e-9, metre.q, atol=1e-5)
    assert np.abs(metre.energy.balance).max() < 1e-6
    assert np.abs(nanometre.energy.balance).max() < 1e-6
    coarse = kp.dynamics(*rods(1e-9), **grid, method=kp.Auto(atol=1e-11))
    assert np.abs(coarse.q / 1e-9 - metre.q).max() > 1e-3
    assert np.abs(coarse.energy.balance).max() > 1e-4
    by_kind = kp.dynamics(*rods(1e-9), **grid, method=kp.Auto(atol={"length": 1e-20}))
    np.testing.assert_allclose(by_kind.q / 1e-9, metre.q, atol=1e-5)


@pytest.mark.parametrize(
    ("method", "allowed"),
    [(kp.Auto(), 1e-6), (kp.Radau(), 1e-4), (kp.GeneralizedAlpha(), 1e-2)],
)
def test_all_reports_of_a_creeping_run_have_one_balance(method: Any, allowed: float) -> None:
    """The kinetic energy is a millionth of the energy that is exchanged."""
    m, start = damped_rod(1.0, 4.0, 1e3)
    sol = kp.dynamics(m, start, t_end=1000, output_step=10, method=method)
    imbalance = np.abs(sol.energy.balance).max()
    assert imbalance < allowed
    assert sol.energy.kinetic.max() < 1e-5 * sol.energy.scale
    shown = summary(sol)["energy"]
    assert (shown["largest_imbalance"], shown["scale"]) == (imbalance, sol.energy.scale)
    drawn = plot.energy_balance(sol)
    heights = np.concatenate([np.asarray(line.get_ydata(), float) for line in drawn.lines])
    assert heights.max() == pytest.approx(imbalance, rel=1e-9)


def swinging() -> tuple[kp.Model, kp.State]:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    m.torsion_spring("damper", "ground", "rod", stiffness=0, damping=0.3)
    return m, kp.assemble(m, {"rod.angle": 0})


COARSE = [kp.DOP853(rtol=1e-3, atol=1e-3), kp.RK4(step=0.02), kp.GeneralizedAlpha()]


@pytest.mark.parametrize("method", COARSE, ids=lambda method: method.kind)
def test_a_run_stops_where_its_balance_is_lost(method: Any) -> None:
    """The stop is the end of the first step at which the balance of the run so far is too large."""
    m, start = swinging()
    grid = {"t_end": 5, "output_step": 1e-3, "method": method}
    free = kp.dynamics(m, start, **grid)
    worst = np.abs(free.energy.balance).max()
    assert kp.dynamics(m, start, **grid, stop=f"abs(energy.balance) > {2 * worst}").status == 0
    limit = worst / 100
    stop = f"abs(energy.balance) > {limit}"
    stopped = kp.dynamics(m, start, **grid, stop=stop, events={"drift": "drift.balance > 1e-9"})
    assert stopped.status == 1 and 0 < stopped.t[-1] < 1
    assert abs(stopped["energy.balance"][-1]) > limit
    assert not len(stopped.events["drift"].t)


@pytest.mark.parametrize("limit", [1e-7, 5e-7, 1e-6])
def test_the_balance_of_a_condition_is_that_of_a_run_that_ends_there(limit: float) -> None:
    m, start = swinging()
    grid = {"t_end": 5, "output_step": 0.05, "method": kp.RK4(step=0.05)}
    energy = kp.dynamics(m, start, **grid).energy
    ended = [energy.at(np.arange(k + 1)).balance[-1] for k in range(101)]
    above = np.abs(ended) > limit
    sol = kp.dynamics(m, start, **grid, events={"lost": f"abs(energy.balance) > {limit}"})
    expected = 0.05 * np.flatnonzero(above[1:] & ~above[:-1]) + 0.05
    assert len(expected)
    np.testing.assert_allclose(sol.events["lost"].t, expected, rtol=1e-9)


def test_a_balance_goes_on_after_an_action() -> None:
    """The action takes half of the speed: three quarters of the kinetic energy are lost."""
    m, start = swinging()

    def brake(state: kp.State) -> kp.State:
        return kp.State(m, state.t, state.q, state.v / 2)

    events = {
        "lowest": kp.Event("rod.angle < -90*deg", action=brake),
        "lost": "energy.balance < -0.6",
        "more": "energy.balance < -0.62",
    }
    sol = kp.dynamics(m, start, t_end=0.8, output_step=1e-2, events=events)
    before = sol.energy.kinetic[sol.t == sol.events["lowest"].t[0]][0]
    assert sol.energy.balance[-1] == pytest.approx(-0.75 * before / sol.energy.scale, rel=1e-6)
    assert -0.62 < sol.energy.balance[-1] < -0.6
    assert len(sol.events["lowest"].t) == 1
    assert len(sol.events["lost"].t) == 1 and not len(sol.events["more"].t)
    assert sol.events["lowest"].t[0] <= sol.events["lost"].t[0] < sol.events["lowest"].t[0] + 0.1
