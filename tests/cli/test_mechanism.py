"""The mechanism as `kempe check` prints it."""

from pathlib import Path

import kempe as kp
import pytest
from command_line import kempe


@pytest.mark.parametrize("loaded", [False, True])
def test_only_groups_with_elements_have_a_heading(loaded: bool, tmp_path: Path) -> None:
    m = kp.Model("rod", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    if loaded:
        m.torque("load", "rod", torque=1)
        m.coordinate_driver("motor", "rod.angle", value="t")
    kp.Case(m).save(tmp_path / "rod.toml")
    found = kempe("check", tmp_path / "rod.toml")
    lines = [line.strip() for line in found.stdout.splitlines()]
    present = [name for name in ("Bodies", "Joints", "Drivers", "Forces") if name in lines]
    assert present == ["Bodies", "Joints", *(["Drivers", "Forces"] if loaded else [])]
    free = 0 if loaded else 1
    assert any(line.endswith(f"{free} degree{'s' * loaded} of freedom") for line in lines)
