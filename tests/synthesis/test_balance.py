"""Counterweights against Berkof and Lowen's conditions."""

import kempe as kp
import numpy as np
import pytest
from design_problems.machines import SCALES, four_bar


def measured(case: kp.Case) -> float:
    (motion,) = case.run().values()
    assert isinstance(motion, kp.Solution)
    return float(np.hypot(*kp.design.shaking(motion).force.T).max())


@pytest.mark.parametrize("scale", SCALES)
def test_counterweights_are_those_of_berkof_and_lowen(scale: tuple[float, float, float]) -> None:
    case, exact = four_bar(*scale)
    case = case.with_parameters({"front": 0.0, "rear": 0.0})
    found = kp.design.balance(case, on=["crank", "rocker"])
    for name, place in (("crank", "front"), ("rocker", "rear")):
        one = found.masses[name]
        assert one.mass * one.at[0] == pytest.approx(4.0 * scale[0] * exact[place], rel=1e-10)
        assert one.at[1] == pytest.approx(0.0, abs=1e-10 * scale[1])
    assert found.after < 1e-10 * found.before
    assert measured(found.case) < 1e-9 * found.before
    assert found.before == pytest.approx(measured(case), rel=1e-6)


def test_a_coupler_with_its_mass_beside_the_line_of_its_pins() -> None:
    """m1 r1 = m2 (r2 - b) a/b and m3 r3 = -m2 r2 c/b, as vectors in the frames of the links."""
    places = np.array([1.01 + 1.62j, 1.11 + 2.02j, 0.90 + 2.25j])
    poses = list(zip(places.real, places.imag, (0.82, 0.63, 0.45), strict=True))
    pivots = {"O": (0, 0), "D": (3, 0)}
    (one,) = kp.synthesis.motion(poses, pivots=pivots, defects="tell")
    found = kp.design.balance(one.case, radius=0.1)
    model = one.case.model.compile()
    o, a, b, d, _ = one.pins
    coupler = model.bodies["coupler"]
    start = one.case.start()
    turn = np.exp(1j * start["coupler.angle"])
    center = start["coupler.x"] + 1j * start["coupler.y"] + turn * complex(*coupler.center)
    ratio = (center - a) / (b - a)
    own = {"crank": (a - o, 1.0 - ratio, o), "rocker": (b - d, ratio, d)}
    for name, (link, share, pivot) in own.items():
        body = model.bodies[name]
        wanted = -(body.mass * 0.5 + coupler.mass * share) * link
        weight = found.masses[name]
        angle = np.exp(1j * start[f"{name}.angle"])
        at = start[f"{name}.x"] + 1j * start[f"{name}.y"] + angle * complex(*weight.at)
        assert weight.mass * (at - pivot) == pytest.approx(wanted, rel=1e-9)
        assert abs(at - pivot) == pytest.approx(0.1)
    assert found.after < 1e-10 * found.before


def test_one_counterweight_leaves_the_least_mean_square() -> None:
    case, _ = four_bar(1.0, 1.0, 1.0)
    case = case.with_parameters({"front": 0.0, "rear": 0.0})
    found = kp.design.balance(case, on=["crank"])
    assert set(found.masses) == {"crank"}
    assert 0.0 < found.after < found.before

    def mean(weight: float) -> float:
        shifted = case.with_parameters({"front": weight})
        (motion,) = shifted.run().values()
        assert isinstance(motion, kp.Solution)
        return float((kp.design.shaking(motion, fine=False).force[:-1] ** 2).mean())

    one = found.masses["crank"]
    best = one.mass * one.at[0] / 4.0
    assert mean(best) < min(mean(best + 0.02), mean(best - 0.02))


def test_wrong_requests_are_explained() -> None:
    case, _ = four_bar(1.0, 1.0, 1.0)
    with pytest.raises(kp.ModelError, match=r"coupler.*crank"):
        kp.design.balance(case, on=["coupler"])
    with pytest.raises(kp.ModelError, match="closed form"):
        kp.design.balance(case, of="torque")
    with pytest.raises(kp.ModelError, match=r"radius\.crank"):
        kp.design.balance(case, radius=0.0)
    with pytest.raises(kp.ModelError, match="no motion"):
        kp.design.balance(kp.Case(case.model))
