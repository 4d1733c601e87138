"""Files of earlier versions are read for ever, with the same meaning.

`files/VERSION/` has the files of a version and `expected.json`: a checksum of each file, the state
at its start, the names of its analyses, and, for files `every_…`, the last state of each analysis.
A folder never changes after the release of its version. A new folder is written once:

    PYTHONPATH=tests .venv/bin/python -m promise.test_old_files tests/promise/files/0.2
"""

import hashlib
import json
import re
import sys
import warnings
from contextlib import suppress
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.results.result import Result
from promise import files_and_commands

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.10
    from pip._vendor import tomli as tomllib

FOLDERS = sorted(path for path in Path(__file__).with_name("files").iterdir() if path.is_dir())
FILES = [path for folder in FOLDERS for path in sorted(folder.iterdir())]
CASES = [path for path in FILES if path.suffix == ".toml"]
SOLUTIONS = [path for path in FILES if path.suffix == ".npz"]
#: Files with these names contain each type and each field, and their analyses are run.
WHOLE = "every_"
#: Largest differences, relative to the largest number of a kind: at the start, and at the end of a
#: run, which has the tolerances of its method.
AT_START, AT_END = 1e-9, 1e-5


def expected(folder: Path) -> Any:
    return json.loads((folder / "expected.json").read_text("utf-8"))


def meaning(path: Path) -> dict[str, Any]:
    """What a file means: the state at its start, its analyses, and their last states."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        case = kp.load(path)
        state = case.start()
        start = {name: numbers(getattr(state, name)) for name in ("q", "v", "z")}
        with suppress(kp.AssemblyError):  # an impact at the start has no acceleration
            start |= {"a": numbers(state.a), "lam": numbers(state.lam)}
        ends = {}
        if path.name.startswith(WHOLE):
            ends = {name: numbers(last_state(one)) for name, one in case.run().items()}
    analyses = {name: entry["type"] for name, entry in case.analyses.items()}
    return {"analyses": analyses, "start": start, "ends": ends}


def stored(path: Path) -> dict[str, list[float]]:
    """The numbers of a stored solution, also between its outputs."""
    sol = kp.load_solution(path)
    between = sol(0.5 * (sol.t[0] + sol.t[1]))
    found = {"t": sol.t, "q": sol.q, "v": sol.v, "lam": sol.lam, "between": between.q}
    return {name: numbers(values) for name, values in found.items()}


def last_state(result: kp.Solution | Result) -> Any:
    return result.q[-1] if isinstance(result, kp.Solution) else result.final.q


def numbers(values: Any) -> list[float]:
    return [float(f"{x:.15g}") for x in np.ravel(values)]


def checksum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def differ(found: list[float], kept: list[float], tolerance: float) -> bool:
    """Whether numbers of one kind differ by more than a part of the largest of them, or of 1."""
    scale = max(1.0, *map(abs, kept), 0.0)
    return not np.allclose(found, kept, rtol=0, atol=tolerance * scale)


@pytest.mark.parametrize("path", CASES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_a_file_of_an_earlier_version_has_its_meaning(path: Path) -> None:
    kept, found = expected(path.parent)["cases"][path.name], meaning(path)
    assert found["analyses"] == kept["analyses"]
    for name, values in kept["start"].items():
        assert not differ(found["start"][name], values, AT_START), name
    for name, values in kept["ends"].items():
        assert not differ(found["ends"][name], values, AT_END), name


@pytest.mark.parametrize("path", SOLUTIONS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_a_solution_of_an_earlier_version_is_read(path: Path) -> None:
    kept, found = expected(path.parent)["solutions"][path.name], stored(path)
    for name, values in kept.items():
        assert not differ(found[name], values, AT_START), name


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_the_files_are_those_of_the_version(folder: Path) -> None:
    found = {path.name: checksum(path) for path in FILES if path.parent == folder}
    del found["expected.json"]
    assert found == expected(folder)["checksums"], "the files of a version never change"


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_the_files_contain_every_type_and_field_of_their_version(folder: Path) -> None:
    found = set().union(*(contained(path) for path in CASES if path.parent == folder))
    assert set(expected(folder)["fields"]) <= found


def test_a_changed_number_is_found() -> None:
    assert not differ([1.0, 1e6], [1.0, 1e6 + 1e-5], AT_START)
    assert differ([1.0, 1e6], [1.01, 1e6], AT_START)


def contained(path: Path) -> set[str]:
    """The types and fields in a file, such as `joints.gear.radii`."""
    tree = tomllib.loads(path.read_text("utf-8"))
    found = set()
    for section in ("bodies", "tables", "joints", "drivers", "forces", "analyses"):
        for name, entry in tree.get(section, {}).items():
            usual = {"bodies": "ground" if name == "ground" else "body", "tables": "table"}
            found |= fields(section, {"type": usual.get(section), **entry})
            for shape in entry.get("shapes", ()):
                found |= fields("shapes", shape)
            for key in ("method", "stabilization"):
                if key in entry:
                    found |= fields(f"{key}s", entry[key])
    return found


def fields(section: str, entry: dict[str, Any]) -> set[str]:
    whole = f"{section}.{entry['type']}"
    return {whole} | {f"{whole}.{key}" for key in entry if key != "type"}


def write(folder: Path) -> None:
    """Write the expected meanings of the files in a folder, at the release of their version."""
    paths = sorted(path for path in folder.iterdir() if path.name != "expected.json")
    cases = {path.name: meaning(path) for path in paths if path.suffix == ".toml"}
    now = {re.split(r"[:=(]", line)[0].strip() for line in files_and_commands.file_format()}
    every = sorted(name for name in now if name.partition(".")[0] in files_and_commands.SECTIONS)
    whole = {"checksums": {path.name: checksum(path) for path in paths}, "fields": every}
    whole["solutions"] = {path.name: stored(path) for path in paths if path.suffix == ".npz"}
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(one)}" for name, one in cases.items())
    text = json.dumps(whole)[:-1] + f', "cases": {{\n{lines}\n}}}}\n'
    (folder / "expected.json").write_text(text, "utf-8")


if __name__ == "__main__":
    write(Path(sys.argv[1]))
