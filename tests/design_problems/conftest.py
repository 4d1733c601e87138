"""A lamp on an arm with a spring, whose best stiffness is sought."""

from pathlib import Path

import kempe as kp
import pytest

TEXT = """kempe = 1
title = "A lamp"
gravity = [0, -9.81]

[parameters]
# the spring
k = "0.3 kN/m"                                  # to be chosen
h = "200 mm"                                    # of its anchor
mass = "1.2 kg"
g = "9.81 m/s^2"
weight = "g*mass"

[bodies.ground]
points = { O = [0, 0], H = [0, "h"] }

[bodies.arm]
mass = "mass"
inertia = 0.01
center = [0.5, 0]
points = { O = [0, 0], S = [0.15, 0] }

[joints.hinge]
type = "revolute"
i = "ground.O"
j = "arm.O"

[forces.spring]
type = "spring_damper"
i = "ground.H"
j = "arm.S"
stiffness = "k"
free_length = 0.02

[start]
set = { "arm.angle" = "-60*deg" }               # low

[analyses.hold]
type = "inverse_dynamics"
static = true
over = "arm.angle"
range = ["-60*deg", "60*deg"]
n = 41
"""
SECTION = """
[optimize]
variables = { k = [50, 2000, "log"], h = [0.05, 0.3] }
minimize = "over.effort.rms"
subject_to = ["h <= 0.25", "spring.force.peak <= 8*weight"]
starts = 2
seed = 4
"""


def written(folder: Path, section: str = SECTION) -> Path:
    path = folder / "lamp.toml"
    path.write_text(TEXT + section, "utf-8")
    return path


@pytest.fixture
def case(tmp_path: Path) -> kp.Case:
    return kp.load(written(tmp_path, ""))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path
