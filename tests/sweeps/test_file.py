"""The section [sweep] of a file: read, checked with places, written, run."""

import json
import re
from pathlib import Path

import jsonschema
import kempe as kp
import numpy as np
import pytest
from sweeps.conftest import FLAGSHIP

SECTION = """
[measures]
pin = "C.force"

[sweep]
measures = ["pin.max", "rocker.angle.final"]
design = "grid"
analysis = "release"

[sweep.variables]
L2 = { from = 25, to = 26, n = 2 }
k = [1e6, 2e6]
"""


def written(folder: Path, section: str = SECTION) -> Path:
    path = folder / "case.toml"
    text = FLAGSHIP.read_text("utf-8").replace("t_end = 15", "t_end = 0.1")
    path.write_text(text + section, "utf-8")
    return path


def test_a_case_runs_its_sweep(folder: Path) -> None:
    case = kp.load(written(folder))
    result = kp.sweep(case)
    assert result.columns == ("L2", "k", "pin.max", "rocker.angle.final")
    np.testing.assert_array_equal(result["L2"], [25, 25, 26, 26])
    same = kp.sweep(case, {"L2": [25, 26], "k": [1e6, 2e6]}, ["pin.max", "rocker.angle.final"])
    np.testing.assert_array_equal(result["pin.max"], same["pin.max"])


def test_arguments_come_before_the_file(folder: Path) -> None:
    case = kp.load(written(folder))
    assert kp.sweep(case, {"k": [1e6]}).columns == ("k", "pin.max", "rocker.angle.final")
    assert kp.sweep(case, measures=["pin.min"]).columns == ("L2", "k", "pin.min")


@pytest.mark.parametrize("form", ["toml", "json"])
def test_saving_loses_nothing(form: str, folder: Path) -> None:
    case = kp.load(written(folder))
    case.with_parameters({"c": 2e4}).save(f"saved.{form}")
    again = kp.load(f"saved.{form}")
    assert again.sweep == case.sweep
    assert list(again.sweep["variables"]["L2"]) == ["from", "to", "n"]
    again.save(f"twice.{form}")
    assert Path(f"twice.{form}").read_bytes() == Path(f"saved.{form}").read_bytes()


def test_a_case_built_in_python_has_one_too(folder: Path) -> None:
    case = kp.load(FLAGSHIP)
    sweep = {
        "variables": {"k": {"normal": [1e6, 1e4]}},
        "measures": ["C.force.max"],
        "design": "sobol",
        "n": 4,
    }
    made = kp.Case(case.model, case._start, case.analyses, sweep)
    made.save("made.toml")
    assert kp.load(folder / "made.toml").sweep == sweep
    with pytest.raises(kp.ModelError, match=r"sweep\.variables\.kk: there is no parameter 'kk'"):
        kp.Case(
            case.model, None, case.analyses, {"variables": {"kk": [1]}, "measures": ["C.force.max"]}
        )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "k = [1e6, 2e6]",
            "kk = [1e6]",
            r"sweep.variables.kk: there is no parameter 'kk'.*line \d+",
        ),
        ("k = [1e6, 2e6]", '"crank.foo" = [1]', r"sweep.variables.crank.foo: .*line \d+"),
        ("k = [1e6, 2e6]", 'k = "1e6"', r"sweep.variables.k: .*list of numbers.*line \d+"),
        ("k = [1e6, 2e6]", 'k = ["a"]', r"sweep.variables.k.0: .*number, in SI units.*line \d+"),
        ("k = [1e6, 2e6]", "k = []", r"sweep.variables.k: a list of 0.*line \d+"),
        ("n = 2", "m = 2", r"sweep.variables.L2.m: unknown key 'm'.*line \d+"),
        ("n = 2", "n = 1", r"sweep.variables.L2.n: 1; must be a whole number from 2.*line \d+"),
        ("n = 2", 'scale = "lg"', r"sweep.variables.L2.scale: .*log.*line \d+"),
        ("from = 25, ", "", r"sweep.variables.L2: from is missing.*line \d+"),
        ('"grid"', '"gird"', r"sweep.design: .*did you mean 'grid'.*line \d+"),
        ('"release"', '"realise"', r"sweep.analysis: no analysis 'realise'.*line \d+"),
        (
            '"pin.max"',
            '"pin.mx"',
            r"sweep.measures.0: a measure has no statistic 'mx'.*did you mean.*line \d+",
        ),
        ('"pin.max"', '"pn.fx.max"', r"sweep.measures.0: .*line \d+"),
        (
            'design = "grid"',
            "seeds = 1",
            r"sweep.seeds: unknown key 'seeds'.*did you mean.*line \d+",
        ),
        ('design = "grid"', "n = 1.5", r"sweep.n: 1.5; must be a whole number from 1.*line \d+"),
        ("measures = ", "design = ", r"sweep: measures is missing"),
    ],
)
def test_faults_have_their_place(old: str, new: str, message: str, folder: Path) -> None:
    section = SECTION.replace('design = "grid"\n', "") if new.startswith("design = ") else SECTION
    assert old in section
    with pytest.raises(kp.KempeError) as caught:
        kp.load(written(folder, section.replace(old, new)))
    told = " ".join(str(problem) for problem in caught.value.problems)
    assert re.search(message, told, re.DOTALL), told


def test_the_schema_describes_it(folder: Path) -> None:
    from kempe.case import schema as text

    schema = json.loads(text())
    case = kp.load(written(folder))
    tree = json.loads(json.dumps(case.tree()))
    jsonschema.validate(tree, schema)
    for wrong in ({"variables": {}}, {"variables": {"k": "x"}, "measures": ["a.max"]}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**tree, "sweep": wrong}, schema)
