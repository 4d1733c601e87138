"""Phases of runs: released drivers, other parameters, actions at events, two states at one time."""

from __future__ import annotations

import math
import pickle
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT

G = 9.81
FOUR_BAR = ROOT / "examples" / "four_bar.toml"
METHODS: list[kp.Option] = [
    kp.RK45(rtol=1e-9, atol=1e-12),
    kp.DOP853(rtol=1e-9, atol=1e-12),
    kp.RK4(step=1e-3),
    kp.Radau(rtol=1e-9, atol=1e-12),
    kp.GeneralizedAlpha(step=1e-4),
    kp.Auto(),
]


def driven(release: str | None = None) -> kp.Model:
    """The flagship with its crank at 1 rad/s."""
    m = kp.load(FOUR_BAR).model
    m.coordinate_driver("motor", "crank.angle", value="70*deg + t", release=release)
    return m


def started(m: kp.Model) -> kp.State:
    return kp.assemble(m, guess={"coupler.angle": "14*deg", "rocker.angle": "240*deg"})


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
def test_the_flagship_is_driven_for_a_second_and_then_released(method: kp.Option) -> None:
    m = driven()
    first = kp.dynamics(m, started(m), t_end=1, method=method)
    second = kp.dynamics(m, first.final, t_end=1.5, method=method, release=["motor"])
    assert second.t[0] == 1
    np.testing.assert_allclose(second.q[0], first.q[-1], rtol=0, atol=1e-12)
    np.testing.assert_allclose(second.v[0], first.v[-1], rtol=0, atol=1e-12)
    assert abs(first["crank.omega"][-1] - 1) < 1e-9
    assert abs(first["motor.effort"][-1]) > 1e3
    assert not second["motor.effort"].any() and not second["motor.power"].any()
    assert second.lam.shape[1] == first.lam.shape[1] == 9
    # the same as a run of a mechanism without the driver
    plain = kp.load(FOUR_BAR).model
    free = kp.State(plain, 1.0, first.final.q, first.final.v)
    alone = kp.dynamics(plain, free, t_end=1.5, method=method)
    np.testing.assert_array_equal(second.t, alone.t)
    np.testing.assert_array_equal(second.q, alone.q)
    np.testing.assert_allclose(second["C.force"], alone["C.force"], rtol=1e-12)
    freed, held = second.final.matrices(), first.final.matrices()
    assert (freed.degrees_of_freedom, held.degrees_of_freedom) == (1, 0)
    assert set(held.rows) - set(freed.rows) == {"motor.angle"}
    # a release is final
    third = kp.dynamics(m, second.final, t_end=1.6)
    assert not third["motor.effort"].any()
    assert abs(third["crank.omega"][-1] - 1) > 1e-3
    assert kp.dynamics(m, started(m), t_end=0.1)["motor.effort"].all()


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
def test_a_driver_is_released_where_its_condition_becomes_true(method: kp.Option) -> None:
    m = driven("crank.angle > 100*deg")
    sol = kp.dynamics(m, started(m), t_end=1.5, method=method, events={"t": "t > 1"})
    at = math.radians(30)
    (t,) = sol.events["motor.release"].t
    assert abs(t - at) < 1e-12
    assert abs(sol.events["motor.release"].states[0]["crank.angle"] - math.radians(100)) < 1e-12
    rows = np.flatnonzero(sol.t == t)
    assert len(rows) == 2
    before, after = rows
    np.testing.assert_allclose(sol.q[after], sol.q[before], rtol=0, atol=1e-12)
    np.testing.assert_allclose(sol.v[after], sol.v[before], rtol=0, atol=1e-12)
    effort = sol["motor.effort"]
    assert effort[: before + 1].all() and not effort[after:].any()
    assert abs(sol["crank.alpha"][before]) < 1e-9
    assert abs(sol["crank.alpha"][after]) > 1
    # sol(t) is after
    assert sol(t)["motor.effort"] == 0.0
    assert abs(sol(t)["crank.alpha"] - sol["crank.alpha"][after]) < 1e-6
    assert sol(np.nextafter(t, 0))["motor.effort"] != 0.0
    np.testing.assert_allclose(
        sol(np.array([0.1, t, 1.2]))["motor.effort"] == 0, [False, True, True]
    )
    # the constraint of the driver no longer holds and does not count as open
    assert sol.drift.position.max() < 1e-8
    assert np.abs(sol.energy.balance).max() < (1e-4 if method.kind == "generalized_alpha" else 1e-6)
    # the run goes on from its state without the driver
    later = kp.dynamics(m, sol.final, t_end=1.6)
    assert not later["motor.effort"].any()


def test_a_release_is_kept_in_files_and_copies(tmp_path: Path) -> None:
    m = driven("t > 0.5")
    sol = kp.dynamics(m, started(m), t_end=1, output_step=0.1)
    sol.save(tmp_path / "sol.npz")
    for other in (kp.load_solution(tmp_path / "sol.npz"), pickle.loads(pickle.dumps(sol))):
        for name in ("motor.effort", "C.force", "crank.alpha", "drift.position"):
            np.testing.assert_allclose(other[name], sol[name], rtol=1e-9, atol=1e-9)
        assert other(0.7)["motor.effort"] == 0.0
        assert other.final.compiled.released == ("motor",)
        assert other.initial.compiled.released == ()
    sol.to_csv(tmp_path / "sol.csv")
    assert (tmp_path / "sol.csv").read_text().count("\n") == len(sol.t) + 1


