"""Motion laws as the laws of drivers: the motion has their velocity and acceleration."""

import kempe as kp
import numpy as np
import pytest
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Second derivatives by s, and the peaks of the first and second.
ACCELERATIONS = {
    "cycloidal(s)": (lambda s: 2 * np.pi * np.sin(2 * np.pi * s), 2.0, 6.2832),
    "harmonic(s)": (lambda s: np.pi**2 / 2 * np.cos(np.pi * s), 1.5708, 4.9348),
    "poly345(s)": (lambda s: 60 * s - 180 * s**2 + 120 * s**3, 1.875, 5.7735),
    "poly4567(s)": (
        lambda s: 420 * s**2 - 1680 * s**3 + 2100 * s**4 - 840 * s**5,
        2.1875,
        7.5132,
    ),
    "modified_sine(s)": (
        lambda s: (
            4
            * np.pi**2
            / (4 + np.pi)
            * np.where(
                (s < 1 / 8) | (s > 7 / 8),
                np.sin(4 * np.pi * s),
                np.sin(4 * np.pi * s / 3 + np.pi / 3),
            )
        ),
        1.7596,
        5.5280,
    ),
    "modified_trapezoid(s)": (
        lambda s: (
            8
            * np.pi
            / (2 + np.pi)
            * np.select(
                [s < 1 / 8, s < 3 / 8, s < 5 / 8, s < 7 / 8],
                [np.sin(4 * np.pi * s), 1, np.cos(4 * np.pi * (s - 3 / 8)), -1],
                -np.cos(4 * np.pi * (s - 7 / 8)),
            )
        ),
        2.0,
        4.8881,
    ),
}


@pytest.mark.parametrize("law", ACCELERATIONS)
def test_a_driver_has_the_acceleration_of_the_law(law: str) -> None:
    acceleration, first, second = ACCELERATIONS[law]
    m = kp.Model()
    m.ground.points(O=(0, 0))
    m.body("slide", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slide.P")
    rise = law.replace("s)", "(t - 0.5)/2)")
    m.coordinate_driver("cam", "slide.x", value=f"0.1*{rise}")
    sol = kp.dynamics(m, kp.assemble(m), t_end=3, output_step=0.001)
    s: Array = (sol.t - 0.5) / 2
    inside = (s > 1e-9) & (s < 1 - 1e-9)
    np.testing.assert_allclose(
        sol["slide.ax"][inside], 0.1 / 4 * acceleration(s[inside]), atol=1e-10
    )
    outside = (s < -1e-9) | (s > 1 + 1e-9)
    assert np.abs(sol["slide.ax"][outside]).max() < 1e-12
    assert np.abs(sol["slide.vx"]).max() * 2 / 0.1 == pytest.approx(first, abs=1e-4)
    assert np.abs(sol["slide.ax"]).max() * 4 / 0.1 == pytest.approx(second, abs=1e-4)
    assert sol["slide.x"][-1] == pytest.approx(0.1, abs=1e-12)


def test_a_printed_law_is_written_piece_by_piece() -> None:
    m = kp.Model()
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("A", "B"))
    m.revolute("O", "ground.O", "rod.A")
    m.coordinate_driver("turn", "rod.angle", value="harmonic(t/2)")
    text = kp.equations(m)[1].text()
    assert "rod.angle - if(0 > t/2, 0, if(t/2 > 1, 1, 1/2 - cos(pi*t/2)/2))" in text
    assert "with" not in text  # a driver has no points
