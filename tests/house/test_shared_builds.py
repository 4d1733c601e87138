"""The extension of Python and the library of FMUs link one build of the core."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def crates(package):
    """The crates that a package is built from, each with its features."""
    command = ["cargo", "tree", "--locked", "--offline", "--edges", "normal,build"]
    command += ["--prefix", "none", "--format", "{p}|{f}", "--package", package]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    lines = [line.removesuffix(" (*)").split("|") for line in done.stdout.splitlines() if line]
    return dict(lines)


@pytest.mark.skipif(shutil.which("cargo") is None, reason="needs cargo")
def test_shared_crates_have_the_same_features():
    python, fmu = crates("kempe-python"), crates("kempe-fmu")
    shared = python.keys() & fmu.keys()
    assert any(name.startswith("kempe v") for name in shared)
    differing = {name: (python[name], fmu[name]) for name in shared if python[name] != fmu[name]}
    assert not differing, "cargo builds the core twice: add these features to both packages"
