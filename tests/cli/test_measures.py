"""Measures on the command line."""

import json
from pathlib import Path

import pytest
from kempe.cli import main

CASE = """kempe = 1
title = "A swinging rod"
gravity = [0, -9.81]

[bodies.ground]
points = { O = [0, 0] }

[bodies.rod]
type = "bar"
mass = 2
length = 1
ends = ["O", "P"]

[joints.O]
type = "revolute"
i = "ground.O"
j = "rod.O"

[measures]
pin = "O.force"
height = "rod.P.y"

[start]
set = { "rod.angle" = 0.0 }

[analyses.swing]
type = "dynamics"
t_end = 1
output_step = 0.01
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "rod.toml"
    path.write_text(CASE, "utf-8")
    return path


def test_a_run_prints_and_writes_measures(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = file.with_name("out")
    assert main(["run", str(file), "-o", str(out)]) == 0
    printed = capsys.readouterr().out
    line = next(row.split() for row in printed.splitlines() if row.split()[:2] == ["pin", "N"])
    # from horizontal: the pin carries 5/2 m g at the lowest point
    assert float(line[2]) == pytest.approx(2.5 * 2 * 9.81, rel=1e-5)
    assert "Newton-Euler balance within" in printed
    summary = json.loads((out / "summary.json").read_text("utf-8"))
    pin, height = summary["measures"]
    assert pin["max"] == pytest.approx(2.5 * 2 * 9.81, rel=1e-6)
    assert height["min"] == pytest.approx(-1, abs=1e-6)
    assert summary["newton_euler"] < 1e-9
    assert (out / "solution.csv").read_text("utf-8").splitlines()[0].endswith("pin [N],height [m]")
    assert [path.name.partition("_")[2] for path in sorted(out.glob("figures/*measure*.png"))] == [
        "measure_height.png",
        "measure_pin.png",
    ]


def test_one_measure_is_drawn(file: Path) -> None:
    out = file.with_name("figures")
    assert main(["plot", str(file), "--figure", "measure_pin", "-o", str(out)]) == 0
    assert len(list(out.rglob("*.png"))) == 1


def test_an_unknown_measure_has_a_suggestion(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", str(file), "--figure", "measure_pni"]) != 0
    assert "did you mean 'pin'" in capsys.readouterr().err


def test_check_reports_the_line(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file.write_text(CASE.replace('"O.force"', '"2*O.forec"'), "utf-8")
    assert main(["check", str(file)]) != 0
    told = capsys.readouterr().err
    assert "line 20" in told
    assert "did you mean 'O.force'" in told


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ("pin = 3", "must be an expression of quantities"),
        ("rod = 'O.force'", "'rod' is already the name of a body"),
        ("t = 'O.force'", "'t' is reserved"),
        ("'a.b' = 'O.force'", "must not contain '.'"),
    ],
)
def test_check_refuses(
    file: Path, changed: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    file.write_text(CASE.replace('pin = "O.force"', changed), "utf-8")
    assert main(["check", str(file)]) != 0
    assert told in capsys.readouterr().err
