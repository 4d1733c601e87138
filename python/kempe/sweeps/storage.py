"""Finished rows of a sweep in a file, from which it resumes.

The file is an SQLite database. It contains a block of rows either completely or not at all, even
after the process was killed. Each number is stored as its eight bytes, each mark as its byte.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from kempe.base import files
from kempe.base.arrays import Floats
from kempe.errors import FileError
from kempe.sweeps.plan import Block

_TABLES = """
CREATE TABLE IF NOT EXISTS sweep (key TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS row (
    k INTEGER PRIMARY KEY, numbers BLOB NOT NULL, reason TEXT NOT NULL, marks BLOB NOT NULL
);
"""

#: Why a file contains another sweep.
CHANGED = "the case, the variables, the measures or the version of kempe changed"


class Storage:
    """The file of a sweep.

    Args:
        path: the file; made if it does not exist.
        key: the fingerprint of the sweep.

    Raises:
        FileError: the file cannot be written, or contains another sweep.
    """

    def __init__(self, path: Path | str, key: str) -> None:
        self.path = files.checked_path(path, "write")
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._data = sqlite3.connect(self.path)
            self._data.executescript(_TABLES)
            known = self._data.execute("SELECT key FROM sweep").fetchone()
            if known is None:
                with self._data:
                    self._data.execute("INSERT INTO sweep VALUES (?)", (key,))
        except OSError as error:
            raise files.trouble(path, "write", error) from error
        except sqlite3.Error as error:
            self._refuse(error)
        if known is not None and known[0] != key:
            self.close()
            raise FileError(
                f"{path} holds the results of another sweep",
                name=str(path),
                hint=f"{CHANGED}; name another file, or delete this one",
            )

    def _refuse(self, error: Exception) -> NoReturn:
        raise FileError(
            f"cannot write {self.path}: {error}",
            name=str(self.path),
            hint="name a file that a sweep wrote, or one that does not exist",
        ) from error

    def read(self) -> Iterator[tuple[int, Floats, str, NDArray[np.uint8]]]:
        """The finished rows: number, numbers, reason and marks."""
        asked = "SELECT k, numbers, reason, marks FROM row ORDER BY k"
        with closing(self._data.execute(asked)) as found:
            for k, numbers, reason, marks in found:
                read = np.frombuffer(numbers, dtype="<f8")
                yield k, read, reason, np.frombuffer(marks, dtype=np.uint8)

    def add(self, rows: NDArray[np.intp], block: Block) -> None:
        """Write finished rows with these numbers, all or none."""
        values = np.ascontiguousarray(block.values, dtype="<f8")
        entries = (
            (int(k), values[i].tobytes(), block.reasons[i], block.marks[i].tobytes())
            for i, k in enumerate(rows.tolist())
        )
        try:
            with self._data:
                self._data.executemany("INSERT OR REPLACE INTO row VALUES (?, ?, ?, ?)", entries)
        except sqlite3.Error as error:
            self._refuse(error)

    def close(self) -> None:
        """Close the file."""
        self._data.close()
