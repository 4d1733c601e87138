"""Slopes where several changes fall together, and where a value is stationary at the start."""

import kempe as kp
import numpy as np
import pytest

EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)


def pair(acts: float) -> kp.Case:
    """Two balls that reach the floor at one time; a force that is zero acts on the second one."""
    numbers = {"g": 9.0, "h": 2.0, "K": 1e9, "acts": acts}
    m = kp.Model("pair", gravity=(0, "-g"), parameters=numbers)
    for name in ("one", "two"):
        m.body(name, mass=1.0, inertia=1.0)
        m.stop(f"{name}_floor", f"{name}.y", lower=0.0, restitution=0.5)
    m.generalized_force("lifts", "two.y", value="acts * (K - 1e9) * 1e-9")
    start = {"one.y": "h", "two.y": "h"}
    return kp.Case(m, {"set": start}, [kp.Dynamics(t_end=0.9, method=EXACT)])


def test_changes_that_fall_together_must_move_together_with_each_variable() -> None:
    # the time changes by 0.17 s/m with h, and by 4e-11 s per unit of K: each must agree for itself
    g = kp.gradient(pair(1.0), ["two.y.final"], ["h", "K"])
    remark = g.remarks["two.y.final", "h"]
    assert "one_floor.hit" in remark and "two_floor.hit" in remark, remark
    assert np.isnan(g.jacobian).all()


def test_changes_that_move_together_have_slopes() -> None:
    g = kp.gradient(pair(0.0), ["two.y.final", "one.y.final"], ["h", "K"])
    t, fall, e = 0.9, np.sqrt(2 * 2.0 / 9.0), 0.5
    # y = e g fall (t - fall) - g (t - fall)² / 2
    by_fall = e * 9.0 * (t - 2 * fall) + 9.0 * (t - fall)
    expected = [by_fall / (9.0 * fall), 0.0]
    assert g.remarks == {}
    np.testing.assert_allclose(g.jacobian, [expected, expected], rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_maximum_at_a_start_at_rest(size: float) -> None:
    m = kp.Model("pendulum", gravity=(0, "-g"), parameters={"g": 9.0, "L": size, "c": 0.1})
    m.ground.points(O=(0, 0))
    m.body("rod", mass=1.0, inertia=0.0, points={"A": (0, "L")})
    m.revolute("A", "ground.O", "rod.A")
    m.generalized_force("air", "rod.angle", value="-c * L^2 * rod.omega")
    start = {"rod.angle": 1.0}
    run = kp.Dynamics(t_end=3.0 * np.sqrt(size), method=EXACT)
    case = kp.Case(m, {"set": start}, [run])
    g = kp.gradient(case, ["rod.angle.max", "rod.angle.t_max"], ["g", "L", "c", "rod.angle"])
    # it swings back to less than the angle from which it was released
    np.testing.assert_allclose(g.jacobian[0], [0.0, 0.0, 0.0, 1.0], atol=1e-12)
    assert "stationary" in g.remarks["rod.angle.t_max", "L"]


@pytest.mark.parametrize("size", [1e-2, 0.1, 1.0, 30.0])
@pytest.mark.parametrize("angle", [0.1, 1.0, 2.5])
def test_a_point_mass_on_a_rod(size: float, angle: float) -> None:
    # the angle depends on g / L alone, so that L dθ/dL = -g dθ/dg
    m = kp.Model("pendulum", gravity=(0, "-g"), parameters={"g": 9.0, "L": size})
    m.ground.points(O=(0, 0))
    m.body("rod", mass=0.3, inertia=0.0, points={"A": (0, "L")})
    m.revolute("A", "ground.O", "rod.A")
    case = kp.Case(m, {"set": {"rod.angle": angle}}, [kp.Dynamics(t_end=np.sqrt(size))])
    g = kp.gradient(case, ["rod.angle.final"], ["g", "L"])
    by_g, by_size = g.jacobian[0]
    assert size * by_size == pytest.approx(-9.0 * by_g, rel=1e-6)
