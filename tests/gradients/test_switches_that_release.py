"""Slopes where a force jumps at a switch of a law and ends a rest at the time of the switch."""

import kempe as kp
import numpy as np
import pytest
from sizes import some

#: Mass in kg, force in N, time in s, length in m.
SCALES = [(1.0, 1.0, 1.0, 1.0), (1e-3, 20.0, 0.01, 3.0), (1e3, 5.0, 30.0, 1e-3)]
CONDITIONS = {"time": "t < {late}", "parameter": "t < late", "state": "pilot.x < way"}


def rest(kind: str, condition: str, grows: float, scale: tuple[float, ...]) -> kp.Case:
    """A block rests at a stop or by its friction, until a force jumps and moves it."""
    mass, force, late, way = scale
    m = kp.Model("rest", parameters={"F": force, "m": mass, "late": late, "way": way})
    m.ground.points(O=(0, 0))
    for name in ("pilot", "block"):
        m.body(name, mass="m", inertia=1, points={"P": (0, 0)})
        m.translational(f"guide_{name}", "ground.O", f"{name}.P")
    before = -1.0 if kind == "stop" else 0.2
    where = CONDITIONS[condition].format(late=repr(late))
    law = f"F*if({where}, {before}*(1 + {grows}*t/{late!r}), 1)"
    m.generalized_force("push", "block.x", value=law)
    if kind == "stop":
        m.stop("floor", "block.x", lower=0, restitution=0)
    else:
        m.friction("rubs", "guide_block", kinetic=0.5, load="F")
    start = {"pilot.x": 0, "pilot.vx": way / late, "block.x": 0, "block.vx": 0}
    return kp.Case(m, {"set": start}, [kp.Dynamics(t_end=2.5 * late, output_step=late / 10)])


ALL = [(k, c, g) for k in ("stop", "friction") for c in CONDITIONS for g in (0.0, 0.4)]


@pytest.mark.parametrize("kind, condition, grows", ALL)
@pytest.mark.parametrize("scale", some(SCALES, 3))
def test_a_rest_that_a_switch_ends(
    kind: str, condition: str, grows: float, scale: tuple[float, ...]
) -> None:
    mass, force, late, way = scale
    variables = ["F", "m", "late", "way", "pilot.vx"]
    g = kp.gradient(rest(kind, condition, grows, scale), ["block.x.final"], variables)
    if condition == "state" and g.remarks:
        # the order of the switch and of the end of the rest is that of rounding errors
        assert all("happen together" in text for text in g.remarks.values())
        return
    assert not g.remarks
    # x = net/m (t - late)²/2; late is way/speed where the pilot ends the rest
    net, during = force * (1.0 if kind == "stop" else 0.5), 1.5 * late
    by_late = -net / mass * during
    exact = {"F": net / force / mass * during**2 / 2, "m": -net / mass**2 * during**2 / 2}
    exact["late"] = by_late if condition == "parameter" else 0.0
    exact["way"] = by_late * late / way if condition == "state" else 0.0
    exact["pilot.vx"] = -by_late * late**2 / way if condition == "state" else 0.0
    for name, slope in exact.items():
        assert g["block.x.final", name] == pytest.approx(slope, rel=1e-9, abs=0.0), name


@pytest.mark.parametrize(("mass", "size"), [(1.0, 1.0), (1e3, 1e-3), (1e-3, 1e3)])
def test_integrals_of_forces_by_a_rate_that_ends_a_rest_are_left_out(
    mass: float, size: float
) -> None:
    """A clutch of capacity c stops a wheel that begins with the rate w: ∫ T dt = -J w."""
    inertia = mass * size**2
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    m.body("w", mass=mass, inertia=inertia, points={"O": (0, 0)})
    m.revolute("pin", "ground.O", "w.O")
    m.clutch("c", "ground", "w", capacity=inertia)
    numbers = ["c.torque.integral", "w.alpha.mean", "w.angle.final", "w.omega.integral"]
    run = kp.Dynamics(t_end=1, output_step=0.1, name="stop")
    at_rest = kp.Case(m, {"set": {"w.angle": 0, "w.omega": 0}}, [run])
    g = kp.gradient(at_rest, numbers, ["w.omega"])
    assert set(g.remarks) == {(name, "w.omega") for name in numbers[:2]}
    assert "ends a rest at the start" in g.remarks["w.alpha.mean", "w.omega"]
    assert np.isnan(g["c.torque.integral", "w.omega"])
    assert g.jacobian[2:, 0] == pytest.approx([0, 0], abs=1e-12)
    rate = 0.5
    moves = kp.Case(m, {"set": {"w.angle": 0, "w.omega": rate}}, [run])
    g = kp.gradient(moves, numbers, ["w.omega"])
    assert not g.remarks
    assert g.jacobian[:, 0] == pytest.approx([-inertia, -1, rate, rate], rel=1e-9)
