"""Changes of a case on the command line: values, start, end, method and tolerances."""

import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.analyses.option import Option
from kempe.cli import main
from kempe.cli.arguments import Changes, Method, read_case

EXAMPLES = Path(__file__).parents[2] / "examples"
FOUR_BAR, SLIDER, SIX_BAR = (
    EXAMPLES / f"{name}.toml" for name in ("four_bar", "slider_crank", "six_bar")
)
FAST = ["--figures", "none", "-q", "-o", "r"]


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def run(file: Path, *words: str) -> kp.Solution:
    assert main(["run", str(file), *FAST, *words]) == 0
    return kp.load_solution("r/solution.npz")


# --- start ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("file", "setting", "name", "value"),
    [
        (FOUR_BAR, "crank.angle=80*deg", "crank.angle", np.radians(80)),
        (FOUR_BAR, "crank.angle = 80 deg", "crank.angle", np.radians(80)),
        (FOUR_BAR, "crank.angle=1.25", "crank.angle", 1.25),
        (FOUR_BAR, "crank.omega=-2", "crank.omega", -2.0),
        (SLIDER, "crank.angle=pi/3", "crank.angle", np.pi / 3),
    ],
    ids=str,
)
def test_a_coordinate_at_the_start_is_set(
    file: Path, setting: str, name: str, value: float
) -> None:
    found = run(file, "--set", setting, "--t-end", "0.01")
    assert found.initial.coordinates()[name] == pytest.approx(value, abs=1e-12)
    assert found.drift.position[0] < 1e-9


def test_a_start_and_a_parameter_are_set_together() -> None:
    found = run(FOUR_BAR, "--set", "L2=27", "--set", "crank.angle=1.3", "--t-end", "0.01")
    assert found.model.parameters["L2"] == 27.0
    assert found.initial["crank"].angle == pytest.approx(1.3, abs=1e-12)
    b, c = found.initial["crank"].point("B").position, found.initial["rocker"].point("C").position
    assert np.hypot(*(c - b)) == pytest.approx(27.0, abs=1e-9)


def test_a_set_value_replaces_a_guess_of_the_same_name() -> None:
    case = kp.load(FOUR_BAR)
    assert "coupler.angle" in case.tree()["start"]["guess"]
    tree = case.with_start({"coupler.angle": 0.25}).tree()["start"]
    assert tree["set"] == {"crank.angle": "70*deg", "coupler.angle": 0.25}
    assert tree["guess"] == {"rocker.angle": "240*deg"}
    assert case.held == {"crank.angle": "70*deg"}  # the case itself does not change


