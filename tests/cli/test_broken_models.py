"""Broken model files: messages with positions, and the correct exit code."""

import re
from pathlib import Path

import pytest
from kempe.cli import exit_codes, main

FLAGSHIP = (Path(__file__).parents[2] / "examples/four_bar.toml").read_text("utf-8")

#: Replaced text, new text, expected part of the message, line, column.
BROKEN: list[tuple[str, str, str, int, int]] = [
    ("mass = 3", "mass = -1", "-1 kg; must not be negative", 18, 8),
    ("mass = 3", "mass = nan", "nan", 18, 8),
    ("mass = 3", "mass = inf", "inf", 18, 8),
    ("mass = 3", 'mass = "M1"', "unknown name 'M1'", 18, 9),
    ("mass = 3", 'mass = "3 +"', "ends too early", 18, 12),
    ("mass = 3", 'mass = "3 m"', "'3 m' is in m; must be in kg", 18, 9),
    ("mass = 3", "mass = true", "a number", 18, 8),
    ("mass = 3", "mass = [3]", "a number", 18, 8),
    ("mass = 3", "mas = 3", "did you mean 'mass'", 18, 1),
    ('type = "bar" ', 'type = "barr" ', "did you mean 'bar'", 17, 8),
    ('length = "L1"', 'length = "L9"', "unknown name 'L9'", 19, 11),
    ('length = "L1"', "length = 0", "0 m; must be > 0", 19, 10),
    ('length = "L1"', 'length = "L1*t"', "t", 19, 14),
    ('ends = ["A", "B"]', 'ends = ["A"]', "two", 20, 8),
    ('i = "coupler.C"', 'i = "cuopler.C"', "did you mean 'coupler'", 46, 5),
    ('i = "coupler.C"', 'i = "coupler.X"', "has no point 'X'", 46, 5),
    ('i = "coupler.C"', 'i = "coupler"', "body.point", 46, 5),
    ('i = "coupler.C"\n', "", "missing; revolute needs it", 44, 9),
    ('type = "revolute"\ni = "coupler.C"', 'type = "hinge"\ni = "coupler.C"', "hinge", 45, 8),
    ('stiffness = "k"', 'stiffness = "kk"', "unknown name 'kk'", 58, 14),
    ('stiffness = "k"', 'stiffness = "1/0"', "1/0", 58, 14),
    ('damping = "c"', 'dampning = "c"', "did you mean 'damping'", 59, 1),
    ("L2 = 26", 'L2 = "L3"\nL4 = "L2 + L5"\nL5 = "L4"', "L4 → L5 → L4", 8, 7),
    ("kempe = 1", "kempe = 2", "2", 1, 9),
    ("kempe = 1", "kepme = 1", "did you mean 'kempe'?", 1, 1),
    ("[joints.A]", "[joint.A]", "did you mean 'joints'", 34, 2),
    ("[joints.B]", "[joints.crank]", "already the name of a body", 39, 9),
    ('"crank.angle" = "70*deg"', '"crank.angel" = "70*deg"', "angle", 63, 9),
    ('"crank.angle" = "70*deg"', '"crnak.angle" = "70*deg"', "did you mean 'crank'", 63, 9),
    ("t_end = 15", "t_end = 15\nt_ned = 3", "did you mean 't_end'", 69, 1),
    ("rtol = 1e-6", "rtol = -1e-6", "must be >= 0", 70, 34),
    ('type = "rk45"', 'type = "rk54"', "did you mean 'rk45'", 70, 19),
    ("output_step = 0.01", "output_step = 0", "must be > 0", 69, 15),
]


@pytest.mark.parametrize(("old", "new", "message", "line", "column"), BROKEN)
def test_a_broken_model_is_reported_with_its_position(
    old: str,
    new: str,
    message: str,
    line: int,
    column: int,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert FLAGSHIP.count(old) >= 1
    path = tmp_path / "broken.toml"
    path.write_text(FLAGSHIP.replace(old, new, 1), "utf-8")
    assert main(["check", str(path)]) == exit_codes.BAD_INPUT
    told = capsys.readouterr().err
    assert message in told
    assert f"(line {line}, column {column})" in told, told
    assert re.search(r"^ +\| +\^", told, re.MULTILINE)
    assert "Traceback" not in told


def test_all_problems_are_reported_together(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = FLAGSHIP.replace("mass = 3", "mass = -3").replace('i = "coupler.C"', 'i = "cuopler.C"')
    path = tmp_path / "broken.toml"
    path.write_text(text, "utf-8")
    assert main(["check", str(path)]) == exit_codes.BAD_INPUT
    told = capsys.readouterr().err
    assert "-3 kg" in told
    assert "cuopler" in told
