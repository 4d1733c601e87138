"""Limits whose sides are zero, have units, or occur twice; objectives without columns or slopes."""

from types import SimpleNamespace

import kempe as kp
import numpy as np
import pytest
from design_problems.machines import lamp
from design_problems.test_faults import dyad
from kempe.sweeps.problems.asked import _NAMES, problem_of
from kempe.sweeps.problems.formulas import read_limit
from kempe.sweeps.problems.optimum import _distinct
from kempe.sweeps.problems.path import Path
from kempe.sweeps.problems.rewritten import rewritten


def oscillator(analysis: kp.Dynamics | None = None) -> kp.Case:
    """A mass of 1 kg on a spring; its largest speed is √k m/s."""
    m = kp.Model("oscillator", parameters={"k": 4.0, "zero": 0.0})
    m.ground.points(O=(0, 0))
    m.body("b", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "b.P")
    m.spring_damper("spring", "ground.O", "b.P", stiffness="k", free_length="zero")
    return kp.Case(m, {"set": {"b.x": 1.0}}, [analysis or kp.Dynamics(t_end=5, output_step=0.05)])


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_candidates_differ_in_their_place_or_in_their_objective(scale: float, sign: float) -> None:
    """Of near places one is kept, unless the objectives differ by more than a part in 10 000."""
    rows = {"a": (0.2, 1.0), "b": (0.2005, 1.00005), "c": (0.2005, 1.01), "d": (0.7, 1.00005)}
    runs = [
        SimpleNamespace(row=np.array([x]), objective=sign * scale * y, holds=True, name=name)
        for name, (x, y) in rows.items()
    ]
    problem = SimpleNamespace(sign=sign, shares=lambda row: row)
    kept = _distinct(problem, [runs[k] for k in (3, 2, 1, 0)])  # type: ignore[arg-type, list-item]
    assert [one.name for one in kept] == ["a", "d", "c"]  # type: ignore[attr-defined]


def test_a_path_is_that_of_its_tree() -> None:
    points = [[0.5, 1.0], [0.25, -2.0]]
    for angles in (None, [0.1, -0.3]):
        tree = Path(points, "rod.P", angles).tree()
        own = {} if angles is None else {"angles": angles}
        assert tree == {"points": points, "of": "rod.P", **own}
        assert Path.read(tree).tree() == tree


@pytest.mark.parametrize("unit", ["µm", "°", "mm", " kN", "*deg"])
def test_a_rewritten_value_keeps_its_unit(unit: str) -> None:
    factor = {"µm": 1e-6, "mm": 1e-3, " kN": 1e3}.get(unit, np.pi / 180)
    text = f'[parameters]\nk = "4{unit}"  # first\nother = 3\n'
    head = 'kempe = 1\ntitle = "t"\n'
    new = rewritten(head + text, {"k": 2.5 * factor})
    assert new is not None
    line = new.splitlines()[3]
    value, _, rest = line.removeprefix('k = "').partition(unit)
    assert float(value) == pytest.approx(2.5) and rest == '"  # first'
    assert new.replace(line, text.splitlines()[1]).rstrip() == (head + text).rstrip()


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_limits_whose_side_is_zero(size: float) -> None:
    """The terms give the size of such a limit, because both sides are zero where it is active."""
    aims = [
        ("maximize", f"{25 * size} - k*{size} >= 0", 25.0, 5.0, 0.1 / size),
        ("maximize", f"0 >= k*{size} - {25 * size}", 25.0, 5.0, 0.1 / size),
        ("minimize", f"b.vx.max*{size} - {3 * size} >= 0", 9.0, 3.0, 1.0 / size),
    ]
    for aim, limit, k, objective, gain in aims:
        best = kp.optimize(oscillator(), {"k": (1, 100)}, **{aim: "b.vx.max"}, subject_to=limit)
        assert best.success and best.values["k"] == pytest.approx(k, rel=1e-5)
        assert best.objective == pytest.approx(objective, rel=1e-5)
        assert dict(best.active) == {limit: pytest.approx(gain, rel=1e-4)}


@pytest.mark.parametrize(
    ("text", "small", "large"),
    [
        ("b.vx.max <= 3*k", "b.vx.max", "3*k"),
        ("b.vx.max >= 3*k", "3*k", "b.vx.max"),
        ("`a < b.max` <= 3*k", "`a < b.max`", "3*k"),
        ("k > `a >= b.max`", "`a >= b.max`", "k"),
        ("`a <= b.max` + `c < d.min` < `e = f.rms` - k", "`a <= b.max` + `c < d.min`",
         "`e = f.rms` - k"),
    ],
)  # fmt: skip
def test_a_comparison_is_not_within_a_quoted_name(text: str, small: str, large: str) -> None:
    model = oscillator().model.compile()
    limit = read_limit(model, text, ())
    assert [side.text for side in limit.sides] == [small, large]
    with pytest.raises(kp.ModelError, match="must be a comparison"):
        read_limit(model, f"({text})", ())


def test_a_limit_at_zero_of_a_variable() -> None:
    best = kp.optimize(
        oscillator(), {"zero": (-0.5, 0.5)}, minimize="b.vx.max - zero*2", subject_to="zero <= 0"
    )  # the largest speed is 2 |1 - zero|
    assert best.success and abs(best.values["zero"]) < 1e-8
    assert dict(best.active) == {"zero <= 0": pytest.approx(4, rel=1e-5)}


