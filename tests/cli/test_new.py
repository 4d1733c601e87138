"""``kempe new``, ``kempe schema``, help and shell completion."""

import json
import os
import subprocess
import sys
from pathlib import Path

import kempe as kp
import pytest
from command_line import kempe
from kempe import templates
from kempe.base import files
from kempe.cli import main
from kempe.templates import FILES, NAMES, template
from sizes import some

ROOT = Path(__file__).parents[2]
COMMANDS = ["run", "check", "show", "study", "new", "schema"]


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


CASES = [name for name in NAMES if FILES[name].endswith(".toml")]


#: All are written as they are in the sources, and docs/test_examples.py runs all of these.
@pytest.mark.parametrize("name", some(CASES, 4))
def test_a_new_case_runs(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", name]) == 0
    assert capsys.readouterr().out == f"{name}.toml written; next: kempe run {name}.toml\n"
    text = Path(f"{name}.toml").read_text(encoding="utf-8")
    assert text.count("#") > 5  # it has comments
    case = kp.load(f"{name}.toml")
    results = case.run()
    assert all(solution.success for solution in results.values())
    assert max(solution.drift.position.max() for solution in results.values()) < 1e-5


def test_every_example_can_be_written_and_equals_the_one_in_the_sources() -> None:
    examples = {path.name for path in (ROOT / "examples").iterdir() if path.is_file()}
    assert set(FILES.values()) == examples
    stored = {path.name for path in Path(templates.__file__).parent.iterdir() if path.is_file()}
    assert stored - {"__init__.py"} == {
        f"{name}.txt" if name.endswith(".py") else name for name in examples
    }
    for name, file in FILES.items():
        assert main(["new", name]) == 0
        written = Path(file).read_bytes()
        assert written == (ROOT / "examples" / file).read_bytes(), "run python -m kempe._generate"


def test_a_new_program_runs(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "n_four_bar", "mine.py"]) == 0
    assert capsys.readouterr().out == "mine.py written; next: python mine.py\n"
    done = subprocess.run([sys.executable, "mine.py", "1"], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_examples_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new"]) == 0
    lines = capsys.readouterr().out.splitlines()[1:]
    assert [line.split()[0] for line in lines] == list(NAMES)
    for name, line in zip(NAMES, lines, strict=True):
        title = " ".join(line.split()[1:])
        assert title
        assert title in template(name)
    assert list(Path().iterdir()) == []


def test_the_help_names_every_example(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "--help"]) == 0
    told = capsys.readouterr().out
    assert [name for name in NAMES if name not in told] == []


def test_the_target_may_be_given(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "pendulum", "deep/down/mine.toml"]) == 0
    Path("folder").mkdir()
    assert main(["new", "pendulum", "folder"]) == 0
    written = [Path("deep/down/mine.toml"), Path("folder/pendulum.toml")]
    assert all(path.read_text(encoding="utf-8") == template("pendulum") for path in written)
    assert capsys.readouterr().err == ""


def test_an_old_file_is_overwritten_only_by_force(capsys: pytest.CaptureFixture[str]) -> None:
    mine = Path("pendulum.toml")
    mine.write_text("mine", encoding="utf-8")
    assert main(["new", "pendulum"]) == 4
    assert mine.read_text(encoding="utf-8") == "mine"
    assert capsys.readouterr().err == "error: pendulum.toml exists; --force overwrites it\n"
    assert main(["new", "pendulum", "--force"]) == 0
    assert mine.read_text(encoding="utf-8") == template("pendulum")


def test_a_broken_link_is_not_followed(capsys: pytest.CaptureFixture[str]) -> None:
    Path("pendulum.toml").symlink_to("nowhere.toml")
    assert main(["new", "pendulum"]) == 4
    assert not Path("nowhere.toml").exists()
    assert "exists" in capsys.readouterr().err


def test_a_failed_write_leaves_the_old_file(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    mine = Path("pendulum.toml")
    mine.write_text("mine", encoding="utf-8")

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(files.os, "fsync", full)
    assert main(["new", "pendulum", "--force"]) == 4
    assert [path.name for path in Path().iterdir()] == ["pendulum.toml"]
    assert mine.read_text(encoding="utf-8") == "mine"
    assert "No space left" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "code", "told"),
    [
        (["nothing"], 2, f"there is {', '.join(NAMES[:20])}"),
        (["slidercrank"], 2, "did you mean 'slider_crank'?"),
        (["pendulum", "mine.txt"], 4, "must end in .toml"),
        (["n_four_bar", "mine.toml"], 4, "must end in .py"),
    ],
)
def test_invalid_targets_are_refused(
    words: list[str], code: int, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["new", *words]) == code
    assert told in capsys.readouterr().err
    assert list(Path().iterdir()) == []


def test_the_schema_is_json_and_contains_every_element(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    text = capsys.readouterr().out
    assert json.loads(text)["$schema"].endswith("2020-12/schema")
    for word in ("revolute", "translational", "coordinate_driver", "torsion_spring", "rk45"):
        assert f'"{word}"' in text


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help_with_an_example(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, "--help"]) == 0
    out = capsys.readouterr().out
    assert f"kempe {command} " in out.partition("Examples:")[2]
    assert "\x1b" not in out  # no colours without a terminal


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_shells_get_completion_scripts(shell: str) -> None:
    done = kempe("--show-completion", shell, _TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION="1")
    assert done.returncode == 0, done.stderr
    assert "_KEMPE_COMPLETE" in done.stdout


@pytest.mark.parametrize(
    ("line", "offered"),
    [("kempe s", {"show", "study", "schema"}), ("kempe new s", {"slider_crank"})],
)
def test_commands_and_examples_are_completed(line: str, offered: set[str]) -> None:
    count = str(len(line.split()) - 1)
    done = kempe(_KEMPE_COMPLETE="complete_bash", COMP_WORDS=line, COMP_CWORD=count)
    assert offered <= set(done.stdout.split())


def test_completion_is_installed_for_the_shell(tmp_path: Path) -> None:
    done = kempe(
        "--install-completion",
        "bash",
        _TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION="1",
        HOME=str(tmp_path),
    )
    assert done.returncode == 0, done.stderr
    assert any(path.is_file() for path in tmp_path.rglob("*kempe*"))


def test_no_colour_is_respected() -> None:
    for environment in ({"FORCE_COLOR": "1"}, {"FORCE_COLOR": "1", "NO_COLOR": "1"}):
        # libraries read these variables while they are imported
        shown = subprocess.check_output(
            [sys.executable, "-m", "kempe", "--help"], env=os.environ | environment, timeout=60
        )
        coloured = b"\x1b[3" in shown or b"\x1b[1;3" in shown
        assert coloured == ("NO_COLOR" not in environment)
