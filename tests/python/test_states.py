"""First-order states z reach every result of a run.

The description of the flagship is changed here: its spring gets two states. The core computes
nothing.
"""

import copy
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import _core
from kempe.model.compiled import CompiledModel
from kempe.results import archive
from kempe.results.dense import DenseOutput
from kempe.results.motion import Motion
from kempe.results.table import columns

T = np.array([0.0, 0.5, 1.0])
#: Current and pressure at these times.
Z = np.array([[1.0, 10.0], [2.0, 20.0], [4.0, 40.0]])


def with_states(model: CompiledModel) -> CompiledModel:
    """The same description, but the spring has two states."""
    other = CompiledModel(model.core, model.case)
    other._about = copy.deepcopy(other._about)
    other._about["n_z"] = 2
    states = [{"name": "current", "unit": "A"}, {"name": "pressure", "unit": "Pa"}]
    other._about["forces"][0] |= {"states": states, "places": [0, 2]}
    return other


def run(start: kp.State) -> SimpleNamespace:
    """The attributes of a run with two steps; the interpolant of z is linear."""
    n, m = start.compiled.n_q, start.compiled.n_rows
    rows, rest = np.tile(start.q, (3, 1)), np.zeros((3, n))
    y = np.hstack([rows, rest, Z, np.zeros((3, 3))])
    c = np.diff(y, axis=0)[:, :, None] / 0.5
    return SimpleNamespace(
        t=T,
        q=rows,
        v=rest,
        z=Z,
        dense_t=T,
        dense_y=y[:-1],
        dense_c=c,
        status="reached",
        message="t_end was reached",
        statistics='{"steps": 2}',
        projection=None,
        settings=[(0, ([], []))],
        events=[],
        responses=lambda: (np.zeros((3, n)), np.zeros((3, m))),
        energies=lambda: np.zeros((3, 5)),
    )


@pytest.fixture
def sol(start: kp.State, monkeypatch: pytest.MonkeyPatch) -> kp.Solution:
    """A solution with two states."""
    monkeypatch.setattr(Motion, "action", lambda self, *_: np.zeros((*self.t.shape, 3)))
    known = Motion._rows  # in the core the spring has no states
    monkeypatch.setattr(
        Motion, "_rows", lambda self: (*known(self)[:3], np.zeros((*self.t.shape, 0)))
    )
    return kp.Solution(with_states(start.compiled), run(start))  # type: ignore[arg-type]


def test_states_have_names_and_units(sol: kp.Solution) -> None:
    assert sol.compiled.n_z == 2
    assert sol.compiled.state_names() == ["spring.current", "spring.pressure"]
    assert sol.compiled.state_units() == ["A", "Pa"]


def test_a_force_has_its_states_as_attributes(sol: kp.Solution) -> None:
    spring = sol.force("spring")
    assert np.array_equal(spring.current, Z[:, 0])
    assert np.array_equal(spring.state("pressure"), Z[:, 1])
    assert not spring.current.flags.writeable
    assert {"current", "pressure"} <= set(dir(spring))
    with pytest.raises(AttributeError, match="its states: current, pressure"):
        _ = spring.voltage
    with pytest.raises(kp.ModelError, match="current"):
        spring.state("curent")


def test_a_force_that_depends_on_a_reaction_is_given_the_multipliers(
    start: kp.State, monkeypatch: pytest.MonkeyPatch
) -> None:
    given, known = [], _core.States

    def states(*arguments: Any) -> object:
        of = known(*arguments)

        def force(*more: Any) -> object:
            given.append(arguments[4:])
            return of.force(*more)

        return SimpleNamespace(force=force, friction_modes=of.friction_modes, evaluate=of.evaluate)

    monkeypatch.setattr("kempe.results.motion._core.States", states)
    seeing = CompiledModel(start.compiled.core, start.compiled.case)
    seeing._about["forces"][0]["reads_multipliers"] = True
    for model in (start.compiled, seeing):
        kp.State(model, 0.0, start.q, start.v).force("spring").torque(on="rocker")
    (_, _, without), (z, _, lam) = given
    assert without is None
    assert z.shape == (1, 0)
    assert np.array_equal(lam, start.lam[None])


def test_states_are_part_of_the_first_and_the_last_state(sol: kp.Solution) -> None:
    assert np.array_equal(sol.initial.z, Z[0])
    assert np.array_equal(sol.final.z, Z[-1])
    assert sol.final.force("spring").current == 4.0
    named = sol.final.coordinates()
    assert (named["spring.current"], named["spring.pressure"]) == (4.0, 40.0)
    assert "spring.pressure = 40 Pa" in str(sol.final)


