"""Wear of contacts without friction whose sliding reverses."""

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose

#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e2, 0.01)]


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("rtol", [1e-6, 1e-10])
@pytest.mark.parametrize("joint", ["contact", "clearance"])
def test_the_way_of_a_body_that_goes_to_and_fro(
    scale: tuple[float, float, float], rtol: float, joint: str
) -> None:
    """A ball rests on a plate, or a shaft in its bush, and swings without friction."""
    mass, size, rate = scale
    force = mass * size * rate**2
    m = kp.Model("to and fro", gravity=(0, -size * rate**2), parameters={"w": rate, "s": size})
    m.ground.points(O=(0, 0))
    m.ground.curves(plate={"line": ((9 * size, 0), (-9 * size, 0))})
    m.body("body", mass=mass, inertia=mass * size**2, points={"C": (0, 0)})
    wear = 1e-3 * size**2 / force
    law = {
        "stiffness": 1e3 * force / size,
        "exponent": 1,
        "damping": 0.1 / (size * rate),
        "wear": wear,
    }
    if joint == "contact":
        m.contact("touch", "body.C", "ground.plate", radius="0.1*s", **law)
        m.coordinate_driver("swing", "body.x", value="0.3*s*sin(3*w*t)")
        m.coordinate_driver("turn", "body.angle", value=0)
        low, way = 0.1 - 1e-3, 0.3 * 3
    else:
        m.clearance("touch", "ground.O", "body.C", radius="0.1*s", clearance="0.01*s", **law)
        m.coordinate_driver("still", "body.x", value=0)
        m.coordinate_driver("turn", "body.angle", value="0.3*sin(3*w*t)")
        # the pitch point is at the depth of the bush that its radius and the load give
        low, way = -0.01 - 1e-3, 0.3 * 3 * (0.1 * 1.1 - 0.011)
    start = kp.assemble(m, {"body.y": low * size, "body.vy": 0})
    sol = kp.dynamics(m, start, t_end=2 / rate, method=kp.DOP853(rtol=rtol))
    # ∫ |cos 3t| dt
    zeros = np.array([0, np.pi / 6, np.pi / 2, 2])
    distance = way * np.abs(np.diff(np.sin(3 * zeros))).sum() / 3
    assert_allclose(sol["touch.sliding_distance"][-1], distance * size, rtol=1e-7)
    assert_allclose(sol["touch.wear_volume"][-1], 1e-3 * distance * size**3, rtol=1e-7)
