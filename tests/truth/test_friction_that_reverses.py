"""Friction that may stick, in joints whose speed changes its sign or is given by a driver."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest


def slider_crank() -> kp.Model:
    m = kp.Model("slider-crank")
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length=0.1, ends=("O", "A"))
    m.bar("rod", mass=1, length=0.3, ends=("A", "B"))
    m.body("piston", mass=2, inertia=0.01, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "piston.B")
    m.translational("S", "ground.O", "piston.B")
    return m


def path(x: np.ndarray) -> float:
    """The way of a coordinate there and back."""
    return float(np.abs(np.diff(x)).sum())


@pytest.mark.parametrize("joints", ["B", "S", "BS", "OABS"])
def test_constant_friction_loses_torque_times_angle(joints: str) -> None:
    m = slider_crank()
    coordinates = {"O": "O.angle", "A": "A.angle", "B": "B.angle", "S": "S.displacement"}
    efforts = {"O": 0.11, "A": 0.07, "B": 0.13, "S": 2.3}
    for joint in joints:
        radius = {} if joint == "S" else {"radius": 0.01}
        load = efforts[joint] / (0.2 * radius.get("radius", 1))
        m.friction(f"rub{joint}", joint, kinetic=0.2, load=load, **radius)
    start = kp.assemble(m, set={"crank.angle": 1, "crank.omega": 20})
    sol = kp.dynamics(m, start, t_end=0.5, method=kp.DOP853(rtol=1e-10, atol=1e-13))
    # the pin of the piston and the slide reverse twice in a turn
    assert np.ptp(sol["crank"].angle) > 3 * np.pi
    fine = sol(np.linspace(0, 0.5, 200_001))
    lost = sum(efforts[joint] * path(fine[coordinates[joint]]) for joint in joints)
    assert sol.energy.dissipated[-1] == pytest.approx(lost, rel=1e-7)
    assert all(event.t.size == 0 for event in sol.events.values())


def test_a_driver_works_against_friction_between_its_dwells() -> None:
    m = kp.Model("driven block", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("block", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("slide", "ground.O", "block.P")
    there_and_back = "step5(t, 1, 0, 2, 1) - step5(t, 3, 0, 4, 1)"
    m.coordinate_driver("drive", "slide.displacement", value=there_and_back)
    m.friction("rub", "slide", kinetic=0.3)
    sol = kp.dynamics(m, kp.assemble(m), t_end=5)
    friction = 0.3 * 9.81
    for t, sign in ((0.5, 0), (1.2, -1), (1.8, -1), (2.5, 0), (3.2, 1), (3.8, 1), (4.5, 0)):
        state = sol(t)
        assert state["rub.force"] == pytest.approx(sign * friction, abs=1e-9), t
        s = t - 1 if t < 2.5 else t - 3
        moving = 60 * s - 180 * s**2 + 120 * s**3 if 0 <= s <= 1 else 0
        wanted = (1 if t < 2.5 else -1) * moving - sign * friction
        assert state["drive.effort"] == pytest.approx(wanted, abs=1e-6), t
    assert sol.energy.dissipated[-1] == pytest.approx(2 * friction, rel=1e-6)


def test_all_friction_of_a_slider_crank_stops_it() -> None:
    m = slider_crank()
    for joint in "OAB":
        m.friction(f"rub{joint}", joint, static=0.4, kinetic=0.3, radius=0.02, load=20)
    m.friction("rubS", "S", static=0.12, kinetic=0.1, load=15)
    start = kp.assemble(m, set={"crank.angle": 1, "crank.omega": 5})
    sol = kp.dynamics(m, start, t_end=2)
    assert sol.events["rubO.stick"].t.size == 1
    t = sol.events["rubO.stick"].t[0]
    assert all(sol.events[f"rub{joint}.stick"].t == pytest.approx(t) for joint in "ABS")
    assert sol.energy.kinetic[-1] < 1e-25
    assert sol.energy.kinetic[0] == pytest.approx(sol.energy.dissipated[-1], rel=1e-8)
