"""The FMUs of the tests, each exported once."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import kempe as kp
import pytest
from fmu.machines import machine


@pytest.fixture(scope="session")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, str], Path]:
    """The FMU of a machine for a version of the standard."""
    folder = tmp_path_factory.mktemp("fmus")

    def made(name: str, version: str) -> Path:
        path = folder / f"{name}_{version[0]}.fmu"
        if not path.exists():
            own = machine(name)
            kp.export_fmu(own.case, path, own.inputs, own.outputs, version=version)
        return path

    return made
