"""Reading files of solutions, which ``saving`` writes.

A file is checked before its data are read. The names, types and sizes of the arrays in its
directory and their headers are checked first, then the numbers. Arrays that do not belong to a
solution are never read.
"""

from __future__ import annotations

import json
import math
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import IO, Any, NoReturn

import numpy as np
from numpy.lib import format as npy

from kempe import _core
from kempe.base import files
from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.errors import FileError, KempeError
from kempe.model.compiled import CompiledModel
from kempe.results.dense import WORKS
from kempe.results.phases import Settings
from kempe.results.runs import STATUS, EventRows, StoredRun
from kempe.results.saving import EVENTS, KIND, LAYOUT
from kempe.results.solution import Solution
from kempe.results.variable import TIME, Variable

#: The largest JSON text, bytes: a case has at most 16 MiB, and NumPy takes 4 bytes for a letter.
_LARGEST_TEXT = 16 * files.LARGEST_TEXT
_HIGHEST_DEGREE = 32
#: Accelerations of a file agree with its model within this fraction of the largest.
_AGREEMENT = 1e-6
_SAMPLES = 9
#: Statistics that are counts.
_COUNTS = {"steps", "rejected", "evaluations", "jacobians", "iterations", "factorisations"}
_DENSE = ("dense_t", "dense_y", "dense_c")

#: Letters for the sizes of an array, such as n for the number of times, or the size itself.
_Shape = tuple["int | str", ...]


@explained
def load_solution(path: Path | str) -> Solution:
    """Read a solution that ``Solution.save`` wrote.

    Raises:
        FileError: the file cannot be read, is damaged, is not a solution, disagrees with its own
            model, or needs a newer kempe.
    """
    where = files.checked_path(path, "read")
    with _only_file_errors(where):
        files.refuse_pipe(where)
    with _only_file_errors(where), where.open("rb") as file, zipfile.ZipFile(file) as stored:
        about = _read_about(stored)
        if about.get("kind") != KIND:
            _refuse("it has other content")
        if about.get("layout") != LAYOUT:
            raise FileError(
                f"cannot read {where}: written by kempe {about.get('kempe')}", hint="update kempe"
            )
        model = CompiledModel.from_case(json.dumps(_entry(about, "case", dict)))
        variable = _variable(about)
        arrays = _read_arrays(stored, model, is_over_time=variable.is_time)
        solution = Solution(model, _run(about, arrays), variable=variable)
        _check_agreement(solution)
        return solution


class _UnfitError(ValueError):
    """The content is not a valid solution."""


def _refuse(why: str) -> NoReturn:
    raise _UnfitError(why)


@contextmanager
def _only_file_errors(path: Path) -> Iterator[None]:
    """Convert errors of numpy, zipfile, json and the core to a FileError."""
    try:
        yield
    except FileError as error:
        if error.problems:  # of the case in the file
            raise _foreign(path, f"its case is invalid ({error})") from error
        raise
    except OSError as error:
        raise files.trouble(path, "read", error) from error
    except _UnfitError as error:
        raise _foreign(path, str(error)) from error
    except KempeError as error:
        raise _foreign(path, f"its case is invalid ({error})") from error
    except Exception as error:
        why = "the file is damaged or is not a solution of kempe"
        raise _foreign(path, why) from error


def _read_about(stored: zipfile.ZipFile) -> dict[str, Any]:
    with _member(stored, "about", _LARGEST_TEXT) as (file, shape, kind):
        if shape != () or kind.kind != "U":
            _refuse("it has other content")
        text = file.read().decode("utf-32-le" if kind.byteorder != ">" else "utf-32-be")
    about = json.loads(text.rstrip("\0"), parse_constant=lambda name: _refuse(f"it has {name}"))
    return about if isinstance(about, dict) else _refuse("it has other content")


@contextmanager
def _member(
    stored: zipfile.ZipFile, name: str, largest: int | None = None
) -> Iterator[tuple[IO[bytes], tuple[int, ...], np.dtype[Any]]]:
    """An array of the file, opened behind its header, with its shape and type."""
    names = stored.namelist()
    if names.count(f"{name}.npy") != 1:
        _refuse(f"it has {names.count(f'{name}.npy')} arrays {name!r}; must be one")
    info = stored.getinfo(f"{name}.npy")
    if info.compress_type != zipfile.ZIP_STORED or info.compress_size != info.file_size:
        _refuse(f"{name} is compressed, which save() does not do")
    if largest is not None and info.file_size > largest:
        _refuse(f"{name} has {info.file_size} bytes; at most {largest} are read")
    with stored.open(info) as file:
        version = npy.read_magic(file)
        read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
        shape, fortran, kind = read(file)
        if fortran and len(shape) > 1:
            _refuse(f"{name} is in the order of Fortran")
        size = int(np.prod([int(count) for count in shape], dtype=object)) * kind.itemsize
        if file.tell() + size != info.file_size:
            _refuse(f"{name} has {info.file_size - file.tell()} bytes; must have {size}")
        yield file, shape, kind


