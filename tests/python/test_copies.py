"""Copies and pickles of models, states, solutions and cases."""

import copy
import pickle
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.results.runs import StoredRun

COPIES: dict[str, Callable[[Any], Any]] = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": lambda x: pickle.loads(pickle.dumps(x)),
}
copied = pytest.mark.parametrize("of", COPIES.values(), ids=list(COPIES))


@pytest.fixture(scope="module")
def pendulum() -> kp.Model:
    m = kp.Model("pendulum", gravity=(0, -9.81), parameters={"L": 2.0})
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=3, length="L", ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    return m


@copied
def test_a_copied_model_is_independent(pendulum: kp.Model, of: Callable[[Any], Any]) -> None:
    other = of(pendulum)
    assert other.tree() == pendulum.tree()
    assert other.bodies["rod"] == pendulum.bodies["rod"]
    other.bar("more", mass=1, length=1)
    other.ground.points(Z=(1, 1))
    assert list(pendulum.bodies) == ["rod"]
    assert "Z" not in pendulum.all_bodies["ground"].points


@copied
def test_parameters_set_later_are_copied(pendulum: kp.Model, of: Callable[[Any], Any]) -> None:
    assert of(pendulum.with_parameters({"L": 5.0})).bodies["rod"].points["B"] == (2.5, 0.0)


@copied
def test_a_copied_state_is_the_same(start: kp.State, of: Callable[[Any], Any]) -> None:
    other = of(start)
    assert (other.t, str(other)) == (start.t, str(start))
    assert np.array_equal(other.q, start.q)
    assert np.array_equal(other.a, start.a)
    assert not other.q.flags.writeable
    assert isinstance(other.t, float)


@copied
def test_a_copied_solution_is_the_same(solution: kp.Solution, of: Callable[[Any], Any]) -> None:
    other = of(solution)
    for name in ("t", "q", "v", "z", "a", "lam"):
        assert np.array_equal(getattr(other, name), getattr(solution, name))
        assert not getattr(other, name).flags.writeable
    assert np.array_equal(other.energy.total, solution.energy.total)
    assert np.array_equal(other(0.123).a, solution(0.123).a)
    assert (other.status, other.message) == (solution.status, solution.message)
    assert other.statistics == solution.statistics
    assert other.model.tree() == solution.model.tree()


@copied
def test_a_copied_case_runs_alike_and_has_its_own_model(
    pendulum: kp.Model, of: Callable[[Any], Any]
) -> None:
    case = kp.Case(pendulum, {"set": {"rod.angle": "-30*deg"}}, [kp.Dynamics(0.5)])
    other = of(case)
    assert other.tree() == case.tree()
    assert np.array_equal(other.run()[0].q, case.run()[0].q)
    other.model.bar("more", mass=1, length=1)
    assert "more" not in case.model.bodies


