"""Values of variables that look like degrees cause a warning, as those of a start do."""

import warnings
from typing import Any

import kempe as kp
import pytest


def rod(angle: str) -> kp.Case:
    parameters = {"length": "500 mm", "lean": "30 deg", "plain": 0.5}
    m = kp.Model("rod", gravity=(0, -9.81), parameters=parameters)
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length="length", ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    return kp.Case(m, {"set": {"rod.angle": angle}}, [kp.Dynamics(t_end=0.01)])


@pytest.mark.parametrize(
    ("angle", "given", "told"),
    [
        ("1", {"rod.angle": [60, 70, 1.2]}, "rod.angle: 60, 70 look like degrees"),
        ("1", {"rod.angle": {"from": 0, "to": 90, "n": 3}}, "90 looks like degrees"),
        ("lean", {"lean": [22.5]}, "variables.lean: 22.5 looks .*22.5 degrees are 0.392699"),
        ("plain", {"plain": [45]}, "variables.plain: 45 looks like degrees"),
    ],
)
def test_an_angle_of_many_turns_is_doubted(angle: str, given: dict[str, Any], told: str) -> None:
    with pytest.warns(kp.AssemblyWarning, match=told):
        kp.sweep(rod(angle), given, ["rod.omega.final"])


@pytest.mark.parametrize(
    ("given", "design"),
    [
        ({"rod.angle": [1.2, 12.566370614359172]}, "grid"),
        ({"rod.omega": [60, 70]}, "grid"),
        ({"length": [45, 50]}, "grid"),
        ({"plain": [45, 50]}, "grid"),
        ({"rod.angle": {"normal": [1, 10]}}, "random"),
    ],
)
def test_other_values_are_not_doubted(given: dict[str, Any], design: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        n = None if design == "grid" else 3
        kp.sweep(rod("1"), given, ["rod.omega.final"], design=design, n=n)
