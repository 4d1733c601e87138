"""Optima that are known in closed form or published."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from design_problems.machines import (
    SCALES,
    absorber,
    four_bar,
    lamp,
    slider_crank,
)
from kempe.sweeps.problems import search
from sizes import some


@pytest.mark.parametrize("scale", some(SCALES, 2))
def test_counterweights_of_berkof_and_lowen(scale: tuple[float, float, float]) -> None:
    case, exact = four_bar(*scale)
    bounds = dict.fromkeys(exact, (-3 * scale[1], 3 * scale[1]))
    best = kp.optimize(case, bounds, target={"shake_x.rms": 0, "shake_y.rms": 0})
    assert dict(best.values) == pytest.approx(exact, rel=1e-6)
    assert best.success and best.runs < 60


@pytest.mark.parametrize("scale", some(SCALES, 2))
def test_pendulum_impact_absorber(scale: tuple[float, float, float]) -> None:
    case, exact, peak = absorber(*scale)
    bounds = {name: (x / 5, x * 5, "log") for name, x in exact.items()}
    best = kp.optimize(
        case, bounds, minimize="absorber.torque.peak", subject_to="pendulum.angle.max <= 0.4"
    )
    assert dict(best.values) == pytest.approx(exact, rel=1e-6)
    assert best.objective == pytest.approx(peak, rel=1e-6)
    assert best.runs < 40 and set(best.active) == {"pendulum.angle.max <= 0.4"}


@pytest.mark.parametrize("scale", some(SCALES[::-1], 2))
def test_spring_with_least_torque(scale: tuple[float, float, float]) -> None:
    case, exact = slider_crank(*scale)
    bounds = {"k": (exact["k"] / 10, exact["k"] * 10, "log"), "free": (0, scale[1])}
    best = kp.optimize(case, bounds, minimize="drive.effort.rms")
    assert dict(best.values) == pytest.approx(exact, rel=1e-6)
    assert best.runs < 80 and not best.active


@pytest.mark.parametrize("method", [None, "slsqp", "trust-constr"])
@pytest.mark.parametrize("scale", some(SCALES[1::-1], 1))
def test_balanced_lamp(scale: tuple[float, float, float], method: str | None) -> None:
    case, exact = lamp(*scale)
    bounds = {"k": (0, 10 * exact["k"]), "free": (-scale[1], scale[1])}
    best = kp.optimize(case, bounds, minimize="over.effort.rms", method=method)
    precise = 1e-4 if method == "trust-constr" else 1e-6
    assert best.values["k"] == pytest.approx(exact["k"], rel=precise)
    assert best.values["free"] == pytest.approx(0, abs=precise * scale[1])


def test_a_target_of_zero_takes_no_more_runs_than_a_minimum() -> None:
    """An rms has the shape of a cone at 0, where least squares of it are slow."""
    case, exact = lamp(1, 1, 9.81, n=9)
    bounds = {"k": (0, 10 * exact["k"]), "free": (-1, 1)}
    least = kp.optimize(case, bounds, minimize="over.effort.rms")
    found = kp.optimize(case, bounds, target={"over.effort.rms": 0})
    assert found.values["k"] == pytest.approx(exact["k"], rel=1e-6)
    assert found.runs <= least.runs < 40


#: Limits that the best lamp satisfies: they do not cut, end there, or have the size 0 there.
INACTIVE = ["k <= 2*{k}", "spring.force.peak <= {k}*{size}", "free >= 0"]


@pytest.mark.parametrize("limit", INACTIVE)
@pytest.mark.parametrize("scale", some(SCALES, 2))
def test_a_limit_takes_no_runs_where_the_residual_is_zero(
    scale: tuple[float, float, float], limit: str
) -> None:
    """What is left of the residual are rounding errors, whose search would never end."""
    case, exact = lamp(*scale, n=5)
    bounds = {"k": (0, 10 * exact["k"]), "free": (-scale[1], scale[1])}
    target = {"over.effort.max": 0, "over.effort.min": 0}
    text = limit.format(k=exact["k"], size=scale[1])
    free = kp.optimize(case, bounds, target=target)
    held = kp.optimize(case, bounds, target=target, subject_to=text)
    assert held.values["k"] == pytest.approx(exact["k"], rel=1e-8)
    assert abs(held.values["free"]) < 1e-8 * scale[1]
    assert held.success and held.runs <= free.runs + 2 and free.runs < 10


def test_a_limit_that_cuts_a_target() -> None:
    """The torque of a lamp is linear in k and in k times the free length: two known slopes."""
    for scale in SCALES:
        case, exact = lamp(*scale, n=5)
        bounds = {"k": (0, 10 * exact["k"])}
        case = case.with_parameters({"free": 0.0})
        short = f"k <= {0.5 * exact['k']}"
        best = kp.optimize(case, bounds, target={"over.effort.max": 0}, subject_to=short)
        weight = scale[0] * scale[2] * 0.8 * scale[1]  # half of it is left where the arm is level
        assert best.values["k"] == pytest.approx(0.5 * exact["k"], rel=1e-9)
        assert best.objective == pytest.approx(0.5 * weight, rel=1e-6) and best.runs < 10
        (gain,) = best.active.values()
        assert gain == pytest.approx(weight / exact["k"], rel=1e-6)


def test_lamp_by_evolution(monkeypatch: pytest.MonkeyPatch) -> None:
    case, exact = lamp(1, 1, 9.81, n=5)  # a search has hundreds of runs
    case = case.with_parameters({"free": 0.0})
    evolution: dict[str, Any] = {"method": "differential-evolution", "seed": 3}
    monkeypatch.setattr(search, "_GENERATIONS", 10)  # a parabola in one variable
    first, again = (
        kp.optimize(case, {"k": (0, 10 * exact["k"])}, minimize="over.effort.rms", **evolution)
        for _ in range(2)
    )
    assert first.values["k"] == pytest.approx(exact["k"], rel=1e-2)
    assert first.values == again.values


def test_a_target_with_a_formula() -> None:
    case, _ = lamp(1, 1, 9.81)
    best = kp.optimize(
        case, {"k": (10, 1000)}, target={"spring.force.min": -40.0}, subject_to="free >= 0"
    )
    assert best.measures["spring.force.min"] == pytest.approx(-40.0, rel=1e-6)
    assert best.objective < 1e-6


def test_multipliers_are_what_the_objective_gains(case: kp.Case) -> None:
    """Relax a bound and a limit, and search again."""

    def best(height: float, most: float) -> kp.Optimum:
        bounds = {"k": (50, most, "log"), "h": (0.05, 0.3)}
        return kp.optimize(case, bounds, minimize="over.effort.rms", subject_to=[f"h <= {height}"])

    tight = best(0.25, 150.0)
    assert set(tight.active) == {"h <= 0.25", "k <= 150"}
    gains = {
        "h <= 0.25": (tight.objective - best(0.251, 150.0).objective) / 1e-3,
        "k <= 150": (tight.objective - best(0.25, 150.5).objective) / 0.5,
    }
    assert dict(tight.active) == pytest.approx(gains, rel=2e-2)
    assert min(gains.values()) > 0


def test_maximum(case: kp.Case) -> None:
    """The largest effort between bounds; its multiplier is positive too."""
    best = kp.optimize(case, {"k": (50, 2000)}, maximize="over.effort.rms")
    assert best.objective == pytest.approx(best.measures["over.effort.rms"])
    assert best.values["k"] == 2000 and best.active["k <= 2000"] > 0
    more = kp.optimize(case, {"k": (50, 2001)}, maximize="over.effort.rms")
    assert more.objective - best.objective == pytest.approx(best.active["k <= 2000"], rel=1e-3)


def bumps(*heights: str) -> kp.Case:
    """A driven slide whose displacement has a peak of each height."""
    m = kp.Model("bumps", parameters={"a": 0.3, "b": 0.4})
    m.ground.points(O=(0, 0))
    m.body("slide", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slide.P")
    law = " + ".join(f"({of})*exp(-20*(t - {1 + 2 * k})^2)" for k, of in enumerate(heights))
    m.coordinate_driver("drive", "guide.displacement", value=law)
    return kp.Case(m, None, [kp.Kinematics(t_end=2.0 * len(heights), output_step=0.02)])


def test_an_optimum_where_peaks_are_equally_high() -> None:
    """Three planes meet in a corner, where the objective has no slope and limits no worth."""
    case = bumps("1 + a + 2*b", "3 - a", "2 - b + 0.2*a")
    bounds = {"a": (-1, 2), "b": (-1, 2)}
    best = kp.optimize(case, bounds, minimize="guide.displacement.max")
    assert best.objective == pytest.approx(23 / 11, rel=1e-6)
    assert list(best.values.values()) == pytest.approx([10 / 11, 1 / 11], abs=1e-4)
    assert best.active == {}
    best = kp.optimize(
        bumps("1 + a", "3 - a"), {"a": (-1, 2), "b": (0, 0.5)}, minimize="guide.displacement.max",
        subject_to="b >= 0.4",
    )  # fmt: skip
    assert best.objective == pytest.approx(2, rel=1e-6) and best.success
    assert all(np.isnan(gain) or gain == 0 for gain in best.active.values()), best.active


def test_parameters_with_formulas_follow_the_variables(case: kp.Case) -> None:
    """The limit is on a parameter that depends on a variable; its worth has the factor."""
    m = case.model.with_parameters({"weight": "2*h"})
    own = kp.Case(m, case._start, case.analyses)
    ask = {"minimize": "over.effort.rms"}
    bounds = {"k": (50, 2000, "log"), "h": (0.05, 0.3)}
    best = kp.optimize(own, bounds, subject_to="weight <= 0.5", **ask)
    plain = kp.optimize(case, bounds, subject_to="h <= 0.25", **ask)
    assert best.values["h"] == pytest.approx(0.25, rel=1e-9)
    assert best.active["weight <= 0.5"] == pytest.approx(plain.active["h <= 0.25"] / 2, rel=1e-6)


@pytest.mark.parametrize("log", [False, True])
def test_the_scale_of_a_variable(log: bool) -> None:
    from kempe.sweeps.problems.problem import Bound

    bound = Bound("k", 2.0, 50.0, log)
    for share in (0.0, 0.2, 0.7, 1.0):
        value = bound.at(share)
        assert bound.share(value) == pytest.approx(share, abs=1e-12)
        if 0 < share < 1:
            slope = (bound.at(share + 1e-6) - bound.at(share - 1e-6)) / 2e-6
            assert bound.rate(value) == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize("size", [1.0, 5.630834976715714])
def test_the_worth_of_a_limit_in_a_corner_with_a_bound(size: float) -> None:
    """A weight on two springs. With the second size, the search ends just beside the bound."""
    mass, gravity = 241.70342572414492, 8.693891694802746
    deep, aim, most = 0.36756215699717754, 0.8001662849112254, 0.8115836700442643
    unit, weight, scale = mass * gravity / size, 1.8103301680943928, 0.5539615512574806
    m = kp.Model("springs", gravity=(0, -gravity), parameters={"k": 1.3 * unit, "q": 0.9 * unit})
    m.ground.points(O=(0, 0))
    m.body("block", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "block.P", axes=(np.pi / 2, np.pi / 2))
    m.generalized_force("springs", "block.y", value="-(k+0.5*q)*block.y")
    case = kp.Case(m, {"set": {"block.y": -0.1 * size}}, [kp.Equilibrium()])
    best = kp.optimize(
        case,
        {"k": (unit * 0.05, most * unit), "q": (unit * 0.05, unit * 20)},
        minimize=f"{scale}*((k/{unit}-{aim})^2 + {weight}*(q/{unit}-{aim})^2)",
        subject_to=[f"block.y >= {-deep * size}"],
        starts=3,
    )
    # k + q/2 >= 1/deep in units of the weight over the size
    other = 2 * (1 / deep - most)
    limit = 4 * weight * scale * (other - aim)
    bound = limit - 2 * scale * (most - aim)
    assert best.values["k"] / unit == pytest.approx(most, rel=1e-6)
    assert best.values["q"] / unit == pytest.approx(other, rel=1e-5)
    worth, expected = sorted(best.active.values()), [limit / (deep**2 * size), bound / unit]
    assert worth == pytest.approx(sorted(expected), rel=1e-4)