@pytest.mark.parametrize(
    ("setting", "told"),
    [
        ("crnk.angle=1", "did you mean 'crank'?"),
        ("crank.angel=1", "did you mean 'angle'?"),
        ("crank.angle=fast", "fast"),
        ("crank.angle=inf", "crank.angle"),
    ],
)
def test_a_wrong_start_is_refused(
    setting: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", str(FOUR_BAR), "--set", setting]) == 2
    assert told in capsys.readouterr().err


# --- method and tolerances ------------------------------------------------------------------------


def test_the_methods_are_those_of_the_core(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    kinds = {kind.kind for kind in Option.__subclasses__()}
    methods = {name.value for name in Method}
    assert methods == kinds - {"projection", "baumgarte", "none"}
    assert main(["run", "--help"]) == 0
    told = capsys.readouterr().out
    assert [name for name in methods if name not in told] == []


def test_a_method_keeps_the_tolerances() -> None:
    case = read_case(FOUR_BAR, Changes(method=Method.dop853))
    assert case.analyses["release"]["method"] == {"type": "dop853", "rtol": 1e-6, "atol": 1e-9}
    case = read_case(FOUR_BAR, Changes(method=Method.rk4, step=1e-3))
    assert case.analyses["release"]["method"] == {"type": "rk4", "step": 1e-3}


def test_tolerances_keep_the_method() -> None:
    case = read_case(FOUR_BAR, Changes(rtol=1e-10, atol=1e-12))
    assert case.analyses["release"]["method"] == {"type": "rk45", "rtol": 1e-10, "atol": 1e-12}
    assert "method" not in kp.load(SIX_BAR).analyses["turns"]
    case = read_case(SIX_BAR, Changes(rtol=1e-4))
    assert case.analyses["turns"]["method"] == {"type": "auto", "rtol": 1e-4}


@pytest.mark.filterwarnings("ignore::kempe.AccuracyWarning")  # of the coarse run
def test_the_method_is_used() -> None:
    usual = run(FOUR_BAR, "--t-end", "0.2")
    other = run(FOUR_BAR, "--t-end", "0.2", "--method", "dop853")
    assert other.statistics["evaluations"] != usual.statistics["evaluations"]
    np.testing.assert_allclose(other.q[-1], usual.q[-1], atol=1e-4)
    coarse = run(FOUR_BAR, "--t-end", "0.2", "--rtol", "1e-3", "--atol", "1e-3")
    fine = run(FOUR_BAR, "--t-end", "0.2", "--rtol", "1e-10", "--atol", "1e-12")
    assert coarse.statistics["steps"] < usual.statistics["steps"] < fine.statistics["steps"]
    stepped = run(FOUR_BAR, "--t-end", "0.2", "--method", "rk4", "--step", "0.001")
    assert stepped.statistics["steps"] == 200


def test_all_analyses_get_the_method() -> None:
    text = FOUR_BAR.read_text(encoding="utf-8")
    Path("two.toml").write_text(
        f'{text}\n[analyses.on]\ntype = "dynamics"\nt_end = 16\n', encoding="utf-8"
    )
    case = read_case(Path("two.toml"), Changes(method=Method.rk45, rtol=1e-5, t_end="15.5"))
    assert [entry["method"]["rtol"] for entry in case.analyses.values()] == [1e-5, 1e-5]
    assert [entry["t_end"] for entry in case.analyses.values()] == [15, 15.5]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--method", "euler"], "'rk45'"),
        (["--method", "rk4"], "step"),
        (["--rtol", "-1"], "rtol"),
        (["--rtol", "small"], "--rtol"),
        (["--method", "rk4", "--step", "0.01", "--rtol", "1e-3"], "rtol"),
    ],
    ids=str,
)
def test_a_wrong_method_is_refused(
    words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", str(FOUR_BAR), *words]) == 2
    assert told in capsys.readouterr().err


# --- end ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("command", ["run", "check", "plot", "animate"])
@pytest.mark.parametrize("end", ["-1", "-1e-9", "0 - 1"])
def test_a_run_does_not_go_backward(
    command: str, end: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, str(FOUR_BAR), "--t-end", end]) == 2
    told = capsys.readouterr().err
    assert "analyses.release.t_end" in told
    assert "lies before 0 s, where the run starts" in told
    assert not Path("out").exists()
    assert main(["run", str(FOUR_BAR), *FAST, "--t-end", "0"]) == 0  # the remedy


def test_a_chain_does_not_go_backward(capsys: pytest.CaptureFixture[str]) -> None:
    text = FOUR_BAR.read_text(encoding="utf-8")
    second = '\n[analyses.on]\ntype = "dynamics"\nt_end = {}\n'
    Path("chain.toml").write_text(text + second.format(5), encoding="utf-8")
    line = len(text.splitlines()) + 4
    for command in ("check", "run"):
        assert main([command, "chain.toml"]) == 2
        told = capsys.readouterr().err
        assert "analyses.on.t_end: 5 s lies before 15 s" in told
        assert f"(line {line}, column 9)" in told
        assert "t_end is a time, not a duration; it must be at least 15 s" in told
    Path("chain.toml").write_text(text + second.format(15), encoding="utf-8")
    assert main(["check", "chain.toml"]) == 0
    with pytest.raises(kp.ModelError, match="lies before 0 s"):
        kp.load(FOUR_BAR).with_analysis("release", t_end=-1)


# --- JSON -----------------------------------------------------------------------------------------


def told(words: list[str], code: int, capsys: pytest.CaptureFixture[str]) -> dict[str, object]:
    assert main(words) == code
    content: dict[str, object] = json.loads(capsys.readouterr().out)
    return content


