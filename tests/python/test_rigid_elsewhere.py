"""Stops and contacts with restitution outside of ``dynamics``: limits, or refused by name."""

from __future__ import annotations

import math
from collections.abc import Callable

import kempe as kp
import numpy as np
import pytest
from kempe.draw.scene import scene

#: Length of the arm, m, and its mass, kg.
SIZES = [(1e-3, 1e3), (1.0, 2.0), (1e3, 1e-3)]
RIGID = [{"restitution": 0}, {"restitution": 0.5}]


def arm(size: float = 1.0, mass: float = 2.0, **law: float) -> kp.Model:
    """A pendulum between two stops at ±45°."""
    m = kp.Model("arm", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=mass, length=size, ends=("O", "P"))
    m.revolute("J", "ground.O", "arm.O")
    m.stop("lim", "arm.angle", lower="-45 deg", upper="45 deg", **(law or {"restitution": 0}))
    return m


def crank(size: float) -> kp.Model:
    """A slider-crank, whose slider has a stop."""
    m = kp.Model("slider-crank", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length=size, ends=("O", "A"))
    m.bar("rod", mass=1, length=2.5 * size, ends=("A", "B"))
    m.body("slider", mass=1, inertia=1, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "slider.B")
    m.translational("slide", "ground.O", "slider.B")
    m.stop("lim", "slide.displacement", lower=2 * size, restitution=0.3)
    return m


def over_floor(size: float) -> kp.Model:
    """An arm above a floor, which its end touches at -30°."""
    m = kp.Model("arm over floor", gravity=(0, -9.81))
    m.ground.points(O=(0, size / 2))
    m.ground.curves(floor={"line": [[-5 * size, 0], [5 * size, 0]]})
    m.bar("arm", mass=1, length=size, ends=("O", "P"))
    m.revolute("J", "ground.O", "arm.O")
    m.contact("lim", "arm.P", "ground.floor", side="left", restitution=0.5)
    return m


@pytest.mark.parametrize(("size", "mass"), SIZES)
def test_a_stop_is_a_limit_of_motion(size: float, mass: float) -> None:
    m = arm(size, mass)
    found = kp.limits(m, kp.assemble(m, set={"arm.angle": 0.1}), over="arm.angle")
    assert [found.lower, found.upper] == pytest.approx([-math.pi / 4, math.pi / 4], abs=1e-12)
    assert any("cannot pass 45°: lim is reached" in reason for reason in found.reasons)
    m = crank(size)
    found = kp.limits(m, kp.assemble(m, set={"crank.angle": 0.2}), over="crank.angle")
    # law of cosines in the triangle of the crank 1, the rod 2.5 and the displacement 2
    at = math.acos((1 + 2**2 - 2.5**2) / (2 * 2))
    assert [found.lower, found.upper] == pytest.approx([-at, at], abs=1e-9)
    m = over_floor(size)
    found = kp.limits(m, kp.assemble(m, set={"arm.angle": 0.1}), over="arm.angle")
    assert [found.lower, found.upper] == pytest.approx([-math.pi / 6, 7 * math.pi / 6], abs=1e-9)


@pytest.mark.parametrize("analysis", [kp.kinematics, kp.inverse_dynamics])
@pytest.mark.parametrize(("size", "mass"), SIZES)
def test_a_driven_motion_ends_at_a_stop(
    analysis: Callable[..., kp.Solution], size: float, mass: float
) -> None:
    m = arm(size, mass)
    m.coordinate_driver("D", "arm.angle", value="-1.2*t")
    with pytest.raises(kp.SingularityError, match=r"cannot pass -45°: lim is reached") as caught:
        analysis(m, kp.assemble(m), t_end=1, output_step=0.1)
    assert caught.value.value == pytest.approx(math.pi / 4 / 1.2, abs=1e-12)
    found = caught.value.solution
    assert found.t == pytest.approx(np.arange(7) * 0.1)
    effort = 0.5 * mass * 9.81 * size * np.cos(found["arm.angle"])
    assert found["D.effort"] == pytest.approx(effort, rel=1e-9)
    start = kp.assemble(m, t=0.8)
    with pytest.raises(kp.AssemblyError, match="the state is beyond lim"):
        analysis(m, start, t_end=1)


def test_a_driven_motion_may_touch_a_stop() -> None:
    m = arm()
    m.coordinate_driver("D", "arm.angle", value="45*deg*cos(t)")
    found = kp.inverse_dynamics(m, kp.assemble(m), t_end=3, output_step=0.1)
    assert found.success and found["lim.gap"][0] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("law", RIGID)
@pytest.mark.parametrize(("size", "mass"), SIZES)
def test_a_state_that_presses_on_a_stop_is_refused(
    size: float, mass: float, law: dict[str, float]
) -> None:
    m = arm(size, mass, **law)
    for angle, speed in ((-45, 0), (-45, -1), (45, 1e-3), (-60, 0)):
        state = kp.assemble(m, set={"arm.angle": f"{angle} deg", "arm.omega": speed})
        assert state["lim.gap"] == pytest.approx(min(0, math.radians(angle + 45)), abs=1e-12)
        for quantity in ("arm.alpha", "J.fy"):
            with pytest.raises(kp.AssemblyError, match="lim"):
                state[quantity]
        with pytest.raises(kp.KempeError, match="lim"):
            kp.modes(m, state)
    # a state that leaves the stop, or is pulled away from it, has the accelerations of a pendulum
    for angle, speed in ((-45, 1), (45, 0), (45, -1), (0, 0)):
        state = kp.assemble(m, set={"arm.angle": f"{angle} deg", "arm.omega": speed})
        free = -1.5 * 9.81 / size * math.cos(math.radians(angle))
        assert state["arm.alpha"] == pytest.approx(free, rel=1e-9)


@pytest.mark.parametrize("law", RIGID)
def test_a_run_decides_what_a_state_cannot(law: dict[str, float]) -> None:
    m = arm(**law)
    run = kp.dynamics(m, kp.assemble(m, set={"arm.angle": "10 deg"}), t_end=30)
    held = 0.5 * 2 * 9.81 * math.cos(math.pi / 4)
    assert run["lim.torque"][-1] == pytest.approx(held, rel=1e-9)
    assert run["arm.alpha"][-1] == pytest.approx(0, abs=1e-9)
    with pytest.raises(kp.KempeError, match="lim"):
        kp.modes(m, run.final)
    for start in (run.final, run.initial):
        with pytest.raises(kp.ModelError, match=r"forces\.lim: .* come to rest beyond it"):
            kp.equilibrium(m, start)
    soft = arm(stiffness=1e6)
    state = kp.equilibrium(soft, kp.assemble(soft, set={"arm.angle": "10 deg"})).state
    assert state["lim.torque"] == pytest.approx(held, rel=1e-4)


def test_a_state_that_presses_on_a_stop_is_drawn_without_arrows() -> None:
    m = arm()
    drawn, free = (
        np.ravel(scene(kp.assemble(m, set={"arm.angle": f"{at} deg"}))["frames"]["accelerations"])
        for at in (-45, 45)
    )
    assert not drawn.any()
    assert free[-1] == pytest.approx(-1.5 * 9.81 / math.sqrt(2), rel=1e-6)
