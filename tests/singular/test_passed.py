"""The report on singular positions that a run passed."""

import io

import kempe as kp
import numpy as np
import pytest
from kempe.cli.findings import show_findings
from kempe.results import singular
from kempe.results.singular import singular_positions
from kempe.results.summary import summary
from rich.console import Console
from singular.equal_cranks import Cranks, cranks, run

#: Driven sets of two and of three cranks.
SEEDS = [2, 8]


def driven(seed: int, number: int) -> tuple[Cranks, kp.Solution]:
    of = cranks(seed, number=number)
    return of, run(of)


def in_line(of: Cranks, sol: kp.Solution) -> np.ndarray:
    """The times at which all links are in line."""
    ends = np.sort([of.angle, of.angle + of.rate * sol.t[-1]])
    turns = np.arange(np.ceil(ends[0] / np.pi), np.floor(ends[1] / np.pi) + 1)
    return np.sort((turns * np.pi - of.angle) / of.rate)


@pytest.mark.parametrize("number", [2, 3])
@pytest.mark.parametrize("seed", SEEDS)
def test_each_position_is_listed_with_its_time(seed: int, number: int) -> None:
    of, sol = driven(seed, number)
    told = summary(sol)
    found = told["singular"]
    assert "singular" in sol.statistics  # listed once, with the joints
    assert set(told["statistics"]) == set(sol.statistics) - {"singular"}
    assert [one["t"] for one in found] == pytest.approx(in_line(of, sol).tolist(), abs=1e-3)
    assert all({"A0", "B0"} <= set(one["joints"]) for one in found)


@pytest.mark.parametrize("number", [2, 3])
def test_positions_that_the_steps_did_not_meet_follow_from_the_multipliers(
    number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    of, sol = driven(2, number)
    times = in_line(of, sol).tolist()
    assert len(times) > 1
    for known in ([], times[:1], times[1:]):
        noted = [{"t": t, "names": [], "slope": None, "residual": 0.0} for t in known]
        monkeypatch.setitem(vars(sol), "statistics", {**sol.statistics, "singular": noted})
        found = singular_positions(sol)
        assert [one["t"] for one in found] == pytest.approx(times, abs=1e-3)
        assert [one["joints"] == [] for one in found] == [t in known for t in times]


def test_a_time_at_which_the_mechanism_is_regular_is_left_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    of, sol = driven(2, 2)
    times = in_line(of, sol).tolist()
    candidates = [0.5 * times[0], *times, 0.5 * (times[0] + times[1])]
    monkeypatch.setattr(singular, "singular_times", lambda _: candidates)
    monkeypatch.setitem(vars(sol), "statistics", {**sol.statistics, "singular": []})
    assert [one["t"] for one in singular_positions(sol)] == times


@pytest.mark.parametrize("number", [2, 3])
def test_the_amplification_is_that_of_the_output(number: int) -> None:
    _, sol = driven(2, number)
    for one in summary(sol)["singular"]:
        k = int(np.flatnonzero(sol.t == one["output"])[0])
        assert one["output"] == sol.t[np.abs(sol.t - one["t"]).argmin()]
        state = kp.State(sol.compiled, one["output"], sol.q[k], sol.v[k])
        rows = np.asarray(state.matrices().Phi_q)
        rows = rows / np.linalg.norm(rows, axis=1, keepdims=True)
        # each crank after the second has a redundant equation
        square = np.linalg.eigvalsh(rows @ rows.T)[number - 2]
        assert one["amplification"] == pytest.approx(1 / square, rel=1e-3)
        assert one["error"] < 1e-11 * one["amplification"]


@pytest.mark.parametrize("number", [2, 3])
def test_reactions_without_bound_are_named_with_times(number: int) -> None:
    """The outer cranks carry the weight of the rod with forces of order 1/sin φ."""
    of, sol = driven(2, number)
    found = summary(sol)
    joint = next(one for one in found["peaks"]["reactions"] if one["joint"] == "B0")
    times = in_line(of, sol)
    assert joint["unbounded_at"] == pytest.approx(times.tolist(), abs=1e-3)
    written = io.StringIO()
    show_findings(Console(file=written, width=200), "run", found)
    text = written.getvalue()
    assert "without bound at singular positions, not counted here (first at" in text
    assert f"{len(times)} singular positions passed (first at" in text
    # a fine grid, whose outputs come near, has the same peak
    fine = kp.dynamics(of.model, of.start, t_end=sol.t[-1], output_step=1e-3)
    again = next(one for one in summary(fine)["peaks"]["reactions"] if one["joint"] == "B0")
    assert again["force"] == pytest.approx(joint["force"], rel=0.1)


def test_a_regular_motion_has_none() -> None:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("A", "B"))
    m.revolute("O", "ground.O", "rod.A")
    sol = kp.dynamics(m, kp.assemble(m, set={"rod.angle": 0.3}), t_end=2, output_step=0.1)
    assert summary(sol)["singular"] == []
