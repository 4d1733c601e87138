"""Objectives without values, limits that cannot be met, bounds without a mechanism."""

import re
import sys

import kempe as kp
import numpy as np
import pytest
from design_problems.machines import lamp, path_generator, slider_crank


def dyad(first: float, second: float) -> kp.Case:
    """Two rods between two points 1 m apart; the upper point is the lower the longer they are."""
    m = kp.Model("dyad", gravity=(0, -9.81), parameters={"a": first, "b": second})
    m.ground.points(A=(0, 0), B=(1, 0))
    m.bar("one", mass=1, length="a", ends=("A", "C"))
    m.bar("two", mass=1, length="b", ends=("B", "C"))
    m.revolute("A", "ground.A", "one.A")
    m.revolute("B", "ground.B", "two.B")
    m.revolute("C", "one.C", "two.C")
    return kp.Case(m, {"guess": {"one.angle": 0.8, "two.angle": 2.4}}, [kp.Equilibrium()])


def test_a_search_leaves_values_that_do_not_close() -> None:
    """It starts where both rods are too short, and ends where C is highest."""
    best = kp.optimize(dyad(0.3, 0.4), {"a": (0.1, 0.9), "b": (0.1, 0.8)}, maximize="one.C.y")
    along = (0.9**2 - 0.8**2 + 1) / 2
    assert best.objective == pytest.approx(np.sqrt(0.9**2 - along**2), rel=1e-9)
    assert set(best.active) == {"a <= 0.9", "b <= 0.8"}
    reasons = [text for text in best.reasons if text]
    assert reasons and "short by" in reasons[0]


def test_a_small_region_in_which_rods_close_is_found() -> None:
    """Rods close in less than a hundredth of the bounds, which no drawn point meets."""
    best = kp.optimize(dyad(0.3, 0.4), {"a": (0.1, 0.55), "b": (0.1, 0.5)}, maximize="one.C.y")
    along = (0.55**2 - 0.5**2 + 1) / 2
    assert best.objective == pytest.approx(np.sqrt(0.55**2 - along**2), rel=1e-9)


def test_an_optimum_at_the_limit_of_assembly() -> None:
    """The lowest C is on the line of the rods, beside values that do not close."""
    best = kp.optimize(dyad(0.8, 0.7), {"a": (0.2, 0.9), "b": (0.2, 0.8)}, minimize="one.C.y")
    assert best.success and 0 <= best.objective < 2e-2
    assert any(best.reasons)


def test_bounds_that_exclude_every_assembly() -> None:
    with pytest.raises(kp.ModelError) as caught:
        kp.optimize(dyad(0.8, 0.7), {"a": (0.1, 0.4), "b": (0.1, 0.5)}, maximize="one.C.y")
    told = str(caught.value)
    assert re.search(r"all \d+ runs within the bounds fail", told) and "short by" in told
    assert "widen the bounds" in told


def test_limits_that_cannot_be_met_are_named_with_their_gap() -> None:
    case = dyad(0.8, 0.7)
    best = kp.optimize(
        case, {"a": (0.6, 0.9), "b": (0.6, 0.8)}, minimize="a", subject_to=["one.C.y >= 1 + 0*a"]
    )
    along = (0.9**2 - 0.8**2 + 1) / 2
    missing = 1 - np.sqrt(0.9**2 - along**2)
    assert not best.success
    told = re.search(r"one\.C\.y >= 1 \+ 0\*a is missed by ([\d.]+) m", best.message)
    assert told and float(told[1]) == pytest.approx(missing, abs=1e-3)


def test_an_objective_without_a_value_at_the_start() -> None:
    """A swing that does not settle has no settling time; with enough damping it has one."""
    m = kp.Model("rod", gravity=(0, -9.81), parameters={"c": 0})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("bearing", "ground", "rod", damping="c")
    run = kp.Dynamics(t_end=6, output_step=0.02)
    case = kp.Case(m, {"set": {"rod.angle": -1.0}}, [run])
    best = kp.optimize(case, {"c": (0, 3)}, minimize="rod.angle.settling", starts=4)
    assert best.success and 0.5 < best.objective < 3
    assert any("has no value here: it is nan" in text for text in best.reasons)


