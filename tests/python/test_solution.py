"""Solutions: values at and between the outputs, and files."""

import csv
import os
import sys
from pathlib import Path

import kempe as kp
import numpy as np
import pytest


def derivative(values: np.ndarray, t: np.ndarray) -> np.ndarray:
    return np.gradient(values, t, axis=0, edge_order=2)


def test_arrays_are_time_first_and_read_only(solution: kp.Solution) -> None:
    n = len(solution.t)
    assert n == 101
    for array, shape in (
        (solution.q, (n, 9)),
        (solution.v, (n, 9)),
        (solution.a, (n, 9)),
        (solution.lam, (n, 8)),
        (solution["rocker"].r, (n, 2)),
        (solution["C"].residual, (n, 2)),
        (solution.drift.position, (n,)),
    ):
        assert array.shape == shape
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0


def test_the_columns_of_a_body(solution: kp.Solution) -> None:
    coupler = solution["coupler"]
    np.testing.assert_array_equal(coupler.angle, solution.q[:, 5])
    np.testing.assert_array_equal(coupler.velocity, solution.v[:, 3:5])
    np.testing.assert_array_equal(coupler.omega, solution.v[:, 5])
    np.testing.assert_array_equal(coupler.acceleration, solution.a[:, 3:5])
    np.testing.assert_array_equal(coupler.alpha, solution.a[:, 5])


def test_the_motion_of_a_point_agrees_with_its_derivatives(solution: kp.Solution) -> None:
    t = np.linspace(0.2, 0.4, 2001)
    dense = solution(t)
    point = dense["coupler"].point("C")
    scale = np.abs(point.acceleration).max()
    np.testing.assert_allclose(derivative(point.position, t), point.velocity, atol=1e-2)
    np.testing.assert_allclose(
        derivative(point.velocity, t)[2:-2], point.acceleration[2:-2], atol=1e-2 * scale
    )


def test_both_bodies_of_a_joint_share_its_point(solution: kp.Solution) -> None:
    gap = solution["rocker"].point("C").position - solution["coupler"].point("C").position
    np.testing.assert_allclose(gap, solution["C"].residual, atol=1e-12)


def test_ground_does_not_move(solution: kp.Solution) -> None:
    d = solution["ground"].point("D")
    np.testing.assert_array_equal(d.position, np.tile([20.0, 0.0], (101, 1)))
    assert not d.velocity.any()
    assert not d.acceleration.any()


def test_reactions_are_opposite_in_the_global_frame(solution: kp.Solution) -> None:
    on_coupler = solution["C"].force(on="coupler")
    np.testing.assert_allclose(on_coupler, -solution["C"].force(on="rocker"))
    np.testing.assert_allclose(on_coupler, solution["C"].lam)


