"""A stiff contact of a light body by every method, against the closed form of Hertz."""

from __future__ import annotations

from typing import Any

import kempe as kp
import pytest

MASS, SPEED, STIFFNESS = 0.01, 3.0, 1e9
DEPTH = (1.25 * MASS * SPEED**2 / STIFFNESS) ** 0.4
LASTS = 2.943275 * DEPTH / SPEED


def model(stop: bool = False) -> tuple[kp.Model, kp.State]:
    """A point that arrives at a floor with 3 m/s after 0.1 s."""
    m = kp.Model("point and floor")
    m.point_mass("ball", mass=MASS)
    if stop:
        m.stop("touch", "ball.y", lower=0, stiffness=STIFFNESS, exponent=1.5)
    else:
        m.ground.curves(floor={"line": ((1, 0), (-1, 0))})
        m.contact("touch", "ball.P", "ground.floor", stiffness=STIFFNESS)
    start = kp.assemble(m, set={"ball.x": 0, "ball.y": 0.1 * SPEED, "ball.vy": -SPEED})
    return m, start


@pytest.mark.parametrize("stop", [False, True])
@pytest.mark.parametrize(
    "method", [kp.RK45(), kp.DOP853(), kp.Radau(), kp.Auto(), kp.GeneralizedAlpha()]
)
def test_methods_that_choose_their_steps(method: Any, stop: bool) -> None:
    m, start = model(stop)
    sol = kp.dynamics(m, start, t_end=0.2, method=method, output_step=0.05)
    hit, release = sol.events["touch.hit"].t, sol.events["touch.release"].t
    assert hit == pytest.approx([0.1], rel=1e-6)
    assert release - hit == pytest.approx([LASTS], rel=1e-3)
    assert sol["ball.vy"][-1] == pytest.approx(SPEED, rel=1e-3)


@pytest.mark.parametrize("stop", [False, True])
@pytest.mark.parametrize("method", [kp.RK4, kp.RK45, kp.DOP853])
def test_constant_steps_that_are_too_long_are_refused(method: Any, stop: bool) -> None:
    m, start = model(stop)
    with pytest.raises(kp.IntegrationError, match="too long for touch") as caught:
        kp.dynamics(m, start, t_end=0.2, method=method(step=0.12 * LASTS))
    assert "at t = 0.100000 s and does so for about 1.0e-4 s" in str(caught.value)
    # the remedy
    sol = kp.dynamics(m, start, t_end=0.2, method=method(step=0.09 * LASTS))
    assert sol["ball.vy"][-1] == pytest.approx(SPEED, rel=1e-3)


def test_the_mass_of_a_contact_is_that_of_the_mechanism() -> None:
    """A rod on a pin that meets a stop with its tip: J/l² in place of the mass."""
    m = kp.Model("rod and stop")
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=3 * MASS, length=2, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    m.stop("touch", "rod.P.y", lower=0, stiffness=STIFFNESS, exponent=1.5)
    start = kp.assemble(m, set={"rod.angle": 0.001, "rod.omega": -0.5 * SPEED})
    for step in (0.12, 0.09):
        if step > 0.1:
            with pytest.raises(kp.IntegrationError, match=r"about 1\.0e-4 s"):
                kp.dynamics(m, start, t_end=0.002, method=kp.RK4(step=step * LASTS))
        else:
            sol = kp.dynamics(m, start, t_end=0.002, method=kp.RK4(step=step * LASTS))
            assert sol["rod.omega"][-1] == pytest.approx(0.5 * SPEED, rel=1e-3)


@pytest.mark.parametrize("other", [False, True])
def test_an_upper_limit_is_met_as_a_lower_one(other: bool) -> None:
    """The same motion in a mirror takes as many steps; the other limit is not met."""

    def run(sign: float) -> kp.Solution:
        m = kp.Model("point and limits")
        m.point_mass("ball", mass=MASS)
        limits = {"lower" if sign > 0 else "upper": 0.0}
        if other:
            limits["upper" if sign > 0 else "lower"] = sign
        m.stop("touch", "ball.y", **limits, stiffness=STIFFNESS, exponent=1.5)
        given = {"ball.x": 0, "ball.y": sign * 0.1 * SPEED, "ball.vy": -sign * SPEED}
        return kp.dynamics(m, kp.assemble(m, set=given), t_end=0.2, output_step=0.05)

    up, down = run(1.0), run(-1.0)
    assert up.statistics["steps"] == down.statistics["steps"]
    assert up["ball.y"] == pytest.approx(-down["ball.y"], abs=1e-12)
    assert abs(down.energy.balance).max() < 1e-7
