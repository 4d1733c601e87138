"""Reading and writing of files: completely or not at all; errors contain a remedy.

A file is written under a temporary name in the same folder, flushed to the disk and then renamed.
A reader therefore receives either the old or the new content, never a part (POSIX rename).
"""

from __future__ import annotations

import json
import math
import os
import re
import secrets
import stat
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, BinaryIO

from kempe.errors import FileError

#: Largest size of a case; the core reads no larger text.
LARGEST_TEXT = 16 * 1024 * 1024

_REMEDIES: tuple[tuple[type[OSError], str, str], ...] = (
    (FileNotFoundError, "does not exist", "check the name"),
    (IsADirectoryError, "is a folder", "name a file in it"),
    (NotADirectoryError, "lies in something that is not a folder", "check the path"),
    (FileExistsError, "exists and is not a folder", "choose another place"),
    (PermissionError, "is not permitted", "check its permissions"),
)


def trouble(path: Path | str, doing: str, error: OSError) -> FileError:
    """The ``FileError`` for an error of the operating system.

    Args:
        path: the file.
        doing: the attempted operation, such as "read".
        error: the error of the system.
    """
    for kind, what, remedy in _REMEDIES:
        if isinstance(error, kind):
            return FileError(f"cannot {doing} {path}: it {what}", name=str(path), hint=remedy)
    reason = error.strerror or str(error)
    return FileError(f"cannot {doing} {path}: {reason}", name=str(path), hint="check the disk")


def refuse_pipe(path: Path | str) -> None:
    """Refuse a pipe or a device, since reading from it may block forever.

    Raises:
        FileError: the file is a pipe or a device.
        OSError, ValueError: the file is missing, or its name is impossible.
    """
    mode = Path(path).stat().st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise FileError(
            f"cannot read {path}: it is a pipe or a device",
            name=str(path),
            hint="copy its content to a file; the commands also read a case from standard input, "
            "with - in place of the name",
        )


def checked_path(path: object, doing: str) -> Path:
    """A path that is valid for the operating system.

    Raises:
        FileError: the argument is not a path, or contains a character that no name can contain.
    """
    try:
        found = Path(path)  # type: ignore[arg-type]
        if b"\0" in os.fsencode(found):
            raise ValueError("a NUL character")
    except (TypeError, ValueError) as error:  # UnicodeEncodeError is a ValueError
        text = ascii(path) if isinstance(path, str) else repr(path)
        raise FileError(
            f"cannot {doing} {text}: it is not a path", hint="check the name"
        ) from error
    return found


def read_text(path: Path | str) -> str:
    """The text of a UTF-8 file.

    Raises:
        FileError: the file is missing, a folder, a pipe, not permitted, too large or not UTF-8.
    """
    where = checked_path(path, "read")
    try:
        refuse_pipe(where)
        with where.open("rb") as file:
            data = file.read(LARGEST_TEXT + 1)
    except OSError as error:
        raise trouble(path, "read", error) from error
    return decoded(data, path)


def json_text(content: Any) -> str:
    """Plain data as indented JSON; numbers that are not finite, which JSON lacks, become null."""
    return json.dumps(_finite(content), indent=2, ensure_ascii=False, allow_nan=False)


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _finite(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(entry) for entry in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def decoded(data: bytes, path: Path | str) -> str:
    """The text of the bytes of a file.

    Args:
        data: the bytes, at most one more than ``LARGEST_TEXT``.
        path: the file, for messages.

    Raises:
        FileError: the text is too large or not UTF-8.
    """
    if len(data) > LARGEST_TEXT:
        megabytes = LARGEST_TEXT // 2**20
        raise FileError(f"cannot read {path}: larger than {megabytes} MiB", hint="is it a case?")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(
            f"cannot read {path}: not UTF-8 text (byte {error.start})",
            name=str(path),
            hint="save it as UTF-8",
        ) from error


def csv_cell(text: str) -> str:
    """A text as a field of a CSV file (RFC 4180) that a spreadsheet does not read as a formula.

    An apostrophe is put before a text that begins with = + - @ or a control character.
    """
    safe = f"'{text}" if text[:1] in {*"=+-@\t\r\n"} else text
    return '"' + safe.replace('"', '""') + '"' if set(safe) & set(',"\r\n') else safe


@contextmanager
def writing(path: Path | str) -> Iterator[BinaryIO]:
    """A binary file that appears at ``path`` only if the block ends without an error.

    Missing folders are created. A symbolic link is kept, and its target is replaced. Devices and
    pipes are refused, since a rename would replace them by a file.

    Raises:
        FileError: the file cannot be written.
    """
    target = Path(os.path.realpath(checked_path(path, "write")))
    draft = target.with_name(f".{target.name}.{os.getpid()}.{secrets.token_hex(4)}.part")
    try:
        _clear(target)
        if target.is_dir():
            raise IsADirectoryError(target)
        if target.exists() and not target.is_file():
            raise FileError(
                f"cannot write {path}: it is a device or a pipe",
                name=str(path),
                hint="name a file, or leave the option out to write to the terminal",
            )
        target.parent.mkdir(parents=True, exist_ok=True)
        with draft.open("xb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        _keep_mode(target, draft)
        draft.replace(target)
    except OSError as error:
        raise trouble(path, "write", error) from error
    finally:
        with suppress(OSError):
            draft.unlink()


def _clear(target: Path) -> None:
    """Remove the temporary files of killed processes that saved the same file."""
    pattern = re.compile(rf"\.{re.escape(target.name)}\.(?:(\d+)\.)?[0-9a-f]{{8}}\.part")
    with suppress(OSError):
        for left in target.parent.iterdir():
            found = pattern.fullmatch(left.name)
            if found and not (found[1] and _is_alive(int(found[1]))):
                with suppress(OSError):
                    left.unlink()


def _is_alive(process: int) -> bool:
    """Whether a process of this machine runs; True if this cannot be determined."""
    if os.name != "posix":
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True


def _keep_mode(target: Path, draft: Path) -> None:
    """Give the new file the permissions of the file that it replaces."""
    with suppress(FileNotFoundError):
        draft.chmod(target.stat().st_mode & 0o7777)


def remove(path: Path) -> None:
    """Delete a file, if it exists.

    Raises:
        FileError: it cannot be deleted.
    """
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        raise trouble(path, "delete", error) from error


def write_text(path: Path | str, text: str) -> None:
    """Write UTF-8 text, whole or not at all.

    Raises:
        FileError: the file cannot be written.
    """
    with writing(path) as file:
        file.write(text.encode("utf-8"))
