"""Files of solutions: NumPy arrays and one JSON text that contains the case, without pickle."""

from __future__ import annotations

import json
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from kempe import _core, files
from kempe._version import __version__
from kempe.arrays import Floats
from kempe.compiled import CompiledModel
from kempe.errors import FileError, KempeError
from kempe.solution import REACHED, Solution

KIND = "kempe solution"
#: Version of the file layout.
LAYOUT = 1

#: Errors of numpy for a file that is not an archive; the last two for a file with a single array.
_UNREADABLE = (
    zipfile.BadZipFile,
    zlib.error,
    ValueError,
    KeyError,
    EOFError,
    TypeError,
    AttributeError,
)


@dataclass(frozen=True)
class _Stored:
    """The attributes of ``_core.Run``, read from a file."""

    t: Floats
    q: Floats
    v: Floats
    z: Floats
    a: Floats
    lam: Floats
    energy: Floats
    dense_t: Floats | None
    dense_y: Floats | None
    dense_c: Floats | None
    status: str
    message: str
    statistics: str

    def responses(self) -> tuple[Floats, Floats]:
        return self.a, self.lam

    def energies(self) -> Floats:
        return self.energy


def save(solution: Solution, path: Path | str) -> None:
    """Write a solution completely or not at all; see ``Solution.save``."""
    arrays = {name: getattr(solution, name) for name in ("t", "q", "v", "z", "a", "lam")}
    energy = solution.energy
    arrays["energy"] = np.column_stack(
        [
            energy.kinetic,
            energy.potential,
            energy.dissipated,
            energy.work_of_drivers,
            energy.work_of_forces,
        ]
    )
    if solution.dense is not None:
        dense = solution.dense
        arrays |= {"dense_t": dense.t, "dense_y": dense.y, "dense_c": dense.c}
    about = json.dumps(_about(solution), allow_nan=False)
    with files.writing(path) as file:
        np.savez(file, about=np.array(about), **arrays)


def _about(solution: Solution) -> dict[str, Any]:
    return {
        "kind": KIND,
        "layout": LAYOUT,
        "kempe": __version__,
        "core": _core.version(),
        "numpy": np.__version__,
        "case": json.loads(solution.model.case),
        "status": "reached" if solution.status == REACHED else "stopped",
        "message": solution.message,
        "statistics": dict(solution.statistics),
    }


def load_solution(path: Path | str) -> Solution:
    """Read a solution that ``Solution.save`` wrote.

    Raises:
        FileError: the file cannot be read, is damaged, is not a solution, or needs a newer kempe.
    """
    about, arrays = _read(path)
    if about.get("kind") != KIND:
        raise _foreign(path, "it has other content")
    if about.get("layout") != LAYOUT:
        raise FileError(
            f"cannot read {path}: written by kempe {about.get('kempe')}", hint="update kempe"
        )
    try:
        model = CompiledModel.from_case(json.dumps(about["case"]))
        solution = Solution(model, _stored(about, arrays, model))  # type: ignore[arg-type]
        for part in ("energy", "statistics", "dense"):  # raises the errors of these parts
            getattr(solution, part)
        return solution
    except (KeyError, ValueError, IndexError, TypeError) as error:
        if isinstance(error, KempeError):
            raise
        raise _foreign(path, f"incomplete ({error})") from error


def _read(path: Path | str) -> tuple[dict[str, Any], dict[str, Floats]]:
    try:
        files.refuse_pipe(path)
        with Path(path).open("rb") as file, np.load(file, allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}
        about = json.loads(str(arrays.pop("about")))
    except OSError as error:
        raise files.trouble(path, "read", error) from error
    except _UNREADABLE as error:
        raise _foreign(path, "the file is damaged or is not a solution of kempe") from error
    if not isinstance(about, dict):
        raise _foreign(path, "it has other content")
    return about, arrays


def _stored(about: dict[str, Any], arrays: dict[str, Floats], model: CompiledModel) -> _Stored:
    n = len(arrays["t"])
    shapes = {"t": (n,), "energy": (n, 5), "lam": (n, model.n_rows)}
    shapes |= dict.fromkeys(("q", "v", "a"), (n, model.n_q))
    arrays.setdefault("z", np.zeros((n, model.n_z)))  # files of version 0.1 have no z
    shapes["z"] = (n, model.n_z)
    for name, shape in shapes.items():
        if arrays[name].shape != shape:
            raise ValueError(f"{name} is {arrays[name].shape}, must be {shape}")
    return _Stored(
        **{name: arrays[name] for name in shapes},
        dense_t=arrays.get("dense_t"),
        dense_y=arrays.get("dense_y"),
        dense_c=arrays.get("dense_c"),
        status=about["status"],
        message=about["message"],
        statistics=json.dumps(about["statistics"]),
    )


def _foreign(path: Path | str, why: str) -> FileError:
    return FileError(
        f"cannot read {path} as a solution: {why}", name=str(path), hint="was it written by save()?"
    )
