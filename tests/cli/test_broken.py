"""Broken files, options and targets: clear messages with the correct exit code.

No file is incomplete, and no traceback is printed.
"""

import errno
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from kempe.base import files
from kempe.cli import main

EXAMPLE = Path(__file__).parents[2] / "examples" / "four_bar.toml"
TEXT = EXAMPLE.read_text(encoding="utf-8").replace("t_end = 15", "t_end = 0.05")

BAD_INPUT, MECHANICS, FILE = 2, 3, 4


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("good.toml").write_text(TEXT, encoding="utf-8")


def tree() -> dict[str, bytes]:
    """All files below the folder with their contents."""
    found = (path for path in Path().rglob("*") if path.is_file() and not path.is_fifo())
    return {str(path): path.read_bytes() for path in found}


def refused(capsys: pytest.CaptureFixture[str], words: list[str], code: int, told: str) -> None:
    before = tree()
    assert main(words) == code
    out, err = capsys.readouterr()
    assert told in " ".join(err.split()), err
    assert "Traceback" not in out + err
    assert "InternalError" not in err
    assert tree() == before


# --- contents of files ----------------------------------------------------------------------------


def with_(old: str, new: str) -> Callable[[], bytes]:
    assert old in TEXT, old
    return lambda: TEXT.replace(old, new, 1).encode()


CONTENTS: dict[str, tuple[Callable[[], bytes], int, str]] = {
    "empty": (lambda: b"", BAD_INPUT, "kempe"),
    "blank": (lambda: b"\n \n", BAD_INPUT, "kempe"),
    "comment": (lambda: b"# nothing\n", BAD_INPUT, "kempe"),
    "binary": (lambda: bytes(range(256)), FILE, "not UTF-8"),
    "nul": (lambda: b"kempe = 1\0", BAD_INPUT, "line 1"),
    "latin": (lambda: b'kempe = 1\ntitle = "F\xfcnf"\n', FILE, "not UTF-8"),
    "utf16": (lambda: TEXT.encode("utf-16"), FILE, "not UTF-8"),
    "too large": (lambda: b"#" * (files.LARGEST_TEXT + 1), FILE, "larger than 16 MiB"),
    "cut off": (TEXT[:600].rstrip()[:-1].encode, BAD_INPUT, "line"),
    "json in toml": (lambda: b'{"kempe": 1}', BAD_INPUT, "line 1"),
    "newer format": (with_("kempe = 1", "kempe = 99"), BAD_INPUT, "99"),
    "unknown section": (with_("[start]", "[strat]"), BAD_INPUT, "did you mean 'start'?"),
    "unknown joint type": (with_('"revolute"', '"revolver"'), BAD_INPUT, "revolver"),
    "unknown method": (with_('"rk45"', '"rk54"'), BAD_INPUT, "rk54"),
    "unknown analysis": (with_('"dynamics"', '"dynamic"'), BAD_INPUT, "dynamic"),
    "unknown body": (with_('"crank.B"', '"cranc.B"'), BAD_INPUT, "did you mean 'crank'?"),
    "unknown point": (with_('"crank.B"', '"crank.E"'), BAD_INPUT, "no point 'E'"),
    "unknown parameter": (with_('"L2"', '"L22"'), BAD_INPUT, "L22"),
    "reserved name": (with_("[bodies.crank]", "[bodies.t]"), BAD_INPUT, "reserved"),
    "negative mass": (with_("mass = 3", "mass = -3"), BAD_INPUT, "must not be negative"),
    "nan": (with_("mass = 3", "mass = nan"), BAD_INPUT, "bodies.crank.mass"),
    "huge length": (with_("L2 = 26", "L2 = 1e300"), BAD_INPUT, "must be below"),
    "overflow": (with_("L2 = 26", 'L2 = "10^400"'), BAD_INPUT, "L2"),
    "deep formula": (with_("L2 = 26", f'L2 = "{"(" * 9000}1{")" * 9000}"'), BAD_INPUT, "L2"),
    "deep lists": (with_("L2 = 26", f"L2 = {'[' * 9000}{']' * 9000}"), BAD_INPUT, "line"),
    "circle": (with_("L1 = 10", 'L1 = "L2"\nL9 = "L1 + L9"'), BAD_INPUT, "L9"),
    "negative step": (with_("output_step = 0.01", "output_step = -1"), BAD_INPUT, "output_step"),
    "open loop": (with_("L2 = 26", "L2 = 1"), MECHANICS, "cannot close"),
    "repeated joint": (
        (TEXT + '[joints.E]\ntype = "revolute"\ni = "ground.D"\nj = "rocker.D"\n').encode,
        MECHANICS,
        "repeats",
    ),
}


