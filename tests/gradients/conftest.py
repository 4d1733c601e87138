"""A rod on a spring: parameters with and without units, a start, and two analyses."""

from pathlib import Path

import kempe as kp
import pytest

TEXT = """kempe = 1
title = "A rod on a spring"
gravity = [0, -9.81]

[parameters]
mass = "2 kg"
length = "1 m"
stiffness = 40                                  # N*m/rad
unused = "3 m"

[bodies.rod]
type = "bar"
mass = "mass"
length = "length"
ends = ["O", "P"]

[bodies.ground]
points = { O = [0, 0] }

[joints.O]
type = "revolute"
i = "ground.O"
j = "rod.O"

[forces.spring]
type = "torsion_spring"
i = "ground"
j = "rod"
stiffness = "stiffness"
free_angle = 0

[measures]
pin = "O.force"

[start]
set = { "rod.angle" = 0.5, "rod.omega" = 0 }

[analyses.swing]
type = "dynamics"
t_end = 0.4
output_step = 0.01

[analyses.ringing]
type = "modes"
from = "start"
"""
SECTION = """
[gradient]
measures = ["pin.max", "rod.angle.final"]
variables = ["stiffness", "length"]
analysis = "swing"
"""


def written(folder: Path, section: str = SECTION) -> Path:
    path = folder / "rod.toml"
    path.write_text(TEXT + section, "utf-8")
    return path


@pytest.fixture
def case(tmp_path: Path) -> kp.Case:
    return kp.load(written(tmp_path, ""))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path
