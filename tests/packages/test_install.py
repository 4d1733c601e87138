"""The wheel is installed in fresh environments and gives the results of the repository.

$KEMPE_PYTHONS contains the interpreters, separated by blanks; by default the one of the tests. Only
$KEMPE_REPOSITORY_BASELINE, a core of the repository for every x86-64, is compared with the source
distribution. An emulated Nehalem (2008) has no AVX.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import kempe
import numpy as np
import pytest
from house.places import PACKAGE, ROOT
from kempe import _core
from kempe.studio import page

pytestmark = pytest.mark.alone

EXAMPLE = Path(__file__).with_name("example.py")
PYTHONS = os.environ.get("KEMPE_PYTHONS", sys.executable).split()
#: OpenBLAS, a part of NumPy, does not identify the emulated processor by itself.
EMULATED = {"OPENBLAS_CORETYPE": "Nehalem"}


class Environment:
    """A virtual environment with a package."""

    def __init__(self, folder: Path, python: str, package: Path) -> None:
        self.python = folder / "bin" / "python"
        self._folder = folder
        subprocess.run([python, "-m", "venv", folder], check=True)
        constraints = ["-c", str(ROOT / "constraints.txt")]
        command = [self.python, "-m", "pip", "install", "--quiet", *constraints, package]
        subprocess.run(command, check=True, cwd=folder)

    def run(self, *words: str | Path, before: tuple[str, ...] = (), **more: str) -> str:
        """The output of Python, without the variables of the tests."""
        kept = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
        done = subprocess.run(
            [*before, self.python, *words],
            cwd=self._folder,
            env=kept | more,
            stdout=subprocess.PIPE,
            text=True,
            check=True,
        )
        return done.stdout

    def example(self, *before: str, **more: str) -> dict[str, Any]:
        output = self.run(EXAMPLE, ROOT / "README.md", before=before, **more)
        found: dict[str, Any] = json.loads(output)
        return found


@pytest.fixture(scope="module", params=PYTHONS)
def installed(
    request: pytest.FixtureRequest, wheel_path: Path, tmp_path_factory: pytest.TempPathFactory
) -> Environment:
    folder = tmp_path_factory.mktemp("fresh")
    return Environment(folder / "environment", request.param, wheel_path)


def of_the_repository(core: Path | None = None, folder: Path | None = None) -> dict[str, Any]:
    """The example with the sources of the repository, and with another core if one is given."""
    sources = PACKAGE.parent
    if core is not None and folder is not None:
        ignored = shutil.ignore_patterns("*.so", "__pycache__")
        shutil.copytree(PACKAGE, folder / "kempe", ignore=ignored)
        shutil.copy(core, folder / "kempe" / "_core.abi3.so")
        sources = folder
    command = [sys.executable, EXAMPLE, ROOT / "README.md"]
    variables = os.environ | {"PYTHONPATH": str(sources)}
    done = subprocess.run(
        command, env=variables, stdout=subprocess.PIPE, text=True, check=True, cwd=sources
    )
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def test_the_example_runs_with_the_instructions_of_the_processor(installed: Environment) -> None:
    found = installed.example()
    assert found["instructions"] == ("x86-64-v3" if _core.supports_v3() else "x86-64")
    assert Path(found["package"]).is_relative_to(installed.python.parents[1])
    assert found["version"] == kempe.__version__
    reference = json.loads((ROOT / "tests/reference/four_bar.json").read_text("utf-8"))
    (state,) = (state for state in reference["states"] if state["t"] == found["tight"]["t"])
    assert np.allclose(found["tight"]["q"], state["q"], rtol=0, atol=1e-7)


def test_the_baseline_can_be_requested(installed: Environment) -> None:
    found, faster = installed.example(KEMPE_BASELINE="1"), installed.example()
    assert found["instructions"] == "x86-64"
    assert np.allclose(found["last"], faster["last"], rtol=0, atol=1e-6)


def test_the_command_line_is_installed(installed: Environment) -> None:
    program = installed.python.with_name("kempe")
    assert installed.run(program, "--version") == f"kempe {kempe.__version__}\n"
    installed.run(program, "new", "four_bar", "mine.toml")
    assert "Largest reactions" in installed.run(program, "run", "mine.toml", NO_COLOR="1")


def test_the_studio_is_installed(installed: Environment, tmp_path: Path) -> None:
    program = installed.python.with_name("kempe")
    installed.run(program, "studio", "--export", str(tmp_path))
    written = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert written == page.read(page.CARRIED).html


def test_the_results_are_those_of_the_repository(installed: Environment) -> None:
    same_packages = sys.version_info[:2] == tuple(
        json.loads(installed.run("-c", "import sys; print(list(sys.version_info[:2]))"))
    )
    if not same_packages:
        pytest.skip("another Python has other versions of NumPy")
    variable = {} if _core.instructions() == "x86-64-v3" else {"KEMPE_BASELINE": "1"}
    assert installed.example(**variable)["hashes"] == of_the_repository()["hashes"]


def test_an_emulated_processor_without_avx_gives_the_same_bits(installed: Environment) -> None:
    emulator = shutil.which("qemu-x86_64")
    if emulator is None:
        pytest.skip("no qemu-x86_64 (Debian: apt install qemu-user)")
    emulated = installed.example(emulator, "-cpu", "Nehalem", **EMULATED)
    assert emulated["instructions"] == "x86-64"
    assert emulated["hashes"] == installed.example(KEMPE_BASELINE="1")["hashes"]


def test_the_source_distribution_gives_the_bits_of_the_repository(
    archive_path: Path, tmp_path: Path
) -> None:
    core = os.environ.get("KEMPE_REPOSITORY_BASELINE")
    if core is None:
        pytest.skip("this compiles the core again; tools/check_packages.sh requests it")
    built = Environment(tmp_path / "environment", sys.executable, archive_path).example()
    repository = of_the_repository(Path(core), tmp_path / "repository")
    assert built["instructions"] == repository["instructions"] == "x86-64"
    assert built["hashes"] == repository["hashes"]
