"""The section [fit] and the command ``kempe fit``; data with faults."""

import csv
import json
import re
from pathlib import Path

import jsonschema
import kempe as kp
import numpy as np
import pytest
from fits.conftest import SECTION, TEXT, written
from fits.machines import TIMES, TRUE, angle, film, rod
from kempe.cli.app import run

HERE = Path("out/rod/fit")


def test_the_command(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = kp.load(written(folder))
    found = kp.fit(case, "rod.csv")
    columns = {"rod.angle": "phi [deg]"}
    data = kp.Data("rod.csv", t="time", columns=columns, sigma={"rod.angle": np.radians(0.5)})
    same = kp.fit(case, data, {"J": (0, None), "c": (0, None), "rod.angle": None})
    assert found.values == same.values and data.missing == {"rod.angle": 2}
    for name, value in TRUE.items():
        assert abs(found.values[name] - value) < 4 * found.standard_errors[name]
    assert run(["fit", "rod.toml", "rod.csv"]) == 0
    told = capsys.readouterr().out
    assert f"{found.values['J']:.6g}" in told and re.search(r"rod.angle +118 +2 ", told)
    with (HERE / "residuals.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 118
    assert float(rows[5]["residual"]) == found.residuals["rod.angle"][5]
    figures = sorted(path.name for path in (HERE / "figures").iterdir())
    assert figures == ["00_fit.png", "00_fit.svg"]


def test_the_new_file_keeps_comments_and_units(folder: Path) -> None:
    written(folder)
    assert run(["fit", "rod.toml", "rod.csv"]) == 0
    new = (HERE / "fitted.toml").read_text("utf-8")
    old = (TEXT + SECTION).splitlines()
    changed = [(a, b) for a, b in zip(old, new.splitlines(), strict=True) if a != b]
    assert [a.split()[0] for a, _ in changed] == ["J", "c", "set"]
    assert changed[0][1].endswith(' kg*mm^2"                              # to be found')
    assert ' deg", "rod.omega" = 0 }' in changed[2][1]
    found, again = kp.fit(kp.load("rod.toml"), "rod.csv"), kp.load(HERE / "fitted.toml")
    assert again.model.parameters["J"] == pytest.approx(found.values["J"], rel=1e-12)
    assert again.start()["rod.angle"] == pytest.approx(found.values["rod.angle"], rel=1e-12)


def test_json(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder, SECTION + 'zero = "free"\n')
    path = Path("rod.toml")
    path.write_text(path.read_text("utf-8").replace("c = 0.0", "zero = 1\nc = 0.0", 1), "utf-8")
    assert run(["fit", "rod.toml", "rod.csv", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["undetermined"] == ["zero has no effect on the data"]
    assert found["standard_errors"]["zero"] is None and found["missing"] == {"rod.angle": 2}


@pytest.mark.parametrize("form", ["toml", "json"])
def test_saving_loses_nothing(form: str, folder: Path) -> None:
    case = kp.load(written(folder))
    case.save(f"saved.{form}")
    again = kp.load(f"saved.{form}")
    assert again.fit == case.fit and again.fit["parameters"]["rod.angle"] == "free"
    again.save(f"twice.{form}")
    assert Path(f"twice.{form}").read_bytes() == Path(f"saved.{form}").read_bytes()
    jsonschema.validate(again.tree(), json.loads(kp._core.schema()))


def test_check(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder)
    assert run(["check", "rod.toml"]) == 0
    assert "; fit: J, c, rod.angle to rod.angle" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("J = [0", "K = [0", r"fit.parameters.K: there is no parameter 'K'"),
        ('[0, "free"]', '[0, "none"]', r"fit.parameters.J.1: .*must be a number"),
        ('[0, "free"]', '"fre"', r"fit.parameters.J: .*must be \"free\", or a list"),
        ('"phi [deg]" }\nsigma', "3 }\nsigma", r"fit.columns.rod.angle: .*header of a column"),
        ("columns =", "column =", r"fit.column: unknown key .*did you mean 'columns'"),
        ('sigma = { "rod.angle" = "0.5 deg" }', 'robust = "l1"', r"fit.robust: "),
    ],
)
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
        ("phi [deg]", "phi [mm]", r"columns.rod.angle: it is in m as written, but .* in rad"),
        ("0.5 deg", "0.5 mm", r"sigma.rod.angle: it is in m as written"),
        ("0.5 deg", "-1 deg", r"must be > 0"),
        ('"time"', '"time [m]"', r"t: it is in m as written, but .* is in s"),
        ('{ "rod.angle" = "phi', '{ "rod.angel" = "phi', r"sigma 'rod.angle'.*mean 'rod.angel'"),
        ('[0, "free"]', "[1, 0]", r"from 1 to 0; the second must be larger"),
    ],
)  # fmt: skip
def test_check_finds_what_the_reader_does_not(
    old: str, new: str, message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written(folder, SECTION.replace(old, new, 1))
    assert run(["check", "rod.toml"]) == 2
    told = capsys.readouterr().err.replace("\n", " ")
    assert re.search(message, told), told
    assert re.search(r"\(?line \d+", told), told


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time;phi [deg]\n0;1,5\n0,1;1,2\n", ""),
        ("time\tphi [deg]\n0\t1.5\n0.1\tNaN\n0.2\t1\n", ""),
        ("time,phi\n0,1.5\n", "unknown column of rod.angle 'phi [deg]'"),
        ("t,phi [deg]\n0,1.5\n", "unknown time 'time'"),
        ("time,phi [deg]\n0,abc\n", "row 1, 'phi [deg]': 'abc' is not a number"),
        ("time,phi [deg]\n0\n", "row 1 has 1 cells, the header 2"),
        ("time,phi [deg]\n0,\n", "'phi [deg]' has no values"),
        ("time,time\n0,1\n", "a header occurs twice"),
        ("", "is empty"),
    ],
)
def test_tables(text: str, message: str, folder: Path) -> None:
    assert folder == Path.cwd()
    Path("a.csv").write_text(text, "utf-8")
    if not message:
        data = kp.Data("a.csv", t="time", columns={"rod.angle": "phi [deg]"})
        assert data.values["rod.angle"][0] == pytest.approx(np.radians(1.5))
        assert data.t["rod.angle"][0] == 0 and len(data) == 2
        return
    with pytest.raises(kp.KempeError, match=re.escape(message)):
        kp.Data("a.csv", t="time", columns={"rod.angle": "phi [deg]"})


