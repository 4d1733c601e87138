"""Friction in a joint that drivers hold at rest: the effort has a range, its middle is reported."""

import kempe as kp
import numpy as np
import pytest

DWELL = "step5(t, 0.5, 0, 1, 1) - step5(t, 2, 0, 2.5, 1)"
SLOPE = np.radians(20)
KINETIC = 0.3


def block(mass: float = 2.0, static: float | None = None) -> kp.Model:
    """A block that a driver moves up a slope, holds there, and moves back."""
    m = kp.Model("block", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("block", mass=mass, inertia=0.1 * mass, points={"P": (0, 0)})
    m.translational("S", "ground.O", "block.P", axes=("20 deg", 0))
    m.coordinate_driver("D", "S.displacement", value=DWELL)
    more = {} if static is None else {"static": static}
    m.friction("rub", "S", kinetic=KINETIC, **more)
    return m


METHODS = {
    "auto": (kp.Auto(), kp.Projection()),
    "dop853": (kp.DOP853(), kp.Baumgarte()),
    "rk45": (kp.RK45(), None),
    "rk4": (kp.RK4(step=0.01), kp.Projection()),
    "radau": (kp.Radau(), kp.Projection()),
    "generalized alpha": (kp.GeneralizedAlpha(), kp.Projection()),
    "hht": (kp.HHT(), kp.Projection()),
}


@pytest.mark.filterwarnings("ignore::kempe.AccuracyWarning")
@pytest.mark.parametrize("name", METHODS)
def test_all_methods_report_the_middle(name: str) -> None:
    method, stabilization = METHODS[name]
    m = block()
    sol = kp.dynamics(
        m, kp.assemble(m), t_end=3, output_step=0.01, method=method, stabilization=stabilization
    )
    rest = (sol.t < 0.5) | ((sol.t > 1.005) & (sol.t < 2)) | (sol.t > 2.505)
    middle = 2 * 9.81 * np.sin(SLOPE)
    np.testing.assert_allclose(sol["D.effort"][rest], middle, rtol=1e-6)
    most = KINETIC * 2 * 9.81 * np.cos(SLOPE)
    wanted = [middle - most, middle + most]
    np.testing.assert_allclose(sol["D"].interval[rest], np.tile(wanted, (rest.sum(), 1)), rtol=1e-6)
    assert not sol["D"].unique and sol["S"].unique
    assert sol.events["rub.slip"].t == pytest.approx([0.5, 2.0], abs=2e-3)
    assert sol.statistics["steps"] < 3000


@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_the_range_has_the_coefficient_of_rest(mass: float) -> None:
    m = block(mass, static=0.5)
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.4)
    low, high = sol["D"].interval[0] / (mass * 9.81)
    assert low == pytest.approx(np.sin(SLOPE) - 0.5 * np.cos(SLOPE))
    assert high == pytest.approx(np.sin(SLOPE) + 0.5 * np.cos(SLOPE))


def test_while_it_moves_the_effort_is_unique() -> None:
    m = block()
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.9, output_step=0.01)
    moving = sol.t > 0.6
    interval = sol["D"].interval[moving]
    np.testing.assert_allclose(interval[:, 0], sol["D.effort"][moving])
    np.testing.assert_allclose(interval[:, 1], sol["D.effort"][moving])
