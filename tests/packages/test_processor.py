"""The second core of a wheel is `kempe._core` where the processor supports it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from house.places import PACKAGE
from kempe import _core, _processor

CODE = """
import kempe, sys
from kempe import _core
import kempe.case
assert kempe.case._core is kempe._core is sys.modules["kempe._core"] is _core
assert type(kempe.load("four_bar.toml").model.compile().core) is _core.Model
print(_core.__file__)
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A copy of the package with two cores."""
    core = Path(_core.__file__)
    copy = tmp_path / "kempe"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("_core.*[od]", "__pycache__"))
    folder = copy / Path(_processor.FOLDER).name
    folder.mkdir()
    for place in (copy, folder):
        (place / core.name).symlink_to(core)
    shutil.copy(copy / "templates" / "four_bar.toml", tmp_path)
    return copy


def core_of(package: Path, **variables: str) -> Path:
    done = subprocess.run(
        [sys.executable, "-c", CODE],
        cwd=package.parent,
        env={**os.environ, "PYTHONPATH": str(package.parent), **variables},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    return Path(done.stdout.strip()).parent


def test_the_core_suits_the_processor(package: Path) -> None:
    faster = package / Path(_processor.FOLDER).name
    assert core_of(package) == (faster if _core.supports_v3() else package)


def test_the_core_for_every_processor_can_be_requested(package: Path) -> None:
    assert core_of(package, **{_processor.VARIABLE: "1"}) == package


def test_a_build_from_source_has_one_core(package: Path) -> None:
    shutil.rmtree(package / Path(_processor.FOLDER).name)
    assert core_of(package) == package