@pytest.mark.parametrize("name", CONTENTS)
def test_a_broken_file_is_reported(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    content, code, told = CONTENTS[name]
    Path("case.toml").write_bytes(content())
    for command in ("check", "run"):
        refused(capsys, [command, "case.toml"], code, told)
    refused(capsys, ["show", "case.toml"], code, told)


# --- command lines --------------------------------------------------------------------------------

WORDS: dict[str, tuple[list[str], int, str]] = {
    "no file": (["run", "none.toml"], FILE, "does not exist"),
    "no file named": (["run"], BAD_INPUT, "Missing argument"),
    "a folder": (["run", "."], FILE, "is a folder"),
    "in a file": (["run", "good.toml/case.toml"], FILE, "not a folder"),
    "wrong suffix": (["run", "good.txt"], FILE, ".toml or .json"),
    "no suffix": (["run", "good"], FILE, ".toml or .json"),
    "wrong format": (["run", "good.json"], FILE, "does not exist"),
    "long name": (["run", "a" * 300 + ".toml"], FILE, "cannot read"),
    "nul in the name": (["run", "a\0b.toml"], BAD_INPUT, "null byte"),
    "unknown command": (["simulate", "good.toml"], BAD_INPUT, "simulate"),
    "unknown option": (["run", "good.toml", "--colour"], BAD_INPUT, "--colour"),
    "two files": (["check", "good.toml", "good.toml"], BAD_INPUT, "unexpected extra argument"),
    "set without value": (["run", "good.toml", "--set", "k"], BAD_INPUT, "NAME=VALUE"),
    "set without name": (["run", "good.toml", "--set", "=3"], BAD_INPUT, "NAME=VALUE"),
    "set of nothing": (["run", "good.toml", "--set", "k="], BAD_INPUT, "NAME=VALUE"),
    "set twice equal": (["run", "good.toml", "--set", "k==3"], BAD_INPUT, "k"),
    "set a joint": (["run", "good.toml", "--set", "C=3"], BAD_INPUT, "C"),
    "set a field": (["run", "good.toml", "--set", "joints.X.i=3"], BAD_INPUT, "joints.X.i"),
    "set unknown": (
        ["run", "good.toml", "--set", "kk=3"],
        BAD_INPUT,
        "the parameters are: L1, L2, L3, G, k, c",
    ),
    "set text": (["run", "good.toml", "--set", "k=stiff"], BAD_INPUT, "stiff"),
    "set nan": (["run", "good.toml", "--set", "k=nan"], BAD_INPUT, "k"),
    "set infinite": (["run", "good.toml", "--set", "L2=inf"], BAD_INPUT, "L2"),
    "set huge": (["run", "good.toml", "--set", "L2=1e999"], BAD_INPUT, "L2"),
    "set open": (["run", "good.toml", "--set", "L2=1"], MECHANICS, "cannot close"),
    "end in words": (["run", "good.toml", "--t-end", "soon"], BAD_INPUT, "soon"),
    "end infinite": (["run", "good.toml", "--t-end", "inf"], BAD_INPUT, "t_end"),
    "option without value": (["run", "good.toml", "-o"], BAD_INPUT, "requires an argument"),
    "output in a file": (["run", "good.toml", "-o", "good.toml"], FILE, "good.toml"),
    "show format": (
        ["show", "good.toml", "--format", "pdf"],
        BAD_INPUT,
        "--format': 'pdf' is not one of 'text'",
    ),
    "method": (["run", "good.toml", "--method", "euler"], BAD_INPUT, "--method': 'euler' is not"),
    "show time": (["show", "good.toml", "--t", "9"], BAD_INPUT, "0 to 0.05 s"),
    "show into a folder": (["show", "good.toml", "-o", "."], FILE, "folder"),
    "study of nothing": (["study", "good.toml", "--analysis", "x"], BAD_INPUT, "release"),
    "new unknown": (["new", "fourbar"], BAD_INPUT, "did you mean 'four_bar'?"),
    "new over a file": (["new", "four_bar", "good.toml"], FILE, "exists"),
    "new in a file": (["new", "four_bar", "good.toml/x.toml"], FILE, "not a folder"),
}


@pytest.mark.parametrize("name", WORDS)
def test_a_wrong_command_line_is_reported(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    refused(capsys, *WORDS[name])


def test_there_are_enough_of_them() -> None:
    assert len(CONTENTS) + len(WORDS) >= 60


# --- errors of the system -------------------------------------------------------------------------


def failing(number: int) -> Callable[..., None]:
    def fail(*_: object, **__: object) -> None:
        raise OSError(number, os.strerror(number))

    return fail


@pytest.mark.parametrize(
    ("number", "told"),
    [
        (errno.ENOSPC, "No space left on device"),
        (errno.EROFS, "Read-only file system"),
        (errno.EACCES, "not permitted"),
        (errno.EIO, "Input/output error"),
        (errno.EDQUOT, "quota"),
    ],
    ids=str,
)
@pytest.mark.parametrize("step", ["fsync", "replace", "mkdir"])
def test_a_failing_disk_leaves_old_results_complete(
    number: int,
    told: str,
    step: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    target = Path("old")
    target.mkdir()
    for name in ("solution.npz", "solution.csv", "summary.json"):
        (target / name).write_text("old", encoding="utf-8")
    owner = files.os if step == "fsync" else Path
    before = tree()
    words = ["run", "good.toml", "-q", "-o", "old" if step != "mkdir" else "new/deep"]
    with monkeypatch.context() as broken:
        broken.setattr(owner, step, failing(number))
        assert main(words) == FILE
    out, err = capsys.readouterr()
    assert told.lower() in err.lower()
    assert "Traceback" not in out + err
    assert tree() == before


@pytest.mark.parametrize("command", ["run", "check", "show"])
def test_a_file_without_permission_is_reported(
    command: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    real = Path.open

    def closed(path: Path, *words: object, **named: object) -> object:
        if path.name == "good.toml":
            raise PermissionError(errno.EACCES, "Permission denied")
        return real(path, *words, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(Path, "open", closed)
    assert main([command, "good.toml"]) == FILE
    assert "it is not permitted; check its permissions" in capsys.readouterr().err


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root may do everything")
def test_missing_permissions_are_reported(capsys: pytest.CaptureFixture[str]) -> None:
    Path("good.toml").chmod(0)
    refused_before = main(["run", "good.toml"])
    Path("good.toml").chmod(0o600)
    assert refused_before == FILE
    assert "not permitted" in capsys.readouterr().err


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes as POSIX has them")
@pytest.mark.parametrize("link", [False, True], ids=["itself", "by a link"])
def test_a_pipe_is_not_replaced_by_a_file(link: bool, capsys: pytest.CaptureFixture[str]) -> None:
    """The pipe also represents devices; a test with a real device could do harm."""
    pipe = Path("pipe.csv")
    os.mkfifo(pipe)
    target = Path("link.csv") if link else pipe
    if link:
        target.symlink_to(pipe)
    refused(capsys, ["show", "good.toml", "-o", str(target)], FILE, "it is a device or a pipe")
    refused(capsys, ["new", "four_bar", str(target.with_suffix(".csv"))], FILE, "must end in .toml")
    assert pipe.is_fifo()