def test_states_between_the_steps(sol: kp.Solution) -> None:
    one, many = sol(0.75), sol(np.array([0.25, 0.75]))
    assert one.z == pytest.approx([3.0, 30.0])
    assert many.z == pytest.approx(np.array([[1.5, 15.0], [3.0, 30.0]]))
    assert many["spring"].current == pytest.approx([1.5, 3.0])


def test_the_parts_of_an_interpolant() -> None:
    dense = DenseOutput.of_an_instant(1.0, np.arange(9.0))
    q, v, z = dense.parts(np.array(1.0), 2, 2)
    assert [q.tolist(), v.tolist(), z.tolist()] == [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]]


def test_a_solution_of_one_instant_keeps_its_states(start: kp.State) -> None:
    whole = run(start)
    whole.t, whole.q, whole.v, whole.z = T[:1], whole.q[:1], whole.v[:1], Z[:1]
    whole.dense_t, whole.dense_y, whole.dense_c = T[:1], whole.dense_y[:0], whole.dense_c[:0]
    instant = kp.Solution(with_states(start.compiled), whole)  # type: ignore[arg-type]
    assert np.array_equal(instant(0.0).z, Z[0])


def test_the_table_has_the_states_with_their_units(sol: kp.Solution, tmp_path: Path) -> None:
    units = {column.name: column.unit for column in columns(sol)}
    assert (units["spring.current"], units["spring.pressure"]) == ("A", "Pa")
    assert sol.to_dataframe().attrs["units"]["spring.current"] == "A"
    sol.to_csv(tmp_path / "all.csv")
    table = np.genfromtxt(tmp_path / "all.csv", delimiter=",", names=True, deletechars="")
    assert np.array_equal(table["spring.pressure_[Pa]"], Z[:, 1])


def test_a_scene_has_the_states_as_channels(sol: kp.Solution) -> None:
    from kempe.draw import channels

    found = {channel["name"]: channel for channel in channels.channels(sol)}
    assert found["spring.current"]["unit"] == "A"
    assert found["spring.pressure"]["values"] == [10.0, 20.0, 40.0]


def test_a_saved_solution_keeps_its_states(
    sol: kp.Solution, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sol.save(tmp_path / "states.npz")
    read = CompiledModel.from_case
    monkeypatch.setattr(CompiledModel, "from_case", lambda case: with_states(read(case)))
    again = kp.load_solution(tmp_path / "states.npz")
    assert np.array_equal(again.z, Z)
    assert again(0.75).z == pytest.approx([3.0, 30.0])


def test_a_file_without_states_is_still_read(solution: kp.Solution, tmp_path: Path) -> None:
    path = tmp_path / "old.npz"
    solution.save(path)
    with np.load(path) as stored:
        arrays = {name: stored[name] for name in stored.files if name != "z"}
    np.savez(path, **arrays)
    again = archive.load_solution(path)
    assert again.z.shape == (len(again.t), 0)
    assert np.array_equal(again.q, solution.q)


def test_a_file_with_too_few_states_is_refused(solution: kp.Solution, tmp_path: Path) -> None:
    path = tmp_path / "wrong.npz"
    solution.save(path)
    with np.load(path) as stored:
        arrays = dict(stored)
    np.savez(path, **{**arrays, "z": np.zeros((2, 1))})
    with pytest.raises(kp.FileError, match="z is"):
        archive.load_solution(path)


def test_states_given_in_another_number_are_refused(model: kp.Model, start: kp.State) -> None:
    wrong = kp.State(start.compiled, 0.0, start.q, start.v, z=np.ones(1))
    with pytest.raises(kp.ModelError, match="z: 1 numbers; must be 0"):
        kp.dynamics(model, wrong, t_end=0.1)


def test_rounding_errors_are_zero_in_matrices_but_not_in_the_residual() -> None:
    m = kp.Model("two")
    m.ground.points(A=(0, 0), B=(0, 0))
    for k, inertia in (("A", 1.0), ("B", 1e-14)):
        m.body(k, mass=1, inertia=inertia, points={k: (0, 0)})
        m.revolute(f"pin{k}", f"ground.{k}", f"{k}.{k}")
    start = kp.assemble(m)
    q = start.q.copy()
    q[[0, 3]] = 1.0, 1e-15
    state = kp.State(start.compiled, 0.0, q, start.v)
    assert kp.show(m, state, "Phi").cells().ravel().tolist() == [1.0, 0.0, 1e-15, 0.0]
    assert np.diag(kp.show(m, state, "M").cells()).tolist() == [1.0, 1.0, 1.0, 1.0, 1.0, 0.0]
