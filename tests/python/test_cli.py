"""The command line: output, files and exit codes."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import command_line
import kempe as kp
import numpy as np
import pytest

COMMAND = [sys.executable, "-m", "kempe"]
FILES = ["solution.npz", "solution.csv", "summary.json"]


def kempe(*words: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    """A command without figures, in this process."""
    fast = ["--no-figures"] if words[0] == "run" else []
    return command_line.kempe(*words, *fast, cwd=cwd)


def test_run_prints_and_writes_everything(four_bar_file: Path, tmp_path: Path) -> None:
    done = subprocess.run(
        [*COMMAND, "run", str(four_bar_file)],
        cwd=tmp_path,
        env=os.environ | {"MPLBACKEND": "agg"},
        capture_output=True,
        encoding="utf-8",
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""  # no progress bar without a terminal
    order = [
        "Four-bar linkage",
        "Bodies",
        "1 degree of freedom",
        "Initial configuration",
        "Jacobian Φ_q at the start, 9 × 9",
        "Largest reactions",
        "Accuracy",
        "Settling",
        "Files",
    ]
    places = [done.stdout.index(words) for words in order]
    assert places == sorted(places)
    assert "\x1b" not in done.stdout
    folder = tmp_path / "out" / "four_bar"
    drawn = ["figures/01_mechanism.png", "figures/14_reactions.svg"]
    assert all((folder / name).stat().st_size > 0 for name in [*FILES, *drawn])
    assert kp.load_solution(folder / "solution.npz").t[-1] == pytest.approx(0.5)


def test_the_jacobian_is_aligned_and_labelled(four_bar_file: Path, tmp_path: Path) -> None:
    lines = kempe("run", four_bar_file, "-o", "r", cwd=tmp_path).stdout.splitlines()
    at = next(k for k, line in enumerate(lines) if line.startswith("Jacobian"))
    header, *rows = lines[at + 1 : at + 11]
    assert header.split()[0] == "crank.x"
    assert [row.split()[0] for row in rows[:3]] == ["A.x", "A.y", "B.x"]
    assert {len(row) for row in rows} == {len(header)}
    assert (tmp_path / "r" / "solution.npz").exists()


def test_only_json_is_printed_on_stdout(four_bar_file: Path, tmp_path: Path) -> None:
    done = kempe("run", four_bar_file, "--json", "--set", "k=2e6", "--t-end", "0.1", cwd=tmp_path)
    told = json.loads(done.stdout)["analyses"]["release"]
    assert told["success"] is True
    assert told["time"]["end"] == pytest.approx(0.1)
    assert told["mechanism"]["degrees_of_freedom"] == 1
    assert {peak["joint"] for peak in told["peaks"]["reactions"]} == set("ABCD")
    assert [Path(path).name for path in told["files"]] == [Path(name).name for name in FILES]
    written = json.loads((tmp_path / "out/four_bar/summary.json").read_text(encoding="utf-8"))
    assert written["peaks"] == told["peaks"]
    stored = kp.load_solution(tmp_path / "out/four_bar/solution.npz")
    assert stored.model.parameters["k"] == 2e6


def test_quiet_writes_files_without_printing(four_bar_file: Path, tmp_path: Path) -> None:
    done = kempe("run", four_bar_file, "-q", cwd=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert (tmp_path / "out/four_bar/solution.npz").exists()


def test_check_runs_no_simulation(four_bar_file: Path, tmp_path: Path) -> None:
    done = kempe("check", four_bar_file, cwd=tmp_path)
    assert done.returncode == 0
    assert "Initial configuration" in done.stdout
    assert "release (dynamics)" in done.stdout
    assert not (tmp_path / "out").exists()


def test_names_are_shown_verbatim(four_bar_file: Path, tmp_path: Path) -> None:
    text = four_bar_file.read_text(encoding="utf-8")
    text = text.replace("[joints.C]", '[joints."[red]$C$[/red]"]')
    four_bar_file.write_text(text, encoding="utf-8")
    done = kempe("run", four_bar_file, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "[red]$C$[/red]" in done.stdout


def test_several_analyses_have_separate_folders(four_bar_file: Path, tmp_path: Path) -> None:
    with four_bar_file.open("a", encoding="utf-8") as file:
        file.write('\n[analyses.on]\ntype = "dynamics"\nt_end = 0.6\n')
        file.write('stabilization = { type = "baumgarte" }\nmethod = { type = "rk45" }\n')
    done = kempe("run", four_bar_file, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    first, second = (
        kp.load_solution(tmp_path / "out/four_bar" / name / "solution.npz")
        for name in ("release", "on")
    )
    # the first one, with Baumgarte's stabilization, leaves the joints open by its errors
    assert "warning: on: the state does not meet the constraints at t = 0.5" in done.stderr
    np.testing.assert_allclose(first.q[-1], second.q[0], atol=1e-6)
    assert second.drift.position[0] < 1e-11


def replaced(path: Path, old: str, new: str) -> Path:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("mass = 3", "mass = -3", "bodies.crank.mass"),
        ("crank.B", "cranc.B", "cranc"),
        ("kempe = 1", "kempe = = 1", "line 1"),
        ("[start]", "[strat]", "strat"),
    ],
)
def test_bad_input_gives_exit_code_2(
    four_bar_file: Path, tmp_path: Path, old: str, new: str, words: str
) -> None:
    done = kempe("run", replaced(four_bar_file, old, new), cwd=tmp_path)
    assert done.returncode == 2
    assert words in done.stderr
    assert done.stderr.count("(line") <= 1  # each problem is printed once
    assert done.stdout == ""


@pytest.mark.parametrize(
    "words", [["--set", "k"], ["--set", "stiff=1"], ["--t-end", "soon"], ["--colour"]], ids=str
)
def test_bad_arguments_give_exit_code_2(
    four_bar_file: Path, tmp_path: Path, words: list[str]
) -> None:
    done = kempe("run", four_bar_file, *words, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr != ""


def test_a_linkage_that_cannot_close_gives_exit_code_3(four_bar_file: Path, tmp_path: Path) -> None:
    done = kempe("run", four_bar_file, "--set", "L2=1", cwd=tmp_path)
    assert done.returncode == 3
    assert "error:" in done.stderr


def test_a_failure_writes_the_partial_solution(four_bar_file: Path, tmp_path: Path) -> None:
    replaced(four_bar_file, "t_end = 0.5", "t_end = 0.5\nmax_steps = 5")
    done = kempe("run", four_bar_file, cwd=tmp_path)
    assert done.returncode == 3
    assert "solution.npz" in done.stderr
    partial = kp.load_solution(tmp_path / "out/four_bar/solution.npz")
    assert not partial.success
    assert partial.t[-1] < 0.5


@pytest.mark.parametrize("words", [["missing.toml"], ["."], ["four_bar.toml", "-o", "file"]])
def test_a_file_error_gives_exit_code_4(
    four_bar_file: Path, tmp_path: Path, words: list[str]
) -> None:
    assert four_bar_file.parent == tmp_path
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    done = kempe("run", *words, cwd=tmp_path)
    assert done.returncode == 4, done.stderr
    assert (tmp_path / "file").read_text(encoding="utf-8") == "in the way"


@pytest.mark.skipif(os.name != "posix", reason="terminals as POSIX has them")
def test_the_simulated_time_is_displayed_on_a_terminal(four_bar_file: Path, tmp_path: Path) -> None:
    replaced(
        four_bar_file,
        "t_end = 0.5\noutput_step = 0.01",
        "t_end = 1500\noutput_step = 1\ndense_output = false",
    )
    terminal, end = os.openpty()
    with subprocess.Popen(
        [*COMMAND, "run", "four_bar.toml", "--no-figures"],
        cwd=tmp_path,
        env=os.environ | {"TERM": "xterm", "COLUMNS": "100", "NO_COLOR": "1"},
        stdout=subprocess.DEVNULL,
        stderr=end,
    ) as process:
        os.close(end)
        shown = b""
        try:
            while chunk := os.read(terminal, 4096):
                shown += chunk
        except OSError:  # Linux: the other end is closed
            pass
    os.close(terminal)
    assert process.returncode == 0
    assert b"release" in shown
    assert b"t = " in shown
    assert b"\x1b[3" not in shown  # NO_COLOR


@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
def test_an_interruption_gives_exit_code_130_and_keeps_the_solution(
    four_bar_file: Path, tmp_path: Path
) -> None:
    endless = "t_end = 1e7\nmax_steps = 1000000000\ndense_output = false"
    replaced(
        replaced(four_bar_file, "t_end = 0.5", endless), "output_step = 0.01", "output_step = 10"
    )
    with subprocess.Popen(
        [*COMMAND, "run", str(four_bar_file), "--no-figures"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        encoding="utf-8",
    ) as process:
        assert process.stdout is not None
        assert any(
            "set.crank.angle" in line for line in process.stdout
        )  # the last line before the run
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=60)
    assert process.returncode == 130, stderr
    assert "interrupted" in stderr
    assert "Traceback" not in stderr
    assert not kp.load_solution(tmp_path / "out/four_bar/solution.npz").success


def test_settling_differs_from_endless_motion() -> None:
    from kempe.results.settling import settling

    t = np.linspace(0.0, 10.0, 1001)
    damped = settling(t, np.exp(-2.0 * t))
    assert damped.time == pytest.approx(np.log(200.0) / 2.0, abs=0.02)
    assert settling(t, np.cos(3.0 * t)).time is None
    assert settling(t, 2.0 * t).time is None
    assert settling(t, np.full_like(t, 4.0)).moves is False
