"""Equations of the state in which a run ends: limits, friction and contacts add and remove some."""

import kempe as kp
import numpy as np
import pytest

#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e2, 0.01)]


def shafts(scale: tuple[float, float, float], limit: float, capacity: float) -> kp.Model:
    """Two driven wheels, the first with a limit, and a brake on a third one."""
    mass, size, rate = scale
    torque = mass * size**2 * rate**2
    m = kp.Model("shafts", parameters={"w": rate})
    m.ground.points(O=(0, 0))
    for name in ("a", "b", "c"):
        m.body(name, mass=mass, inertia=mass * size**2, points={"O": (0, 0)})
        m.revolute(f"pin_{name}", "ground.O", f"{name}.O")
    m.coordinate_driver("first", "a.angle", value="2*w*t", limit=limit * torque)
    m.coordinate_driver("second", "b.angle", value="3*w*t")
    m.torque("load", "a", torque=-torque)
    m.clutch("brake", "ground", "c", capacity=capacity * torque)
    return m


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("limit", [0.5, 2.0])
@pytest.mark.parametrize("capacity", [0.5, 2.0])
def test_each_equation_has_its_own_name(
    scale: tuple[float, float, float], limit: float, capacity: float
) -> None:
    m = shafts(scale, limit, capacity)
    rate = scale[2]
    start = kp.assemble(m, {"c.angle": 0, "c.omega": rate})
    sol = kp.dynamics(m, start, t_end=1 / rate)
    found = sol.final.matrices({"a.x": 0})
    wheels = dict(zip(found.rows, found.Phi_q[:, 2::3], strict=True))
    expected = {"second.angle": [0.0, 1.0, 0.0]}
    if limit > 1:  # the limit suffices for the load
        expected["first.angle"] = [1.0, 0.0, 0.0]
    if capacity > 1:  # the brake has stopped its wheel
        expected["brake (at rest)"] = [0.0, 0.0, 1.0]
    given = {name: list(row) for name, row in wheels.items() if np.any(row)}
    assert given == expected
    assert found.rows[-1] == "set.a.x"
    assert set(found.units) == {"m", "rad"}
    assert found.units[found.rows.index("second.angle")] == "rad"
    # a wheel that a driver moves does not settle, a braked one may
    settle = {entry["body"] for entry in sol.summary["settling"]}
    assert settle == {"c"} | ({"a"} if limit < 1 else set())
