"""Packages to test: those in the folder $KEMPE_PACKAGES, which tools/check_packages.sh builds."""

import os
import tarfile
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def packages() -> Path:
    named = os.environ.get("KEMPE_PACKAGES")
    if named is None:
        pytest.skip("packages are tested by tools/check_packages.sh")
    return Path(named)


@pytest.fixture(scope="session")
def wheel_path(packages: Path) -> Path:
    (found,) = packages.glob("*x86_64.whl")
    return found


@pytest.fixture(scope="session")
def archive_path(packages: Path) -> Path:
    (found,) = packages.glob("*.tar.gz")
    return found


@pytest.fixture
def wheel(wheel_path: Path) -> Iterator[zipfile.ZipFile]:
    with zipfile.ZipFile(wheel_path) as opened:
        yield opened


@pytest.fixture
def archive(archive_path: Path) -> Iterator[tarfile.TarFile]:
    with tarfile.open(archive_path) as opened:
        yield opened
