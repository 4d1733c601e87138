"""Friction in other units of length, mass and time, against closed forms and laws of scale.

Models are written for the units 1 m, 1 kg and 1 s and realised in others. Each result divided by
its unit must be the same.
"""

from dataclasses import dataclass
from typing import Any

import kempe as kp
import numpy as np
import pytest


@dataclass(frozen=True)
class Units:
    """Units of length, mass and time, m, kg and s."""

    length: float = 1.0
    mass: float = 1.0
    time: float = 1.0

    @property
    def force(self) -> float:
        return self.mass * self.length / self.time**2

    @property
    def torque(self) -> float:
        return self.force * self.length

    @property
    def inertia(self) -> float:
        return self.mass * self.length**2


ALL = [
    Units(),
    Units(1024.0, 2.0**-10, 16.0),
    Units(1e3, 1e3, 1e4),
    Units(1e-3, 1e3, 1e-3),
    Units(1e-3, 1e-3, 1e3),
]
units = pytest.mark.parametrize("u", ALL)


@units
def test_friction_acts_as_soon_as_its_driver_moves(u: Units) -> None:
    """A brake on a shaft that a drive holds for a while and then turns slowly."""
    m = kp.Model("shaft", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("shaft", mass=u.mass, inertia=0.1 * u.inertia, points={"O": (0.3 * u.length, 0)})
    m.revolute("pin", "ground.O", "shaft.O")
    m.clutch("brake", "ground", "shaft", capacity=0.2 * u.torque)
    m.coordinate_driver("drive", "shaft.angle", value=f"step5(t/{u.time!r}, 1, 0, 2, 1)")
    run = kp.dynamics(m, kp.assemble(m), t_end=3 * u.time)
    at = run(np.array([0.5, 1.02, 1.1, 1.5, 1.9, 1.98, 2.5]) * u.time)
    expected = np.array([0.0, -0.2, -0.2, -0.2, -0.2, -0.2, 0.0])
    assert np.allclose(at["brake.torque"] / u.torque, expected, atol=1e-12)
    needed = at["drive.effort"] - 0.19 * u.inertia * at["shaft.alpha"]
    assert np.allclose(needed / u.torque, -expected, atol=1e-9)


def wheel(u: Units, **brake: Any) -> kp.Model:
    """A wheel beside its pin, without gravity: at rest, a torque does not load the pin."""
    m = kp.Model("wheel", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=u.mass, inertia=0.1 * u.inertia, points={"O": (0.3 * u.length, 0)})
    m.revolute("pin", "ground.O", "wheel.O")
    m.friction("rub", "pin", kinetic=0.3, radius=0.02 * u.length)
    m.clutch("brake", "ground", "wheel", capacity=0.3 * u.torque, **brake)
    return m


@units
def test_a_brake_holds_where_the_pin_carries_nothing(u: Units) -> None:
    """Pin and brake stop together; then the limit of the pin is zero, and the brake alone holds."""
    m = wheel(u)
    m.torque("load", "wheel", torque=f"{u.torque!r}*0.2*sin(t/{u.time!r})")
    start = kp.assemble(m, {"wheel.angle": 0, "wheel.omega": 1 / u.time})
    run = kp.dynamics(m, start, t_end=4 * u.time)
    assert [len(run.events[name].t) for name in ("rub.stick", "brake.stick")] == [1, 1]
    assert not len(run.events["rub.slip"].t) and not len(run.events["brake.slip"].t)
    after = run(np.linspace(run.events["brake.stick"].t[0] * 1.01, run.t[-1], 30))
    assert np.allclose(after["brake.torque"], -after["load.torque"], atol=1e-9 * u.torque)
    assert np.abs(after["rub.torque"]).max() < 1e-12 * u.torque


def arm(u: Units) -> kp.Model:
    """A wheel on the free arm of a machine at rest; brake and friction act on the same angle."""
    m = kp.Model("arm", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=0.3 * u.mass, length=0.6 * u.length, ends=("O", "P"))
    m.body("wheel", mass=0.02 * u.mass, inertia=8e-4 * u.inertia, points={"P": (0, 0)})
    m.revolute("O", "ground.O", "arm.O")
    m.revolute("P", "arm.P", "wheel.P")
    m.friction("rub_O", "O", kinetic=0.1, radius=0.04 * u.length)
    m.friction("rub", "P", kinetic=0.25, radius=0.15 * u.length)
    m.torque("motor", "arm", torque=f"{0.4 * u.torque!r}*t/{u.time!r}")
    m.clutch("brake", "arm", "wheel", capacity=0.07 * u.torque)
    return m


@units
def test_friction_and_a_brake_on_one_angle_share_the_load(u: Units) -> None:
    """Both take the same part of their limits, from the first moment on."""
    m = arm(u)
    at_rest = {f"{body}.{x}": 0.0 for body in ("arm", "wheel") for x in ("angle", "omega")}
    run = kp.dynamics(m, kp.assemble(m, at_rest), t_end=0.5 * u.time)
    assert not len(run.events["rub.slip"].t)
    at = run(np.linspace(0.05, 0.5, 10) * u.time)
    assert np.all(at["rub.sticking"] == 1) and np.all(at["brake.sticking"] == 1)
    limit = 0.25 * 0.15 * u.length * at["rub.load"]
    part = at["brake.torque"] / (0.07 * u.torque)
    assert np.allclose(at["rub.torque"], part * limit, rtol=1e-9)
    whole = at["rub.torque"] + at["brake.torque"]
    assert np.allclose(whole, 8e-4 * u.inertia * at["wheel.alpha"], rtol=1e-9)


def toggle(u: Units) -> kp.Solution:
    """The rocker of a linkage passes its dead point, with friction in its pin and a brake."""
    m = kp.Model("toggle", gravity=(0, 0))
    a, b, c = (np.array(of) * u.length for of in ((0.3, 0.0), (1.2, 0.35), (1.0, -0.3)))
    m.ground.points(A=(0, 0), D=tuple(c))
    links = {"crank": ("A", (0, 0), "B", a), "rod": ("B", a, "C", b), "rocker": ("C", b, "D", c)}
    for name, (p, first, q, last) in links.items():
        length = float(np.hypot(*(np.array(last) - first)))
        m.bar(name, mass=0.2 * u.mass, length=length, ends=(p, q))
    for name, i, j in (("A", "ground", "crank"), ("B", "crank", "rod"), ("C", "rod", "rocker")):
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    m.revolute("D", "rocker.D", "ground.D")
    m.friction("rub", "D", kinetic=0.5, radius=0.015 * u.length)
    m.clutch("brake", "ground", "rocker", capacity=0.02 * u.torque)
    set_ = {"crank.angle": 0.0, "crank.omega": 5 / u.time}
    start = kp.assemble(m, set_, {"rod.C.x": b[0], "rod.C.y": b[1]})
    return kp.dynamics(m, start, t_end=1.2 * u.time)


@units
def test_a_brake_acts_on_both_sides_of_a_dead_point(u: Units) -> None:
    """The rocker reverses while the crank moves on: neither the brake nor the pin sticks."""
    run = toggle(u)
    turned = run(np.linspace(0, 1.2, 400) * u.time)
    assert np.ptp(np.sign(turned["rocker.omega"])) == 2
    assert not any(len(run.events[name].t) for name in ("rub.stick", "brake.stick"))
    expected = -0.02 * np.sign(turned["rocker.omega"][1:])
    assert np.allclose(turned["brake.torque"][1:] / u.torque, expected, atol=1e-12)


def press(u: Units) -> kp.State:
    """A heavy slide in a long guide and a light pin, both with friction of their reactions."""
    m = kp.Model("press", gravity=(0, -0.02 * u.length / u.time**2))
    m.ground.points(S=(0, 0), P=(0.1 * u.length, 0.33 * u.length), Q=(0.5 * u.length, u.length))
    pulled = {"S": (0, 0), "E": (0.4 * u.length, 0.3 * u.length)}
    m.body("slide", mass=1.4 * u.mass, inertia=0.1 * u.inertia, points=pulled)
    m.body("wheel", mass=1e-3 * u.mass, inertia=1e-4 * u.inertia, points={"P": (0, 0)})
    m.translational("S", "ground.S", "slide.S")
    m.revolute("P", "ground.P", "wheel.P")
    m.rack("teeth", "slide.S", "wheel.P", radius=0.33 * u.length)
    m.friction("rub_S", "S", kinetic=0.16, guide=0.87 * u.length)
    m.friction("rub_P", "P", kinetic=0.37, radius=0.03 * u.length)
    m.spring_damper("spring", "ground.Q", "slide.E", stiffness=30 * u.force / u.length)
    return kp.assemble(m, {"slide.x": 0.0, "slide.vx": 0.3 * u.length / u.time})


@units
def test_a_small_load_beside_large_ones(u: Units) -> None:
    """The friction of a pin is its own load times the coefficient, however large others are."""
    state = press(u)
    load = float(np.hypot(state["P.fx"], state["P.fy"]))
    torque = np.sign(state["P.omega"]) * 0.37 * 0.03 * u.length * load
    teeth = state["teeth.tangential"] * 0.33 * u.length
    balance = 1e-4 * u.inertia * state["wheel.alpha"] + torque + teeth
    assert abs(balance) < 1e-9 * abs(torque)
    assert abs(state["rub_P.load"] - load) < 1e-9 * load


@units
@pytest.mark.parametrize("seed", range(3))
def test_a_motion_without_forces(u: Units, seed: int) -> None:
    """A rack and its pinion move on; all forces are rounding errors, which need not balance."""
    x, y, turn, shift = np.random.default_rng(seed).normal(size=4)
    m = kp.Model("rack", gravity=(0, 0))
    c, s = np.cos(0.6 + turn), np.sin(0.6 + turn)
    centre = (-0.2 * s * u.length, 0.2 * c * u.length)
    m.ground.points(S=(0, 0), P=centre)
    own = {"S": (x * u.length, y * u.length)}
    m.body("rack", mass=u.mass, inertia=u.inertia, center=own["S"], points=own)
    own = {"P": (shift * u.length, x * u.length)}
    m.body("pinion", mass=9 * u.mass, inertia=0.2 * u.inertia, center=own["P"], points=own)
    m.translational("S", "ground.S", "rack.S", axes=(0.6 + turn, turn))
    m.revolute("P", "ground.P", "pinion.P")
    m.rack("teeth", "rack.S", "pinion.P", radius=0.2 * u.length, axis=turn)
    m.friction("rub", "S", kinetic=0.25)
    start = kp.assemble(m, {"S.displacement": 0, "S.rate": 0.3 * u.length / u.time})
    run = kp.dynamics(m, start, t_end=2 * u.time)
    assert np.allclose(run["S.rate"] * u.time / u.length, 0.3, atol=1e-9)