@copied
def test_redundancy_that_was_allowed_stays_allowed(of: Callable[[Any], Any]) -> None:
    m = kp.Model(gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    m.revolute("A2", "ground.A", "rod.A")
    start = of(kp.assemble(m, redundancy="allow"))
    assert kp.dynamics(start.model, start, t_end=0.1).success


def test_the_tree_of_a_model_keeps_that_redundancy_is_allowed() -> None:
    m = kp.Model("drawer", parameters={"m": 1}, redundancy="allow")
    m.ground.points(A=(0, 0), B=(1, 0))
    m.body("drawer", mass="m", inertia=1, points={"A": (0, 0), "B": (1, 0)})
    m.translational("left", "ground.A", "drawer.A")
    m.translational("right", "ground.B", "drawer.B")
    for other in (kp.Model.from_tree(m.tree()), m.with_parameters({"m": 2})):
        other.ground.points(C=(2, 0))
        assert other.redundancy == "allow" and other.tree()["redundancy"] == "allow"
        assert kp.assemble(other)["left"].unique is False


def test_a_pair_of_model_and_solution_stays_together(pendulum: kp.Model) -> None:
    sol = kp.dynamics(pendulum, kp.assemble(pendulum), t_end=0.1)
    of_case = kp.Case(pendulum, analyses=[kp.Dynamics(0.1)]).run()[0]
    model, *others = pickle.loads(pickle.dumps((pendulum, sol, of_case)))
    for other in others:
        assert other.model is model
    for own in (sol, of_case):
        assert copy.copy(own).model is pendulum


def test_an_error_of_a_run_is_pickled_with_its_solution(pendulum: kp.Model) -> None:
    with pytest.raises(kp.IntegrationError) as caught:
        kp.dynamics(pendulum, kp.assemble(pendulum), t_end=10, max_steps=5)
    other = pickle.loads(pickle.dumps(caught.value))
    assert str(other) == str(caught.value)
    assert np.array_equal(other.solution.q, caught.value.solution.q)


def test_a_solution_whose_accelerations_fail_is_copied_with_the_error(
    solution: kp.Solution, monkeypatch: pytest.MonkeyPatch
) -> None:
    own, responses = copy.copy(solution), StoredRun.responses

    def fails(run: StoredRun, rows: int | None = None) -> tuple[np.ndarray, np.ndarray]:
        if rows is None or rows > 50:
            raise kp.SingularityError("not unique", t=float(own.t[50]))
        return responses(run, rows)

    monkeypatch.setattr(StoredRun, "responses", fails)
    other = pickle.loads(pickle.dumps(own))
    monkeypatch.undo()
    with pytest.raises(kp.SingularityError, match="not unique") as caught:
        _ = other.a
    assert np.array_equal(other.q, solution.q)
    assert np.array_equal(caught.value.solution.a, solution.a[:50])


def end(model: kp.Model, angle: float) -> kp.Solution:
    start = kp.assemble(model, set={"rod.angle": angle})
    return kp.dynamics(model, start, t_end=0.1)


def test_models_go_to_processes_and_solutions_come_back(pendulum: kp.Model) -> None:
    angles = [-1.0, 0.5]
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        found = list(pool.map(end, [pendulum] * 2, angles))
    for sol, angle in zip(found, angles, strict=True):
        assert np.array_equal(sol.q, end(pendulum, angle).q)


def test_results_refer_to_the_model_of_the_user(pendulum: kp.Model) -> None:
    start = kp.assemble(pendulum)
    sol = kp.dynamics(pendulum, start, t_end=0.1)
    case = kp.Case(pendulum, analyses=[kp.Dynamics(0.1)])
    for found in (start, sol, sol.final, sol(0.05), sol(sol.t), case.start(), case.run()[0]):
        assert found.model is pendulum


def test_a_solution_keeps_the_numbers_of_its_time(pendulum: kp.Model) -> None:
    own = copy.copy(pendulum)
    sol = kp.dynamics(own, kp.assemble(own), t_end=0.1)
    before = sol["A"].force(on="rod")
    own.bar("later", mass=1, length=1)
    assert np.allclose(sol(sol.t).q, sol.q, atol=1e-9)
    assert np.array_equal(sol["A"].force(on="rod"), before)
    assert "later" not in str(sol.final)


def test_a_state_is_made_from_the_model_of_the_user(pendulum: kp.Model) -> None:
    made = kp.State(pendulum, 0.5, [1.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    assert (made["rod.x"], made.t) == (1.0, 0.5)
    assert made.model is pendulum
    with pytest.raises(kp.ModelError, match=r"q has shape \(2,\); must be \(3,\)"):
        kp.State(pendulum, 0.0, [1.0, 0.0], np.zeros(3))
    with pytest.raises(kp.ModelError, match="v contains a number that is not finite"):
        kp.State(pendulum, 0.0, np.zeros(3), [0.0, float("nan"), 0.0])
    with pytest.raises(kp.ModelError, match="q must be numbers"):
        kp.State(pendulum, 0.0, ["a", "b", "c"], np.zeros(3))
    with pytest.raises(kp.ModelError, match="is not a model"):
        kp.State("pendulum", 0.0, np.zeros(3), np.zeros(3))


def test_a_parameter_that_the_model_lacks_is_refused_at_once(pendulum: kp.Model) -> None:
    with pytest.raises(kp.ModelError, match=r"unknown parameter 'l'; did you mean 'L'\?"):
        pendulum.with_parameters({"l": 3})
