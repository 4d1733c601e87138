"""Each analysis has its own folder inside that of the results, and nothing is written elsewhere."""

from pathlib import Path

import kempe as kp
import pytest
from kempe.cli import main

CASE = """kempe = 1

[bodies.ball]
type = "point_mass"
mass = 1

[start]
set = { "ball.x" = 0, "ball.y" = 0 }
"""


def analyses(*names: str) -> str:
    entry = '\n[analyses."{}"]\ntype = "dynamics"\nt_end = {}\noutput_step = 0.1\n'
    return CASE + "".join(
        entry.format(name.replace("\\", "\\\\"), k / 10) for k, name in enumerate(names, 1)
    )


def everything(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*")}


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")


WRONG = {
    "absolute": "{tmp}/stolen",
    "up": "../up",
    "folders": "a/b",
    "backslash": "a\\b",
    "slash behind": "a/",
    "only a slash": "/",
    "drive": "C:x",
    "here": ".",
    "up only": "..",
    "blank": " ",
    "blank behind": "a ",
    "pipe": "a|b",
    "long": "é" * 150,
}


@pytest.mark.parametrize("command", ["check", "run", "plot", "animate", "study", "show"])
@pytest.mark.parametrize("name", WRONG)
def test_a_name_that_is_no_folder_is_refused_with_its_line(
    name: str, command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = WRONG[name].format(tmp=tmp_path)
    Path("case.toml").write_text(analyses("good", wrong), encoding="utf-8")
    assert main([command, "case.toml"]) == 2
    told = capsys.readouterr().err
    assert "case.toml" in told
    assert "(line 15, column " in told
    assert everything(tmp_path) == {"work", "work/case.toml"}


@pytest.mark.parametrize(
    ("one", "other"), [("a", "A"), ("Fall", "fALL"), ("ärger", "ÄRGER")], ids=str
)
def test_names_that_some_file_systems_do_not_distinguish_are_refused(
    one: str, other: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("case.toml").write_text(analyses(one, "between", other), encoding="utf-8")
    assert main(["run", "case.toml"]) == 2
    assert f"differs from '{one}' only in upper and lower case" in capsys.readouterr().err
    assert everything(tmp_path) == {"work", "work/case.toml"}


def test_a_case_built_in_python_has_the_same_names() -> None:
    model = kp.Model("free")
    model.point_mass("ball", mass=1)
    for wrong in ("/tmp/x", "a/b", "a/"):
        with pytest.raises(kp.ModelError, match="must not contain '/'"):
            kp.Case(model, analyses=[kp.Dynamics(1, name=wrong)])
        with pytest.raises(kp.ModelError, match="must not contain '/'"):
            kp.Case(model, analyses={wrong: {"type": "dynamics", "t_end": 1}})


def test_each_analysis_writes_to_its_own_folder(tmp_path: Path) -> None:
    names = ("first", "second run", "mit Umlaut ä", "a-b_c (1)")
    Path("case.toml").write_text(analyses(*names), encoding="utf-8")
    assert main(["run", "case.toml", "-q", "--no-figures", "-o", "results"]) == 0
    files = ("solution.npz", "solution.csv", "summary.json")
    expected = {f"{name}/{file}" for name in names for file in files} | set(names)
    assert everything(Path("results")) == expected
    assert everything(tmp_path / "work") - {f"results/{name}" for name in expected} == {
        "case.toml",
        "results",
    }
    for k, name in enumerate(names, 1):
        assert kp.load_solution(f"results/{name}/solution.npz").t[-1] == pytest.approx(k / 10)
