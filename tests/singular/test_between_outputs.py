"""Between the outputs, states near change points are as accurate as the outputs."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from singular.test_change_points import LINKAGES

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = ["kite", "parallelogram", "1, 2, 3, 4", "equal slider-crank", "slider at the pivot"]
METHODS = {"dop853": kp.DOP853(rtol=1e-8), "rk45": kp.RK45(rtol=1e-8), "auto": kp.Auto()}


def solved(name: str, by: str, output_step: float) -> kp.Solution:
    linkage = LINKAGES[name]()
    options = {"t_end": 2, "output_step": output_step, "method": METHODS[by]}
    return kp.dynamics(linkage.model, linkage.start(), **options)


def largest(values: np.ndarray) -> float:
    return float(np.abs(values).max())


@pytest.mark.parametrize("by", METHODS)
@pytest.mark.parametrize("name", NAMES)
def test_velocities_and_accelerations_are_those_of_an_output(name: str, by: str) -> None:
    sol, finer = solved(name, by, 0.01), solved(name, by, 0.0013)
    between = sol(finer.t)
    fastest, strongest = largest(finer.v), largest(finer.a)
    # the interpolant alone is off by up to 1e-2
    assert largest(between.q - finer.q) < 1e-8
    assert largest(between.v - finer.v) < 1e-8 * fastest
    assert largest(between.a - finer.a) < 1e-6 * strongest
    assert largest(between.residuals[0]) < 1e-8
    assert largest(between.residuals[1]) < 1e-6 * fastest


@pytest.mark.parametrize("name", NAMES)
def test_one_time_many_times_and_the_outputs_agree(name: str) -> None:
    sol = solved(name, "auto", 0.01)
    many = sol(sol.t)
    strongest = largest(sol.a)
    assert_allclose(many.a, sol.a, atol=1e-7 * strongest)
    # near the change points: the largest accelerations by a division by little
    nearest = np.argsort(-np.abs(sol.lam).max(axis=1))[:10]
    for k in nearest:
        one = sol(float(sol.t[k]))
        assert_allclose(one.a, sol.a[k], atol=1e-7 * strongest)
        assert_allclose(one.lam, sol.lam[k], atol=1e-6 * largest(sol.lam))
    for state, k in ((sol.initial, 0), (sol.final, -1)):
        assert_allclose(state.a, sol.a[k], atol=1e-9 * strongest)


def test_states_near_change_points_are_starts() -> None:
    linkage = LINKAGES["1, 2, 3, 4"]()
    sol = solved("1, 2, 3, 4", "dop853", 0.01)
    for t in np.arange(0.005, 1.5, 0.0371):
        state = sol(float(t))
        again = kp.dynamics(linkage.model, state, t_end=float(t) + 0.01, method=METHODS["dop853"])
        assert_allclose(again.final.q, sol(float(t) + 0.01).q, atol=1e-5)


def test_a_stored_solution_interpolates_as_before(tmp_path: object) -> None:
    sol = solved("kite", "dop853", 0.01)
    path = f"{tmp_path}/kite.npz"
    sol.save(path)
    back, t = kp.load_solution(path), np.linspace(0, 2, 333)
    np.testing.assert_array_equal(back(t).v, sol(t).v)
    np.testing.assert_array_equal(back(t).a, sol(t).a)


def test_without_projection_the_interpolant_is_as_it_was() -> None:
    linkage = LINKAGES["1, 2, 3, 4"]()
    options = {"t_end": 0.3, "method": kp.RK45(), "stabilization": kp.Baumgarte()}
    sol = kp.dynamics(linkage.model, linkage.start(), **options)
    assert sol.dense is not None
    t = np.linspace(0, 0.3, 50)
    np.testing.assert_array_equal(sol(t).v, sol.dense.parts(t, sol.model.n_q, 0)[1])


STOPPED = ["parallelogram", "folded kite", "slider at the pivot"]


@pytest.mark.parametrize("name", STOPPED)
def test_a_stop_under_baumgarte_names_projection_which_passes(name: str) -> None:
    linkage = LINKAGES[name]()
    options = {"t_end": 2.0, "method": kp.RK45()}
    with pytest.raises(kp.SingularityError) as caught:
        kp.dynamics(linkage.model, linkage.start(), stabilization=kp.Baumgarte(), **options)
    assert "a run with stabilization projection passes this position" in str(caught.value)
    stopped = caught.value.t
    assert stopped is not None
    # the remedy
    sol = kp.dynamics(linkage.model, linkage.start(), stabilization=kp.Projection(), **options)
    assert sol.success
    assert stopped < sol.t[-1]


def test_a_stop_that_projection_does_not_pass_does_not_name_it() -> None:
    """A crank-rocker that is driven at its rocker reaches a dead point."""
    m = kp.Model("dead point")
    m.ground.points(A=(0, 0), D=(3, 0))
    m.bar("crank", mass=1, length=1, ends=("A", "B"))
    m.bar("coupler", mass=1, length=3, ends=("B", "C"))
    m.bar("rocker", mass=1, length=2, ends=("D", "C"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.coordinate_driver("motor", "rocker.angle", value="120*deg - 0.5*t")
    start = kp.assemble(m)
    for stabilization in (kp.Baumgarte(), kp.Projection()):
        with pytest.raises((kp.SingularityError, kp.IntegrationError)) as caught:
            kp.dynamics(m, start, t_end=10, method=kp.RK45(), stabilization=stabilization)
        assert "with stabilization projection passes" not in str(caught.value)


@pytest.mark.parametrize(
    ("example", "rate", "t_end"), [("four_bar", "crank.omega", 2.4), ("pendulum", "rod.omega", 3.0)]
)
def test_a_state_at_rest_for_an_instant(example: str, rate: str, t_end: float) -> None:
    case = kp.load(EXAMPLES / f"{example}.toml")
    start = case.start()
    sol = kp.dynamics(case.model, start, t_end=t_end, events={"turn": rate})
    turn = sol.events["turn"]
    assert len(turn.t) >= 2
    for t, state in zip(turn.t, turn.states, strict=True):
        exact = kp.dynamics(case.model, start, t_end=float(t), method=kp.DOP853(rtol=1e-11)).final
        assert_allclose(state.q, exact.q, atol=1e-5)
        assert_allclose(sol(float(t)).q, exact.q, atol=1e-5)
        assert_allclose(sol(np.array([t, t_end])).q[0], exact.q, atol=1e-5)
