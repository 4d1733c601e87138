"""Redundant joints whose equations do not agree: the error names them, the gap and a remedy."""

from __future__ import annotations

import kempe as kp
import pytest
from redundant.pinned import G
from redundant.wheels import shafts


def beam(offset: float) -> kp.Model:
    m = kp.Model("beam", gravity=G, redundancy="allow")
    m.ground.points(A=(0, 0), B=(2 + offset, 0))
    m.bar("beam", mass=1, length=2, ends=("A", "B"))
    m.revolute("A", "ground.A", "beam.A")
    m.revolute("B", "ground.B", "beam.B")
    return m


def gears() -> kp.Model:
    m = kp.Model("gears", redundancy="allow")
    shafts(m, {"A": (0, 0), "B": (0.3, 0)})
    m.gear("first", "wheelA.O", "wheelB.O", radii=(0.1, 0.2))
    m.gear("second", "wheelA.O", "wheelB.O", radii=(0.1, 0.2))
    return m


def drawer(tilt: float) -> kp.Model:
    m = kp.Model("drawer", redundancy="allow")
    m.ground.points(L=(0, 0), R=(0, 0.6))
    m.body("drawer", mass=1, inertia=1, points={"L": (0, 0), "R": (0, 0.6)})
    m.translational("left", "ground.L", "drawer.L")
    m.translational("right", "ground.R", "drawer.R", axes=(tilt, 0))
    return m


def shaft(offset: float) -> kp.Model:
    m = kp.Model("shaft", redundancy="allow")
    m.ground.points(A=(0, 0), B=(1, offset), C=(2, 0))
    points = {"A": (0, 0), "B": (1, 0), "C": (2, 0)}
    m.body("shaft", mass=1, inertia=1, points=points)
    for name in points:
        m.pin_in_slot(name, f"ground.{name}", f"shaft.{name}")
    return m


CASES = {
    "long beam": (beam, 0.1, ["A", "B"], "0.1 m", "free one of A along x, B along x"),
    "short beam": (beam, -0.1, ["A", "B"], "0.1 m", "free one of A along x, B along x"),
    "drawer": (drawer, 0.1, ["left", "right"], "0.1 rad", "free one of left.angle, right.angle"),
    "shaft": (shaft, 0.03, ["A", "B", "C"], "0.04 m", "remove one of A, B, C"),
}


@pytest.mark.parametrize("name", CASES)
def test_joints_that_contradict_each_other_are_named(name: str) -> None:
    made, off, joints, gap, remedy = CASES[name]
    with pytest.raises(kp.AssemblyError) as caught:
        kp.assemble(made(off))
    told = str(caught.value)
    assert told.startswith(f"{', '.join(joints)} contradict each other: ")
    assert f"stay open by {gap} in all" in told
    assert remedy in told
    assert caught.value.name in joints
    # what agrees assembles
    assert len(kp.mobility(made(0.0), kp.assemble(made(0.0))).redundant) >= 1


def test_drivers_that_contradict_each_other() -> None:
    for rate, consistent in (("-t", True), ("-2*t", False)):
        m = gears()
        m.coordinate_driver("fast", "wheelA.angle", value="2*t")
        m.coordinate_driver("slow", "wheelB.angle", value=rate)
        found = kp.mobility(m, kp.State(m, 0, [0, 0, 0, 0.3, 0, 0], [0] * 6))
        of_drivers = [one for one in found.redundant if "slow" in one.joints]
        assert [one.consistent for one in of_drivers] == [consistent]
        assert ("CONTRADICT" in str(found)) == (not consistent)


def test_a_loop_that_is_too_short_is_not_called_redundant() -> None:
    m = kp.Model("short")
    m.ground.points(A=(0, 0), D=(10, 0))
    for name, ends in (("crank", "AB"), ("coupler", "BC"), ("rocker", "CD")):
        m.bar(name, mass=1, length=1, ends=tuple(ends))
    for pin, i, j in (("A", "ground", "crank"), ("B", "crank", "coupler")):
        m.revolute(pin, f"{i}.{pin}", f"{j}.{pin}")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    with pytest.raises(kp.AssemblyError, match="cannot close"):
        kp.assemble(m)
