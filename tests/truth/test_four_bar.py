"""The flagship, compared with an independent formulation in one minimal coordinate.

``tests/reference/four_bar.json`` was computed without kempe, by loop closure and DOP853 at rtol
3e-14.
"""

from typing import Any

import kempe as kp
import numpy as np
import pytest

ANGLES = [2, 5, 8]


def test_the_start_configuration(start: kp.State, reference: dict[str, Any]) -> None:
    np.testing.assert_allclose(start.q, reference["start"]["q"], rtol=0, atol=1e-12)
    np.testing.assert_array_equal(start.v, 0.0)


def test_the_start_needs_no_guess(case: kp.Case, reference: dict[str, Any]) -> None:
    start = kp.assemble(case.model, set={"crank.angle": "70*deg"})
    np.testing.assert_allclose(start.q, reference["start"]["q"], rtol=0, atol=1e-12)
    assert start.report is not None
    assert start.report.alternatives == 1
    assert [mode.joint for mode in start.report.modes] == ["C"]


def test_the_jacobian_as_printed(start: kp.State, reference: dict[str, Any]) -> None:
    printed = np.array(reference["Phi_q_at_start_rounded"])
    # printed with few digits: 1.71, 4.7, 12.6
    np.testing.assert_allclose(start.matrices().Phi_q, printed, rtol=0, atol=0.05)
    signs = np.sign(start.matrices().Phi_q) == np.sign(printed)
    assert signs.all()


def test_the_multipliers_at_the_start(start: kp.State, reference: dict[str, Any]) -> None:
    np.testing.assert_allclose(start.lam, reference["start"]["lam"], rtol=1e-9)
    np.testing.assert_allclose(start.a, reference["start"]["a"], rtol=1e-9)


def test_the_spring_at_the_start(start: kp.State, reference: dict[str, Any]) -> None:
    torque = start["spring"].torque(on="rocker")
    assert torque == pytest.approx(reference["start"]["spring_damper_torque_on_rocker"], rel=1e-12)


def test_the_reaction_at_c(start: kp.State, reference: dict[str, Any]) -> None:
    on_coupler = start["C"].force(on="coupler", frame="global")
    on_rocker = start["C"].force(on="rocker", frame="global")
    np.testing.assert_allclose(on_coupler, reference["start"]["lam"][4:6], rtol=1e-9)
    np.testing.assert_allclose(on_rocker, -on_coupler, rtol=1e-12)
    # in the joint frame, each body rotates the force by its own angle (Haug 6.6.8)
    angle = start["rocker"].angle
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    expected = turn @ on_rocker
    np.testing.assert_allclose(start["C"].force(on="rocker", frame="joint"), expected, rtol=1e-12)


def test_angles_over_the_first_second(tight: kp.Solution, reference: dict[str, Any]) -> None:
    grid = reference["first_second"]
    count = len(grid["t"])
    np.testing.assert_allclose(tight.t[:count], grid["t"], atol=1e-12)
    for body in ("crank", "rocker"):
        truth = grid[f"{body}_angle"]
        np.testing.assert_allclose(tight[body].angle[:count], truth, rtol=0, atol=1e-8)


def test_all_listed_states(tight: kp.Solution, reference: dict[str, Any]) -> None:
    peaks = {name: np.abs(getattr(tight, name)).max(axis=0) for name in ("v", "a", "lam")}
    for state in [reference["start"], *reference["states"]]:
        at = int(np.argmin(np.abs(tight.t - state["t"])))
        assert tight.t[at] == pytest.approx(state["t"], abs=1e-9)
        np.testing.assert_allclose(
            tight.q[at, ANGLES], np.array(state["q"])[ANGLES], rtol=0, atol=1e-8
        )
        for name, share in (("v", 1e-6), ("a", 1e-5), ("lam", 1e-5)):
            error = np.abs(getattr(tight, name)[at] - state[name])
            assert (error <= share * peaks[name]).all(), (state["t"], name)


def test_the_energy_balance(tight: kp.Solution) -> None:
    assert np.abs(tight.energy.balance).max() < 1e-9


def test_it_settles_between_2_and_2_5_seconds(tight: kp.Solution) -> None:
    torque = tight["spring"].torque(on="rocker")
    deviation = np.abs(torque - torque[-1])
    outside = np.flatnonzero(deviation > 0.005 * deviation.max())
    assert 2.0 < tight.t[outside[-1] + 1] < 2.5


@pytest.mark.filterwarnings("ignore::kempe.AccuracyWarning")
@pytest.mark.parametrize(
    ("alpha", "beta", "steps", "peak"),
    [(10, 200, (1250, 1400), (1.4e-3, 1.6e-3)), (1, 20, (200, 270), (7e-3, 9e-3))],
)
def test_stabilization_at_the_classical_tolerances(
    case: kp.Case,
    start: kp.State,
    alpha: float,
    beta: float,
    steps: tuple[int, int],
    peak: tuple[float, float],
) -> None:
    sol = kp.dynamics(
        case.model,
        start,
        t_end=15,
        method=kp.RK45(rtol=1e-3, atol=1e-6),
        stabilization=kp.Baumgarte(alpha=alpha, beta=beta),
    )
    assert steps[0] <= sol.statistics["steps"] <= steps[1]
    assert len(sol.t) == sol.statistics["steps"] + 1
    drift = sol.drift.position
    assert peak[0] <= drift.max() <= peak[1]
    if beta == 200:
        assert sol.t[drift.argmax()] == pytest.approx(0.22, abs=0.02)


@pytest.mark.parametrize(("method", "steps"), [(kp.RK45, 2400), (kp.DOP853, 550)])
def test_projection_against_the_listed_states(
    case: kp.Case,
    start: kp.State,
    reference: dict[str, Any],
    method: type[kp.RK45] | type[kp.DOP853],
    steps: int,
) -> None:
    sol = kp.dynamics(
        case.model,
        start,
        t_end=15,
        output_step=0.01,
        method=method(rtol=1e-9, atol=1e-12),
        stabilization=kp.Projection(),
    )
    assert sol.statistics["steps"] < steps
    assert sol.drift.position.max() < 1e-10
    assert np.abs(sol.energy.balance).max() < 1e-8
    for state in reference["states"]:
        at = int(np.argmin(np.abs(sol.t - state["t"])))
        np.testing.assert_allclose(sol.q[at], state["q"], rtol=0, atol=1e-8)
        lam = np.abs(sol.lam[at] - state["lam"])
        assert lam.max() < 1e-7 * np.abs(sol.lam).max()


def test_without_stabilization_the_joints_open_by_metres(case: kp.Case, start: kp.State) -> None:
    method = kp.RK45(rtol=1e-3, atol=1e-6)
    with pytest.warns(kp.AccuracyWarning, match="joints are open"):
        sol = kp.dynamics(case.model, start, t_end=15, method=method, stabilization=None)
    assert 1.0 < sol.drift.position[-1] < 20.0


def test_the_defaults(case: kp.Case, start: kp.State, reference: dict[str, Any]) -> None:
    sol = kp.dynamics(case.model, start, t_end=15, output_step=0.01)
    assert sol.statistics["method"] == "dop853"
    assert sol.drift.position.max() < 1e-10
    for state in [reference["start"], *reference["states"]]:
        at = int(np.argmin(np.abs(sol.t - state["t"])))
        truth = np.array(state["q"])[ANGLES]
        np.testing.assert_allclose(sol.q[at, ANGLES], truth, rtol=0, atol=1e-6)
