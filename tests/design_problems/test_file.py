"""The section [optimize] of a file: read, checked with places, written, solved."""

import json
import re
from pathlib import Path

import jsonschema
import kempe as kp
import pytest
from design_problems.conftest import SECTION, written
from kempe.cli.app import run


def test_a_case_solves_its_problem(folder: Path) -> None:
    case = kp.load(written(folder))
    best = kp.optimize(case)
    same = kp.optimize(
        case, {"k": (50, 2000, "log"), "h": (0.05, 0.3)}, minimize="over.effort.rms",
        subject_to=["h <= 0.25", "spring.force.peak <= 8*weight"], starts=2, seed=4,
    )  # fmt: skip
    assert best.values == same.values and best.runs == same.runs
    other = kp.optimize(case, maximize="over.effort.rms", starts=1)
    assert other.objective > best.objective and not other._problem.limits


@pytest.mark.parametrize("form", ["toml", "json"])
def test_saving_loses_nothing(form: str, folder: Path) -> None:
    case = kp.load(written(folder))
    case.with_parameters({"mass": 3}).save(f"saved.{form}")
    again = kp.load(f"saved.{form}")
    assert again.optimize == case.optimize and again.optimize["starts"] == 2
    again.save(f"twice.{form}")
    assert Path(f"twice.{form}").read_bytes() == Path(f"saved.{form}").read_bytes()


def test_a_path_and_targets_in_a_file(folder: Path) -> None:
    points = 'minimize = { points = [[0.9, -0.3]], of = "arm.S", angles = [0.1] }'
    section = re.sub(r"minimize = .*", points, SECTION)
    case = kp.load(written(folder, section.replace("starts = 2", "starts = 1")))
    case.save("saved.toml")
    assert kp.load("saved.toml").optimize == case.optimize
    jsonschema.validate(case.tree(), json.loads(kp._core.schema()))
    best = kp.optimize(case)  # the place of S does not depend on the spring
    assert best.objective == pytest.approx(abs(0.15 * complex(0.99500417, 0.09983342) - 0.9 + 0.3j))
    section = re.sub(r"minimize = .*", 'target = { "spring.force.peak" = 60 }', SECTION)
    assert kp.optimize(kp.load(written(folder, section))).objective < 1e-6


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("{ k =", "{ kk =", r"optimize.variables.kk: there is no parameter 'kk'"),
        ("[50, 2000, ", "[50, ", r"optimize.variables.k.1: .*must be a number"),
        ('"log"', '"lg"', r"optimize.variables.k.2: .*did you mean 'log'"),
        ("[0.05, 0.3]", "0.3", r"optimize.variables.h: .*a list \[least, largest\]"),
        ("[0.05, 0.3]", "[0.05]", r"optimize.variables.h: a list of 1"),
        ("minimize =", "minimise =", r"optimize.minimise: unknown key .*did you mean 'minimize'"),
        ('minimize = "over.effort.rms"\n', "", r"optimize: minimize, maximize or target is"),
        ("minimize =", 'target = { a = 1 }\nminimize =', r"optimize: more than one of minimize"),
        ('"over.effort.rms"', "3", r"optimize.minimize: .*a column such as"),
        ('"over.effort.rms"', "{ points = [[0]], of = \"arm.S\" }", r"points.0: a list of 1"),
        ('"over.effort.rms"', "{ point = [[0, 1]], of = \"arm.S\" }", r"point: unknown key"),
        ('["h <= 0.25", ', '[1, ', r"optimize.subject_to.0: .*a limit such as"),
        ("starts = 2", "starts = 0", r"optimize.starts: 0; must be a whole number from 1"),
        ("starts = 2", 'method = "simplex"', r"optimize.method: "),
    ],
)  # fmt: skip
def test_faults_have_places(old: str, new: str, message: str, folder: Path) -> None:
    assert old in SECTION
    path = written(folder, SECTION.replace(old, new, 1))
    with pytest.raises(kp.KempeError) as caught:
        kp.load(path)
    told = str(caught.value).replace("\n", " ")
    assert re.search(message, told), told
    assert re.search(r"line \d+", told)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("over.effort.rms", "over.effort.rsm", r"statistic in measures .*'rsm'"),
        ("over.effort.rms", "over.effort.rms + h", r"over.effort.rms is in N\*m, h is in m"),
        ("h <= 0.25", "h <= k", r"h is in m, k is in N/m"),
        ("h <= 0.25", "h = 0.25", r"'h = 0.25' is an equation.*target="),
        ("h <= 0.25", "h", r"must be a comparison such as"),
        ("h <= 0.25", "h <= hh", r"'hh' is neither a parameter nor a column"),
        ("[50, 2000", "[-50, 2000", r"variables.k: a logarithmic range from -50 to 2000"),
        ("[0.05, 0.3]", "[0.3, 0.05]", r"variables.h: from 0.3 to 0.05; the second must be larger"),
        ("starts = 2", 'method = "least-squares"', r"least-squares solves paths and targets"),
    ],
)
def test_check_finds_what_the_reader_does_not(
    old: str, new: str, message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written(folder, SECTION.replace(old, new, 1))
    assert run(["check", "lamp.toml"]) == 2
    told = capsys.readouterr().err.replace("\n", " ")
    assert re.search(message, told), told
    assert re.search(r"\(?line \d+", told), told


def test_check(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder)
    assert run(["check", "lamp.toml"]) == 0
    assert "; optimize: minimize over.effort.rms over k, h" in capsys.readouterr().out
    assert run(["check", "lamp.toml", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["optimize"] == {
        "objective": "minimize over.effort.rms",
        "variables": ["k", "h"],
        "subject_to": ["h <= 0.25", "spring.force.peak <= 8*weight"],
    }


def test_the_schema_has_the_section(folder: Path) -> None:
    case, schema = kp.load(written(folder)).tree(), json.loads(kp._core.schema())
    jsonschema.validate(case, schema)
    for broken in (
        {"variables": {"k": [1, 2]}},
        {**case["optimize"], "maximize": "over.effort.max"},
        {**case["optimize"], "variables": {"k": [1]}},
        {**case["optimize"], "measures": ["over.effort.max"]},
    ):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**case, "optimize": broken}, schema)
