"""Standard output and standard error that report lost output with one error.

A reader such as ``head`` may close a pipe early, and a disk may be full. Libraries handle both
differently: rich ends the process with code 1. These streams raise ``OutputLost``, which no library
catches.
"""

from __future__ import annotations

import errno
import io
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO

from kempe.cli import exit_codes


class OutputLost(BaseException):
    """Text cannot be written to a stream.

    Attributes:
        is_closed_pipe: whether the reader closed the pipe; otherwise the device failed.
    """

    def __init__(self, error: OSError) -> None:
        super().__init__(error.strerror or str(error))
        self.is_closed_pipe = error.errno == errno.EPIPE


class _Stream:
    """A text stream whose errors are ``OutputLost``."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Write text."""
        try:
            return self._stream.write(text)
        except OSError as error:
            raise OutputLost(error) from error

    def writelines(self, lines: Any) -> None:
        """Write several texts."""
        for line in lines:
            self.write(line)

    def flush(self) -> None:
        """Write the buffer."""
        try:
            self._stream.flush()
        except OSError as error:
            raise OutputLost(error) from error


def code_of(command: Callable[[], int]) -> int:
    """The exit code of a command, or the code for lost output."""
    try:
        with _guarded():
            return command()
    except OutputLost as lost:
        if lost.is_closed_pipe:
            return exit_codes.CLOSED_PIPE
        with suppress(OutputLost), _guarded():
            print(f"error: cannot write the output: {lost}", file=sys.stderr)
        return exit_codes.FILE


@contextmanager
def _guarded() -> Iterator[None]:
    """Guard both streams in the block, and write their buffers at its end."""
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = map(_guard, before)
    try:
        yield
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
    except OutputLost:
        _discard_the_rest(before)
        raise
    finally:
        sys.stdout, sys.stderr = before


def _guard(stream: TextIO | None) -> Any:
    """The guarded stream; output to a stream that was closed before the start is discarded."""
    if stream is None:
        return open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123 - no path; never closed
    if isinstance(stream, io.TextIOWrapper):
        # A character that the terminal cannot show is printed as a question mark.
        stream.reconfigure(errors="replace")
    return _Stream(stream)


def _discard_the_rest(streams: tuple[TextIO, TextIO]) -> None:
    """Discard the rest of the buffer of a broken stream.

    Python writes the buffers at its end and would report the error again.
    """
    for stream in streams:
        try:
            stream.flush()
        except (OSError, AttributeError):
            with suppress(OSError, AttributeError):
                nowhere = os.open(os.devnull, os.O_WRONLY)
                os.dup2(nowhere, stream.fileno())
                os.close(nowhere)