def _read_arrays(
    stored: zipfile.ZipFile, model: CompiledModel, *, is_over_time: bool
) -> dict[str, Floats]:
    """All arrays of a solution, checked; z of version 0.1 is absent."""
    wanted = _shapes(stored, model)
    sizes: dict[str, int] = {}
    for name, shape in wanted.items():  # before any data are read
        with _member(stored, name) as (_, found, kind):
            _check_header(name, found, kind, shape, sizes)
    arrays = {name: _floats(stored, name) for name in wanted}
    arrays.setdefault("z", np.zeros((sizes["n"], model.n_z)))
    for name in ("t", "dense_t"):
        steps = np.diff(arrays.get(name, np.zeros(1)))
        if np.any(steps < 0.0) and (is_over_time or np.any(steps > 0.0)):
            _refuse(f"the times {name} are not in order")
    return arrays


def _shapes(stored: zipfile.ZipFile, model: CompiledModel) -> dict[str, _Shape]:
    present = set(stored.namelist())
    rows = {"q": model.n_q, "v": model.n_q, "a": model.n_q, "lam": model.n_multipliers, "energy": 5}
    shapes: dict[str, _Shape] = {"t": ("n",)}
    shapes |= {name: ("n", count) for name, count in rows.items()}
    if "z.npy" in present or model.n_z:
        shapes["z"] = ("n", model.n_z)
    if present & {f"{name}.npy" for name in _DENSE}:
        n_y = 2 * model.n_q + model.n_z + WORKS
        shapes |= {"dense_t": ("k + 1",), "dense_y": ("k", n_y), "dense_c": ("k", n_y, "degree")}
    if present & {f"{name}.npy" for name in EVENTS}:
        widths = {"event_q": model.n_q, "event_v": model.n_q, "event_z": model.n_z}
        widths |= {"event_impulses": model.n_multipliers}
        shapes |= {"event_t": ("events",)}
        shapes |= {name: ("events", width) for name, width in widths.items()}
    return shapes


def _check_header(
    name: str, found: tuple[int, ...], kind: np.dtype[Any], shape: _Shape, sizes: dict[str, int]
) -> None:
    """Compare the shape of an array with the expected one; new letters get their values here."""
    if kind != np.dtype(np.float64):
        _refuse(f"{name} has numbers of type {kind}; must be float64")
    for size, count in zip(shape, found, strict=False):
        if isinstance(size, str) and count > 0:
            sizes.setdefault(size, min(count, _HIGHEST_DEGREE) if size == "degree" else count)
            if size == "k + 1":
                sizes["k"] = count - 1
    told = tuple(sizes.get(size, size) if isinstance(size, str) else size for size in shape)
    if found != told:
        _refuse(f"{name} is {found}, must be {told}".replace("'", ""))


def _floats(stored: zipfile.ZipFile, name: str) -> Floats:
    with _member(stored, name) as (file, shape, _):
        values = np.frombuffer(file.read(), dtype=np.float64).reshape(shape)
    if not np.isfinite(values).all():
        _refuse(f"{name} contains a number that is not finite")
    return values


def _run(about: Mapping[str, Any], arrays: Mapping[str, Floats]) -> StoredRun:
    status, statistics = _entry(about, "status", str), dict(_entry(about, "statistics", dict))
    if status not in STATUS:
        _refuse(f"its status is {status!r}")
    for name in {"steps", *statistics} & _COUNTS:
        count = statistics.get(name)
        if isinstance(count, bool) or not isinstance(count, int) or count < 0:
            _refuse(f"its statistics have {count!r} {name}")
    statistics.setdefault("method", _method(about["case"]))
    return StoredRun(
        **{name: arrays[name] for name in ("t", "q", "v", "z", "energy")},
        accelerations=(arrays["a"], arrays["lam"]),
        dense_t=arrays.get("dense_t"),
        dense_y=arrays.get("dense_y"),
        dense_c=arrays.get("dense_c"),
        status=status,
        message=_entry(about, "message", str),
        statistics=json.dumps(statistics),
        projection=_projection(about),
        settings=_settings(about, len(arrays["t"])),
        events=_events(about, arrays),
    )


