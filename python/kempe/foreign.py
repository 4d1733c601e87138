"""Files of other tools, which the crate ``exchange`` reads."""

from __future__ import annotations

import codecs
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from kempe import _core
from kempe.base import files
from kempe.base.arrays import Floats
from kempe.errors import FileError, Problem

#: Largest size of a file of another tool, bytes; as in the crate.
LARGEST = 100_000_000
#: Endings of the formats whose older files are written in a code page of Windows.
_CODE_PAGES = {"dxf": "cp1252"}
#: Endings of formats that Python reads, and a text that their first lines contain.
_OF_PYTHON = {"xml": ("mjcf", "<mujoco")}
#: Takes a text; returns the case as JSON, what it lacks, and recorded results.
Reader = Callable[
    [str], tuple[str | None, Sequence[tuple[int, str, bool]], Sequence[tuple[str, Any]]]
]
#: Number of reasons that a message lists.
_SHOWN = 10


@dataclass(frozen=True)
class Foreign:
    """The content of a file of another tool.

    Attributes:
        case: the case as JSON.
        unread: what the case lacks, each with its line.
        recorded: results that the file carries.
    """

    case: str
    unread: tuple[str, ...]
    recorded: Mapping[str, Floats]


def format_of(path: Path | str) -> str | None:
    """The format of a file of another tool, by its ending or its first lines; None if unknown."""
    where = files.checked_path(path, "read")
    ending = where.suffix.lower().removeprefix(".")
    if ending in _core.exchange_formats():
        return ending
    if ending in _OF_PYTHON:
        return _OF_PYTHON[ending][0]
    try:
        with where.open("rb") as file:
            begin = file.read(4096)
    except OSError:
        return None
    first = _text(begin.rpartition(b"\n")[0] or begin, None) or ""
    known = (form for form, mark in _OF_PYTHON.values() if mark in first)
    return next(known, None) or _core.exchange_format(first)


def read(path: Path | str, form: str, partial: bool, reader: Reader | None = None) -> Foreign:
    """Read a file of another tool.

    Args:
        path: the file.
        form: its format.
        partial: whether what cannot be read is left out; otherwise it is an error.
        reader: reads the text; the crate if None.

    Raises:
        FileError: the file cannot be read, or a part of it has no equal in kempe.
    """
    where = files.checked_path(path, "read")
    try:
        files.refuse_pipe(where)
        with where.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as error:
        raise files.trouble(path, "read", error) from error
    if len(data) > LARGEST:
        megabytes = LARGEST // 10**6
        raise FileError(f"cannot read {path}: larger than {megabytes} MB", hint="is it a model?")
    text = _text(data, form)
    if text is None:
        raise FileError(f"cannot read {path}: not UTF-8 text", hint="save it as UTF-8")
    case, unread, recorded = reader(text) if reader else _core.exchange_read(text, form)
    lost = [(line, what) for line, what, harmless in unread if not harmless]
    if case is None or (lost and not partial):
        raise _refused(path, lost, case is not None)
    texts = tuple(_told(line, what) for line, what, _ in unread)
    return Foreign(case, texts, dict(recorded))


def dxf_text(unit: float, *parts: Any) -> str:
    """The text of a DXF drawing.

    Args:
        unit: its unit, m.
        parts: lines, circles and texts.
    """
    return _core.exchange_dxf(unit, *parts)


def _told(line: int, what: str) -> str:
    return f"line {line}: {what}" if line else what


def _refused(path: Path | str, lost: list[tuple[int, str]], readable: bool) -> FileError:
    texts = [_told(line, what) for line, what in lost]
    more = [f"and {len(texts) - _SHOWN} more"] if len(texts) > _SHOWN else []
    return FileError(
        f"cannot read {path}:\n" + "\n".join(texts[:_SHOWN] + more),
        name=str(path),
        problems=tuple(Problem(what, "", line or None, None) for line, what in lost),
        hint="partial=True, or kempe convert --partial, keeps the rest" if readable else None,
    )


def _text(data: bytes, form: str | None) -> str | None:
    """The text of some bytes: UTF-8, UTF-16 with its mark, or the code page of the format."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encoding = "utf-16"
    elif b"\0" in data[:4096]:
        return None
    else:
        encoding = "utf-8-sig"
    try:
        return data.decode(encoding)
    except UnicodeDecodeError:
        page = _CODE_PAGES.get(form or "")
        return data.decode(page, errors="replace") if page else None