def test_a_measure_without_slopes_is_evolved() -> None:
    """Steps of generalized-alpha have no slopes."""
    m = kp.Model("mass on a spring", parameters={"k": 20.0})
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    m.generalized_force("spring", "guide.displacement", value="-k*guide.displacement")
    start = {"set": {"guide.displacement": 0, "mass.vx": 1}}
    run = kp.Dynamics(t_end=1.5, output_step=0.01, method=kp.GeneralizedAlpha(step=2e-3))
    best = kp.optimize(
        kp.Case(m, start, [run]), {"k": (10, 100, "log")}, target={"mass.x.max": 0.2}
    )
    assert best.values["k"] == pytest.approx(2 / 0.2**2, rel=1e-3)
    assert best.runs > 50


def test_runs_that_fail_are_rows() -> None:
    case = path_generator(0.0, 6.28)
    path = kp.Path([(3, 3), (2.7, 3.4)], of="coupler.P")
    best = kp.optimize(case, {"r2": (1, 30), "rcx": (0, 4)}, minimize=path, starts=4, seed=2)
    failed = best.history[best.history["reason"] != ""]
    assert len(failed) > 2 and len(best.history) == best.runs
    assert failed["objective"].isna().all()
    assert best.objective < 1e-3


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"minimize": "drive.effort.rms", "maximize": "k"}, "minimize and maximize at once"),
        ({}, "no objective"),
        ({"minimize": ["drive.effort.rms", "k"], "method": "slsqp"}, "and there are 2"),
        ({"minimize": "drive.effort.rms", "starts": 0}, "starts: 0"),
        ({"minimize": "drive.effort.rms", "method": "simplex"}, "unknown method 'simplex'"),
        ({"target": {"drive.effort.rms": "a"}}, "target.drive.effort.rms: 'a' is not a number"),
        ({"maximize": kp.Path([(0, 0)], of="rod.S")}, "a path is a distance"),
        ({"minimize": kp.Path([(0, 0)], of="rod.Q")}, "unknown point of rod 'Q'"),
        ({"minimize": "drive.effort.rms", "goal": 3}, "unknown argument 'goal'"),
    ],
)
def test_wrong_requests(given: dict[str, object], message: str) -> None:
    case, _ = slider_crank(1, 1, 1)
    with pytest.raises(kp.ModelError, match=re.escape(message)):
        kp.optimize(case, {"k": (1, 2)}, **given)  # type: ignore[arg-type]
    with pytest.raises(kp.ModelError, match=r"unknown variable 'x'|no parameter 'x'"):
        kp.optimize(case, {"x": (1, 2)}, minimize="drive.effort.rms")


@pytest.mark.parametrize(
    ("points", "of", "angles"),
    [([1, 2], "a.P", None), ([(1, np.nan)], "a.P", None), ([(1, 2)], "P", None),
     ([(1, 2)], "a.P", [1, 2]), ([], "a.P", None)],
)  # fmt: skip
def test_wrong_paths(points: list[object], of: str, angles: list[float] | None) -> None:
    with pytest.raises(kp.ModelError):
        kp.Path(points, of=of, angles=angles)  # type: ignore[arg-type]


def test_an_angle_beyond_the_motion_is_a_reason() -> None:
    case = path_generator(0.5, 1.0)
    with pytest.raises(kp.ModelError, match=r"the motion has no value at 2: it goes from 0\.5"):
        kp.optimize(case, {"r2": (2, 3)}, minimize=kp.Path([(1, 1)], of="coupler.P", angles=[2]))


def test_ctrl_c_keeps_the_best() -> None:
    case, exact = lamp(1, 1, 9.81)

    stopped: list[int] = []

    def stop(runs: int, *_: object) -> None:
        if runs >= 3 and not stopped:
            import _thread

            stopped.append(runs)
            _thread.interrupt_main()

    with pytest.raises(KeyboardInterrupt) as caught:
        kp.optimize(
            case, {"k": (0, 10 * exact["k"]), "free": (-1, 1)}, minimize="over.effort.rms",
            starts=4, progress=stop,
        )  # fmt: skip
    best = caught.value.result  # type: ignore[attr-defined]
    assert best.message == "interrupted" and best.runs >= 3 and best.case.model is not None


def test_scipy_is_named_where_it_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy.optimize", None)
    with pytest.raises(kp.ModelError, match=r"pip install 'kempe\[design\]'"):
        kp.optimize(dyad(0.8, 0.7), {"a": (0.6, 0.9)}, minimize="one.C.y")
