"""The site, built once."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from house.places import ROOT


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> subprocess.CompletedProcess[str]:
    """The process that builds the site; ``args[-1]`` is the folder of the site."""
    command = [ROOT / "tools" / "build_site.sh", tmp_path_factory.mktemp("site")]
    environment = os.environ | {"PYTHON": sys.executable}
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


@pytest.fixture(scope="session")
def site(built: subprocess.CompletedProcess[str]) -> Path:
    """The folder of the site."""
    assert built.returncode == 0, built.stdout + built.stderr
    return Path(built.args[-1])
