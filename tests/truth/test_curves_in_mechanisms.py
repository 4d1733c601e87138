"""Mechanisms whose bodies touch along their curves: a cam, a ratchet, a Geneva drive."""

from typing import Any

import kempe as kp
import numpy as np
import pytest

G = 9.81
#: Masses and sizes.
SCALES = [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3)]


def scaled(corners: Any, size: float) -> list[tuple[float, float]]:
    return [(float(x) * size, float(y) * size) for x, y in corners]


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_a_hexagon_lifts_a_flat_follower(mass: float, size: float) -> None:
    m = kp.Model("cam", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    hexagon = [(np.cos(a), np.sin(a)) for a in np.pi / 3 * np.arange(6)]
    rim = {"polygon": scaled(hexagon, size)}
    inertia = mass * size**2
    m.body("cam", mass=mass, inertia=inertia, points={"C": (0, 0)}, curves={"rim": rim})
    face = {"line": ((-3 * size, 0), (3 * size, 0))}
    m.body("plate", mass=mass, inertia=inertia, points={"P": (0, 0)}, curves={"face": face})
    m.revolute("pivot", "ground.O", "cam.C")
    m.translational("guide", "ground.O", "plate.P", axes=(np.pi / 2, np.pi / 2))
    rate = 0.3 / np.sqrt(size)
    m.coordinate_driver("drive", "pivot.angle", value=f"pi/2 + {rate}*t")
    m.contact("lift", curves=["cam.rim", "plate.face"], restitution=0)
    sol = kp.dynamics(m, kp.assemble(m, set={"plate.y": size}), t_end=2.2 / rate)
    angle = np.pi / 2 + rate * sol.t[:, None] + np.pi / 3 * np.arange(6)
    assert sol["plate.y"] == pytest.approx(size * np.sin(angle).max(axis=1), rel=1e-7)
    # the plate hits the next corner where both are level
    level = (np.pi / 6 + np.pi / 3 * np.arange(2)) / rate
    assert sol.events["lift.hit"].t == pytest.approx(level, rel=1e-7)


def ratchet(mass: float, size: float, load: float) -> kp.Model:
    """A wheel with twelve teeth, and a pawl that its weight turns into them.

    The radial flanks of the teeth look in the sense of falling angles.
    """
    m = kp.Model("ratchet", gravity=(0, -G))
    m.ground.points(O=(0, 0), A=(1.6 * size, 1.01 * size))
    angles = np.pi / 6 * np.arange(12)
    teeth = [(r * np.cos(a), r * np.sin(a)) for a in angles for r in (0.8, 1)]
    rim = {"polygon": scaled(teeth, size)}
    inertia = mass * size**2 / 2
    m.body("wheel", mass=mass, inertia=inertia, points={"C": (0, 0)}, curves={"rim": rim})
    nose = [(-1.6, -0.21), (-1.3, -0.02), (0, -0.04), (0, 0.06), (-1.5, 0.04)]
    m.body(
        "pawl",
        mass=0.1 * mass,
        inertia=0.03 * mass * size**2,
        center=(-0.8 * size, 0),
        points={"C": (0, 0)},
        curves={"nose": {"polygon": scaled(nose, size)}},
    )
    m.revolute("axle", "ground.O", "wheel.C")
    m.revolute("hinge", "ground.A", "pawl.C")
    m.torque("load", "wheel", torque=load * mass * G * size)
    m.contact("catch", curves=["pawl.nose", "wheel.rim"], restitution=0)
    return m


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_a_pawl_catches_a_tooth(mass: float, size: float) -> None:
    """It rests in the root of a tooth, on both flanks: statics gives both forces."""
    load = 0.5
    m = ratchet(mass, size, -load)
    start = kp.assemble(m, set={"wheel.angle": 0.2, "pawl.angle": -0.1})
    sol = kp.dynamics(m, start, t_end=3 * np.sqrt(size))
    assert sol["wheel.angle"][-1] == pytest.approx(0, abs=1e-8)
    assert sol["pawl.angle"][-1] == pytest.approx(0, abs=1e-8)
    # at (0, 0.8): the radial flank pushes the pawl along x, the other along its normal
    root, tip = np.array([0, 0.8]), np.array([np.cos(np.pi * 2 / 3), np.sin(np.pi * 2 / 3)])
    other = tip - np.array([0.8 * np.cos(2 * np.pi / 3), 0.8 * np.sin(2 * np.pi / 3)])
    assert other @ tip > 0
    before = np.array([np.cos(np.pi / 3), np.sin(np.pi / 3)])  # the tip of the tooth before
    slope = root - before
    normal = np.array([slope[1], -slope[0]]) / np.linalg.norm(slope)
    pushes = [np.array([1.0, 0.0]), normal if normal[1] > 0 else -normal]
    arms = [root, root - [1.6, 1.01]]

    def torque(arm: Any, force: Any) -> float:
        return float(arm[0] * force[1] - arm[1] * force[0])

    moments = [
        [sign * torque(arm, push) for push in pushes]
        for sign, arm in zip((-1, 1), arms, strict=False)
    ]
    flanks = np.linalg.solve(moments, [load, -0.1 * 0.8])
    force = sum(f * push for f, push in zip(flanks, pushes, strict=True)) * mass * G
    assert sol["catch"].force(on="pawl")[-1] == pytest.approx(force, rel=1e-6)
    assert sol["catch.force"][-1] == pytest.approx(flanks.sum() * mass * G, rel=1e-6)
    assert (flanks > 0).all()


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_teeth_pass_below_a_pawl(mass: float, size: float) -> None:
    """In the other sense, each tooth lifts the pawl."""
    m = ratchet(mass, size, 0.1)
    start = kp.assemble(m, set={"wheel.angle": 0.01, "pawl.angle": -0.01})
    sol = kp.dynamics(m, start, t_end=9 * np.sqrt(size), stop="wheel.angle > pi")
    assert sol["wheel.angle"][-1] == pytest.approx(np.pi, rel=1e-9)
    high = np.hypot(*(np.array([[1.6], [1.01]]) * size + corner(sol, size)))
    assert high.max() > 0.99 * size
    assert high.min() > 0.8 * size * np.cos(np.pi / 6) * 0.9
    assert len(sol.events["catch.hit"].t) >= 6
    assert sol["catch.gap"].min() > -1e-9 * size
    assert np.ptp(sol.energy.balance) < 1e-7 * mass * G * size


def corner(sol: kp.Solution, size: float) -> Any:
    """The sharp corner of the pawl from its hinge."""
    angle = sol["pawl.angle"]
    x, y = -1.6 * size, -0.21 * size
    return np.array([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)])


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_a_geneva_drive_indexes(mass: float, size: float) -> None:
    """A pin in one of four radial slots turns the wheel by a right angle."""
    m = kp.Model("geneva")
    m.ground.points(O=(0, 0), A=(np.sqrt(2) * size, 0))
    play = 1e-3
    half, deep = 0.1 + play, np.sqrt(2) - 1 - 0.1 - 0.02
    arm = np.array([(1, half), (deep, half), (deep, -half), (1, -half)])
    arm = arm[::-1]
    corners = []
    for k in range(4):
        c, s = np.cos(k * np.pi / 2), np.sin(k * np.pi / 2)
        corners += [(c * x - s * y, s * x + c * y) for x, y in arm]
    m.body(
        "wheel",
        mass=mass,
        inertia=mass * size**2,
        points={"C": (0, 0)},
        curves={"rim": {"polygon": scaled(corners, size)}},
    )
    pin = {"circle": (size, 0, 0.1 * size)}
    inertia = mass * size**2
    m.body("crank", mass=mass, inertia=inertia, points={"C": (0, 0)}, curves={"pin": pin})
    m.revolute("axle", "ground.O", "wheel.C")
    m.revolute("shaft", "ground.A", "crank.C")
    rate = 1 / np.sqrt(size)
    m.coordinate_driver("motor", "crank.angle", value=f"{0.76 * np.pi} + {rate}*t")
    m.contact("slot", curves=["crank.pin", "wheel.rim"], restitution=0)
    start = kp.assemble(m, set={"wheel.angle": -np.pi / 4, "wheel.omega": 0})
    sol = kp.dynamics(m, start, t_end=0.46 * np.pi / rate)
    crank = 0.76 * np.pi + rate * sol.t
    x, y = np.sqrt(2) + np.cos(crank), np.sin(crank)
    seen = np.arctan2(y, x)
    # the pin lies in the slot that begins at -45 degrees + 90 degrees
    off = sol["wheel.angle"] + np.pi / 2 - seen
    within = np.hypot(x, y) < 0.98
    across = np.hypot(x, y) * np.sin(off)
    assert np.abs(across[within]).max() < play * 1.02
    turned = sol["wheel.angle"][-1] - sol["wheel.angle"][0]
    assert abs(turned) > 1.4
    assert sol["slot.gap"].min() > -1e-9 * size
