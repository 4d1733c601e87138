"""The section [gradient] of a file: read, checked with places, written, computed."""

import json
import re
from pathlib import Path

import jsonschema
import kempe as kp
import numpy as np
import pytest
from gradients.conftest import SECTION, written
from kempe.cli.app import run


def test_a_case_computes_its_gradient(folder: Path) -> None:
    case = kp.load(written(folder))
    g = kp.gradient(case)
    same = kp.gradient(
        case, ["pin.max", "rod.angle.final"], ["stiffness", "length"], analysis="swing"
    )
    assert np.array_equal(g.jacobian, same.jacobian)
    other = kp.gradient(case, variables=["mass"])
    assert list(other.measures) == ["pin.max", "rod.angle.final"]
    assert list(other.variables) == ["mass"]


@pytest.mark.parametrize("form", ["toml", "json"])
def test_saving_loses_nothing(form: str, folder: Path) -> None:
    case = kp.load(written(folder))
    case.with_parameters({"mass": 3}).save(f"saved.{form}")
    again = kp.load(f"saved.{form}")
    assert again.gradient == case.gradient
    again.save(f"twice.{form}")
    assert Path(f"twice.{form}").read_bytes() == Path(f"saved.{form}").read_bytes()


def test_a_case_built_in_python_has_one_too(case: kp.Case, folder: Path) -> None:
    gradient = {"measures": ["pin.max"], "variables": ["mass", "rod.omega"], "analysis": "swing"}
    made = kp.Case(case.model, case._start, case.analyses, gradient=gradient)
    made.save("made.toml")
    assert kp.load(folder / "made.toml").gradient == gradient
    with pytest.raises(kp.ModelError, match=r"gradient\.variables\.0: there is no parameter 'ma'"):
        kp.Case(
            case.model, None, case.analyses, gradient={"measures": ["rod.x"], "variables": ["ma"]}
        )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"stiffness", ', '"stifness", ', r"gradient.variables.0: .*did you mean 'stiffness'"),
        ('"stiffness", ', '"rod.foo", ', r"gradient.variables.0: 'foo' is not a coordinate"),
        ('"stiffness", ', "1, ", r"gradient.variables.0: .*a variable such as \"L2\""),
        ('["stiffness", "length"]', "[]", r"gradient.variables: an empty list"),
        ('["stiffness", "length"]', '"length"', r"gradient.variables: .*a list of variables"),
        ('"pin.max"', '"pin.mx"', r"gradient.measures.0: a measure has no statistic 'mx'"),
        ('"swing"', '"swng"', r"gradient.analysis: no analysis 'swng'.*did you mean 'swing'"),
        ("variables =", "variable =", r"gradient.variable: unknown key .*did you mean 'variables'"),
        ('measures = ["pin.max", "rod.angle.final"]\n', "", r"gradient: measures is missing"),
        ("[gradient]", "[gradients]", r"unknown key 'gradients'.*did you mean 'gradient'"),
    ],
)
def test_faults_have_places(old: str, new: str, message: str, folder: Path) -> None:
    path = written(folder)
    path.write_text(path.read_text("utf-8").replace(old, new, 1), "utf-8")
    if old in SECTION and old != "[gradient]":
        head, _, tail = path.read_text("utf-8").replace(new, old, 1).rpartition("[gradient]")
        path.write_text(f"{head}[gradient]{tail.replace(old, new, 1)}", "utf-8")
    with pytest.raises(kp.KempeError) as caught:
        kp.load(path)
    told = " ".join([str(caught.value.args[0]), str(caught.value.hint)])
    assert re.search(message, told.replace("\n", " ")), told
    assert re.search(r"line \d+", told)


def test_the_schema_has_the_section(folder: Path) -> None:
    case, schema = kp.load(written(folder)).tree(), json.loads(kp._core.schema())
    jsonschema.validate(case, schema)
    for broken in ({"measures": ["pin.max"]}, {**case["gradient"], "seed": 1}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**case, "gradient": broken}, schema)


def test_check(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder)
    assert run(["check", "rod.toml"]) == 0
    told = capsys.readouterr().out
    assert "; gradient: pin.max, rod.angle.final over stiffness, length" in told
    assert run(["check", "rod.toml", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["gradient"]
    assert found == {
        "measures": ["pin.max", "rod.angle.final"],
        "variables": ["stiffness", "length"],
    }


def test_check_finds_what_the_reader_does_not(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written(folder, SECTION.replace('"length"]', '"stiffness"]'))
    assert run(["check", "rod.toml"]) == 2
    assert "gradient.variables: one of them is given twice (line" in capsys.readouterr().err
