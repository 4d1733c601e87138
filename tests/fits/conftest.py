"""A rod on an edge as a file, and its film."""

import csv
from pathlib import Path

import pytest
from fits.machines import film

TEXT = """kempe = 1
title = "Rod on an edge"
gravity = [0, -9.81]

[parameters]
J = "4000 kg*mm^2"                              # to be found
c = 0.0                                         # of the edge

[bodies.ground]
points = { O = [0, 0] }

[bodies.rod]
mass = 0.62
inertia = "J"
points = { O = [0, 0.14] }

[joints.edge]
type = "revolute"
i = "ground.O"
j = "rod.O"

[forces.bearing]
type = "torsion_spring"
i = "ground"
j = "rod"
damping = "c"

[start]
set = { "rod.angle" = "35 deg", "rod.omega" = 0 }

[analyses.swing]
type = "dynamics"
t_end = 6
"""
SECTION = """
[fit]
t = "time"
columns = { "rod.angle" = "phi [deg]" }
sigma = { "rod.angle" = "0.5 deg" }

[fit.parameters]
J = [0, "free"]
c = [0, "free"]
"rod.angle" = "free"
"""


def written(folder: Path, section: str = SECTION) -> Path:
    path = folder / "rod.toml"
    path.write_text(TEXT + section, "utf-8")
    with (folder / "rod.csv").open("w", encoding="utf-8") as file:
        write = csv.writer(file, lineterminator="\n")
        write.writerow(["time", "phi [deg]", "note"])
        for k, (t, phi) in enumerate(zip(*film(4).values(), strict=True)):
            write.writerow([f"{t:.3f}", "" if k in (7, 30) else f"{phi:.6f}", "1"])
    return path


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path
