"""The command line in the process of the tests: a hundredth of the time of a process of its own.

Tests of pipes, signals and exit codes of processes start real ones.
"""

import io
import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from subprocess import CompletedProcess
from unittest.mock import patch

from kempe.cli import main


def kempe(
    *words: object, cwd: Path | None = None, given: bytes | None = None, **environment: str
) -> CompletedProcess[str]:
    """The exit code and the output of one command; an exception that it does not catch fails."""
    out, err = _stream(), _stream()
    with _inside(cwd, environment), patch("sys.stdin", _stream(given)):
        code = _run(out, err, [str(word) for word in words])
    return CompletedProcess(words, code, _text(out), _text(err))


def run_into(out: io.TextIOWrapper, *words: str, cwd: Path) -> tuple[int, str]:
    """The exit code and the errors of one command that writes to a stream, and closes it."""
    err = _stream()
    with _inside(cwd, {}), out:
        return _run(out, err, list(words)), _text(err)


def _run(out: io.TextIOWrapper, err: io.TextIOWrapper, words: list[str]) -> int:
    with patch("sys.stdout", out), patch("sys.stderr", err), warnings.catch_warnings():
        # Python prints these, and pytest raises all others.
        warnings.simplefilter("always", UserWarning)
        return main(words)


def _stream(data: bytes | None = b"") -> io.TextIOWrapper:
    return io.TextIOWrapper(io.BytesIO(data or b""), encoding="utf-8")


def _text(stream: io.TextIOWrapper) -> str:
    stream.flush()
    assert isinstance(stream.buffer, io.BytesIO)
    return stream.buffer.getvalue().decode()


@contextmanager
def _inside(folder: Path | None, environment: dict[str, str]) -> Iterator[None]:
    before = Path.cwd()
    with patch.dict(os.environ, environment):
        os.chdir(folder or before)
        try:
            yield
        finally:
            os.chdir(before)