def test_check_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    content = told(["check", str(FOUR_BAR), "--json"], 0, capsys)
    state = kp.load(FOUR_BAR).start()
    assert content["start"] == state.coordinates()
    assert content["mechanism"]["degrees_of_freedom"] == 1  # type: ignore[index]
    assert content["mechanism"]["joints"] == ["A", "B", "C", "D"]  # type: ignore[index]
    assert content["assembly"]["alternatives"] == 1  # type: ignore[index]
    assert content["analyses"] == [{"name": "release", "type": "dynamics"}]


def test_show_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["show", str(SLIDER), "--json", "--mass", "--multipliers", "--iterations", "--symbolic"]
    content = told(words, 0, capsys)
    case = kp.load(SLIDER)
    state = case.start()
    mass, multipliers = content["matrices"]  # type: ignore[misc]
    assert (mass["name"], multipliers["name"]) == ("M", "lam")
    np.testing.assert_array_equal(mass["values"], state.matrices().M)
    assert mass["rows"] == mass["columns"] == list(state.model.column_names())
    np.testing.assert_array_equal(multipliers["values"], state.lam)
    assert content["iterations"][0]["residual"] > 0  # type: ignore[index]
    names = [equation["name"] for equation in content["equations"]]  # type: ignore[attr-defined]
    assert names == list(state.model.constraints)


def test_study_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    text = FOUR_BAR.read_text(encoding="utf-8").replace("t_end = 15", "t_end = 0.02")
    Path("short.toml").write_text(text, encoding="utf-8")
    content = told(["study", "short.toml", "--json"], 0, capsys)
    stored = json.loads(Path("out/short/study/study.json").read_text(encoding="utf-8"))
    files = content.pop("files")
    assert content == stored
    assert all(Path(name).exists() for name in files)  # type: ignore[attr-defined]


@pytest.mark.parametrize("command", ["run", "check", "show", "study"])
def test_errors_as_json(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    text = FOUR_BAR.read_text(encoding="utf-8").replace("mass = 3", "mass = -3")
    Path("bad.toml").write_text(text, encoding="utf-8")
    assert main([command, "bad.toml", "--json"]) == 2
    out, err = capsys.readouterr()
    error = json.loads(out)["error"]
    assert error["type"] in ("ModelError", "FileError")
    assert error["exit_code"] == 2
    (problem,) = error["problems"]
    assert problem["path"] == "bodies.crank.mass"
    line = 1 + text[: text.index("mass = -3")].count("\n")
    assert (problem["line"], problem["column"]) == (line, 8)
    assert "bodies.crank.mass" in err  # people read it on stderr


@pytest.mark.parametrize(
    ("words", "code", "kind"),
    [
        (["check", "missing.toml", "--json"], 4, "FileError"),
        (["check", str(FOUR_BAR), "--json", "--set", "L2=1"], 3, "AssemblyError"),
        (["check", str(FOUR_BAR), "--json", "--colour"], 2, "UsageError"),
        (["show", str(FOUR_BAR), "--json", "--t", "99"], 2, "ModelError"),
        (["show", str(FOUR_BAR), "--json", "-o", "x.csv"], 2, "ModelError"),
    ],
    ids=lambda value: " ".join(value[2:]) if isinstance(value, list) else str(value),
)
def test_every_error_as_json(
    words: list[str], code: int, kind: str, capsys: pytest.CaptureFixture[str]
) -> None:
    error = told(words, code, capsys)["error"]
    assert error["type"] == kind  # type: ignore[index]
    assert error["exit_code"] == code  # type: ignore[index]
    assert error["message"]  # type: ignore[index]


def test_a_failed_run_as_json_has_results_and_error(capsys: pytest.CaptureFixture[str]) -> None:
    text = FOUR_BAR.read_text(encoding="utf-8").replace("t_end = 15", "t_end = 15\nmax_steps = 50")
    Path("short.toml").write_text(text, encoding="utf-8")
    content = told(["run", "short.toml", "--json", "--no-figures"], 3, capsys)
    assert content["error"]["type"] == "IntegrationError"  # type: ignore[index]
    assert content["error"]["t"] > 0  # type: ignore[index]
    assert content["analyses"]["release"]["success"] is False  # type: ignore[index]
