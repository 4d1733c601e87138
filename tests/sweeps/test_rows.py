"""The rows of a sweep are the numbers of single runs, to the last bit; failures have reasons."""

import re
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe import _core
from sizes import only_full
from sweeps.conftest import flagship

#: Statistics that the core computes without Python.
NATIVE = ["max", "min", "peak", "mean", "rms", "integral", "final", "t_max", "t_min", "settling"]


def single(result: kp.SweepResult, k: int) -> list[float]:
    """The numbers of a row by the interface of a single run: the declared measures."""
    case = result.case(k)
    pairs = [text.rpartition(".")[::2] for text in result.measures]
    declared = case.model.compile().measures
    others = [name for name in dict.fromkeys(name for name, _ in pairs) if name not in declared]
    case.model.measures({f"other{k}": name for k, name in enumerate(others)})
    solution = case.run()[-1]
    known = {name: f"other{k}" for k, name in enumerate(others)}
    return [getattr(solution.measure(known.get(name, name)), of) for name, of in pairs]


def same(result: kp.SweepResult, rows: list[int]) -> None:
    for k in rows:
        expected = np.array(single(result, k))
        np.testing.assert_array_equal([result[text][k] for text in result.measures], expected)


def test_every_statistic_equals_that_of_a_single_run(case: kp.Case) -> None:
    names = ("pin", "lean", "where", "rocker.alpha", "spring.power")
    texts = [f"{name}.{statistic}" for name in names for statistic in NATIVE]
    result = kp.sweep(case, {"L2": [25, 26.5], "k": [5e5, 2e6]}, texts)
    assert not result.reasons
    same(result, [0, 3])


def run_of(case: kp.Case, **options: Any) -> kp.Case:
    """The case with another run of half a second."""
    start = {"set": case._start.set, "guess": case._start.guess}
    return kp.Case(case.model, start, [kp.Dynamics(t_end=0.5, name="release", **options)])


@pytest.mark.parametrize("output_step", [0.01, 0.07, None])
@pytest.mark.parametrize(
    "options",
    [
        {"method": kp.RK45(), "stabilization": kp.Baumgarte()},
        {"method": kp.DOP853(), "stabilization": kp.Baumgarte(alpha=20, beta=20)},
        {"method": kp.DOP853(), "stabilization": kp.Projection()},
        {"method": kp.RK4(step=0.003), "stabilization": kp.NoStabilization()},
        {"method": kp.RK45(), "stabilization": kp.Baumgarte(), "stop": "crank.angle > 2"},
    ],
    ids=["rk45", "dop853", "projection", "rk4", "stop"],
)
def test_final_values_alone_equal_those_of_single_runs(
    case: kp.Case, options: dict[str, Any], output_step: float | None
) -> None:
    """Other outputs are left out: the run ends on the grid, beside it, or has no grid."""
    case = run_of(case, output_step=output_step, **options)
    texts = ["rocker.omega.final", "pin.final", "crank.alpha.final"]
    result = kp.sweep(case, {"k": [5e5, 2e6]}, texts)
    assert result.succeeded.all()
    same(result, [0, 1])


def test_a_run_without_outputs_has_the_reason_of_a_single_run(case: kp.Case) -> None:
    stabilization = kp.Baumgarte(alpha=0.1, beta=0.1)
    case = run_of(case, output_step=0.01, method=kp.RK4(step=0.05), stabilization=stabilization)
    result = kp.sweep(case, {"k": [1e5, 1e7]}, ["crank.angle.final"])
    assert result.reasons
    for k, reason in result.reasons.items():
        with pytest.raises(kp.KempeError) as caught:
            result.run(k)
        assert caught.value.args[0] == reason


