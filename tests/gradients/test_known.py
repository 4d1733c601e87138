"""Derivatives where small errors of the run grow."""

import re
import warnings

import kempe as kp
import numpy as np
import pytest

#: Relative tolerances of a run whose errors grow too large, and of one that is accurate.
RTOL = (1e-6, 1e-11)
TIGHT = {"type": "dop853", "rtol": 1e-11, "atol": 1e-14}


def double_pendulum(t_end: float, rtol: float) -> kp.Case:
    """Two rods that fall from a horizontal position; small changes grow by e in 0.2 s."""
    m = kp.Model(
        "double pendulum", gravity=(0, -9.81), parameters={"L": 1.0, "m": 1.0, "T": "0.3 s"}
    )
    m.ground.points(O=(0, 0))
    m.bar("first", mass="m", length="L", ends=("O", "P"))
    m.bar("second", mass=1, length=1, ends=("P", "Q"))
    m.revolute("O", "ground.O", "first.O")
    m.revolute("P", "first.P", "second.P")
    start = {"first.angle": 0.3, "second.angle": 1.2}
    run = kp.Dynamics(t_end=t_end, output_step=0.1, method=kp.DOP853(rtol=rtol, atol=1e-3 * rtol))
    return kp.Case(m, {"set": start}, [run])


def hammer(rtol: float) -> kp.Case:
    """A rod on a pin that hits a stop three times."""
    m = kp.Model("hammer", gravity=(0, -9.81), parameters={"L": 1.0, "k": 3.0, "e": 0.9})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length="L", ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.stop("S", "rod.angle", lower=-1.6, restitution="e")
    run = kp.Dynamics(t_end=3, output_step=0.1, method=kp.RK45(rtol=rtol, atol=1e-3 * rtol))
    return kp.Case(m, {"set": {"rod.angle": 0.2}}, [run])


def gradient(case: kp.Case, measure: str, variables: list[str]) -> kp.Gradient:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return kp.gradient(case, [measure], variables)


def told(g: kp.Gradient) -> float:
    """The error of the run that a remark states."""
    found = re.search(r"known to ([\d.e+-]+) of", next(iter(g.remarks.values())))
    assert found is not None, g.remarks
    return float(found[1])


@pytest.mark.parametrize("variables", [["L"], ["L", "m", "second.angle"]])
def test_the_error_of_a_run_is_told(variables: list[str]) -> None:
    measure = "second.angle.final"
    loose, tight = (gradient(double_pendulum(8, rtol), measure, variables) for rtol in RTOL)
    assert not tight.remarks and len(loose.remarks) == len(variables)
    off = abs(loose.measures[measure] - tight.measures[measure])
    assert 0.3 * off < told(loose) < 3 * off
    change = np.abs(loose.jacobian / tight.jacobian - 1)
    assert (change > 0.01).all() and (change < 3 * off).all()


def test_a_motion_that_is_not_known_has_no_derivatives() -> None:
    case = double_pendulum(12, RTOL[0])
    g = gradient(case, "second.angle.final", ["L", "second.omega"])
    assert np.isnan(g.jacobian).all() and np.isfinite(g.measures["second.angle.final"])
    assert "the motion is not known at t = 12.000000 s" in g.remarks["second.angle.final", "L"]


def test_what_lies_before_it_has_derivatives() -> None:
    case = double_pendulum(12, RTOL[0])
    early, whole = (
        gradient(one, "exp(-t/T)*first.omega.min", ["L"])
        for one in (case.with_analysis("dynamics", t_end=1), case)
    )
    assert not whole.remarks and whole.measures == pytest.approx(early.measures)
    assert whole.jacobian == pytest.approx(early.jacobian, rel=1e-5)


def test_errors_are_followed_through_impacts() -> None:
    measure = "rod.angle.final"
    loose, tight = (gradient(hammer(rtol), measure, ["L", "e"]) for rtol in (2e-3, 1e-12))
    off = abs(loose.measures[measure] - tight.measures[measure])
    assert not tight.remarks and off > 1e-3
    assert 0.3 * off < told(loose) < 3 * off


def test_the_next_analysis_begins_with_the_error() -> None:
    first = double_pendulum(7, RTOL[0])
    short = {"from": "dynamics", "t_end": 8}
    both = kp.Case(first.model, first.tree()["start"], {
        **first.analyses, "after": {**first.analyses["dynamics"], **short, "method": TIGHT}
    })  # fmt: skip
    whole = gradient(double_pendulum(8, RTOL[0]), "second.angle.final", ["L"])
    assert 0.3 * told(whole) < told(gradient(both, "second.angle.final", ["L"])) < 3 * told(whole)
