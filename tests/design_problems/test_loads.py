"""Several analyses and several load cases in one problem."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from design_problems.conftest import SECTION, written
from design_problems.test_faults import dyad
from sizes import only_full


def crane(size: float, mass: float) -> kp.Case:
    """A block on a spring: hanging at rest, and swinging about this place."""
    rate = {"k": 130.0 * mass / size, "mass": mass, "lift": 0.1 * size}
    m = kp.Model("crane", gravity=(0, -10), parameters=rate)
    m.ground.points(O=(0, 0))
    m.body("block", mass="mass", inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "block.P", axes=(np.pi / 2, np.pi / 2))
    m.generalized_force("spring", "guide.displacement", value="-k*guide.displacement")
    rest = kp.Equilibrium(name="rest")
    swing = kp.Dynamics(name="swing", t_end=5 * size**0.5, output_step=0.02 * size**0.5)
    return kp.Case(m, {"set": {"block.y": "lift", "block.vy": 0}}, [swing, rest])


SCALES = [(1.0, 1.0), (1e-2, 1e3), (1e2, 1e-3)]


@pytest.mark.parametrize(("size", "mass"), SCALES)
def test_limits_in_two_analyses(size: float, mass: float) -> None:
    """The block sinks by m g / k at rest; its largest speed is ω (lift + m g / k)."""
    case = crane(size, mass)
    k = 100.0 * mass / size
    limit = f"rest:block.y >= {-0.2 * size!r}"
    best = kp.optimize(
        case, {"k": (k / 10, 10 * k)}, minimize="block.vy.max", subject_to=limit, analysis="swing"
    )
    speed = lambda k: np.sqrt(k / mass) * (0.1 * size + 10 * mass / k)  # noqa: E731
    assert best.values["k"] == pytest.approx(mass * 10 / (0.1 * size), rel=1e-4)
    assert best.objective == pytest.approx(speed(best.values["k"]), rel=1e-6)
    assert best.measures["rest:block.y"] == pytest.approx(-10 * mass / best.values["k"], rel=1e-8)
    stiff = kp.optimize(
        case, {"k": (k / 10, 10 * k)}, minimize="swing:block.vy.max", analysis="rest",
        subject_to=f"block.y >= {-0.05 * size!r}",
    )  # fmt: skip
    assert stiff.values["k"] == pytest.approx(10 * mass / (0.05 * size), rel=1e-6)
    (gain,) = stiff.active.values()
    own = stiff.values["k"]
    step = 1e-4 * own
    by_k = (speed(own + step) - speed(own - step)) / (2 * step)
    assert gain == pytest.approx(by_k * own**2 / (10 * mass), rel=1e-3)


@pytest.mark.parametrize(("size", "mass"), SCALES)
def test_the_worst_of_loads_in_a_corner(size: float, mass: float) -> None:
    """ω (lift + m g / k) falls with k for a heavy block at first, and rises for a light one later.

    The best k is where both are equally fast: with w = √k, w a/√m + g √m/w for m and 4 m, and so
    k = 2 m g / lift.
    """
    k = 100.0 * mass / size
    best = kp.optimize(
        crane(size, mass), {"k": (k / 10, 100 * k)}, minimize='worst("block.vy.max")',
        loads=[{"mass": mass}, {"mass": 4 * mass}], analysis="swing",
    )  # fmt: skip
    assert best.values["k"] == pytest.approx(2 * mass * 10 / (0.1 * size), rel=1e-5)
    speeds = [best.measures[f"block.vy.max, load {j}"] for j in (1, 2)]
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-5)
    assert best.objective == pytest.approx(max(speeds), rel=1e-12)
    assert best.runs < 60 and not best.active
    assert len(best.remarks) == 1 and "loads 1 and 2 are equally bad" in best.remarks[0]


def test_the_slope_is_that_of_the_worst_load() -> None:
    """Away from the corner, against differences; the best of ``maximize`` is of the least load."""
    loads = [{"mass": 1.0}, {"mass": 4.0}, {"mass": 2.0}]
    ask = {"loads": loads, "analysis": "swing"}
    bound = {"k": (500.0, 900.0)}
    low = kp.optimize(crane(1, 1), bound, minimize="worst(block.vy.max) + 0.5*block.vy.max", **ask)
    assert low.values["k"] == 500 and not low.remarks
    fast = lambda k, m: np.sqrt(k / m) * (0.1 + 10 * m / k)  # noqa: E731
    assert low.objective == pytest.approx(fast(500, 1) * 1.5, rel=1e-6)
    by_k = (fast(500.01, 1) - fast(499.99, 1)) / 0.02
    assert low.active["k >= 500"] == pytest.approx(1.5 * by_k, rel=1e-4)
    high = kp.optimize(crane(1, 1), bound, maximize="worst(block.vy.max)", **ask)
    assert high.objective == pytest.approx(min(fast(900, m) for m in (1, 2, 4)), rel=1e-6)


@pytest.mark.parametrize(
    "method",
    ["slsqp", "trust-constr", pytest.param("differential-evolution", marks=only_full)],
)
def test_a_limit_holds_in_every_load(method: str) -> None:
    """The block of 4 kg sinks most; the limit has a formula and a parameter of its load case."""
    best = kp.optimize(
        crane(1, 1), {"k": (20.0, 2000.0, "log")}, minimize="k", method=method,
        subject_to=["worst(rest:block.y + 0*lift) >= -0.2", "worst(mass*block.vy.max) <= 40"],
        loads=[{"mass": 1}, {"mass": "4 kg"}, {}], analysis="swing",
    )  # fmt: skip
    precise = 1e-6 if method == "slsqp" else 1e-3
    assert best.success and best.values["k"] == pytest.approx(200, rel=precise)


def test_a_load_that_fails_is_named() -> None:
    case = dyad(0.8, 0.7)
    best = kp.optimize(
        case, {"a": (0.2, 0.9)}, minimize="worst(one.C.y)", loads=[{"b": 0.7}, {"b": 0.5}]
    )
    along = (0.25 - 0.49 + 1) / 2  # load 2 needs a >= 0.5, where load 1 is the higher one
    assert best.objective == pytest.approx(np.sqrt(0.25 - along**2), rel=1e-2)
    assert any("load 2: " in text and "short by" in text for text in best.reasons)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"minimize": "worst(block.vy.max)"}, r"there are no load cases"),
        ({"minimize": "worst(block.vy.max", "loads": [{}]}, r"write worst\(C.force.max\)"),
        ({"minimize": "k", "loads": [{"k": 3}]}, r"loads.0: it sets k, which is a variable"),
        ({"minimize": "k", "loads": [{"kk": 3}]}, r"unknown parameter .kk."),
        ({"minimize": "k", "loads": {"mass": 3}}, r"loads: .*a list of settings"),
        ({"minimize": "sing:block.vy.max"}, r"unknown analysis 'sing'; did you mean 'swing'"),
        ({"minimize": "rest:block.vy.max"}, r"a statistic of a motion"),
        ({"target": {"worst(block.vy.max)": 3}, "loads": [{}]}, r"has no worst load case"),
        ({"minimize": "rest:block.y + block.vy.max"}, r"rest:block.y is in m, block.vy.max is in"),
    ],
)
def test_wrong_requests(given: dict[str, object], message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        kp.optimize(crane(1, 1), {"k": (1, 2)}, analysis="swing", **given)


def test_loads_in_a_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The heavier lamp needs the stiffer spring; both loads are columns of the history."""
    from kempe.cli.app import run

    section = SECTION.replace(
        '"over.effort.rms"', '"worst(over.effort.rms)"\nloads = [{ mass = 1 }, { mass = "1.5 kg" }]'
    )
    case = kp.load(written(folder, section))
    case.save("saved.toml")
    assert kp.load("saved.toml").optimize == case.optimize
    assert run(["check", "lamp.toml"]) == 0
    assert run(["optimize", "lamp.toml", "--starts", "1"]) == 0
    told = capsys.readouterr().out
    assert "worst(over.effort.rms) =" in told and "over.effort.rms, load 2" in told
    for old, new, message in (
        ("{ mass = 1 }", "1", r"optimize.loads.0: .*a table such as \{ mass = 2 \}"),
        ("[{ mass = 1 }, ", "[{ mass = true }, ", r"loads.0.mass: .*a number with a unit"),
    ):
        with pytest.raises(kp.KempeError, match=message):
            kp.load(written(folder, section.replace(old, new)))
