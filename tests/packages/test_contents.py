"""The contents of the packages: all sources and licences, both cores, no path of this machine."""

import base64
import csv
import gzip
import hashlib
import io
import os
import subprocess
import tarfile
import zipfile
from pathlib import Path

import kempe
import pytest
from house.places import ROOT
from kempe.studio.page import CARRIED, read
from kempe.studio.sources import checksum

LICENCES = ("LICENSE-MIT", "LICENSE-APACHE", "THIRD_PARTY_NOTICES.txt")
INFORMATION = f"kempe-{kempe.__version__}.dist-info"
#: The page of the studio.
STUDIO = "kempe/studio/page.html.gz"
#: The stored solutions of nine points.
NINE = "kempe/synthesis/nine_points.bin"
#: The library inside FMUs, with its licences.
FMU = {
    f"kempe/_fmu/{name}" for name in ("libkempe_fmu.so", "LICENSE-MIT", "THIRD_PARTY_NOTICES.txt")
}
CORES = {"kempe/_core.abi3.so", "kempe/_x86_64_v3/_core.abi3.so"}


def tracked(folder: str) -> set[str]:
    """Names of the tracked files in a folder, from that folder."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT / folder, capture_output=True, text=True, check=True
    )
    return {name for name in listed.stdout.split("\0") if name}


def test_the_wheel_is_for_every_python_and_old_systems(wheel_path: Path) -> None:
    name, version, python, abi, platforms = wheel_path.stem.split("-")
    assert (name, version, python, abi) == ("kempe", kempe.__version__, "cp310", "abi3")
    assert "manylinux_2_17_x86_64" in platforms.split(".")


def test_the_wheel_has_all_of_the_package_and_both_cores(wheel: zipfile.ZipFile) -> None:
    inside = {name for name in wheel.namelist() if not name.startswith(INFORMATION)}
    assert inside == tracked("python") | CORES | FMU
    assert {"kempe/py.typed", STUDIO} <= inside


@pytest.mark.skipif(
    "KEMPE_REPOSITORY_BASELINE" not in os.environ,
    reason="between releases, the page that kempe carries may be older than its sources",
)
def test_a_release_has_the_page_of_its_sources() -> None:
    assert read(CARRIED).sources == checksum(), "run tools/release_page.sh"


def test_every_file_of_the_wheel_is_recorded(wheel: zipfile.ZipFile) -> None:
    rows = csv.reader(io.StringIO(wheel.read(f"{INFORMATION}/RECORD").decode()))
    recorded = {name: digest for name, digest, _ in rows}
    assert set(recorded) == set(wheel.namelist())
    assert recorded.pop(f"{INFORMATION}/RECORD") == ""
    for name, digest in recorded.items():
        found = base64.urlsafe_b64encode(hashlib.sha256(wheel.read(name)).digest())
        assert digest == "sha256=" + found.rstrip(b"=").decode(), name


def test_the_wheel_has_the_licences(wheel: zipfile.ZipFile) -> None:
    for name in LICENCES:
        assert wheel.read(f"{INFORMATION}/licenses/{name}") == (ROOT / name).read_bytes()
    library = wheel.read(f"{INFORMATION}/licenses/COPYRIGHT-rust-library.html")
    assert b"The Rust Standard Library" in library


def test_no_path_of_this_machine_is_in_the_wheel(wheel: zipfile.ZipFile) -> None:
    folders = {str(Path.home()).encode(), str(ROOT).encode()}
    for name in wheel.namelist():
        content = wheel.read(name)
        content = gzip.decompress(content) if name.endswith(".gz") else content
        assert not [folder for folder in folders if folder + b"/" in content], name


def test_the_metadata_agree(wheel: zipfile.ZipFile) -> None:
    lines = wheel.read(f"{INFORMATION}/METADATA").decode().splitlines()
    assert f"Version: {kempe.__version__}" in lines
    assert "License-Expression: MIT OR Apache-2.0" in lines
    assert "Requires-Python: >=3.10" in lines
    assert "Classifier: Typing :: Typed" in lines


def test_the_source_distribution_has_what_a_build_needs(
    archive: tarfile.TarFile, archive_path: Path
) -> None:
    root = f"kempe-{kempe.__version__}"
    inside = {member.name.removeprefix(f"{root}/") for member in archive if member.isfile()}
    assert {"Cargo.lock", "Cargo.toml", "pyproject.toml", "README.md", "PKG-INFO"} <= inside
    assert set(LICENCES) <= inside
    assert {f"core/src/{name}" for name in tracked("core/src")} <= inside
    assert {f"drawing/src/{name}" for name in tracked("drawing/src")} <= inside
    assert {f"exchange/src/{name}" for name in tracked("exchange/src")} <= inside
    assert {f"synthesis/src/{name}" for name in tracked("synthesis/src")} <= inside
    assert {f"bindings/python/{name}" for name in tracked("bindings/python")} <= inside
    assert {f"python/{name}" for name in tracked("python")} <= inside
    folders = {name.partition("/")[0] for name in inside if "/" in name}
    assert folders == {"core", "drawing", "exchange", "synthesis", "bindings", "python"}
    assert not [name for name in inside if name.endswith((".so", ".pyd", ".dylib"))]
    # both have no repetitions, and limits of their own
    data = sum((ROOT / "python" / name).stat().st_size for name in (STUDIO, NINE))
    assert archive_path.stat().st_size - data < 2e6
