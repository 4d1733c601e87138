"""A driver that an analysis has released does not act in analyses that start from its end."""

from typing import Any

import kempe as kp
import numpy as np
import pytest


def pendulum(length: float, mass: float) -> kp.Model:
    """A rod that a driver holds level."""
    m = kp.Model(gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=mass, length=length, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    m.coordinate_driver("hold", "rod.angle", value=0)
    return m


def dropped(m: kp.Model, then: Any) -> kp.Results:
    return kp.Case(m, None, [kp.Dynamics(0.2, release=["hold"], name="drop"), then]).run()


@pytest.mark.parametrize(("length", "mass"), [(1e-3, 1e3), (1.0, 1.0), (1e3, 1e-3)])
def test_the_next_run_goes_on_without_it(length: float, mass: float) -> None:
    found = dropped(pendulum(length, mass), kp.Dynamics(0.4, name="more"))["more"]
    # conservation of energy since the rod was level: ω² = 3 g (-sin angle) / L, at most 3 g / L
    angle, omega = found["rod.angle"], found["rod.omega"]
    largest = 3 * 9.81 / length
    assert omega**2 == pytest.approx(largest * -np.sin(angle), abs=1e-6 * largest)
    assert found.final.compiled.released == ("hold",)


def test_kinematics_needs_another_driver() -> None:
    with pytest.raises(kp.ModelError, match="leave 1 degree of freedom"):
        dropped(pendulum(1.0, 1.0), kp.Kinematics(t_end=0.4))


def test_limits_and_motions_over_its_quantity_drive_it_anew() -> None:
    m = pendulum(1.0, 1.0)
    assert dropped(m, kp.Limits("rod.angle"))["limits"].turns_fully
    turned = dropped(m, kp.Kinematics(over="rod.angle", range=(-1, 1), n=3))["kinematics"]
    assert turned["rod.P.y"] == pytest.approx(np.sin([-1, 0, 1]))
    with pytest.raises(kp.ModelError, match="the model has no driver that acts"):
        dropped(m, kp.Limits())
