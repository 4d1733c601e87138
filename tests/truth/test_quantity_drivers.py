"""Cylinders, couplings and drivers of quantities against equations that are derived by hand."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest

G = 9.81


def boom(length: str, *, joint: bool) -> kp.Model:
    """A boom of 1 m, pinned at the origin, that a cylinder at (0.5, -0.2) lifts by its tip."""
    m = kp.Model("boom", gravity=(0, -G))
    m.ground.points(O=(0, 0), G=(0.5, -0.2))
    m.bar("boom", mass=20, length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "boom.O")
    if joint:
        m.distance("cylinder", "ground.G", "boom.P", length=length)
    else:
        m.spring_damper("line", "ground.G", "boom.P")
        m.coordinate_driver("cylinder", "line.length", value=length)
    return m


@pytest.mark.parametrize("joint", [True, False])
def test_a_cylinder_turns_through_its_vertical_position(joint: bool) -> None:
    """l² = 1 + b² - 2 b cos ψ with b the distance of the pivots and ψ the angle between."""
    b, beta = np.hypot(0.5, 0.2), np.arctan2(-0.2, 0.5)
    start_angle, rate = np.arcsin(-0.2), 0.35  # horizontal at the start
    first = float(np.sqrt(1 + b * b - 2 * b * np.cos(start_angle - beta)))
    m = boom(f"{first!r} + {rate}*t", joint=joint)
    start = kp.assemble(m, guess={"boom.angle": start_angle})
    sol = kp.dynamics(m, start, t_end=2, output_step=0.01, method=kp.DOP853(rtol=1e-12))

    length = first + rate * sol.t
    psi = np.arccos((1 + b * b - length**2) / (2 * b))
    omega = length * rate / (b * np.sin(psi))
    alpha = (rate**2 - b * np.cos(psi) * omega**2) / (b * np.sin(psi))
    theta = psi + beta
    tip = np.array([np.cos(theta), np.sin(theta)])
    along = (tip - np.array([[0.5], [-0.2]])) / length
    # J α = push × arm - weight × lever, about O
    arm = tip[0] * along[1] - tip[1] * along[0]
    push = (20 / 3 * alpha + 20 * G * 0.5 * np.cos(theta)) / arm
    assert along[1][0] == pytest.approx(0, abs=1e-12)  # from horizontal …
    assert along[0].max() > 0.5 and along[0].min() < 0  # … through vertical

    np.testing.assert_allclose(sol["boom.angle"], theta, rtol=1e-10)
    np.testing.assert_allclose(sol["O.alpha"], alpha, rtol=1e-10)
    found = -sol["cylinder.tension"] if joint else sol["cylinder.effort"]
    np.testing.assert_allclose(found, push, rtol=1e-10)
    center = 0.5 * (alpha * np.array([-tip[1], tip[0]]) - omega**2 * tip)
    pin = 20 * (center + np.array([[0], [G]])) - push * along
    np.testing.assert_allclose(
        sol["O"].force(on="boom").T, pin, rtol=1e-10, atol=1e-10 * push.max()
    )
    if not joint:
        np.testing.assert_allclose(sol["cylinder.power"], push * rate, rtol=1e-10)


def test_two_pendulums_joined_by_a_coupling() -> None:
    """(J1 + J2 n²) α1 = M1 + n M2 with φ2 = n φ1."""
    n, bars = -2.5, (("first", 3.0, 1.2, "O"), ("second", 1.5, 0.8, "P"))
    m = kp.Model("pendulums", gravity=(0, -G), parameters={"n": n})
    m.ground.points(O=(0, 0), P=(2, 0))
    for name, mass, length, at in bars:
        m.bar(name, mass=mass, length=length, ends=("A", "B"))
        m.revolute(at, f"ground.{at}", f"{name}.A")
    m.coupling("ratio", terms={"O.angle": "n", "second.angle": -1})
    start = kp.assemble(m, set={"first.angle": 0.3})
    sol = kp.dynamics(m, start, t_end=3, output_step=0.01, method=kp.DOP853(rtol=1e-12))

    angles = sol["first.angle"], sol["second.angle"]
    inertias = [mass * length**2 / 3 for _, mass, length, _ in bars]
    moments = [
        -mass * G * length / 2 * np.cos(angle)
        for (_, mass, length, _), angle in zip(bars, angles, strict=True)
    ]
    alpha = (moments[0] + n * moments[1]) / (inertias[0] + n**2 * inertias[1])
    np.testing.assert_allclose(angles[1], n * angles[0], rtol=0, atol=1e-10)
    np.testing.assert_allclose(sol["O.alpha"], alpha, rtol=1e-10, atol=1e-10)
    on_second = inertias[1] * n * alpha - moments[1]
    np.testing.assert_allclose(sol["ratio"].torque(on="second"), on_second, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(
        sol["ratio"].torque(on="first"), -n * on_second, rtol=1e-9, atol=1e-9
    )
    scale = sol["energy.kinetic"].max()
    assert sol["energy.total"] == pytest.approx(sol["energy.total"][0], abs=1e-9 * scale)
    assert np.ptp(angles[0]) > 0.5


def test_a_motor_in_a_joint_turns_both_bodies_apart() -> None:
    """Two free wheels on one pin: the effort of the relative drive accelerates both."""
    m = kp.Model("wheels")
    m.ground.points(O=(0, 0))
    for name, inertia in (("rotor", 2.0), ("stator", 3.0)):
        m.body(name, mass=1, inertia=inertia, points={"C": (0, 0)})
    m.revolute("mount", "ground.O", "stator.C")
    m.revolute("shaft", "stator.C", "rotor.C")
    m.coordinate_driver("motor", "shaft.angle", value="2*t^2")
    start = kp.assemble(m)
    sol = kp.dynamics(m, start, t_end=1, output_step=0.1)
    effort = 4 / (1 / 2.0 + 1 / 3.0)  # α = 4 rad/s² between them
    assert sol["motor.effort"] == pytest.approx(effort, rel=1e-12)
    assert sol["rotor.alpha"] == pytest.approx(effort / 2, rel=1e-12)
    assert sol["stator.alpha"] == pytest.approx(-effort / 3, rel=1e-12)
    assert sol["motor"].torque(on="rotor") == pytest.approx(effort, rel=1e-12)
    assert sol["motor"].torque(on="stator") == pytest.approx(-effort, rel=1e-12)
    assert sol["motor.power"] == pytest.approx(effort * 4 * sol.t, rel=1e-9, abs=1e-9)
    assert sol["energy.work"][-1] == pytest.approx(effort * 2, rel=1e-8)
