"""`./kempe` and `./test`: fast if nothing has changed, with clear messages if a tool is missing."""

import os
import re
import select
import shutil
import signal
import stat
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import Any

import kempe
import pytest
from house.places import ROOT
from quiet import within

pytestmark = pytest.mark.skipif(os.name != "posix", reason="./kempe is a script for POSIX shells")

SETUP_FAILED = 5
TOOLS = "sh dirname cat cksum find sort mkdir rm mv tail sleep env"


def run(command: Sequence[str | Path], **options: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


def seconds(command: Sequence[str | Path], cwd: Path) -> float:
    begin = time.perf_counter()
    assert run(command, cwd=cwd).returncode == 0
    return time.perf_counter() - begin


@pytest.fixture
def built() -> None:
    """This checkout is set up, so that `./kempe` builds nothing."""
    script = 'ROOT=$1; . "$ROOT/tools/setup.sh"; is_set_up run'
    if run(["sh", "-c", script, "sh", ROOT]).returncode:
        pytest.skip("the core is not built from the present sources; run ./kempe --version")


@pytest.mark.alone
def test_the_version_is_printed_quickly(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "kempe", "--version"]
    assert run(command, cwd=tmp_path).stdout == f"kempe {kempe.__version__}\n"
    assert within(0.2, lambda: median(seconds(command, tmp_path) for _ in range(5)))


@pytest.mark.alone
@pytest.mark.usefixtures("built")
def test_a_second_start_has_nothing_to_do(tmp_path: Path) -> None:
    command = [ROOT / "kempe", "--version"]
    first = run(command, cwd=tmp_path)
    assert (first.returncode, first.stdout) == (0, f"kempe {kempe.__version__}\n")
    again = run(command, cwd=tmp_path)
    assert (again.returncode, again.stderr) == (0, "")
    assert within(1.0, lambda: median(seconds(command, tmp_path) for _ in range(5)))


@pytest.mark.usefixtures("built")
@pytest.mark.skipif(sys.version_info < (3, 11), reason="Python 3.10 has no such option")
def test_no_module_is_imported_from_the_current_folder(tmp_path: Path) -> None:
    (tmp_path / "dataclasses.py").write_text("raise SystemExit('this is not the right one')")
    plain = run([sys.executable, "-m", "kempe", "--help"], cwd=tmp_path)
    assert "this is not the right one" in plain.stderr
    assert run([ROOT / "kempe", "--help"], cwd=tmp_path).returncode == 0


@pytest.fixture
def bare(tmp_path: Path) -> Path:
    """A copy of the scripts in a folder with a space, and a `bin` with standard programs."""
    root = tmp_path / "my kempe"
    (root / "tools" / "lock").mkdir(parents=True)
    for name in (
        "kempe",
        "tools/setup.sh",
        "tools/lock/run.txt",
        "tools/lock/test.txt",
        "Cargo.lock",
        "pyproject.toml",
    ):
        shutil.copy(ROOT / name, root / name)
    (tmp_path / "bin").mkdir()
    for name in TOOLS.split():
        (tmp_path / "bin" / name).symlink_to(shutil.which(name) or pytest.fail(f"no {name} here"))
    return root


def program(folder: Path, name: str, body: str) -> None:
    path = folder / name
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


def start(root: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    paths = {"PATH": str(root.parent / "bin"), "HOME": str(root.parent)}
    return run([root / "kempe", "--version"], env=paths | environment, cwd=root.parent)


OLD_PYTHON = "case $2 in *version_info*) exit 1 ;; esac"
NO_VENV = "case $2 in *venv*) exit 1 ;; esac"


@pytest.mark.parametrize(
    ("programs", "environment", "told"),
    [
        ({}, {}, "no C linker (cc) found: install one"),
        ({"cc": ""}, {}, "Rust (cargo) not found: install it"),
        (
            {"cc": "", "cargo": "echo cargo 1.63.0"},
            {},
            "Rust 1.85 or later is needed, found cargo 1.63.0",
        ),
        (
            {"cc": "", "cargo": "echo cargo 1.99.0"},
            {},
            "Python 3.10 or later not found: install it",
        ),
        (
            {"cc": "", "cargo": "echo cargo 1.99.0", "python3": OLD_PYTHON},
            {},
            "Python 3.10 or later not found: install it",
        ),
        (
            {"cc": "", "cargo": "echo cargo 1.99.0", "python3": ""},
            {"PYTHON": "python9"},
            "PYTHON=python9 is not Python 3.10 or later",
        ),
        (
            {"cc": "", "cargo": "echo cargo 1.99.0", "python3.12": NO_VENV},
            {},
            "python3.12 has no venv module: install it",
        ),
    ],
)
def test_a_missing_requirement_is_reported_in_one_line(
    bare: Path, programs: dict[str, str], environment: dict[str, str], told: str
) -> None:
    for name, body in programs.items():
        program(bare.parent / "bin", name, body)
    done = start(bare, **environment)
    assert done.returncode == SETUP_FAILED
    assert done.stdout == ""
    assert done.stderr.startswith(f"kempe: {told}")
    assert done.stderr.count("\n") == 1
    assert not (bare / ".venv.lock").exists()


def test_the_lock_of_a_dead_process_is_replaced(bare: Path) -> None:
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    (bare / ".venv.lock").mkdir()
    (bare / ".venv.lock" / "pid").write_text(f"{dead.pid}\n")
    done = start(bare)
    assert done.returncode == SETUP_FAILED
    assert "no C linker" in done.stderr
    assert not list(bare.glob(".venv.lock*"))


def test_a_process_waits_for_the_set_up_of_another(bare: Path) -> None:
    (bare / ".venv.lock").mkdir()
    (bare / ".venv.lock" / "pid").write_text(f"{os.getpid()}\n")
    command = [str(bare / "kempe"), "--version"]
    paths = {"PATH": str(bare.parent / "bin"), "HOME": str(bare.parent)}
    waiting = subprocess.Popen(command, env=paths, stderr=subprocess.PIPE, text=True)
    with pytest.raises(subprocess.TimeoutExpired):
        waiting.wait(timeout=1.5)
    shutil.rmtree(bare / ".venv.lock")
    _, told = waiting.communicate(timeout=10)
    assert f"waiting for another set-up (process {os.getpid()};" in told
    assert waiting.returncode == SETUP_FAILED


def test_only_one_process_holds_the_lock(bare: Path) -> None:
    script = """
        ROOT=$1; . "$ROOT/tools/setup.sh"
        for turn in 1 2 3; do
            take_lock
            mkdir "$ROOT/inside" || exit 1
            rmdir "$ROOT/inside"
            release_lock
        done
    """
    command = ["sh", "-c", script, "sh", str(bare)]
    racing = [subprocess.Popen(command, stderr=subprocess.DEVNULL) for _ in range(4)]
    assert [process.wait(timeout=60) for process in racing] == [0] * 4


def test_a_failing_step_prints_its_output_and_leaves_no_stamp(bare: Path) -> None:
    folder = bare.parent / "bin"
    program(folder, "cc", "")
    program(folder, "cargo", "echo cargo 1.99.0")
    program(folder, "python3", 'case "$*" in *"-m venv"*) echo "the disk is full"; exit 1 ;; esac')
    done = start(bare)
    assert done.returncode == SETUP_FAILED
    assert "the disk is full" in done.stderr
    assert f"making .venv failed; all of its output is in {bare}/.venv.log" in done.stderr
    assert not list(bare.glob(".venv*/stamp*"))
    assert not list(bare.glob(".venv.lock*"))


#: Make an environment with the interpreter `its_python`.
ENVIRONMENT = """
case "$*" in *"-m venv"*)
    mkdir -p "$4/bin"
    cp "$HOME/bin/its_python" "$4/bin/python"
esac
"""
#: An interpreter whose maturin compiles for 2.5 s.
ITS_PYTHON = """
case "$*" in
*sysconfig*) echo "$HOME" ;;
*"-m maturin"*)
    echo "   Compiling serde v1.0.2"
    echo "   Compiling kempe v0.1.0 (/kempe/core)"
    sleep 2.5
    ;;
esac
"""


@pytest.fixture
def complete(bare: Path) -> Path:
    """The scripts with all that they need, and one file of sources."""
    folder = bare.parent / "bin"
    for name in ("cp", "grep"):
        (folder / name).symlink_to(shutil.which(name) or pytest.fail(f"no {name} here"))
    program(folder, "cc", "")
    program(folder, "cargo", "echo cargo 1.99.0")
    program(folder, "python3", ENVIRONMENT)
    program(folder, "its_python", ITS_PYTHON)
    return bare


def start_on_terminal(root: Path) -> tuple[subprocess.Popen[bytes], int]:
    """The process, and the other side of its terminal."""
    import pty  # only on POSIX

    mine, its = pty.openpty()
    paths = {"PATH": str(root.parent / "bin"), "HOME": str(root.parent)}
    started = subprocess.Popen(
        [root / "kempe"],
        env=paths,
        stdin=its,
        stdout=its,
        stderr=its,
        start_new_session=True,
        # a run in the background of a script ignores interruptions, and what it starts would too
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509
    )
    os.close(its)
    return started, mine


def until(terminal: int, text: str | None) -> str:
    """What is written to a terminal up to a text, or until all processes have closed it."""
    told = b""
    end = time.monotonic() + 20
    while text is None or text.encode() not in told:
        assert select.select([terminal], [], [], end - time.monotonic())[0], told
        try:
            told += os.read(terminal, 1000)
        except OSError:  # the last process has closed it
            break
    return told.decode()


def test_the_set_up_says_what_it_does(complete: Path) -> None:
    told = [line for line in start(complete).stderr.splitlines() if line.startswith("kempe: ")]
    assert told[0].startswith("kempe: first run: makes .venv and builds the core, which takes")
    assert told[1].startswith("kempe: making .venv")
    assert told[2] == "kempe: installing Python packages"
    assert re.fullmatch(r"kempe: building the core: .+ \(later builds take seconds\)", told[3])
    assert len(told) == 4  # the first line of progress comes after half a minute
    again = start(complete).stderr
    assert "first run" not in again
    assert "kempe: building the core, because its sources have changed\n" in again


def test_progress_is_shown_on_a_terminal(complete: Path) -> None:
    crates = (complete / "Cargo.lock").read_text(encoding="utf-8").count("[[package]]")
    started, terminal = start_on_terminal(complete)
    told = until(terminal, None)
    os.close(terminal)
    assert started.wait() == 0
    begin = "\r\033[K"  # replaces the line before
    shown = f"{begin}kempe: building the core: crate 2 of about {crates} (kempe), 2 s{begin}"
    assert shown in told
    assert "\033" not in (complete / ".venv.log").read_text(encoding="utf-8")


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM])
def test_an_interruption_ends_the_progress_too(complete: Path, sent: signal.Signals) -> None:
    started, terminal = start_on_terminal(complete)
    until(terminal, "1 s")
    os.killpg(started.pid, sent)
    until(terminal, None)  # ends with the last process
    os.close(terminal)
    assert started.wait() == 128 + sent
    assert not list(complete.glob(".venv.lock*"))


