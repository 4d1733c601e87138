"""Friction at states outside of runs: they have the equations with which a run begins there."""

import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.results import friction_at_rest

DWELL = "step5(t, 0.5, 0, 1, 1) - step5(t, 2, 0, 2.5, 1)"
SCALES = [(1e-3, 1e-2), (1.0, 1.0), (1e3, 30.0)]


def arm(mass: float, length: float, radius: float, angle: str = "20 deg") -> kp.State:
    """An arm that falls from rest, with friction in its pin."""
    m = kp.Model("arm", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    inertia = mass * length**2 / 12
    m.body("arm", mass=mass, inertia=inertia, center=(length / 2, 0), points={"A": (0, 0)})
    m.revolute("A", "ground.O", "arm.A")
    m.friction("rub", "A", kinetic=0.3, static=0.4, radius=radius * length)
    return kp.assemble(m, set={"arm.angle": angle})


@pytest.mark.parametrize(("mass", "length"), SCALES)
@pytest.mark.parametrize("direction", [1, -1])
def test_a_state_has_the_friction_of_the_first_row(
    mass: float, length: float, direction: int
) -> None:
    state = arm(mass, length, 0.2, "20 deg" if direction > 0 else "160 deg")
    m = state.model
    first = kp.dynamics(m, state, t_end=1e-3 * length**0.5).initial
    plain = 9.81 * 0.5 * np.cos(np.radians(20)) / (1 / 3) / length
    assert 0.6 * plain < -direction * state["arm.alpha"] < 0.99 * plain
    assert state["arm.alpha"] == pytest.approx(first["arm.alpha"], rel=1e-12)
    np.testing.assert_allclose(state["rub.torque"], first["rub.torque"], rtol=1e-12)
    np.testing.assert_allclose(state["A"].force(on="arm"), first["A"].force(on="arm"), rtol=1e-12)
    assert state["rub.sticking"] == 0
    assert state.newton_euler.largest < 1e-12
    both = kp.Motion(m, [0.0, 0.1], np.array([state.q] * 2), np.array([state.v] * 2))
    np.testing.assert_allclose(both["arm.alpha"], first["arm.alpha"], rtol=1e-12)


@pytest.mark.parametrize(("mass", "length"), SCALES)
def test_a_state_sticks_where_friction_can_hold_it(mass: float, length: float) -> None:
    state = arm(mass, length, 0.2, "88 deg")
    load = mass * 9.81 * length / 2 * np.cos(np.radians(88))
    assert abs(state["arm.alpha"]) < 1e-12 * 9.81 / length
    assert state["rub.torque"] == pytest.approx(load)
    assert state["rub.sticking"] == 1
    assert state["A"].unique
    assert np.abs(state.newton_euler.largest) < 1e-12


def block(mass: float, size: float, law: str = DWELL) -> kp.Model:
    """A block that a driver moves up a slope, holds there, and moves back."""
    m = kp.Model("block", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("block", mass=mass, inertia=0.1 * mass * size**2, points={"P": (0, 0)})
    m.translational("S", "ground.O", "block.P", axes=("20 deg", 0))
    m.coordinate_driver("D", "S.displacement", value=f"{size}*({law})")
    m.friction("rub", "S", kinetic=0.3)
    return m


def ends(mass: float) -> list[float]:
    slope = np.radians(20)
    return [mass * 9.81 * (np.sin(slope) + k * 0.3 * np.cos(slope)) for k in (-1, 1)]


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_inverse_dynamics_gives_the_range_at_a_dwell(mass: float, size: float) -> None:
    m = block(mass, size)
    sol = kp.inverse_dynamics(m, kp.assemble(m), t_end=3, output_step=0.05)
    rest = (sol.t <= 0.5) | ((sol.t >= 1) & (sol.t <= 2)) | (sol.t >= 2.5)
    interval, effort = sol["D"].interval, sol["D.effort"]
    np.testing.assert_allclose(interval[rest], np.tile(ends(mass), (rest.sum(), 1)), rtol=1e-9)
    np.testing.assert_allclose(effort[rest], np.mean(ends(mass)), rtol=1e-9)
    np.testing.assert_allclose(interval[~rest], np.stack([effort[~rest]] * 2, axis=1), rtol=1e-12)
    assert sol["D"].choice == "middle of friction at rest"
    assert not sol["D"].unique and sol["S"].unique
    np.testing.assert_allclose(sol(np.array([1.5]))["D"].interval, [ends(mass)], rtol=1e-9)
    np.testing.assert_allclose(kp.assemble(m)["D"].interval, [ends(mass)], rtol=1e-9)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_driven_motion_that_begins_from_rest_slides_at_once(sign: int) -> None:
    m = block(2.0, 1.0, f"{sign}*t^2")
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.1)
    effort = ends(2.0)[(1 + sign) // 2] + 2 * 2.0 * sign
    np.testing.assert_allclose(sol["D.effort"], effort, rtol=1e-9)
    assert kp.assemble(m)["D.effort"] == pytest.approx(effort)
    assert sol["D"].unique


@pytest.mark.parametrize(("mass", "size"), SCALES)
@pytest.mark.parametrize("analysis", ["dynamics", "inverse"])
def test_a_driver_at_rest_beside_one_that_moves(mass: float, size: float, analysis: str) -> None:
    m = block(mass, size)
    m.body("fan", mass=mass, inertia=mass * size**2, points={"F": (0, 0)})
    m.revolute("F", "block.P", "fan.F")
    m.coordinate_driver("E", "F.angle", value="3*sin(2*t)")
    run = kp.dynamics if analysis == "dynamics" else kp.inverse_dynamics
    sol = run(m, kp.assemble(m), t_end=3, output_step=0.05)
    rest = (sol.t < 0.5) | ((sol.t > 1.005) & (sol.t < 2)) | (sol.t > 2.505)
    wanted = np.tile(ends(2 * mass), (rest.sum(), 1))
    np.testing.assert_allclose(sol["D"].interval[rest], wanted, rtol=1e-6)
    np.testing.assert_allclose(sol["D.effort"][rest], np.mean(ends(2 * mass)), rtol=1e-6)
    assert sol["E"].unique
    if analysis == "dynamics":
        assert sol.events["rub.slip"].t == pytest.approx([0.5, 2.0], abs=2e-3)
        assert sol.events["rub.stick"].t == pytest.approx([1.0, 2.5], abs=2e-3)


def test_tables_and_figures_say_which_value_is_given(tmp_path: Path) -> None:
    m = block(2.0, 1.0)
    m.measures(push="D.effort")
    sol = kp.inverse_dynamics(m, kp.assemble(m), t_end=3, output_step=0.05)
    told = "middle of friction at rest"
    sol.to_csv(tmp_path / "a.csv")
    header = (tmp_path / "a.csv").read_text("utf-8").splitlines()[0]
    assert f"push [N, {told}]" in header and "minimum norm" not in header
    assert told in repr(sol.measure("push"))
    assert told in kp.plot.measure(sol, "push").get_title(loc="left")
    assert told in repr(kp.design.duty(sol, "D"))
    assert [one["choice"] for one in sol.summary["measures"]] == [told]
    assert json.loads(json.dumps(kp.draw.scene(sol)))["choices"] == {"D": told}
    assert kp.design.free_body(sol, "block", 1.5).remarks == (f"not unique, {told}: D",)


def test_a_sweep_says_which_value_is_given() -> None:
    m = block(2.0, 1.0)
    m.measures(push="D.effort")
    case = kp.Case(m, analyses=[kp.Dynamics(t_end=0.8)])
    found = kp.sweep(case, {"S.displacement": [0, 0]}, ["push.final", "push.max"])
    assert dict(found.choices) == dict.fromkeys(found.measures, "middle of friction at rest")


def test_states_between_outputs_are_decided_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The states that close the joints do not depend on friction, so that only they are decided."""
    m = block(2.0, 1.0)
    sol = kp.inverse_dynamics(m, kp.assemble(m), t_end=3, output_step=0.05)
    calls = []
    found = friction_at_rest.phases
    monkeypatch.setattr(
        friction_at_rest, "phases", lambda motion: calls.append(motion) or found(motion)
    )
    effort = sol(np.linspace(0, 3, 7))["D.effort"]
    assert len(calls) == 1
    np.testing.assert_allclose(effort[0], np.mean(ends(2.0)), rtol=1e-12)