@pytest.mark.parametrize("limit", ["free >= 0", "0 <= free", "-free <= 0"])
def test_least_squares_from_a_limit_whose_size_is_zero(limit: str) -> None:
    case, exact = lamp(1, 1, 9.81, n=5)
    best = kp.optimize(
        case.with_parameters({"free": 0.0}), {"k": (0, 10 * exact["k"]), "free": (-1, 1)},
        target={"over.effort.max": 0, "over.effort.min": 0}, subject_to=limit,
    )  # fmt: skip
    assert best.success and best.values["k"] == pytest.approx(exact["k"], rel=1e-8)


@pytest.mark.parametrize("method", ["slsqp", "trust-constr"])
def test_methods_with_slopes_take_differences_where_there_are_none(method: str) -> None:
    """A frequency of a motion has no slope; the right stiffness is (2 π 0.5)²."""
    case = oscillator(kp.Dynamics(t_end=20, output_step=0.02))
    best = kp.optimize(case, {"k": (1, 40)}, target={"b.x.frequency": 0.5}, method=method)
    assert best.values["k"] == pytest.approx(np.pi**2, rel=2e-2)


def test_an_objective_of_parameters_alone_needs_a_case_that_runs() -> None:
    """C exists from a = 0.3 m, where the rods are in line."""
    best = kp.optimize(dyad(0.8, 0.7), {"a": (0.1, 0.9)}, minimize="a")
    assert best.success and best.values["a"] == pytest.approx(0.3, abs=2e-3)
    best.case.run()


def test_an_objective_without_any_name() -> None:
    with pytest.raises(kp.ModelError, match="'2\\*pi' has no column and no parameter"):
        kp.optimize(oscillator(), {"k": (1, 100)}, minimize="2*pi")


def test_limits_with_units() -> None:
    for limit in ("b.vx.max >= 3000 mm/s", "3 m/s <= b.vx.max", "b.vx.max - 3 >= 0 m/s"):
        best = kp.optimize(oscillator(), {"k": (1, 100)}, minimize="k", subject_to=limit)
        assert best.values["k"] == pytest.approx(9, rel=1e-5)
    with pytest.raises(kp.ModelError, match=r"b\.vx\.max is in m/s, 3 m is in m|3 m is in m, b"):
        kp.optimize(oscillator(), {"k": (1, 100)}, minimize="k", subject_to="b.vx.max >= 3 m")


@pytest.mark.parametrize("most", [100, 1e5])
@pytest.mark.parametrize("limit", ["b.vx.max >= 3", "b.vx.max - 3 >= 0"])
def test_limits_are_kept_however_wide_the_bounds_are(most: float, limit: str) -> None:
    best = kp.optimize(oscillator(), {"k": (1, most)}, minimize="k", subject_to=limit)
    assert best.success and best.measures["b.vx.max"] == pytest.approx(3, rel=2e-6)


def test_a_limit_that_occurs_twice_or_is_a_bound() -> None:
    """The multiplier of a text is that of all limits with it."""
    twice = ["b.vx.max <= 3", "b.vx.max <= 3"]
    best = kp.optimize(oscillator(), {"k": (1, 100)}, maximize="k", subject_to=twice)
    assert dict(best.active) == {"b.vx.max <= 3": pytest.approx(6, rel=1e-4)}
    best = kp.optimize(oscillator(), {"k": (1, 9)}, maximize="k", subject_to="k <= 9")
    assert dict(best.active) == {"k <= 9": pytest.approx(1)}


@pytest.mark.parametrize(
    ("of", "unit"),
    [
        ("b.vx.max + b.vx.min", "m/s"),
        ("b.x.max*b.vx.max", "m^2/s"),
        ("b.vx.max/b.x.max", "1/s"),
        ("1/b.x.max", "1/m"),
        ("b.vx.max", "m/s"),
    ],
)
def test_units_are_written_with_divisions(of: str, unit: str) -> None:
    best = kp.optimize(oscillator(), {"k": (4, 5)}, minimize=of)
    assert best.unit == unit


@pytest.mark.parametrize("width", [10.0, 1e3, 1e5])
def test_wide_linear_bounds_do_not_end_a_search_early(width: float) -> None:
    case, exact = lamp(1, 1, 9.81)
    best = kp.optimize(
        case, {"k": (0, width * exact["k"]), "free": (-width / 10, width / 10)},
        minimize="over.effort.rms", method="slsqp",
    )  # fmt: skip
    assert best.values["k"] == pytest.approx(exact["k"], rel=1e-6)
    assert best.values["free"] == pytest.approx(0, abs=1e-6) and best.runs < 60


@pytest.mark.parametrize("a", [0.30002, 0.5])
def test_a_difference_beside_values_that_do_not_close(a: float) -> None:
    """C.x = (a² - b² + 1)/2; the rods are too short below a = 0.3."""
    problem = problem_of(
        dyad(0.8, 0.7), {**dict.fromkeys(_NAMES), "variables": {"a": (0.1, 0.9)},
                         "minimize": "one.C.x"}
    )  # fmt: skip
    (part,) = problem.columns.parts
    row = np.array([a])
    values, exact = part.slopes(row, np.array([[0.1, 0.9]]), 1)
    slopes = part._difference(row, values, (0, 0.1, 0.9), 1)
    assert slopes == pytest.approx([a], abs=1e-4) and exact[:, 0] == pytest.approx([a], rel=1e-6)
