"""A driven motion that ends at a rigid stop: the solution up to the stop is written."""

import math
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli import main

CASE = """\
kempe = 1
gravity = [0, -9.81]
bodies.ground.points = { O = [0, 0] }
bodies.arm = { type = "bar", mass = 2, length = 1, ends = ["O", "A"] }
joints.O = { type = "revolute", i = "ground.O", j = "arm.O" }
forces.wall = { type = "stop", coordinate = "arm.angle", upper = 1, restitution = 0.5 }
[analyses.turn]
type = "inverse_dynamics"
over = "arm.angle"
range = [0, 2]
n = 9
"""


def test_the_solution_up_to_a_stop_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("arm.toml").write_text(CASE, "utf-8")
    assert main(["run", "arm.toml", "--no-figures"]) == 3
    told = " ".join(capsys.readouterr().err.split())
    assert "the solution up to arm.angle = 1 rad is in" in told
    assert "wall is reached" in told


def test_its_efforts_are_those_before_the_stop(tmp_path: Path) -> None:
    (tmp_path / "arm.toml").write_text(CASE, "utf-8")
    case = kp.load(tmp_path / "arm.toml")
    with pytest.raises(kp.SingularityError, match="wall is reached") as caught:
        dict(case.each())
    motion = caught.value.solution
    angle = motion["arm.angle"]
    np.testing.assert_allclose(angle[-1], 1, rtol=1e-12)
    (driver,) = (n for n, info in motion.compiled.constraints.items() if info.group == "drivers")
    weight = [2 * 9.81 * 0.5 * math.cos(a) for a in angle]  # the drive turns at a constant rate
    np.testing.assert_allclose(motion[f"{driver}.effort"], weight, rtol=1e-9)
