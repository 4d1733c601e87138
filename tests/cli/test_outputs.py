"""Pipes, devices and standard input: the command line behaves as other programs do."""

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import kempe, run_into
from kempe.cli import exit_codes, main

EXAMPLES = Path(__file__).parents[2] / "examples"
FOUR_BAR = EXAMPLES / "four_bar.toml"
COMMAND = [sys.executable, "-m", "kempe"]
COMMANDS = {
    "version": ["--version"],
    "help": ["--help"],
    "help of a command": ["run", "-h"],
    "check": ["check", str(FOUR_BAR)],
    "check as JSON": ["check", str(FOUR_BAR), "--json"],
    "show": ["show", str(FOUR_BAR), "--kkt"],
    "run": ["run", str(FOUR_BAR), "--figures", "none", "--t-end", "0.01"],
    "run as JSON": ["run", str(FOUR_BAR), "--figures", "none", "--t-end", "0.01", "--json"],
    "new": ["new"],
    "schema": ["schema"],
}

pytestmark = pytest.mark.skipif(os.name != "posix", reason="pipes and devices of POSIX")


BUFFERS = {"buffered": "", "unbuffered": "1"}
FULL = b"error: cannot write the output: No space left on device\n"
NO_DEVICE = pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is full")


def stream(descriptor: int, buffer: str) -> io.TextIOWrapper:
    """The standard output of a process, as Python makes it with and without PYTHONUNBUFFERED."""
    if buffer == "buffered":
        return io.TextIOWrapper(os.fdopen(descriptor, "wb"), encoding="utf-8")
    raw = os.fdopen(descriptor, "wb", buffering=0)
    return io.TextIOWrapper(raw, encoding="utf-8", write_through=True)  # type: ignore[arg-type]


def broken_pipe() -> int:
    """A pipe without a reader."""
    reading, writing = os.pipe()
    os.close(reading)
    return writing


@pytest.mark.parametrize("buffer", BUFFERS)
@pytest.mark.parametrize("name", COMMANDS)
def test_a_reader_that_leaves_ends_a_command_quietly(
    name: str, buffer: str, tmp_path: Path
) -> None:
    out = stream(broken_pipe(), buffer)
    assert run_into(out, *COMMANDS[name], cwd=tmp_path) == (exit_codes.CLOSED_PIPE, "")


@NO_DEVICE
@pytest.mark.parametrize("buffer", BUFFERS)
@pytest.mark.parametrize("name", COMMANDS)
def test_a_full_device_is_reported(name: str, buffer: str, tmp_path: Path) -> None:
    out = stream(os.open("/dev/full", os.O_WRONLY), buffer)
    assert run_into(out, *COMMANDS[name], cwd=tmp_path) == (exit_codes.FILE, FULL.decode())


def process(name: str, out: int, buffer: str, folder: Path) -> tuple[int, bytes]:
    """Exit code and errors of a process; Python writes what its buffers hold when it ends."""
    done = subprocess.run(
        [*COMMAND, *COMMANDS[name]],
        cwd=folder,
        env=os.environ | {"PYTHONUNBUFFERED": BUFFERS[buffer]},
        stdout=out,
        stderr=subprocess.PIPE,
        check=False,
    )
    os.close(out)
    return done.returncode, done.stderr


@pytest.mark.parametrize("buffer", BUFFERS)
@pytest.mark.parametrize("name", ["version", "run"])
def test_the_end_of_a_process_reports_a_closed_pipe_once(
    name: str, buffer: str, tmp_path: Path
) -> None:
    assert process(name, broken_pipe(), buffer, tmp_path) == (exit_codes.CLOSED_PIPE, b"")


@NO_DEVICE
@pytest.mark.parametrize("buffer", BUFFERS)
@pytest.mark.parametrize("name", ["version", "run"])
def test_the_end_of_a_process_reports_a_full_device_once(
    name: str, buffer: str, tmp_path: Path
) -> None:
    out = os.open("/dev/full", os.O_WRONLY)
    assert process(name, out, buffer, tmp_path) == (exit_codes.FILE, FULL)


