"""Finished rows of a sweep in a file, from which it resumes.

The file is an SQLite database. It contains a block of rows either completely or not at all, even
after the process was killed. Each number is stored as its eight bytes, each mark as its byte. Each
row has a checksum, so that a damaged row is never read as a result.
"""

from __future__ import annotations

import hashlib
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from kempe.base import files
from kempe.base.arrays import Floats
from kempe.errors import FileError
from kempe.sweeps.plan import Block

_TABLES = """
CREATE TABLE IF NOT EXISTS sweep (key TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS row (
    k INTEGER PRIMARY KEY, numbers BLOB NOT NULL, reason TEXT NOT NULL, marks BLOB NOT NULL,
    checksum BLOB NOT NULL
);
"""

#: Why a file contains another sweep.
CHANGED = "the case, the variables, the measures or the version of kempe changed"
#: Errors of a damaged file; its texts need not be UTF-8, nor its sizes possible.
_FAULTS = (sqlite3.Error, UnicodeDecodeError, OverflowError, MemoryError)
#: What to do with a damaged file.
DELETE = "delete this file, or name another; the sweep then starts anew"


class Storage:
    """The file of a sweep.

    Args:
        path: the file; made if it does not exist.
        key: the fingerprint of the sweep.

    Raises:
        FileError: the file cannot be written, is damaged, or contains another sweep.
    """

    def __init__(self, path: Path | str, key: str) -> None:
        self.path = files.checked_path(path, "write")
        self._data: sqlite3.Connection | None = None
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            # the threads of a search take turns
            self._data = sqlite3.connect(self.path, check_same_thread=False)
            known = self._key(self._data, key)
        except OSError as error:
            raise files.trouble(path, "write", error) from error
        except _FAULTS as error:
            self._refuse(error)
        if known != key:
            self.close()
            raise FileError(
                f"{path} holds the results of another sweep",
                name=str(path),
                hint=f"{CHANGED}; name another file, or delete this one",
            )

    @staticmethod
    def _key(data: sqlite3.Connection, key: str) -> str:
        """The fingerprint in the file; a new file receives this one."""
        data.executescript(_TABLES)
        known = data.execute("SELECT key FROM sweep").fetchone()
        if known is not None:
            return str(known[0])
        if data.execute("SELECT k FROM row").fetchone() is not None:
            raise sqlite3.DatabaseError("it has rows, but not the name of their sweep")
        with data:
            data.execute("INSERT INTO sweep VALUES (?)", (key,))
        return key

    def _refuse(self, error: Exception) -> NoReturn:
        """Report a fault of the file, and close it."""
        self.close()
        code = getattr(error, "sqlite_errorname", "") or ""  # Python 3.11 and later
        about, hint = f"cannot use {self.path} for the rows of a sweep: {error}", DELETE
        if "locked" in str(error):
            hint = "another sweep writes to it: wait for its end, or name another file"
        elif code.startswith(("SQLITE_FULL", "SQLITE_READONLY", "SQLITE_CANTOPEN")):
            hint = "name a file in a folder that can be written, on a disk that is not full"
        raise FileError(about, name=str(self.path), hint=hint) from error

    def _damaged(self, k: object) -> NoReturn:
        self.close()
        raise FileError(f"{self.path} is damaged: row {k}", name=str(self.path), hint=DELETE)

    def read(self, n: int, width: int) -> Iterator[tuple[int, Floats, str, NDArray[np.uint8]]]:
        """The finished rows: number, numbers, reason and marks.

        Args:
            n: number of rows of the sweep.
            width: number of wanted numbers in each.

        Raises:
            FileError: the file or a row is damaged.
        """
        asked = "SELECT k, numbers, reason, marks, checksum FROM row ORDER BY k"
        try:
            with closing(self._open.execute(asked)) as found:
                for k, numbers, reason, marks, checksum in found:
                    kinds = list(map(type, (k, numbers, reason, marks, checksum)))
                    if kinds != [int, bytes, str, bytes, bytes] or not 0 <= k < n:
                        self._damaged(k)
                    if (len(numbers), len(marks)) != (8 * width, width):
                        self._damaged(k)
                    if checksum != _checksum(k, numbers, reason, marks):
                        self._damaged(k)
                    read = np.frombuffer(numbers, dtype="<f8")
                    yield k, read, reason, np.frombuffer(marks, dtype=np.uint8)
        except _FAULTS as error:
            self._refuse(error)

    def add(self, rows: NDArray[np.intp], block: Block) -> None:
        """Write finished rows with these numbers, all or none."""
        values = np.ascontiguousarray(block.values, dtype="<f8")
        entries = (
            _entry(int(k), values[i].tobytes(), block.reasons[i], block.marks[i].tobytes())
            for i, k in enumerate(rows.tolist())
        )
        try:
            with self._open as data:
                data.executemany("INSERT OR REPLACE INTO row VALUES (?, ?, ?, ?, ?)", entries)
        except _FAULTS as error:
            self._refuse(error)

    @property
    def _open(self) -> sqlite3.Connection:
        assert self._data is not None
        return self._data

    def close(self) -> None:
        """Close the file."""
        if self._data is not None:
            self._data.close()


def _entry(k: int, numbers: bytes, reason: str, marks: bytes) -> tuple[Any, ...]:
    return k, numbers, reason, marks, _checksum(k, numbers, reason, marks)


def _checksum(k: int, numbers: bytes, reason: str, marks: bytes) -> bytes:
    """Eight bytes of a hash of a row; the number of its row is part of it."""
    text = reason.encode()
    parts = (k.to_bytes(8, "little"), len(text).to_bytes(8, "little"), text, numbers, marks)
    return hashlib.blake2b(b"".join(parts), digest_size=8).digest()
