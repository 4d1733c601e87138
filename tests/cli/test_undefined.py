"""A law that is undefined at one output time: the solution before it is written."""

from pathlib import Path

import kempe as kp
import pytest
from kempe.cli import main

#: Steps of 40 ms evaluate the law at multiples of 20 ms, outputs at multiples of 50 ms.
CASE = """\
kempe = 1
gravity = [0, -9.81]
bodies.ground.points = { O = [0, 0] }
bodies.rod = { type = "bar", mass = 1, length = 1, ends = ["A", "B"] }
joints.pin = { type = "revolute", i = "ground.O", j = "rod.A" }
[forces.spring]
type = "torsion_spring"
i = "ground"
j = "rod"
stiffness = "2 + (t - 0.25) / (t - 0.25)"
[start]
set = { "rod.angle" = "0.5" }
[analyses.swing]
type = "dynamics"
t_end = 1
output_step = 0.05
method = { type = "rk4", step = 0.04 }
"""


def test_the_solution_before_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("swing.toml").write_text(CASE, "utf-8")
    assert main(["run", "swing.toml", "--no-figures"]) == 3
    told = " ".join(capsys.readouterr().err.split())
    assert "the solution up to 0.2 s is in" in told
    assert (
        "undefined at t = 0.250000 s: the law stiffness of spring has no finite value there" in told
    )
    assert "check forces and laws at this state" in told
    kept = kp.load_solution(next(Path("out").rglob("solution.npz")))
    assert len(kept.t) == len(kept.a) == 5
    assert not kept.success