def test_a_release_that_is_true_at_the_start_waits() -> None:
    m = driven("crank.angle > 60*deg")
    with pytest.warns(kp.EventWarning, match=r"motor\.release: .* is true at the start"):
        sol = kp.dynamics(m, started(m), t_end=0.2)
    assert not len(sol.events["motor.release"].t)
    assert sol["motor.effort"].all()


def test_a_faulty_release_is_refused() -> None:
    m = driven("crank.angel > 1")
    with pytest.raises(kp.ModelError, match=r"crank\.angel"):
        kp.Case(m, analyses=[kp.Dynamics(1)])
    start = started(m)
    with pytest.raises(kp.ModelError, match=r"crank\.angel"):
        kp.dynamics(m, start, t_end=1)
    with pytest.raises(kp.ModelError, match="there is no driver 'moter'; did you mean 'motor'"):
        kp.dynamics(driven(), started(driven()), t_end=1, release=["moter"])


def spring() -> kp.Model:
    """A mass on a spring along x; ω² = k/m, with k twice the parameter half."""
    m = kp.Model("spring", parameters={"half": 50, "k": "2*half", "L": 1})
    m.ground.points(O=(0, 0), A=(-5, 0))
    m.body("slider", mass=4, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slider.P")
    m.spring_damper("spring", "ground.A", "slider.P", stiffness="k", free_length=5)
    return m


def pulled(m: kp.Model, x: float = 0.2) -> kp.State:
    return kp.assemble(m, set={"slider.x": x})


def test_parameters_of_one_analysis() -> None:
    """With four times the stiffness the period is half as long."""
    m = spring()
    case = kp.Case(
        m,
        start={"set": {"slider.x": 0.2}},
        analyses=[
            kp.Dynamics(math.pi / 5, name="soft"),  # half a period
            kp.Dynamics(math.pi / 5 + math.pi / 10, parameters={"half": 200}, name="hard"),
            kp.Dynamics(2, name="soft_again"),
        ],
    )
    soft, hard, again = case.run().values()
    assert abs(soft["slider.x"][-1] + 0.2) < 1e-8
    np.testing.assert_allclose(
        hard["slider.x"], -0.2 * np.cos(10 * (hard.t - hard.t[0])), atol=1e-8
    )
    assert hard.compiled.parameters["k"] == 400
    np.testing.assert_allclose(hard["spring.force"], -400 * hard["slider.x"], atol=1e-9)
    assert again.compiled.parameters["k"] == 100
    np.testing.assert_allclose(again["spring.force"], -100 * again["slider.x"], atol=1e-9)
    assert abs(hard["slider.x"][-1] - 0.2) < 1e-8
    assert "parameters" in case.tree()["analyses"]["hard"]


def test_parameters_that_open_a_joint_are_refused() -> None:
    case = kp.load(FOUR_BAR)
    with pytest.raises(kp.AssemblyError, match=r"does not meet the constraints.*joint"):
        kp.dynamics(case.model, case.start(), t_end=1, parameters={"L2": 26.5})
    analyses = [kp.Dynamics(0.1, name="a"), kp.Dynamics(0.2, name="b", parameters={"L2": 26.5})]
    with pytest.raises(kp.AssemblyError, match="does not meet the constraints"):
        kp.Case(case.model, {"set": case.held}, analyses).run()
    with pytest.raises(kp.ModelError, match="mass"):
        heavy = kp.Model("m", parameters={"m": 1})
        heavy.point_mass("ball", mass="m")
        kp.dynamics(heavy, kp.assemble(heavy), t_end=1, parameters={"m": -1})


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
def test_an_action_changes_a_parameter(method: kp.Option) -> None:
    """Where the spring is relaxed its stiffness is multiplied by nine: the amplitude is a third."""
    m = spring()
    seen: list[kp.State] = []

    def stiffen(state: kp.State) -> dict[str, float]:
        seen.append(state)
        return {"half": 450.0}

    sol = kp.dynamics(
        m,
        pulled(m),
        t_end=1,
        method=method,
        events={"relaxed": kp.Event("slider.x", direction="falling", action=stiffen)},
    )
    first = math.pi / 10  # a quarter of the period
    loose = {"generalized_alpha": 1e-6, "rk4": 1e-8}.get(method.kind, 1e-8)
    assert abs(seen[0].t - first) < loose
    assert seen[0].t == sol.events["relaxed"].t[0]
    rows = np.flatnonzero(sol.t == seen[0].t)
    assert len(rows) == 2
    np.testing.assert_array_equal(sol.q[rows[0]], sol.q[rows[1]])
    later = sol.t > seen[0].t
    np.testing.assert_allclose(
        sol["slider.x"][later],
        -0.2 / 3 * np.sin(15 * (sol.t[later] - first)),
        atol=20 * loose,
    )
    k = np.where(np.arange(len(sol.t)) <= rows[0], 100, 900)
    np.testing.assert_allclose(sol["spring.force"], -k * sol["slider.x"], rtol=0, atol=1e-9)
    np.testing.assert_allclose(sol["slider.ax"], -k / 4 * sol["slider.x"], rtol=0, atol=1e-9)
    assert sol.final.compiled.parameters["k"] == 900
    assert sol.initial.compiled.parameters["k"] == 100
    # once in each later period, 2π/15 s
    np.testing.assert_allclose(np.diff(sol.events["relaxed"].t), 2 * math.pi / 15, atol=20 * loose)


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
def test_an_action_returns_a_state(method: kp.Option) -> None:
    """A ball that bounces without loss: each flight takes the same time."""
    m = kp.Model("ball", gravity=(0, -G))
    m.point_mass("ball", mass=2)

    def bounce(state: kp.State) -> kp.State:
        return kp.State(m, state.t, state.q, state.v * [1, -1])

    sol = kp.dynamics(
        m,
        kp.assemble(m, set={"ball.x": 0, "ball.y": 1}),
        t_end=4,
        method=method,
        events={"hit": kp.Event("ball.y < 0", action=bounce)},
    )
    fall = math.sqrt(2 / G)
    expected = fall * np.arange(1, 9, 2)
    within = 1e-7 if method.kind == "generalized_alpha" else 1e-10
    np.testing.assert_allclose(sol.events["hit"].t, expected, rtol=0, atol=within)
    for t in sol.events["hit"].t:
        before, after = np.flatnonzero(sol.t == t)
        assert sol["ball.vy"][before] == -sol["ball.vy"][after] < 0
        assert sol(t)["ball.vy"] > 0
    assert sol["ball.y"].min() > -1e-9
    np.testing.assert_array_equal(
        sol.events["hit"].states[0].q, sol.q[sol.t == sol.events["hit"].t[0]][0]
    )


def test_answers_of_actions_are_checked() -> None:
    case = kp.load(FOUR_BAR)

    def run(action: Any) -> kp.Solution:
        events = {"hit": kp.Event("rocker.angle > 270*deg", action=action)}
        return kp.dynamics(case.model, case.start(), t_end=0.2, events=events)

    def with_velocity(state: kp.State) -> kp.State:
        return kp.State(case.model, state.t, state.q, state.v * [2, *[1] * 8])

    with pytest.raises(kp.AssemblyError, match=r"joint [AB] opens at .*/s") as caught:
        run(with_velocity)
    assert caught.value.solution.t[-1] == pytest.approx(0.0778417)
    with pytest.raises(kp.ModelError, match=r"must be at 0\.07784"):
        run(lambda state: kp.State(case.model, 0.0, state.q, state.v))
    with pytest.raises(kp.ModelError, match=r"did you mean|'kk'"):
        run(lambda _: {"kk": 2.0})
    with pytest.raises(kp.ModelError, match="must return None"):
        run(lambda _: 5)
    with pytest.raises(kp.AssemblyError, match="does not meet the constraints"):
        run(lambda _: {"L2": 26.5})
    with pytest.raises(ZeroDivisionError) as broken:
        run(lambda _: 1 / 0)
    assert broken.value.solution.t[-1] == pytest.approx(0.0778417)
    # all velocities reversed meet the constraints
    sol = run(lambda state: kp.State(case.model, state.t, state.q, -state.v))
    assert len(sol.events["hit"].t) >= 1


def test_an_action_that_changes_nothing_leaves_the_motion_as_it_is() -> None:
    m = spring()
    events = {"relaxed": kp.Event("slider.x", action=lambda _: None)}
    sol = kp.dynamics(m, pulled(m), t_end=2, events=events)
    assert len(sol.events["relaxed"].t) == 3
    np.testing.assert_allclose(sol["slider.x"], 0.2 * np.cos(5 * sol.t), atol=1e-8)
    assert np.abs(sol.energy.balance).max() < 1e-8


def test_a_release_is_kept_where_a_drifted_start_is_assembled_anew() -> None:
    """The joints drift with Baumgarte's stabilization; the next analysis closes them."""
    loose = kp.RK45(rtol=1e-4, atol=1e-6)
    drifting: dict[str, Any] = {"method": loose, "stabilization": kp.Baumgarte(alpha=10, beta=50)}
    analyses = [
        kp.Dynamics(0.5, name="driven", **drifting),
        kp.Dynamics(1.0, name="free", release=["motor"], **drifting),
        kp.Dynamics(1.2, name="later", **drifting),
    ]
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    with pytest.warns(kp.AssemblyWarning, match="it starts from the nearest state"):
        results = kp.Case(driven(), {"guess": guess}, analyses).run()
    assert results["driven"]["motor.effort"].all()
    for name in ("free", "later"):
        assert not results[name]["motor.effort"].any()
    far = results["later"]["crank.angle"][-1] - math.radians(70) - 1.2
    assert abs(far) > 0.01