def test_the_core_computes_them(case: kp.Case, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: object) -> None:
        raise AssertionError("a single run")

    monkeypatch.setattr(kp.Case, "each", refused)
    texts = [f"pin.{statistic}" for statistic in NATIVE]
    result = kp.sweep(case, {"k": [5e5, 1e6, 2e6]}, texts)
    assert result.succeeded.all()
    assert result["pin.max"][1] > 20e3


@pytest.mark.parametrize("name", ["slamming_door", "barrier", "jumping_follower", "trebuchet"])
def test_the_core_computes_runs_with_phases(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Friction that sticks, contacts, releases and actions: each row has the model of its phase."""
    case = kp.load(ROOT / "examples" / f"{name}.toml")
    joint = next(iter(case.model.joints))
    parameter, value = next(iter(case.model.parameters.items()))
    analysis = next(n for n, e in case.analyses.items() if e["type"] == "dynamics")
    texts = [f"{joint}.force.{statistic}" for statistic in NATIVE]
    given = {parameter: [value, 1.01 * value]}
    monkeypatch.setattr(kp.Case, "each", None)
    result = kp.sweep(case, given, texts, analysis=analysis)
    monkeypatch.undo()
    assert result.succeeded.all()
    for k in range(2):
        variant = result.case(k)
        variant.model.measures(one=f"{joint}.force")
        measure = variant.run()[analysis].measure("one")
        expected = [getattr(measure, statistic) for statistic in NATIVE]
        np.testing.assert_array_equal([result[text][k] for text in texts], expected)


def test_start_values_and_parameters_vary_together(case: kp.Case) -> None:
    given = {"crank.angle": np.radians([60, 75]), "k": [1e6, 2e6], "crank.omega": [0, 0.5]}
    result = kp.sweep(case, given, ["pin.max", "crank.omega.final"], design="paired")
    same(result, [0, 1])
    assert result.case(1).held["crank.angle"] == np.radians(75)
    state = result.case(1).start()
    assert state["crank.omega"] == pytest.approx(0.5, abs=1e-12)


def test_a_frequency_and_an_energy_are_those_of_single_runs(case: kp.Case) -> None:
    case.model.measures(lost="energy.dissipated", kinetic="energy.kinetic")
    texts = ["pin.frequency", "lost.final", "kinetic.max", "pin.max"]
    same(kp.sweep(case, {"k": [8e5, 1e6]}, texts), [0, 1])


LONG = pytest.param("geneva_drive", marks=only_full)


@pytest.mark.parametrize("name", ["slider_crank", LONG, "slamming_door", "trebuchet"])
def test_other_examples_equal_single_runs(name: str) -> None:
    case = kp.load(ROOT / "examples" / f"{name}.toml")
    parameter = next(iter(case.model.parameters))
    value = case.model.parameters[parameter]
    joint = next(iter(case.model.joints))
    texts = [f"{joint}.force.max", f"{joint}.fx.mean"]
    analysis = next(n for n, e in case.analyses.items() if e["type"] == "dynamics")
    result = kp.sweep(case, {parameter: [value, 1.01 * value]}, texts, analysis=analysis)
    for k in range(2):
        variant = result.case(k)
        variant.model.measures(a=f"{joint}.force", b=f"{joint}.fx")
        try:
            solution = variant.run()[analysis]
            expected = [solution.measure("a").max, solution.measure("b").mean]
        except kp.KempeError as error:
            assert result.reasons[k] == error.args[0]
            continue
        np.testing.assert_array_equal([result[text][k] for text in texts], expected)


def test_variants_that_cannot_assemble_carry_their_gap(case: kp.Case) -> None:
    lengths = np.concatenate([np.linspace(25, 27, 14), np.linspace(44, 50, 6)])
    result = kp.sweep(case, {"L2": lengths}, ["pin.max"])
    assert list(result.reasons) == list(range(14, 20))
    for k, reason in result.reasons.items():
        gap = float(re.findall(r"by ([\d.]+) m", reason)[0])
        with pytest.raises(kp.AssemblyError) as caught:
            result.run(k)
        assert caught.value.args[0] == reason
        # at 70° the pins of the coupler are at most |BD| + L3 apart
        angle, along = np.radians(70), 18.0
        widest = np.hypot(20 - 10 * np.cos(angle), 10 * np.sin(angle)) + along
        assert gap == pytest.approx(lengths[k] - widest, abs=2e-3)
        assert np.isnan(result["pin.max"][k])
    same(result, [0, 7, 13])


def cranks() -> kp.Case:
    """Two equal cranks on a rod, the first longer by a part: a change point is passed at 0.63 s."""
    m = kp.Model("cranks", gravity=(0, -9.81), parameters={"longer": 0})
    m.ground.points(A0=(0, 0), A1=(2, 0))
    m.body("rod", mass=1, inertia=1, points={"B0": (0, 0), "B1": (2, 0)})
    for k, length in enumerate(["1 + longer", 1]):
        m.bar(f"crank{k}", mass=1, length=length, ends=("A", "B"))
        m.revolute(f"A{k}", f"ground.A{k}", f"crank{k}.A")
        m.revolute(f"B{k}", f"crank{k}.B", f"rod.B{k}")
    m.measures(pin="B1.force")
    start = {"set": {"crank0.angle": 1.2}, "guess": {"crank1.angle": 1.2, "rod.angle": 0}}
    return kp.Case(m, start, [kp.Dynamics(t_end=3, output_step=0.1)])


def test_a_singular_position_has_its_time() -> None:
    """One variant stops there; the other passes, and its peak is that of a single run."""
    result = kp.sweep(cranks(), {"longer": [0, 1e-10]}, ["pin.max", "crank0.angle.final"])
    assert list(result.reasons) == [1]
    assert re.search(r"without meeting.* at t = 0\.6\d+ s|at t = 0\.6\d+ s", result.reasons[1])
    same(result, [0])


def test_an_impossible_model_is_a_row(case: kp.Case) -> None:
    result = kp.sweep(case, {"L2": [26, -1]}, ["pin.max"])
    assert list(result.reasons) == [1]
    assert "must be > 0" in result.reasons[1]


def test_the_number_of_threads_changes_nothing(case: kp.Case) -> None:
    given = {"k": np.linspace(5e5, 2e6, 7)}
    one, many = (kp.sweep(case, given, ["pin.max"], workers=n) for n in (1, 4))
    np.testing.assert_array_equal(one["pin.max"], many["pin.max"])


@pytest.mark.parametrize(
    ("kind", "fields", "text"),
    [
        ("limits", {"over": "crank.angle"}, "lower"),
        ("mobility", {}, "degrees_of_freedom"),
        ("modes", {}, "frequency[0]"),
        ("equilibrium", {}, "stable"),
    ],
)
def test_other_analyses_give_numbers_of_their_results(
    kind: str, fields: dict[str, str], text: str
) -> None:
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    case = kp.Case(
        case.model, case._start, {"a": {"type": "equilibrium"}, "b": {"type": kind, **fields}}
    )
    result = kp.sweep(case, {"L2": [29.0, 30.0]}, [text])
    found = result.run(1)
    expected = found.frequency[0] if "[" in text else getattr(found, text)
    assert not result.reasons
    assert result[text][1] == float(expected)


def test_a_panic_is_an_internal_error(case: kp.Case) -> None:
    """The next sweep works."""
    _core._inject_panic("sweep")
    try:
        with pytest.raises(kp.InternalError):
            kp.sweep(case, {"k": [1e6]}, ["pin.max"])
    finally:
        _core._inject_panic(None)
    assert kp.sweep(case, {"k": [1e6]}, ["pin.max"]).succeeded.all()


def test_the_case_is_not_changed() -> None:
    case = flagship(0.05)
    before = case.text()
    kp.sweep(case, {"L2": [25, 26]}, ["pin.max"]).case(0)
    assert case.text() == before
