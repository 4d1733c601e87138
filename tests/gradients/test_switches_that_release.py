"""Slopes where a force jumps at a switch of a law and ends a rest at the time of the switch."""

import kempe as kp
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
