"""Works of implicit methods are as exact as the motion where bodies touch, rub or follow pieces.

The energy balance compares the works, which are integrals of powers, with the energies of the
states.
"""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest

G = 9.81
SCALES = [(1e-3, 1e-2), (1.0, 1.0), (1e3, 50.0)]
METHODS = [(kp.Radau(), 1e-5), (kp.GeneralizedAlpha(), 2e-3)]


def slider(mass: float, size: float) -> kp.Model:
    """A block that slides down against a stop of exponent 1.5, with regularised friction."""
    speed = (G * size) ** 0.5
    m = kp.Model("slider", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("block", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.translational("S", "ground.O", "block.P", axes=("50 deg", 0))
    m.friction("rub", "S", kinetic=0.2, velocity=0.01 * speed)
    stiffness = 1e4 * mass * G / size**1.5
    m.stop("end", "S.displacement", lower=-size, stiffness=stiffness, exponent=1.5)
    return m


def crank(mass: float, size: float) -> kp.Model:
    """A crank that a driver turns in pieces, with regularised friction in its pin."""
    unit = (size / G) ** 0.5
    m = kp.Model("crank", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("bar", mass=mass, inertia=mass * size**2, center=(size, 0), points={"P": (0, 0)})
    m.revolute("A", "ground.O", "bar.P")
    m.friction("rub", "A", kinetic=0.2, velocity=0.01 * (G * size) ** 0.5, radius=0.2 * size)
    law = f"step5(t, {0.5 * unit}, 0, {unit}, 1) - step5(t, {1.5 * unit}, 0, {2.5 * unit}, 2)"
    m.coordinate_driver("D", "A.angle", value=law)
    return m


@pytest.mark.parametrize(("mass", "size"), SCALES)
@pytest.mark.parametrize("build", [slider, crank])
@pytest.mark.parametrize(("method", "most"), METHODS, ids=lambda of: getattr(of, "kind", ""))
def test_the_energy_balance(
    build: object, method: kp.Option, most: float, mass: float, size: float
) -> None:
    m = build(mass, size)  # type: ignore[operator]
    sol = kp.dynamics(m, kp.assemble(m), t_end=3 * (size / G) ** 0.5, method=method)
    assert np.abs(sol.energy.balance).max() < most
    assert sol.statistics["steps"] < 500


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_works_of_a_step_that_is_as_short_as_rounding_errors(rtol: float) -> None:
    """A dwell begins where rounding errors end it once more: multipliers of that step are noise."""
    m = kp.Model("block", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("block", mass=2, inertia=0.2, points={"P": (0, 0)})
    m.translational("S", "ground.O", "block.P", axes=("20 deg", 0))
    m.coordinate_driver("D", "S.displacement", value="step5(t, 0.5, 0, 1, 1)")
    m.friction("rub", "S", kinetic=0.3)
    method = kp.GeneralizedAlpha(rtol=rtol, atol=1e-3 * rtol)
    sol = kp.dynamics(m, kp.assemble(m), t_end=1.5, method=method)
    work = 2 * G * (np.sin(np.radians(20)) + 0.3 * np.cos(np.radians(20)))
    assert sol.energy.columns[-1][3] == pytest.approx(work, rel=2 * rtol ** (2 / 3))
