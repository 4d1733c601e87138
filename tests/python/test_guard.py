"""The check at the end of a run: a result beyond its limits is an error that carries the result."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from house.places import ROOT
from kempe.analyses.option import Option

FOUR_BAR = ROOT / "examples" / "four_bar.toml"


def bouncing(mass: float = 1.0, size: float = 1.0) -> tuple[kp.Model, kp.State]:
    """A pendulum that hits a rigid stop."""
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0.3 * size, 0.1 * size))
    points = {"O": (-0.7 * size, 0.3 * size)}
    m.body("rod", mass=mass, inertia=0.1 * mass * size**2, points=points)
    m.revolute("pin", "ground.O", "rod.O")
    m.stop("wall", "rod.angle", lower=-1.1, restitution=0.5)
    return m, kp.assemble(m, set={"rod.angle": 0})


LIMITS = ["force_limit", "joint_limit", "penetration_limit", "energy_limit"]


@pytest.mark.parametrize("limit", LIMITS)
def test_each_limit_is_an_error_that_carries_the_solution(limit: str) -> None:
    m, start = bouncing()
    radau = kp.Radau()  # its hits are a little late
    whole = kp.dynamics(m, start, t_end=1.5, output_step=0.01, method=radau)
    assert len(whole.events["wall.hit"].t)
    with pytest.raises(kp.IntegrationError, match="more than") as caught:
        kp.dynamics(m, start, t_end=1.5, output_step=0.01, method=radau, **{limit: 1e-18})
    error = caught.value
    assert error.hint and 0 <= error.t <= 1.5
    assert error.solution.status == -1 and not error.solution.success
    np.testing.assert_array_equal(error.solution.q, whole.q)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_runs_of_any_mass_and_size_pass(mass: float, size: float) -> None:
    m, start = bouncing(mass, size)
    assert kp.dynamics(m, start, t_end=1.5 * np.sqrt(size), output_step=0.01).success


def test_a_limit_in_a_case_file(tmp_path: Path) -> None:
    text = FOUR_BAR.read_text(encoding="utf-8") + "energy_limit = 1e-12\n"
    text = text.replace('"baumgarte", alpha = 10, beta = 200', '"projection"')
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    done = kempe("run", "case.toml", "--no-figures", cwd=tmp_path)
    assert done.returncode != 0 and "energy_limit = 1.0e-12" in done.stderr
    assert "the solution up to 15 s is in" in done.stderr


@pytest.mark.parametrize("gains", ['"baumgarte", alpha = 1, beta = 20', '"none"'])
def test_drift_is_a_result_with_a_warning(gains: str, tmp_path: Path) -> None:
    text = FOUR_BAR.read_text(encoding="utf-8")
    text = text.replace('"baumgarte", alpha = 10, beta = 200', gains)
    (tmp_path / "case.toml").write_text(text.replace("1e-6, atol = 1e-9", "1e-3, atol = 1e-6"))
    done = kempe("run", "case.toml", "--no-figures", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "warning: the joints are open" in done.stderr


@pytest.mark.parametrize("method", [kp.HHT(step=2e-2), kp.GeneralizedAlpha(step=2e-2)])
def test_energy_that_a_damped_method_loses_is_a_warning(method: Option) -> None:
    m, start = bouncing()
    with pytest.warns(kp.AccuracyWarning, match="energy balance"):
        sol = kp.dynamics(m, start, t_end=1.5, method=method, energy_limit=1e-9)
    assert sol.success


def test_a_run_that_ends_early_is_not_checked() -> None:
    m, start = bouncing()

    def interrupt(_: kp.State) -> None:
        raise KeyboardInterrupt

    events = {"low": kp.Event("rod.angle < -45*deg", action=interrupt)}
    with pytest.raises(KeyboardInterrupt) as caught:
        kp.dynamics(m, start, t_end=1.5, events=events, energy_limit=1e-18)
    assert 0.0 < caught.value.solution.t[-1] < 1.5


def test_an_action_may_change_the_energy() -> None:
    m, start = bouncing()

    def brake(state: kp.State) -> kp.State:
        return kp.State(m, state.t, state.q, state.v / 2)

    events = {"low": kp.Event("rod.angle < -45*deg", action=brake)}
    sol = kp.dynamics(m, start, t_end=0.5, events=events)
    assert np.abs(sol.energy.balance[-1]) > 0.1


def test_the_balances_contain_internal_coordinates() -> None:
    m = kp.Model("bead", gravity=(0, -9.81))
    m.ground.curves(wire={"circle": (0, 0, 1)})
    m.point_mass("bead", mass=2)
    m.point_on_curve("on", "bead.P", "ground.wire")
    sol = kp.dynamics(m, kp.assemble(m, set={"bead.x": 1}), t_end=1, output_step=0.1)
    balance = sol.newton_euler
    assert balance.coordinates == ("on.u",)
    assert balance.effort.shape == (len(sol.t), 1) and balance.relative.shape == (len(sol.t), 2)
    # 3 m g at the lowest point, whose components along the wire cancel
    assert balance.effort_scale[0] > 9.81
    assert balance.largest < 1e-12


@pytest.mark.parametrize("stiffness", [1e3, 1e6])
@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_works_of_stops_under_a_driver(mass: float, stiffness: float) -> None:
    """The motion does not depend on the stop; the work of its damping has a closed form."""
    m = kp.Model("press", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("ram", mass=mass, inertia=mass, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "ram.P")
    m.coordinate_driver("motor", "guide.displacement", value="0.3*sin(3*t)")
    law = {"stiffness": stiffness * mass, "exponent": 1.5, "damping": 0.5}
    m.stop("pad", "guide.displacement", upper=0.2, **law)
    for method in (kp.Auto(), kp.RK45(rtol=1e-8, atol=1e-11)):
        sol = kp.dynamics(m, kp.assemble(m), t_end=1, method=method)
        # ∫ k δ^1.5 c δ̇² dt by Gauss's rule over the time of contact, with δ = (1 - x²) smooth in x
        x, weights = np.polynomial.legendre.leggauss(200)
        begin, end = np.arcsin(2 / 3) / 3, (np.pi - np.arcsin(2 / 3)) / 3
        t = begin + (end - begin) * np.sin(np.pi / 4 * (x + 1)) ** 2
        dt = (end - begin) * np.pi / 4 * np.sin(np.pi / 2 * (x + 1)) * weights
        depth, rate = 0.3 * np.sin(3 * t) - 0.2, 0.9 * np.cos(3 * t)
        lost = np.sum(stiffness * mass * depth**1.5 * 0.5 * rate**2 * dt)
        assert sol.energy.dissipated[-1] == pytest.approx(lost, abs=3e-8 * sol.energy.scale)
        assert np.abs(sol.energy.balance).max() < 1e-7
