"""The tangential force of a rolling wheel, by hand."""

import kempe as kp
import numpy as np
import pytest

MASS, RADIUS, G = 4.0, 0.2, 9.81


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("slope", [30, -50])
def test_a_disc_on_an_incline(side: int, slope: float) -> None:
    m = kp.Model("disc on an incline", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("disc", mass=MASS, inertia=MASS * RADIUS**2 / 2, points={"P": (0, 0)})
    m.rolling("slope", "ground.O", "disc.P", radius=side * RADIUS, axis=f"{-slope}*deg")
    start = kp.assemble(m)
    sol = kp.dynamics(m, start, t_end=0.4, output_step=0.1)
    # down the slope m a = m g sin - F and, about the centre, J a / r = F r: F = m g sin / 3
    force = MASS * G * np.sin(np.radians(slope)) / 3
    assert start["slope"].tangential == pytest.approx(force, rel=1e-12)
    np.testing.assert_allclose(sol["slope"].tangential, force, rtol=1e-9)
    np.testing.assert_allclose(
        sol["disc"].vx[-1], 0.8 * force / MASS * np.cos(np.radians(slope)), rtol=1e-6
    )
