"""The mechanism as `kempe check` prints it, and the place of a finding of a driven motion."""

import io
import re
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from kempe.cli.findings import show_findings
from python.test_kinematics import slider_crank, started
from rich.console import Console


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


def test_the_place_of_the_largest_residual_is_an_angle_in_degrees() -> None:
    m = slider_crank()
    sol = kp.kinematics(m, started(m), over="crank.angle", range=(0.5, 3.0), n=40)
    written = io.StringIO()
    show_findings(Console(file=written, width=200), "turn", sol.summary)
    found = re.search(r"largest residual .* at ([\d.]+)(\S*)", written.getvalue())
    assert found
    worst = sol.summary["peaks"]["residual"]
    assert float(found[1]) == pytest.approx(np.degrees(worst["at"]), rel=1e-3)
    assert found[2].startswith("°")


def test_joints_that_are_forces_stand_among_the_joints(tmp_path: Path) -> None:
    """A gear with backlash and a loose belt have the types of their files."""
    m = kp.Model("wheels")
    m.ground.points(O=(0, 0), Q=(0.3, 0), R=(1, 0))
    for name, place in (("a", "O"), ("b", "Q"), ("c", "R")):
        m.body(name, mass=1, inertia=0.01, points={"O": (0, 0)})
        m.revolute(f"pin_{name}", f"ground.{place}", f"{name}.O")
    m.gear("teeth", "a.O", "b.O", radii=(0.1, 0.2), backlash=1e-3)
    m.belt("strap", "a.O", "c.O", radii=(0.1, 0.1), preload=10, friction=0.3)
    kp.Case(m).save(tmp_path / "wheels.toml")
    found = kempe("check", tmp_path / "wheels.toml").stdout
    joints = found[found.index("Joints") :]
    assert re.search(r"teeth +gear +a +b", joints)
    assert re.search(r"strap +belt +a +c", joints)
    assert "Forces" not in found
