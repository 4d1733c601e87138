"""Light bodies and free wheels beside others find their rest."""

import kempe as kp
import numpy as np
import pytest
from scipy.optimize import brentq


@pytest.mark.parametrize("driven", [True, False])
@pytest.mark.parametrize(("mass", "length"), [(1e3, 1.0), (1e3, 100.0), (100.0, 1.0)])
@pytest.mark.parametrize(("light", "short"), [(1e-3, 1e-2), (1e-3, 1e-3)])
def test_a_light_bar_rests_beside_a_heavy_one(
    mass: float, length: float, light: float, short: float, driven: bool
) -> None:
    m = kp.Model("two bars", gravity=(0, -9.81))
    m.ground.points(A=(0, 0), B=(1, 0))
    m.bar("light", mass=light, length=short, ends=("A", "B"))
    m.bar("heavy", mass=mass, length=length, ends=("A", "B"))
    m.revolute("a", "ground.A", "light.A")
    m.revolute("b", "ground.B", "heavy.A")
    m.torsion_spring("k", "ground", "light", stiffness=7 * light * short, free_angle=0.3)
    start = {"light.angle": 1.0}
    if driven:
        m.coordinate_driver("d", "heavy.angle", value=0)
    else:
        m.torsion_spring("h", "ground", "heavy", stiffness=7 * mass * length, free_angle=0.3)
        start["heavy.angle"] = 1.2
    rest = kp.equilibrium(m, kp.assemble(m, start))
    angle = brentq(lambda a: 7 * (a - 0.3) + 9.81 / 2 * np.cos(a), -2, 1, xtol=1e-15)
    assert rest.state["light.angle"] == pytest.approx(angle, abs=1e-12)
    assert rest.stable


@pytest.mark.parametrize(("mass", "length"), [(1e-3, 1e-3), (1.0, 1.0), (1e3, 1e2)])
def test_a_pendulum_rests_beside_a_free_wheel(mass: float, length: float) -> None:
    m = kp.Model("pendulum and wheel", gravity=(0, -9.81))
    m.ground.points(A=(0, 0), B=(length, 0))
    m.bar("arm", mass=mass, length=length, ends=("A", "B"))
    m.body("wheel", mass=mass, inertia=mass * length**2, points={"C": (0, 0)})
    m.revolute("a", "ground.A", "arm.A")
    m.revolute("b", "ground.B", "wheel.C")
    rest = kp.equilibrium(m, kp.assemble(m, {"arm.angle": 0.4, "wheel.angle": 0.7}))
    assert rest.state["arm.angle"] == pytest.approx(-np.pi / 2, abs=1e-13)
    assert rest.state["wheel.angle"] == pytest.approx(0.7, abs=1e-13)