def test_tables_in_memory_and_headers_without_units() -> None:
    pandas = pytest.importorskip("pandas")
    table = film(2)
    free = {"J": (0, None), "c": (0, None), "rod.angle": None}
    one = kp.fit(rod(), angle(table), free)
    assert kp.fit(rod(), angle(pandas.DataFrame(table)), free).values == one.values
    plain = {"t": TIMES, "a": np.radians(table["phi [deg]"])}
    other = kp.fit(rod(), kp.Data(plain, columns={"rod.angle": "a"}), free)
    assert other.values == pytest.approx(dict(one.values), rel=1e-9)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        ({"parameters": {"K": None}}, "unknown variable 'K'"),
        ({"parameters": {"J": (1, 0)}}, "parameters.J: from 1 to 0"),
        ({"parameters": {"J": "wide"}}, "parameters.J: 'wide'; must be None or"),
        ({}, "no parameters"),
        ({"parameters": {"J": None}, "robust": "l2"}, "unknown robust 'l2'"),
        ({"parameters": {"J": None}, "priors": {"c": (1, 1)}}, "unknown parameter in priors 'c'"),
        ({"parameters": {"J": None}, "priors": {"J": (1, 0)}}, "standard deviation > 0"),
        ({"parameters": {"J": None}, "losses": 1}, "unknown argument 'losses'"),
    ],
)
def test_wrong_requests(ask: dict[str, object], message: str) -> None:
    with pytest.raises(kp.ModelError, match=re.escape(message)):
        kp.fit(rod(), angle(film(0)), **ask)  # type: ignore[arg-type]


def test_data_beyond_the_motion_and_other_analyses() -> None:
    late = kp.Data({"t": [1, 7], "a": [0, 0]}, columns={"rod.angle": "a"})
    with pytest.raises(
        kp.KempeError, match=r"from 1 to 7 s, and the run from 0 to 6 s.*change t_end"
    ):
        kp.fit(rod(), late, {"J": (0, None)})
    with pytest.raises(kp.ModelError, match="quantity of a whole run"):
        whole = kp.Data({"t": [1, 2], "a": [0, 0]}, columns={"energy.total": "a"})
        kp.fit(rod(), whole, {"J": (0, None)})
    rest = rod().with_start({})._with(analyses={"rest": {"type": "equilibrium"}})
    with pytest.raises(kp.ModelError, match="equilibrium is not a motion"):
        kp.fit(rest, angle(film(0)), {"J": (0, None)})


def test_reactions_and_driven_motions() -> None:
    """The mass of a driven rod from the force in its bearing, over the angle."""
    m = kp.Model("driven rod", gravity=(0, -9.81), parameters={"mass": 1.0})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass="mass", length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    run_over = kp.InverseDynamics(over="rod.angle", range=(0, 2), n=21, static=True)
    case = kp.Case(m, {"set": {"rod.angle": 0}}, [run_over])
    phi = np.linspace(0.1, 1.9, 15)
    table = {"phi [deg]": np.degrees(phi), "M": 2.5 * 9.81 * 0.5 * np.cos(phi)}
    data = kp.Data(table, t="phi", columns={"over.effort": "M"})
    found = kp.fit(case, data, {"mass": (0, None)})
    assert found.values["mass"] == pytest.approx(2.5, rel=1e-9)