def _settings(about: Mapping[str, Any], count: int) -> Settings:
    """The phases of the run; files of version 0.1 have only one phase."""
    found = []
    for row, parameters, released, *rest in about.get("settings", [[0, [], []]]):
        numbers = all(isinstance(x, int | float) for _, x in parameters)
        if not isinstance(row, int) or not 0 <= row <= count or not numbers:
            _refuse("its phases are damaged")
        given = [(str(name), float(x)) for name, x in parameters]
        modes = [tuple(mode) for mode in rest[0]] if rest else []
        found.append((row, (given, list(map(str, released)), modes)))
    if not found or found[0][0] != 0 or any(a >= b for (a, _), (b, _) in pairwise(found)):
        _refuse("its phases are damaged")
    return found


def _events(about: Mapping[str, Any], arrays: Mapping[str, Floats]) -> list[EventRows]:
    """The events with their states."""
    counts = about.get("events", [])
    if any(type(n) is not int or n < 0 for _, n in counts):
        _refuse("its events are damaged")
    if sum(n for _, n in counts) != len(arrays.get("event_t", ())):
        _refuse("its events are damaged")
    if "event_t" in arrays:
        t, q, v, z, impulses = (arrays[name] for name in EVENTS)
    else:  # no event occurred
        t = np.zeros(0)
        q, v, z, impulses = (arrays[name][:0] for name in ("q", "v", "z", "lam"))
    found: list[EventRows] = []
    begin = 0
    for name, n in counts:
        rows = slice(begin, begin + n)
        found.append((str(name), t[rows], q[rows], v[rows], z[rows], impulses[rows]))
        begin += n
    return found


def _projection(about: Mapping[str, Any]) -> float | None:
    """Tolerance of the projection of the states; absent in files of version 0.1."""
    given = about.get("projection")
    if given is None:
        return None
    if isinstance(given, bool) or not isinstance(given, (int, float)) or not 0 < given < math.inf:
        _refuse(f"its projection is {given!r}")
    return float(given)


def _variable(about: Mapping[str, Any]) -> Variable:
    """The quantity of the times; the time in files of version 0.1."""
    given = about.get("variable", [TIME.name, TIME.unit])
    if not isinstance(given, list) or [type(word) for word in given] != [str, str]:
        _refuse("its variable is damaged")
    static = about.get("static", False)
    if not isinstance(static, bool):
        _refuse("its variable is damaged")
    name, unit = given
    return Variable(name, unit, static)


def _method(case: Mapping[str, Any]) -> str:
    """The method of the only analysis; files of version 0.1 do not name it in their statistics."""
    methods = [entry.get("method") for entry in case.get("analyses", {}).values()]
    only = methods[0] if len(methods) == 1 else None
    return str(only["type"]) if isinstance(only, dict) and "type" in only else "unknown"


def _entry(about: Mapping[str, Any], name: str, kind: type) -> Any:
    value = about.get(name)
    return value if isinstance(value, kind) else _refuse(f"it has no {name}")


def _check_agreement(solution: Solution) -> None:
    """Check that the accelerations at some times follow from the model and its parameters."""
    rows = np.unique(np.linspace(0, len(solution.t) - 1, _SAMPLES).round().astype(int))
    for k in rows:
        t, q, v, z = (
            values[k : k + 1] for values in (solution.t, solution.q, solution.v, solution.z)
        )
        try:
            model = solution._state_of(int(k)).compiled
            a, *_ = _core.States(model.core, t, q, v, z).evaluate(solution._passing)
        except KempeError:  # a run may end in a position without unique accelerations
            continue
        largest = max(
            float(np.abs(a).max(initial=0.0)), float(np.hypot(*solution.compiled.gravity))
        )
        if np.abs(a - solution.a[k]).max(initial=0.0) > _AGREEMENT * largest:
            _refuse(f"its accelerations at t = {t[0]:g} s are not those of its model")


def _foreign(path: Path | str, why: str) -> FileError:
    return FileError(
        f"cannot read {path} as a solution: {why}", name=str(path), hint="was it written by save()?"
    )
