"""Parameters with units: in a file, in JSON, in Python and with ``--set``."""

import json
from pathlib import Path

import kempe as kp
import pytest
from kempe.cli import main

CASE = """\
kempe = 1
[parameters]
L = "800 mm"
m = "2 kg"
k = "3 N*m/rad"
[bodies.ground]
points = { O = [0, 0] }
[bodies.rod]
type = "bar"
mass = "m"
length = "L"
ends = ["O", "P"]
[joints.pin]
type = "revolute"
i = "ground.O"
j = "rod.O"
[forces.spring]
type = "torsion_spring"
i = "ground"
j = "rod"
stiffness = "k"
[start]
set = { "rod.angle" = 0.1 }
[analyses.swing]
type = "dynamics"
t_end = 0.1
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "rod.toml"
    path.write_text(CASE, "utf-8")
    return path


def test_a_length_as_a_mass_names_both_dimensions_and_the_line(file: Path, tmp_path: Path) -> None:
    assert kp.load(file).model.bodies["rod"].mass == 2.0
    file.write_text(CASE.replace('mass = "m"', 'mass = "L"'), "utf-8")
    with pytest.raises(kp.ModelError, match="'L' is in m; must be in kg") as caught:
        kp.load(file)
    (problem,) = caught.value.problems
    assert (problem.path, problem.line, problem.column) == ("bodies.rod.mass", 10, 9)
    file.write_text(CASE, "utf-8")
    as_json = tmp_path / "rod.json"
    kp.load(file).save(as_json)
    tree = json.loads(as_json.read_text("utf-8"))
    tree["bodies"]["rod"]["mass"] = "L"
    as_json.write_text(json.dumps(tree), "utf-8")
    with pytest.raises(kp.ModelError, match="'L' is in m; must be in kg"):
        kp.load(as_json)


def test_python_refuses_the_same(file: Path) -> None:
    m = kp.Model("rod", parameters={"L": "800 mm", "F": "1 kN"})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass="L", length="L", ends=("O", "P"))
    m.torsion_spring("s", "ground", "rod", stiffness="F")
    with pytest.raises(kp.ModelError) as caught:
        m.compile()
    assert [problem.path for problem in caught.value.problems] == [
        "bodies.rod.mass",
        "forces.s.stiffness",
    ]
    model = kp.load(file).model.with_parameters({"k": "1 kN"})
    with pytest.raises(kp.ModelError, match=r"'k' is in N \(kg\*m\*s\^-2\); must be in N\*m/rad"):
        model.compile()
    assert kp.load(file, parameters={"k": "1 kN*m"}).model.parameters["k"] == 1000.0
    assert kp.load(file, parameters={"k": 5}).model.parameters["k"] == 5.0


def test_the_command_line_refuses_the_same(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(file), "--set", "k=1 kN"]) == 2
    told = " ".join(capsys.readouterr().err.split())
    assert "forces.spring.stiffness: 'k' is in N (kg*m*s^-2); must be in N*m/rad" in told
    assert "(line 21, column 14)" in told
    assert main(["check", str(file), "--set", "k=1 kN*m/rad"]) == 0


def test_start_and_options_have_dimensions_too(file: Path) -> None:
    for right, wrong, path in [
        ('"rod.angle" = 0.1', '"rod.angle" = "L"', "start.set.rod.angle"),
        ("t_end = 0.1", 't_end = "L"', "analyses.swing.t_end"),
        (
            "t_end = 0.1",
            't_end = 1\nmethod = { type = "rk4", step = "m" }',
            "analyses.swing.method.step",
        ),
        (
            "t_end = 0.1",
            't_end = 1\nmethod = { type = "rk45", rtol = "m" }',
            "analyses.swing.method.rtol",
        ),
    ]:
        file.write_text(CASE.replace(right, wrong), "utf-8")
        with pytest.raises(kp.ModelError) as caught:
            kp.load(file)
        (problem,) = caught.value.problems
        assert problem.path == path
        assert "must be" in problem.message
        assert problem.line is not None
