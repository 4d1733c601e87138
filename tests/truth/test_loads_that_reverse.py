"""Friction whose load passes zero while it slides: the bend of its magnitude is located."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose

#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e2, 0.01)]
MU, RATE, END = 0.15, 1.7, 6.0


def total(most: float, amplitude: float, bias: float = 0.0) -> float:
    """∫ |bias + amplitude cos(RATE t)| dt from 0 to `most`."""
    first = np.arccos(-bias / amplitude)
    zeros = [(s * first + 2 * np.pi * k) / RATE for k in range(9) for s in (1, -1)]
    bounds = [0.0, *sorted(t for t in zeros if 0 < t < most), most]
    area = [bias * t + amplitude / RATE * np.sin(RATE * t) for t in bounds]
    return float(np.abs(np.diff(area)).sum())


def rolling(scale: tuple[float, float, float]) -> tuple[kp.Model, kp.State]:
    """A wheel on a plate that shakes so much that it lifts the wheel and pulls it down."""
    mass, size, rate = scale
    m = kp.Model("plate", gravity=(0, -size * rate**2), parameters={"s": size, "w": rate, "mu": MU})
    m.body("plate", mass=mass, inertia=mass * size**2, points={"O": (0, 0)})
    m.body("wheel", mass=mass, inertia=0.4 * mass * size**2, points={"C": (0, 0)})
    m.rolling("road", "plate.O", "wheel.C", radius="s", friction="mu")
    m.coordinate_driver("turn", "plate.angle", value=0)
    m.coordinate_driver("along", "plate.x", value="-9*s*w*t")
    m.coordinate_driver("up", "plate.y", value=f"0.9*s*cos({RATE}*w*t)")
    return m, kp.assemble(m, {"wheel.x": 0, "wheel.vx": 0, "wheel.angle": 0, "wheel.omega": 0})


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("method", [kp.DOP853(rtol=1e-6), kp.RK45(rtol=1e-6), kp.Radau(rtol=1e-6)])
def test_a_wheel_that_slips_under_a_load_that_reverses(
    scale: tuple[float, float, float], method: Any
) -> None:
    mass, size, rate = scale
    m, start = rolling(scale)
    sol = kp.dynamics(m, start, t_end=END / rate, method=method)
    # the load is m g - 0.9 m RATE² cos(RATE t)
    impulse = MU * total(END, -0.9 * RATE**2, 1.0)
    assert_allclose(sol["wheel.vx"][-1], -impulse * size * rate, rtol=1e-7)
    assert_allclose(sol["wheel.omega"][-1], -impulse / 0.4 * rate, rtol=1e-7)
    assert not sol.events["road.stick"].t.size
    # the friction takes what the drivers give and the wheel does not have
    heat = sol.dissipated("road")
    assert_allclose(heat, sol.energy.dissipated, rtol=1e-6, atol=1e-9 * heat[-1])
    assert_allclose(sol["road.dissipated"], heat)
    own = mass * size**2 * rate**2 * (9 * impulse - 0.5 * impulse**2 * (1 + 1 / 0.4))
    assert_allclose(heat[-1], own, rtol=1e-6)


def sliding(
    scale: tuple[float, float, float], joint: str, guide: float
) -> tuple[kp.Model, kp.State]:
    """A body in a slide, with a force across it that outweighs its weight at times."""
    mass, size, rate = scale
    force = mass * size * rate**2
    given = {"s": size, "w": rate, "F": force, "mu": MU}
    m = kp.Model("slide", gravity=(0, -size * rate**2), parameters=given)
    m.ground.points(O=(0, 0))
    m.body("body", mass=mass, inertia=mass * size**2, points={"C": (0, 0), "E": (size, 0)})
    getattr(m, joint)("slide", "ground.O", "body.C")
    m.force("across", "body.C", force=("0", f"2*F*cos({RATE}*w*t)"))
    if joint == "pin_in_slot":
        m.coordinate_driver("turn", "body.angle", value=0)
        m.friction("rub", "slide", kinetic="mu")
    else:
        # the torque loads the guide more than the force for a part of the time
        m.torque("tilt", "body", torque=f"0.35*F*s*{int(guide > 0)}")
        m.friction("rub", "slide", kinetic="mu", guide=guide * size)
    return m, kp.assemble(m, {"body.x": 0, "body.vx": 9 * size * rate})


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize(
    ("joint", "guide"), [("translational", 0.0), ("translational", 0.5), ("pin_in_slot", 0.0)]
)
def test_a_slide_whose_load_bends(
    scale: tuple[float, float, float], joint: str, guide: float
) -> None:
    _, size, rate = scale
    m, start = sliding(scale, joint, guide)
    sol = kp.dynamics(m, start, t_end=END / rate, method=kp.DOP853(rtol=1e-6))
    load = total(END, 2.0, -1.0)
    if guide:
        # the load is max(|force|, 2 torque / guide)
        fine = np.linspace(0, END, 2_000_001)
        force = np.abs(2 * np.cos(RATE * fine) - 1)
        load = np.trapezoid(np.maximum(force, 2 * 0.35 / guide), fine)
    assert_allclose(sol["body.vx"][-1], (9 - MU * load) * size * rate, rtol=1e-7)


@pytest.mark.parametrize("make", [rolling, lambda scale: sliding(scale, "translational", 0.5)])
def test_slopes_of_a_load_that_reverses(make: Any) -> None:
    m, start = make(SCALES[0])
    wheel = "wheel" in m.compile().bodies
    quantity = "wheel.vx" if wheel else "body.vx"
    sol = kp.dynamics(m, start, t_end=END, slopes=["mu"], method=kp.DOP853(rtol=1e-9))
    change = sol[quantity][-1] - (0 if wheel else 9)
    # the change of the velocity is in proportion to the friction
    assert_allclose(sol.slope(quantity, "mu")[-1], change / MU, rtol=1e-6)