def test_frames_rotate_a_reaction_and_keep_its_length(solution: kp.Solution) -> None:
    whole, body = (solution["C"].force(on="rocker", frame=frame) for frame in ("global", "body"))
    angle = solution["rocker"].angle
    x = np.cos(angle) * whole[:, 0] + np.sin(angle) * whole[:, 1]
    np.testing.assert_allclose(body[:, 0], x, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(body, solution["C"].force(on="rocker", frame="joint"))
    np.testing.assert_allclose(np.hypot(*body.T), np.hypot(*whole.T))


def test_newton_holds_for_the_coupler(solution: kp.Solution) -> None:
    forces = solution["B"].force(on="coupler") + solution["C"].force(on="coupler")
    expected = 5 * (solution["coupler"].acceleration - [0.0, -9.81])
    np.testing.assert_allclose(forces, expected, atol=1e-6)


def test_the_spring_is_the_sum_of_its_parts(solution: kp.Solution) -> None:
    spring, rocker = solution["spring"], solution["rocker"]
    stiffness = -1e6 * (rocker.angle - 1.5 * np.pi)
    np.testing.assert_allclose(spring.stiffness_torque(on="rocker"), stiffness, rtol=1e-9)
    np.testing.assert_allclose(spring.damping_torque(on="rocker"), -1e4 * rocker.omega, atol=1e-6)
    np.testing.assert_allclose(spring.torque(on="ground"), -spring.torque(on="rocker"))
    assert not spring.force(on="rocker").any()
    assert not spring.damping_force(on="rocker").any()
    assert "damping_torque" in dir(spring)


def test_energy_is_conserved(solution: kp.Solution) -> None:
    energy = solution.energy
    assert np.abs(energy.balance).max() < 1e-4
    assert energy.dissipated[-1] > 0.0
    assert not energy.work.any()
    np.testing.assert_allclose(
        energy.total, energy.kinetic + energy.potential + energy.dissipated, rtol=1e-12
    )


def test_energies_at_any_time(solution: kp.Solution) -> None:
    times = np.array([solution.t[0], 0.5 * (solution.t[3] + solution.t[4]), solution.t[-1]])
    found = solution.energy_at(times)
    for name in ("kinetic", "potential", "dissipated", "work"):
        at_outputs = getattr(solution.energy, name)
        scale = 1e-6 * np.abs(solution.energy.total[0])
        np.testing.assert_allclose(getattr(found, name)[[0, 2]], at_outputs[[0, -1]], atol=scale)
    at = solution(float(times[1]))
    by_hand = sum(
        0.5 * info.mass * (at.body(name).at(info.center).velocity ** 2).sum()
        + 0.5 * info.inertia * at.body(name).omega ** 2
        for name, info in at.model.bodies.items()
    )
    assert found.kinetic[1] == pytest.approx(float(by_hand), rel=1e-12)
    np.testing.assert_allclose(found.total, solution.energy.total[0], rtol=1e-5)
    with pytest.raises(kp.ModelError):
        solution.energy_at(np.array([1e3]))


def test_drift_is_the_largest_residual(solution: kp.Solution) -> None:
    opening = np.max([np.abs(solution[j].residual).max(axis=1) for j in "ABCD"], axis=0)
    np.testing.assert_array_equal(solution.drift.position, opening)
    assert solution.drift.position[0] < 1e-9
    assert 0.0 < solution.drift.position.max() < 1e-2


def test_names_as_in_scipy(solution: kp.Solution) -> None:
    assert (solution.status, solution.success) == (0, True)
    assert solution.nfev > solution.statistics["steps"] > 0
    assert solution.message


def test_between_the_outputs(solution: kp.Solution) -> None:
    one = solution(0.25)
    assert isinstance(one, kp.State)
    np.testing.assert_allclose(one.q, solution.q[25], atol=1e-6)
    np.testing.assert_allclose(one.a, solution.a[25], rtol=1e-3, atol=1e-2)
    assert isinstance(one["rocker"].angle, float)
    assert one["C"].force(on="rocker").shape == (2,)
    many = solution(solution.t)
    np.testing.assert_allclose(many.q, solution.q, atol=1e-6)
    assert many["C"].force(on="rocker").shape == (101, 2)


def test_a_run_must_not_end_before_it_begins(model: kp.Model, start: kp.State) -> None:
    with pytest.raises(kp.ModelError, match=r"t_end: -0.1 s lies before 0 s") as caught:
        kp.dynamics(model, start, t_end=-0.1)
    assert "t_end is a time, not a duration; it must be at least 0 s" in str(caught.value)
    first = kp.dynamics(model, start, t_end=0.1)
    with pytest.raises(kp.ModelError, match=r"0.05 s lies before 0.1 s") as caught:
        kp.dynamics(model, first.final, t_end=0.05)  # a duration instead of a time
    assert "at least 0.1 s" in str(caught.value)
    assert kp.dynamics(model, first.final, t_end=0.1).success  # the remedy


def test_a_simulation_without_a_step_is_its_start(model: kp.Model, start: kp.State) -> None:
    sol = kp.dynamics(model, start, t_end=0)
    np.testing.assert_array_equal(sol.q, start.q[None])
    np.testing.assert_array_equal(sol(0.0).q, start.q)
    with pytest.raises(kp.ModelError, match="outside"):
        sol(0.1)


@pytest.mark.parametrize("t", [-0.1, 1.1, float("nan"), [0.5, 2.0]])
def test_times_outside_the_solution_are_refused(solution: kp.Solution, t: object) -> None:
    with pytest.raises(kp.ModelError, match="outside the solution"):
        solution(t)  # type: ignore[arg-type]


def test_without_dense_output_the_error_has_a_remedy(model: kp.Model, start: kp.State) -> None:
    sol = kp.dynamics(model, start, t_end=0.01, dense_output=False)
    with pytest.raises(kp.ModelError, match="dense_output=True"):
        sol(0.005)


def test_unknown_names_are_key_errors_with_a_suggestion(solution: kp.Solution) -> None:
    for error in (kp.ModelError, KeyError):
        with pytest.raises(error, match="did you mean 'coupler'"):
            solution["cuopler"]
    with pytest.raises(kp.ModelError, match="point of rocker"):
        solution["rocker"].point("X")
    assert "coupler" in solution
    assert "cuopler" not in solution


def test_wrong_arguments_are_refused(solution: kp.Solution) -> None:
    with pytest.raises(kp.ModelError, match="coupler, rocker"):
        solution["C"].force(on="crank")
    with pytest.raises(kp.ModelError, match="did you mean 'global'"):
        solution["C"].force(on="rocker", frame="lokal")
    with pytest.raises(kp.ModelError, match="stiffness, damping"):
        solution["spring"].torque(on="rocker", part="friction")
    with pytest.raises(AttributeError, match="stiffness, damping"):
        _ = solution["spring"].friction_torque
    with pytest.raises(TypeError):
        solution["C"].force("rocker")


def test_a_state_is_printed_in_full(start: kp.State) -> None:
    text = str(start)
    assert "crank" in text
    assert "iteration" in text
    assert start.coordinates()["crank.angle"] == pytest.approx(np.deg2rad(70))
    assert start.report is not None
    assert start.report.iterations[-1].residual < 1e-9
    assert start.z.shape == (0,)


def test_the_jacobian_at_the_start_has_names(start: kp.State) -> None:
    found = start.matrices({"crank.angle": "70*deg"})
    assert found.rows[:2] == ("A.x", "A.y")
    assert found.columns[-1] == "rocker.angle"
    assert found.Phi_q.shape == (9, 9)
    assert found.Phi_q[2, 0] == -1.0  # B: Φ = point of the coupler - point of the crank
    assert start.matrices().degrees_of_freedom == 1


def test_a_state_serves_as_guess(model: kp.Model, start: kp.State) -> None:
    again = kp.assemble(model, set={"crank.angle": "71*deg"}, from_state=start)
    assert again["crank"].angle == pytest.approx(np.deg2rad(71))
    assert again["rocker"].angle == pytest.approx(start["rocker"].angle, abs=0.1)


def test_a_state_of_another_mechanism_is_refused(start: kp.State) -> None:
    other = kp.Model()
    other.bar("rod", mass=1, length=1, ends=("A", "B"))
    with pytest.raises(kp.ModelError, match="the state has the bodies"):
        kp.dynamics(other, start, t_end=1)


def test_a_failure_has_the_solution_until_then(model: kp.Model, start: kp.State) -> None:
    with pytest.raises(kp.IntegrationError) as caught:
        kp.dynamics(model, start, t_end=1, max_steps=5)
    partial = caught.value.solution
    assert isinstance(partial, kp.Solution)
    assert not partial.success
    assert partial.status == -1
    assert 0.0 < partial.t[-1] < 1.0


def test_progress_is_called(model: kp.Model, start: kp.State) -> None:
    seen: list[float] = []
    slow = {"method": kp.RK4(step=1e-3), "output_step": 1, "dense_output": False}
    kp.dynamics(model, start, t_end=200, **slow, progress=seen.append)
    assert seen
    assert seen == sorted(seen)
    assert 0.0 < seen[0] <= seen[-1] <= 200.0


def test_an_exception_in_progress_ends_the_simulation_and_has_the_solution(
    model: kp.Model, start: kp.State
) -> None:
    def enough(_: float) -> None:
        raise TimeoutError("enough")

    slow = {"method": kp.RK4(step=1e-3), "output_step": 1, "dense_output": False}
    with pytest.raises(TimeoutError, match="enough") as caught:
        kp.dynamics(model, start, t_end=200, **slow, progress=enough)
    assert 0.0 <= caught.value.solution.t[-1] < 200.0


def twice_pinned(redundancy: str | None = None) -> kp.Model:
    m = kp.Model("pendulum", gravity=(0, -9.81), redundancy=redundancy)
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    m.revolute("A2", "ground.A", "rod.A")
    return m


def test_a_joint_that_repeats_another_is_refused_unless_allowed(tmp_path: Path) -> None:
    m = twice_pinned()
    with pytest.raises(kp.RedundancyError, match="A2"):
        kp.assemble(m)
    start = kp.assemble(m, redundancy="allow")
    sol = kp.dynamics(m, start, t_end=0.1, redundancy="allow")
    assert sol.success
    pins = sol["A"].force(on="rod") + sol["A2"].force(on="rod")
    np.testing.assert_allclose(
        pins, 2 * (sol["rod"].acceleration - [0.0, -9.81]), rtol=1e-6, atol=1e-6
    )
    np.testing.assert_allclose(sol(sol.t).lam, sol.lam, rtol=1e-4, atol=1e-4)
    sol.save(tmp_path / "s.npz")
    np.testing.assert_array_equal(kp.load_solution(tmp_path / "s.npz")(0.05).a, sol(0.05).a)
    case = kp.Case(twice_pinned("allow"), analyses=[kp.Dynamics(0.1)])
    np.testing.assert_array_equal(case.run()[0].q, sol.q)
    with pytest.raises(kp.ModelError, match="did you mean 'allow'"):
        kp.assemble(m, redundancy="alow")


# --- files ----------------------------------------------------------------------------------------


def test_a_saved_solution_is_the_same(solution: kp.Solution, tmp_path: Path) -> None:
    solution.save(tmp_path / "s.npz")
    again = kp.load_solution(tmp_path / "s.npz")
    for name in ("t", "q", "v", "a", "lam"):
        np.testing.assert_array_equal(getattr(again, name), getattr(solution, name))
    np.testing.assert_array_equal(again.energy.total, solution.energy.total)
    np.testing.assert_array_equal(again(0.123).q, solution(0.123).q)
    np.testing.assert_array_equal(
        again["C"].force(on="rocker", frame="joint"),
        solution["C"].force(on="rocker", frame="joint"),
    )
    assert (again.message, dict(again.statistics)) == (
        solution.message,
        dict(solution.statistics),
    )


def spoiled(folder: Path, solution: kp.Solution, kind: str) -> Path:
    path = folder / "spoiled.npz"
    solution.save(path)
    data = path.read_bytes()
    match kind:
        case "torn":
            path.write_bytes(data[: len(data) // 2])
        case "bytes":
            path.write_bytes(b"\x00" * 100)
        case "empty":
            path.write_bytes(b"")
        case "other arrays":
            np.savez(path, x=np.zeros(3))
        case "pickled":
            np.savez(path, about=np.array([{}], dtype=object))
        case "one array":
            with path.open("wb") as file:
                np.save(file, np.zeros(3))
        case "wrong shape":
            with np.load(path) as stored:
                arrays = dict(stored) | {"q": np.zeros((3, 3))}
            np.savez(path, **arrays)
        case "missing":
            path.unlink()
    return path


@pytest.mark.parametrize(
    "kind",
    ["torn", "bytes", "empty", "other arrays", "pickled", "one array", "wrong shape", "missing"],
)
def test_an_invalid_solution_file_is_refused_with_its_name(
    solution: kp.Solution, tmp_path: Path, kind: str
) -> None:
    path = spoiled(tmp_path, solution, kind)
    with pytest.raises(kp.FileError, match="spoiled"):
        kp.load_solution(path)


def test_a_failed_save_leaves_the_old_file(
    solution: kp.Solution, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "s.npz"
    target.write_text("old", encoding="utf-8")

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(kp.FileError, match="No space left"):
        solution.save(target)
    assert [path.name for path in tmp_path.iterdir()] == ["s.npz"]
    assert target.read_text(encoding="utf-8") == "old"


def test_the_table_has_units_and_every_digit(solution: kp.Solution, tmp_path: Path) -> None:
    solution.to_csv(tmp_path / "s.csv")
    with (tmp_path / "s.csv").open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert header[0] == "t [s]"
    column = header.index("rocker.angle [rad]")
    assert {"C.lambda_x [N]", "spring.torque_on_rocker [N*m]", "energy.kinetic [J]"} <= set(header)
    np.testing.assert_array_equal([float(row[column]) for row in rows], solution["rocker"].angle)


def test_the_data_frame_has_units(solution: kp.Solution) -> None:
    frame = solution.to_dataframe()
    np.testing.assert_array_equal(frame["rocker.alpha"], solution["rocker"].alpha)
    assert frame.attrs["units"]["rocker.alpha"] == "rad/s^2"


def test_without_pandas_the_error_has_a_remedy(
    solution: kp.Solution, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(kp.ModelError, match="pip install pandas"):
        solution.to_dataframe()
