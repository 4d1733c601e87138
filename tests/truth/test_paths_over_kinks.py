"""Equilibrium paths through the places where linear stops and contacts begin to push."""

import kempe as kp
import numpy as np
import pytest

#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e3, 0.01)]
#: Stiffness of the stop over that of the spring.
STIFF = [0.3, 10.0, 1e4]


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("ratio", STIFF)
@pytest.mark.parametrize("exponent", [1, 1.5])
def test_a_spring_presses_a_lever_on_a_stop_and_lifts_it_again(
    scale: tuple[float, float, float], ratio: float, exponent: float
) -> None:
    mass, size, rate = scale
    spring = mass * size**2 * rate**2
    m = kp.Model("lever", parameters={"p": 0.2})
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=mass, length=size, ends=("A", "B"))
    m.revolute("J", "ground.O", "arm.A")
    m.torsion_spring("S", "ground", "arm", stiffness=spring, free_angle="p*(3 - p)")
    m.stop("wall", "J.angle", upper=1.1, stiffness=ratio * spring, exponent=exponent)
    start = kp.assemble(m, set={"J.angle": 0.2 * 2.8})
    path = kp.equilibrium(m, start, over="p", range=(0.2, 2.9))
    assert path.values[-1] == 2.9
    for p, state in zip(path.values, path.states, strict=True):
        depth = max(0.0, state["J.angle"] - 1.1)
        left = p * (3 - p) - state["J.angle"] - ratio * depth**exponent
        assert left == pytest.approx(0, abs=1e-9)
    assert max(state["wall.torque"] for state in path.states[1:-1]) <= 0
    assert min(state["wall.torque"] for state in path.states) < -0.1 * spring * min(ratio, 1)


@pytest.mark.parametrize("scale", SCALES)
def test_a_weight_lifts_off_a_linear_floor(scale: tuple[float, float, float]) -> None:
    mass, size, rate = scale
    weight = mass * size * rate**2
    m = kp.Model("weight", gravity=(0, -size * rate**2), parameters={"p": 0})
    m.ground.points(O=(0, 0))
    m.ground.curves(floor={"line": ((9 * size, 0), (-9 * size, 0))})
    m.body("block", mass=mass, inertia=mass * size**2, points={"C": (0, 0)})
    m.translational("way", "ground.O", "block.C", axes=("90*deg", "90*deg"))
    m.contact("foot", "block.C", "ground.floor", stiffness=50 * weight / size, exponent=1)
    m.spring_damper(
        "rope", "ground.O", "block.C", stiffness=weight / size, damping=0, free_length=0
    )
    m.generalized_force("lift", "way.displacement", value=f"{weight!r}*p")
    start = kp.assemble(m, set={"way.displacement": -0.02 * size})
    path = kp.equilibrium(m, start, over="p", range=(0, 3))
    assert path.values[-1] == 3
    places = np.array([state["way.displacement"] for state in path.states]) / size
    lift = np.asarray(path.values) - 1
    np.testing.assert_allclose(places, np.where(lift < 0, lift / 51, lift), rtol=0, atol=1e-9)
