"""Objectives without values, limits that cannot be met, bounds without a mechanism."""

import re
import resource
import sys
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from design_problems.machines import lamp, path_generator, slider_crank
from kempe.base.arrays import Floats
from kempe.sweeps.problems import search
from kempe.sweeps.problems.evaluate import Evaluations
from kempe.sweeps.problems.problem import Numbers


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


@pytest.mark.parametrize("size", [1.0, 1e-4])
def test_limits_that_exclude_each_other_are_missed_by_equal_parts(size: float) -> None:
    """The largest excess is least at k = √(10·30): there, (k - 10)/k and (30 - k)/30 are equal."""
    m = kp.Model("slide", parameters={"k": 4.0 * size})
    m.ground.points(O=(0, 0))
    m.body("slide", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slide.P")
    m.generalized_force("spring", "guide.displacement", value="k - guide.displacement")
    case = kp.Case(m, None, [kp.Equilibrium()])
    limits = [f"slide.x <= {10 * size}", f"slide.x >= {30 * size}"]
    best = kp.optimize(case, {"k": (size, 100 * size)}, minimize="slide.x", subject_to=limits)
    told = best.message.replace("mm", "e-3 m")
    found = re.findall(r"(slide[^,]*) is missed by ([\d.]+) ?(e-3)? m", told)
    missed = {text: float(by + power) for text, by, power in found}
    assert not best.success and list(missed) == limits
    assert sum(missed.values()) == pytest.approx(20 * size, rel=1e-3)
    assert best.values["k"] == pytest.approx(np.sqrt(300) * size, rel=1e-2)


def damped_rod() -> kp.Case:
    """A rod that swings; it settles within 6 s with enough damping."""
    m = kp.Model("rod", gravity=(0, -9.81), parameters={"c": 0})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("bearing", "ground", "rod", damping="c")
    run = kp.Dynamics(t_end=6, output_step=0.02)
    return kp.Case(m, {"set": {"rod.angle": -1.0}}, [run])


def test_an_objective_without_a_value_at_the_start() -> None:
    """A swing that does not settle has no settling time; with enough damping it has one."""
    best = kp.optimize(damped_rod(), {"c": (0, 3)}, minimize="rod.angle.settling", starts=4)
    assert best.success and 0.5 < best.objective < 3
    assert any("has no value here: it is nan" in text for text in best.reasons)


def test_a_limit_and_a_target_without_a_value_at_the_start() -> None:
    limit = "rod.angle.settling <= 3"
    best = kp.optimize(damped_rod(), {"c": (0, 3)}, minimize="c", subject_to=limit)
    assert best.success and best.measures["rod.angle.settling"] <= 3 * (1 + 1e-6)
    assert f"{limit} has no value here: it is nan" in best.reasons
    best = kp.optimize(damped_rod(), {"c": (0, 3)}, target={"rod.angle.settling": 2.0})
    assert best.success and best.measures["rod.angle.settling"] == pytest.approx(2, rel=0.1)
    told = "all .* fail; most frequently: rod.angle.settling has no value here"
    with pytest.raises(kp.ModelError, match=told):
        kp.optimize(damped_rod(), {"c": (0, 1e-3)}, minimize="rod.angle.settling")


def test_an_objective_with_jumps() -> None:
    """Between its jumps it falls with a, so that the search passes all of them."""
    best = kp.optimize(dyad(0.8, 0.7), {"a": (0.6, 0.9)}, minimize="floor(20*a) + one.C.y - 2*b")
    assert best.success and best.values["a"] < 0.65
    assert any(run.objective > best.objective + 3 for *_, run in best._history)


def test_a_worker_that_dies(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A thread runs out of memory: the call fails, the runs are kept, and it continues."""
    case, bounds = dyad(0.8, 0.7), {"a": (0.1, 0.9), "b": (0.1, 0.8)}
    ask = {"maximize": "one.C.y", "starts": 3, "out": tmp_path / "runs.db"}
    measured, done = Evaluations._measured, []

    def dying(self: Evaluations, row: Floats) -> Numbers:
        done.append(row)
        if len(done) == 5:
            raise MemoryError("no memory for another run")
        return measured(self, row)

    with monkeypatch.context() as patch:
        patch.setattr(Evaluations, "_measured", dying)
        with pytest.raises(MemoryError, match="no memory for another run"):
            kp.optimize(case, bounds, **ask)
    rows: list[Floats] = []
    monkeypatch.setattr(
        Evaluations, "_measured", lambda self, row: rows.append(row) or measured(self, row)
    )
    best = kp.optimize(case, bounds, **ask)
    assert dict(best.values) == pytest.approx({"a": 0.9, "b": 0.8})
    assert 0 < len(rows) <= best.runs - 4


@pytest.mark.skipif(sys.platform != "linux", reason="the memory in use is read from /proc")
def test_memory_of_a_thousand_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ten thousand runs may add 50 MB; the history of each run is kept."""

    def used() -> float:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
        return pages * resource.getpagesize() / 1e6

    def searched(generations: int) -> kp.Optimum:
        monkeypatch.setattr(search, "_GENERATIONS", generations)
        monkeypatch.setattr(search, "_SPREAD", 0.0)
        return kp.optimize(
            dyad(0.8, 0.7), {"a": (0.6, 0.9), "b": (0.6, 0.8)}, maximize="one.C.y",
            method="differential-evolution",
        )  # fmt: skip

    searched(1)
    before = used()
    best = searched(32)
    assert best.runs > 1000 and used() - before < 5.0


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


def crank_and_rod(size: float) -> kp.Case:
    """A driven slider-crank with a crank of 0.1 sizes; it turns if the rod is longer."""
    m = kp.Model("engine", parameters={"l": 0.3 * size})
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length=0.1 * size, ends=("A", "B"))
    m.bar("rod", mass=1, length="l", ends=("B", "C"))
    m.body("slide", mass=1, inertia=1, points={"P": (0, 0)})
    m.revolute("main", "ground.O", "crank.A")
    m.revolute("big_end", "crank.B", "rod.B")
    m.revolute("small_end", "rod.C", "slide.P")
    m.translational("guide", "ground.O", "slide.P")
    m.coordinate_driver("motor", "crank.angle", value="t")
    start = {"guess": {"slide.x": 0.4 * size}}
    return kp.Case(m, start, [kp.Kinematics(t_end=6.3, output_step=0.7, name="turn")])


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e3])
def test_a_search_that_ends_beside_failed_runs_says_so(size: float) -> None:
    case, least = crank_and_rod(size), "slide.x.max"
    best = kp.optimize(case, {"l": (0.05 * size, 0.5 * size)}, minimize=least)
    assert best.values["l"] == pytest.approx(0.1 * size, rel=1e-3)
    (told,) = best.remarks
    assert "beside the best values fail (crank cannot pass" in told
    for asked in (
        {"variables": {"l": (0.15 * size, 0.5 * size)}, "minimize": least},
        {"variables": {"l": (0.05 * size, 0.5 * size)}, "target": {least: 0.35 * size}},
    ):
        assert not kp.optimize(case, **asked).remarks  # type: ignore[arg-type]
