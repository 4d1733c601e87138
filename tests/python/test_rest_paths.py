"""Paths of rest positions: progress, and a mechanism that is held."""

import re

import kempe as kp
import numpy as np
import pytest
from kempe import plot

G = 9.81


def hanging(n: int) -> kp.Model:
    """A chain of n bars that is fixed at its first end, with a force at its last."""
    m = kp.Model("chain", gravity=(0, -G), parameters={"load": 0.0})
    m.ground.points(P=(0, 0))
    before = "ground"
    for k in range(n):
        m.bar(f"b{k}", mass=1, length=1, ends=("O", "P"))
        m.revolute(f"j{k}", f"{before}.P", f"b{k}.O")
        before = f"b{k}"
    m.force("push", f"{before}.P", force=["load", 0])
    return m


def test_progress_is_reported_and_may_stop_the_work() -> None:
    m = hanging(40)
    start = kp.assemble(m)
    found = []

    def stop(value: float) -> None:
        found.append(value)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        kp.equilibrium(m, start, over="load", range=(-1000, 1000), progress=stop)
    assert len(found) == 1
    assert np.isfinite(found[0])


def test_a_path_of_a_mechanism_that_is_held_has_no_page_of_coordinates() -> None:
    m = hanging(1)
    start = kp.assemble(m, set={"b0.angle": np.pi / 2})
    found = kp.equilibrium(m, start, hold=["b0.angle"], over="load", range=(-5, 5))
    assert found.coordinates == ()
    assert [page.name for page in plot.pages(found)] == ["efforts", "rest"]
    # the force pushes the upper end of the bar clockwise; the holder turns it back
    assert np.allclose(found.effort["b0.angle"], found.values, atol=1e-12)


#: kg and m.
SIZES = [(2.0, 0.5), (1e-3, 1e-2), (5e3, 40.0)]


def tilted(mass: float, size: float, angle: float) -> tuple[kp.Model, kp.State]:
    """A bar on a pin in gravity that is tilted by an angle, with a torque p, hanging at rest."""
    m = kp.Model("tilted", gravity=(G * np.sin(angle), -G * np.cos(angle)), parameters={"p": 0.0})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=mass, length=size, ends=("O", "B"))
    m.revolute("O", "ground.O", "rod.O")
    m.torque("push", "rod", torque="p")
    return m, kp.assemble(m, set={"rod.angle": angle - np.pi / 2})


@pytest.mark.parametrize(("mass", "size"), SIZES)
@pytest.mark.parametrize("angle", [0.5, -0.2])
def test_the_fold_of_a_turned_bar_is_reported(mass: float, size: float, angle: float) -> None:
    """The weight balances m g L/2 cos(φ - tilt) at most, at φ = tilt, and hangs with that rate."""
    m, start = tilted(mass, size, angle)
    most = mass * G * size / 2
    found = kp.equilibrium(m, start, over="p", range=(0, 1.5 * most))
    count, stable = len(found.values), int(np.sum(found.stable))
    assert found.report() == [
        f"{count} points over p from 0 to 0",
        f"fold at p = {most:.10g}: rod.angle = {np.degrees(angle):.8g}°",
        f"{stable} points are stable",
        found.end,
    ]
    assert 0.3 * count < stable < 0.7 * count
    with kp.units("rad"):
        assert found.report()[1].endswith(f": rod.angle = {angle:.8g} rad")
    half = kp.equilibrium(m, start, over="p", range=(0, 0.5 * most)).report()
    assert half[0].endswith(f" points over p from 0 to {0.5 * most:.6g}")
    assert half[1] == "all points are stable"
    assert f"stiffness along rod.angle: {most:.6g} N·m/rad" in kp.equilibrium(m, start).report()


@pytest.mark.parametrize(("stiffness", "size"), [(1e3, 0.2), (5.0, 3e-3), (1e7, 30.0)])
def test_the_fold_of_a_slide_is_reported(stiffness: float, size: float) -> None:
    """A spring from a distance a, as long as 2 a, snaps where its length is the root of 2 a³."""
    m = kp.Model("snap", parameters={"p": 0.0})
    m.ground.points(O=(0, 0), S=(size, 0))
    m.body("block", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "block.P", axes=("90 deg", "90 deg"))
    m.spring_damper("s", "ground.S", "block.P", stiffness=stiffness, free_length=2 * size)
    m.force("push", "block.P", force=(0, "-p"))
    start = kp.assemble(m, set={"block.y": np.sqrt(3) * size})
    length = 2 ** (1 / 3) * size
    place = np.sqrt(length**2 - size**2)
    most = stiffness * (2 * size - length) * place / length
    found = kp.equilibrium(m, start, over="p", range=(0, 1.5 * most)).report()[1]
    at, _, where = re.sub(r"^fold at p = ", "", found).partition(": block.y = ")
    number, _, unit = where.partition(" ")
    assert float(at) == pytest.approx(most, rel=1e-7)
    assert (float(number), unit) == (pytest.approx(place, rel=1e-3), "m")
    there = f"stiffness along block.y: {0.75 * stiffness:.6g} N/m"
    assert there in kp.equilibrium(m, start).report()


@pytest.mark.parametrize(("mass", "size"), SIZES)
def test_a_column_buckles_at_its_load(mass: float, size: float) -> None:
    """A spring k at the foot of an upright bar holds P up to k/L."""
    stiffness = 10.0 * mass * G * size
    m = kp.Model("column", parameters={"P": 0.0})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=mass, length=size, ends=("O", "B"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("s", "ground", "rod", stiffness=stiffness, free_angle=np.pi / 2)
    m.force("load", "rod.B", force=(0, "-P"))
    most = stiffness / size
    start = kp.assemble(m, set={"rod.angle": np.pi / 2})
    report = kp.equilibrium(m, start, over="P", range=(0, 1.5 * most)).report()
    told = re.fullmatch(r"crossing at P = (\S+): rod.angle = 90°", report[1])
    assert told and float(told[1]) == pytest.approx(most, rel=1e-6)
    assert re.fullmatch(r"\d+ points are stable", report[2])


@pytest.mark.parametrize(("voltage", "resistance", "constant"), [(12.0, 2.0, 0.5), (-3.0, 0.1, 40)])
def test_a_motor_at_rest_has_its_current(
    voltage: float, resistance: float, constant: float
) -> None:
    """U/R flows, and its torque turns the rotor against a spring."""
    m = kp.Model("motor")
    m.ground.points(O=(0, 0))
    m.body("rotor", mass=1, inertia=0.01, points={"O": (0, 0)})
    m.revolute("shaft", "ground.O", "rotor.O")
    m.torsion_spring("s", "ground", "rotor", stiffness=1e4)
    electric = {"voltage": voltage, "resistance": resistance, "torque_constant": constant}
    m.motor("motor", "rotor", inductance=0.1, **electric)
    state = kp.equilibrium(m, kp.assemble(m, {"rotor.angle": 0})).state
    current = voltage / resistance
    assert state["motor.current"] == pytest.approx(current, rel=1e-9)
    assert state["rotor.angle"] == pytest.approx(constant * current / 1e4, rel=1e-9)