def test_the_first_line_of_a_run_can_be_taken(tmp_path: Path) -> None:
    words = " ".join([*COMMAND, "run", str(FOUR_BAR), "--figures", "none"])
    done = subprocess.run(
        ["sh", "-c", f"{words} | head -n 1"], cwd=tmp_path, capture_output=True, check=False
    )
    assert done.stdout == b"Four-bar linkage with a rotational spring-damper\n"
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-"])
def test_a_closed_stream_is_no_fault(closed: str, tmp_path: Path) -> None:
    words = " ".join([*COMMAND, *COMMANDS["run"]])
    done = subprocess.run(
        ["sh", "-c", f"{words} {closed}"], cwd=tmp_path, capture_output=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert (tmp_path / "out" / "four_bar" / "summary.json").exists()


def test_characters_that_a_terminal_lacks_are_no_fault(tmp_path: Path) -> None:
    done = subprocess.run(
        [*COMMAND, *COMMANDS["show"]],
        cwd=tmp_path,
        env=os.environ | {"PYTHONIOENCODING": "ascii"},
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert b"augmented matrix" in done.stdout


# --- standard input -------------------------------------------------------------------------------


def piped(words: list[str], data: bytes, cwd: Path) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [*COMMAND, *words], input=data, cwd=cwd, capture_output=True, timeout=60, check=False
    )


@pytest.mark.parametrize("form", ["toml", "json"])
def test_a_case_comes_from_standard_input(form: str, tmp_path: Path) -> None:
    import kempe as kp

    copy = tmp_path / f"copy.{form}"
    kp.load(FOUR_BAR).save(copy)
    words = ["run", "-", "--figures", "none", "--t-end", "0.05", "--set", "k=2e6"]
    done = piped(words, copy.read_bytes(), tmp_path)  # a process of its own
    assert done.returncode == 0, done.stderr
    found = kp.load_solution(tmp_path / "out" / "stdin" / "solution.npz")
    expected = kp.load(FOUR_BAR, parameters={"k": 2e6}).with_analysis("release", t_end=0.05).run()
    assert (found.q == expected[0].q).all()
    for command in (["check"], ["show", "--mass"], ["animate", "--at", "0", "-o", "a.png"]):
        done = kempe(command[0], "-", *command[1:], cwd=tmp_path, given=copy.read_bytes())
        assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("text", "code", "told"),
    [
        ("", 2, "kempe"),
        (
            "kempe = 1\n[bodies.a]\nmas = 1\n",
            2,
            "error: standard input: 2 problems\nbodies.a.inertia",
        ),
        (b"\xff\xfe", 4, "cannot read standard input: not UTF-8"),
        ("#" * (16 * 2**20 + 1), 4, "larger than 16 MiB"),
    ],
    ids=["empty", "faulty", "binary", "large"],
)
def test_faults_of_standard_input_are_reported(
    text: str | bytes, code: int, told: str, tmp_path: Path
) -> None:
    data = text.encode() if isinstance(text, str) else text
    done = kempe("check", "-", cwd=tmp_path, given=data)
    assert done.returncode == code
    assert told in done.stderr


def test_a_closed_standard_input_is_reported(tmp_path: Path) -> None:
    words = " ".join([*COMMAND, "check", "-", "<&-"])
    done = subprocess.run(["sh", "-c", words], cwd=tmp_path, capture_output=True, check=False)
    assert done.returncode == 4
    assert b"cannot read standard input" in done.stderr
    assert b"Traceback" not in done.stderr


# --- pipes in place of files ----------------------------------------------------------------------


@pytest.mark.parametrize("link", [False, True], ids=["itself", "by a link"])
@pytest.mark.parametrize("name", ["case.toml", "case.json", "solution.npz"])
def test_a_pipe_without_a_writer_does_not_hang(name: str, link: bool, tmp_path: Path) -> None:
    pipe = tmp_path / (f"linked_{name}" if link else name)
    os.mkfifo(pipe)
    if link:
        (tmp_path / name).symlink_to(pipe)
    command = "plot" if name.endswith("npz") else "check"
    done = kempe(command, name, cwd=tmp_path)
    assert done.returncode == 4
    assert f"cannot read {name}: it is a pipe or a device" in done.stderr


def test_the_remedy_for_a_pipe_works(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    os.mkfifo(tmp_path / "case.toml")
    assert main(["check", str(tmp_path / "case.toml")]) == 4
    assert "standard input, with - in place of the name" in capfd.readouterr().err
    writer = subprocess.Popen(["sh", "-c", f"cat '{FOUR_BAR}' > '{tmp_path}/case.toml'"])
    words = " ".join([*COMMAND, "check", "-"])
    done = subprocess.run(
        ["sh", "-c", f"{words} < '{tmp_path}/case.toml'"], capture_output=True, check=False
    )
    writer.wait()
    assert done.returncode == 0, done.stderr
