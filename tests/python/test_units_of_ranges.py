"""The range of `over` has the unit of what it names."""

from typing import Any

import kempe as kp
import pytest
from numpy.testing import assert_allclose


def crank() -> kp.Model:
    m = kp.Model("crank", parameters={"k": "3 N/m"}, gravity=(0, -9.81))
    m.ground.points(O=(0, 0), Q=(2, 0))
    m.bar("crank", mass=1, length=0.5, ends=("O", "A"))
    m.revolute("O", "ground.O", "crank.O")
    m.coordinate_driver("drive", "crank.angle", value="t")
    m.spring_damper("spring", "ground.Q", "crank.A", stiffness="k", free_length=0.1)
    return m


@pytest.mark.parametrize("over", ["drive", "crank.angle"])
def test_an_angle_takes_angles_only(over: str) -> None:
    start = kp.assemble(crank())
    sol = kp.kinematics(crank(), start, over=over, range=(0, "90 deg"), n=3)
    assert_allclose(sol["crank.angle"], [0, 0.7853981633974483, 1.5707963267948966])
    for wrong in ("5 kg", "0.1 m"):
        with pytest.raises(kp.ModelError, match="range"):
            kp.kinematics(crank(), start, over=over, range=(0, wrong), n=3)


def test_a_length_takes_lengths_only() -> None:
    wanted: dict[str, Any] = {"over": "crank.A.x", "n": 2, "start": kp.assemble(crank(), t=0.5)}
    sol = kp.kinematics(crank(), range=("400 mm", "0.3 m"), **wanted)
    assert_allclose(sol["crank.A.x"], [0.4, 0.3])
    with pytest.raises(kp.ModelError, match="range"):
        kp.kinematics(crank(), range=("90 deg", "0.3 m"), **wanted)
