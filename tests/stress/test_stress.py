"""Random runs: no success is wrong, no run is endless, and nothing panics.

`PYTHONPATH=tests python -m stress.run` runs a hundred thousand.
"""

from collections import Counter

import kempe as kp
import numpy as np
import pytest
from sizes import count
from stress.mechanisms import KINDS
from stress.trial import CLOSED, Outcome, gap, judge, judge_error, run

RUNS = count(400, 3000)
#: Runs that had faults, which have been corrected.
FOUND = {
    435: "success with numbers that are not finite",
    134: "consistent rates were refused",
    532: "consistent rates were refused",
    191: "a partial solution with numbers that are not finite",
    14472: "success with an open joint, its coordinates without digits left",
    33493: "success with an open joint, its angle without digits left",
    45349: "success with an open joint",
    96513: "success with an open joint",
}


@pytest.fixture(scope="module")
def outcomes() -> list[Outcome]:
    return [run(4, number) for number in range(RUNS)]


def test_no_run_has_a_fault(outcomes: list[Outcome]) -> None:
    faulty = [(o.number, o.faults, o.options) for o in outcomes if o.faults]
    assert not faulty


def test_the_runs_are_of_all_kinds(outcomes: list[Outcome]) -> None:
    ended = Counter((o.kind, o.ended) for o in outcomes)
    for kind in KINDS:
        assert ended[kind, "success"] > RUNS // 20
        assert ended[kind, "IntegrationError"] > RUNS // 100
    projected = [o for o in outcomes if o.projected and o.ended == "success"]
    assert len(projected) > RUNS // 5


@pytest.mark.parametrize("number", FOUND)
def test_earlier_faults_do_not_return(number: int) -> None:
    found = run(4, number)
    assert not found.faults
    assert found.ended != "AssemblyError", FOUND[number]


def test_a_run_can_be_repeated() -> None:
    first, second = run(4, 17), run(4, 17)
    assert (first.options, first.message, first.gap) == (
        second.options,
        second.message,
        second.gap,
    )


def solution(stabilization: kp.Projection | None, step: float) -> kp.Solution:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    start = kp.assemble(m, set={"rod.angle": 0.0})
    return kp.dynamics(m, start, t_end=1, method=kp.RK4(step=step), stabilization=stabilization)


@pytest.mark.filterwarnings("ignore::kempe.AccuracyWarning")
def test_an_open_joint_is_detected() -> None:
    sol = solution(None, 0.25)
    assert gap(sol) > CLOSED
    told = Outcome(0, "pendulum", "stabilization=Projection(…)")
    judge(told, sol)
    assert any("gap" in fault for fault in told.faults)


def test_numbers_that_are_not_finite_are_detected() -> None:
    sol = solution(kp.Projection(), 0.01)
    judge(fine := Outcome(0, "pendulum", "stabilization=Projection(…)"), sol)
    assert not fine.faults
    sol.q = np.where(sol.q == sol.q[3, 0], np.nan, sol.q)
    judge(told := Outcome(0, "pendulum"), sol)
    assert "success with numbers that are not finite" in told.faults


def test_a_foreign_error_is_a_fault() -> None:
    judge_error(told := Outcome(0, "pendulum"), kp.InternalError("a panic"))
    assert told.faults == ["InternalError: a panic"]
