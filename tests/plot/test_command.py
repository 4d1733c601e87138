"""``kempe plot`` and the figures of ``kempe run``."""

import json
from pathlib import Path

import pytest
from command_line import kempe
from plot.conftest import ROOT
from plot.test_pages import FLAGSHIP

CASE = ROOT / "examples" / "four_bar.toml"


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("run")
    done = kempe("run", CASE, "-q", "--figures", "all", "--index-base", "0", cwd=folder)
    assert (done.returncode, done.stderr) == (0, "")
    return folder / "out" / "four_bar"


def test_run_writes_all_figures_and_lists_them(results: Path) -> None:
    listed = json.loads((results / "summary.json").read_text(encoding="utf-8"))["files"]
    figures = [f"figures/{stem}.{form}" for stem in FLAGSHIP for form in ("png", "svg")]
    assert listed[:3] == ["solution.npz", "solution.csv", "summary.json"]
    assert listed[3:6] == ["animation.html", "first_frame.png", "last_frame.png"]
    assert [name for name in listed if name.startswith("figures/")] == figures
    there = {path.relative_to(results).as_posix() for path in results.rglob("*.*")}
    assert there == set(listed)


@pytest.mark.parametrize("words", [["--no-figures"], ["--figures", "none"]], ids=str)
def test_figures_can_be_left_out(tmp_path: Path, words: list[str]) -> None:
    done = kempe("run", CASE, "-q", *words, "-o", "r", cwd=tmp_path)
    assert done.returncode == 0
    written = sorted(path.name for path in (tmp_path / "r").iterdir())
    assert written == ["solution.csv", "solution.npz", "summary.json"]


#: All that a run draws by default.
KEY = ["01_mechanism", "12_residual", "13_energy", "14_reactions", "15_motion"]


def test_a_run_draws_the_key_figures_by_default(tmp_path: Path) -> None:
    assert kempe("run", CASE, "-q", cwd=tmp_path).returncode == 0
    folder = tmp_path / "out" / "four_bar"
    figures = {f"figures/{stem}.{form}" for stem in KEY for form in ("png", "svg")}
    files = {"solution.npz", "solution.csv", "summary.json", "animation.html"}
    there = {path.relative_to(folder).as_posix() for path in folder.rglob("*.*")}
    assert there == figures | files
    listed = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["files"]
    assert set(listed) == there


@pytest.mark.parametrize("axis", ["linear", "compressed"])
def test_the_time_axis_is_compressed_on_request(results: Path, tmp_path: Path, axis: str) -> None:
    words = ["--figure", "energy", "--format", "svg", "--time-axis", axis, "-o", "p"]
    assert kempe("plot", results / "solution.npz", *words, cwd=tmp_path).returncode == 0
    drawn = (tmp_path / "p" / "13_energy.svg").read_bytes()
    usual = (results / "figures" / "13_energy.svg").read_bytes()
    assert (drawn == usual) == (axis == "linear")


def test_figures_of_a_stored_solution(results: Path, tmp_path: Path) -> None:
    words = ["--figure", "reactions_C", "--figure", "03_final", "--format", "pdf,png", "-o", "p"]
    done = kempe("plot", results / "solution.npz", *words, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    names = sorted(path.name for path in (tmp_path / "p").iterdir())
    assert names == ["03_final.pdf", "03_final.png", "11_reactions_C.pdf", "11_reactions_C.png"]
    assert [Path(line).name for line in done.stdout.splitlines()] == [
        "11_reactions_C.pdf",
        "11_reactions_C.png",
        "03_final.pdf",
        "03_final.png",
    ]


def test_figures_of_a_case_lie_where_run_puts_them(tmp_path: Path) -> None:
    done = kempe("plot", CASE, "--figure", "energy", "--format", "svg", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "four_bar" / "figures" / "13_energy.svg").stat().st_size > 0


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--figure", "enrgy"], "unknown figure 'enrgy'; did you mean 'energy'?"),
        (["--figure", "cranc"], "did you mean 'crank'?"),
        (["--figure", "reactions_Q"], "unknown joint or driver 'Q'; there is A, B, C, D"),
        (["--figure", "torque_sprin"], "unknown force 'sprin'; did you mean 'spring'?"),
        (["--format", "gif"], "unknown format 'gif'; there is png, svg, pdf"),
        (["--format", ","], "must be some of png,svg,pdf"),
        (["--index-base", "2"], "--index-base"),
        (["--set", "k=1"], "--set"),
    ],
)
def test_what_does_not_exist_ends_with_2(
    results: Path, tmp_path: Path, words: list[str], told: str
) -> None:
    done = kempe("plot", results / "solution.npz", *words, cwd=tmp_path)
    assert done.returncode == 2
    assert told in done.stderr
    assert done.stdout == ""
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["missing.npz", "missing.toml"])
def test_a_missing_file_ends_with_4(tmp_path: Path, name: str) -> None:
    assert kempe("plot", name, cwd=tmp_path).returncode == 4
