"""Rounding errors of a position are printed as zeros, at every size; small values are not."""

import kempe as kp
import numpy as np
import pytest


def slider(size: float) -> kp.State:
    m = kp.Model("slider-crank")
    m.ground.points(O=(0, 0))
    m.body("crank", mass=1, inertia=1, points={"O": (0, 0), "A": (0.1 * size, 0)})
    m.bar("rod", mass=1, length=0.3 * size, ends=("A", "B"))
    m.body("slider", mass=1, inertia=1, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "slider.B")
    m.translational("guide", "ground.O", "slider.B")
    return kp.assemble(m, {"crank.angle": "60 deg", "crank.omega": 30})


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_rounding_errors_are_zero(size: float) -> None:
    start = slider(size)
    noise = np.random.default_rng(7).uniform(-1, 1, 18)
    scales = np.tile([size, size, 1.0], 3)
    q = np.where(start.q == 0, 1e-15 * scales * noise[:9], start.q)
    v = np.where(abs(start.v) < 1e-9 * scales, 1e-15 * scales * noise[9:], start.v)
    _, rows = kp.State(start.compiled, 0.0, q, v).table()
    assert rows[0][1:3] == ["0", "0"]  # the crank turns about the origin
    assert rows[0][4:6] == ["0", "0"]
    (slides,) = (row for row in rows if row[0] == "slider")
    assert slides[2:4] == ["0", "0"] and slides[5:] == ["0", "0"]
    assert float(slides[1]) == pytest.approx(start["slider.x"], rel=1e-5)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_small_values_stay(size: float) -> None:
    start = slider(size)
    q = start.q.copy()
    q[6], q[8] = 1e-9 * size, 1e-9
    _, rows = kp.State(start.compiled, 0.0, q, start.v).table()
    assert float(rows[2][1]) == pytest.approx(1e-9 * size, rel=1e-5)
    assert float(rows[2][3]) == pytest.approx(np.degrees(1e-9), rel=1e-5)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_force_along_its_line_has_no_torque(size: float) -> None:
    m = kp.Model("boom", gravity=(0, -9.81))
    m.ground.points(O=(0, 0), F=(0.3 * size, 0))
    m.body("boom", mass=1e3, inertia=1, points={"O": (-0.8 * size, 0), "H": (0.2 * size, 0)})
    m.revolute("O", "ground.O", "boom.O")
    m.distance("cylinder", "ground.F", "boom.H", length=f"{size}*(0.75 + 0.03*t)")
    start = kp.assemble(m, guess={"boom.angle": "20 deg"})
    rows = kp.inverse_dynamics(m, start, t_end=8, output_step=0.1)
    _, cylinder = kp.report.summary(rows)["peaks"]["reactions"]
    assert cylinder["force"] > 1e4
    assert (cylinder["torque"], cylinder["torque_at"]) == (0, 0)
