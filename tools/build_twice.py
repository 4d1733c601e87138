"""Build the packages of the last commit in two folders and compare their bytes.

    .venv/bin/python tools/build_twice.py            as they are released, some twenty minutes
    .venv/bin/python tools/build_twice.py --quick    without optimisation

The folders have names of different lengths and caches of their own, as on two machines. The tools
are those of this environment: the same compiler is needed for the same bytes. Exit code: 1 if the
packages differ; the files in them that differ are printed.
"""

import argparse
import hashlib
import io
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def built(folder: Path, words: list[str]) -> dict[str, Path]:
    """The packages of the last commit, built in a folder."""
    text = subprocess.run(["git", "archive", "HEAD"], cwd=ROOT, check=True, stdout=subprocess.PIPE)
    with tarfile.open(fileobj=io.BytesIO(text.stdout)) as archive:
        archive.extractall(folder, filter="data")
    command = [sys.executable, "tools/build_packages.py", "--out", str(folder / "dist"), *words]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return {path.name: path for path in (folder / "dist").iterdir()}


def members(path: Path) -> dict[str, bytes]:
    """The files in a package."""
    if path.suffix == ".whl":
        with zipfile.ZipFile(path) as wheel:
            return {name: wheel.read(name) for name in wheel.namelist()}
    with tarfile.open(path) as archive:
        files = [member for member in archive if member.isfile()]
        return {one.name: archive.extractfile(one).read() for one in files}  # type: ignore[union-attr]


def differences(one: Path, other: Path) -> list[str]:
    """Names of the files that differ, or that one lacks; empty if the bytes are the same."""
    if one.read_bytes() == other.read_bytes():
        return []
    first, second = members(one), members(other)
    names = sorted(set(first) | set(second))
    return [n for n in names if first.get(n) != second.get(n)] or ["times or order of the files"]


def main(words: list[str] | None = None) -> int:
    """Build twice and compare."""
    parser = argparse.ArgumentParser(description="Compare two builds of the packages.")
    parser.add_argument("--quick", action="store_true", help="compile without optimisation")
    chosen = parser.parse_args(words)
    code = 0
    with tempfile.TemporaryDirectory(prefix="kempe-") as place:
        folders = (Path(place) / "a", Path(place) / "another_folder" / "below")
        for folder in folders:
            folder.mkdir(parents=True)
        more = ["--quick"] if chosen.quick else []
        one, other = (built(folder, more) for folder in folders)
        assert set(one) == set(other), "the names of the packages differ"
        for name, path in one.items():
            wrong = differences(path, other[name])
            digest = hashlib.sha256(path.read_bytes()).hexdigest()
            print(f"{name}: {'differs in ' + ', '.join(wrong) if wrong else 'sha256 ' + digest}")
            code |= bool(wrong)
    return code


if __name__ == "__main__":
    sys.exit(main())
