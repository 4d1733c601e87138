"""Instants of the player: more of them where forces change fast."""

import kempe as kp
import numpy as np
import pytest

G = 9.81


@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_short_impact_has_its_peak(mass: float, size: float) -> None:
    """A mass falls by h on a spring: the largest acceleration is g √(1 + 2 k h / (m g)).

    The contact lasts about a thousandth of the motion, less than an even interval.
    """
    time = (2.0 * size / G) ** 0.5
    stiffness = mass * (np.pi / (2e-3 * time)) ** 2
    m = kp.Model("ball", gravity=(0, -G))
    m.point_mass("ball", mass=mass)
    m.stop("floor", "ball.y", lower=0.0, stiffness=stiffness)
    sol = kp.dynamics(m, kp.assemble(m, set={"ball.x": 0, "ball.y": size}), t_end=2.0 * time)
    scene = kp.scene(sol)
    told = np.array(scene["frames"]["accelerations"])[:, 0, 1]
    peak = G * (1.0 + 2.0 * stiffness * size / (mass * G)) ** 0.5
    assert told.max() == pytest.approx(peak, rel=0.03)
    assert scene["accuracy"] <= 0.02
    assert len(scene["frames"]["t"]) < (1350 if size > 1.0 else 400)
    even = np.array(kp.scene(sol, frames=241)["frames"]["t"])
    np.testing.assert_allclose(np.diff(even), 2.0 * time / 240, rtol=1e-6)


@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_rounding_errors_need_no_instants(mass: float, size: float) -> None:
    """A crank with constant speed: its angular acceleration is zero, and so is a slide's torque."""
    m = kp.Model("yoke")
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=mass, length=size, ends=("O", "P"))
    m.revolute("pin", "ground.O", "crank.O")
    m.coordinate_driver("motor", "crank.angle", value="2*pi*t")
    scene = kp.scene(kp.dynamics(m, kp.assemble(m), t_end=2.0))
    assert len(scene["frames"]["t"]) == 241
    assert scene["accuracy"] < 1e-3