def test_the_progress_ends_with_a_killed_set_up(complete: Path) -> None:
    started, terminal = start_on_terminal(complete)
    until(terminal, "1 s")
    started.kill()
    started.wait()
    until(terminal, None)
    os.close(terminal)


@pytest.mark.parametrize("depth", [1, 3])
def test_the_script_works_through_symbolic_links(bare: Path, depth: int) -> None:
    tools = bare.parent / "bin"
    (tools / "readlink").symlink_to(shutil.which("readlink") or pytest.fail("no readlink here"))
    target = Path("..") / bare.name / "kempe"  # relative to the folder of the link
    for k in range(depth):
        folder = bare.parent / f"links {k}"
        folder.mkdir()
        link = folder / "kempe"
        link.symlink_to(target)
        target = link
    done = run([link, "--version"], env={"PATH": str(tools)}, cwd="/")
    assert done.returncode == SETUP_FAILED
    assert "no C linker (cc) found" in done.stderr  # the first check of tools/setup.sh


def test_the_cause_of_a_failed_download_is_reported(bare: Path) -> None:
    folder = bare.parent / "bin"
    program(folder, "cc", "")
    program(folder, "cargo", "echo cargo 1.99.0")
    download = f"'{sys.executable}' -m pip --isolated download --no-cache-dir --retries 1 numpy"
    program(folder, "python3", f'case "$*" in *"-m venv"*) {download} ;; esac')
    done = start(bare, HTTPS_PROXY="http://me:secret@127.0.0.1:9")
    assert done.returncode == SETUP_FAILED
    told = done.stderr.splitlines()[-1]
    assert "failed, because a download failed" in told
    assert "Cannot connect to proxy" in told
    assert told.endswith("The variable HTTPS_PROXY names a proxy: correct or unset it")
    assert "secret" not in told


def test_the_site_says_what_is_missing(tmp_path: Path) -> None:
    """In a fresh clone, with no Python, no packages, or no core."""
    (tmp_path / "tools").mkdir()
    shutil.copy(ROOT / "tools" / "build_site.sh", tmp_path / "tools")
    script = tmp_path / "tools" / "build_site.sh"
    for name, missing, remedy in (
        ("none", None, "run ./kempe --version, or set PYTHON"),
        ("packages", "mkdocs", "--require-hashes -r tools/lock/test.txt"),
        ("core", "kempe._core", "the core of kempe is not built"),
    ):
        if missing is not None:
            program(tmp_path, name, f'case "$*" in *{missing}*) exit 1 ;; esac')
        ran = run([script], cwd=tmp_path, env=os.environ | {"PYTHON": str(tmp_path / name)})
        assert ran.returncode == 5
        assert remedy in ran.stderr and ran.stderr.count("\n") == 1, ran.stderr
