"""The library inside FMUs: that of the wheel, or one that cargo builds from the sources."""

from __future__ import annotations

import os
import platform
import subprocess
import sys
from pathlib import Path

from kempe import _core
from kempe.errors import FileError

PACKAGE = Path(__file__).parents[1]
ROOT = PACKAGE.parents[1]
#: The folder of the library in a wheel.
IN_WHEEL = PACKAGE / "_fmu"
_ENDINGS = {"linux": ".so", "darwin": ".dylib", "win32": ".dll"}
#: Names of systems and processors in FMI 3.0.
_SYSTEMS = {"linux": "linux", "darwin": "darwin", "win32": "windows"}
_PROCESSORS = {"amd64": "x86_64", "arm64": "aarch64"}
#: Names in FMI 2.0, where they differ.
_OF_2 = {
    "x86_64-linux": "linux64",
    "x86_64-windows": "win64",
    "x86_64-darwin": "darwin64",
}


def ending() -> str:
    """The ending of libraries on this system."""
    return _ENDINGS.get(sys.platform, ".so")


def folder(version: str) -> str:
    """The folder of the library in an FMU for this system."""
    machine = platform.machine().lower()
    name = f"{_PROCESSORS.get(machine, machine)}-{_SYSTEMS.get(sys.platform, sys.platform)}"
    return _OF_2.get(name, name) if version == "2.0" else name


def licences() -> bytes:
    """The licences of the library.

    Raises:
        FileError: the files are missing.
    """
    found = []
    for name in ("LICENSE-MIT", "THIRD_PARTY_NOTICES.txt"):
        path = IN_WHEEL / name if IN_WHEEL.is_dir() else ROOT / name
        try:
            found.append(path.read_bytes())
        except OSError as error:
            raise FileError(f"cannot read {path}: {error.strerror}", name=str(path)) from error
    return b"\n".join(found)


def library() -> bytes:
    """The library for this system.

    Raises:
        FileError: there is none, and it cannot be built.
    """
    name = ("" if sys.platform == "win32" else "lib") + "kempe_fmu" + ending()
    ready = IN_WHEEL / name
    path = ready if ready.is_file() else _built(name)
    try:
        return path.read_bytes()
    except OSError as error:
        raise FileError(f"cannot read {path}: {error.strerror}", name=str(path)) from error


def _built(name: str) -> Path:
    """Build the library in a checkout, unless it is up to date."""
    if not (ROOT / "bindings" / "fmu" / "Cargo.toml").is_file():
        raise FileError(
            "this installation of kempe has no library for FMUs",
            hint="install a wheel of kempe, or export the FMU in a checkout of its sources",
        )
    profile = os.environ.get("KEMPE_PROFILE", "checkout")
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    path = target / profile / name
    if not path.is_file():
        print(
            "kempe: building the library for FMUs, which takes some minutes the first time",
            file=sys.stderr,
            flush=True,
        )
    command = ["cargo", "build", "--package", "kempe-fmu", "--profile", profile, "--locked"]
    try:
        done = subprocess.run(
            command, cwd=ROOT, env=_environment(), capture_output=True, text=True, check=False
        )
    except OSError as error:
        raise FileError(
            f"cannot build the library for FMUs: cargo: {error.strerror}",
            hint="install Rust from https://rustup.rs, or use a wheel of kempe",
        ) from error
    if done.returncode:
        lines = "\n".join(done.stderr.strip().splitlines()[-20:])
        raise FileError(f"cannot build the library for FMUs:\n{lines}", name="bindings/fmu")
    return path


def _environment() -> dict[str, str]:
    """The variables of cargo: the instructions of the core, as in tools/setup.sh."""
    found = dict(os.environ)
    home = Path(found.get("CARGO_HOME", Path.home() / ".cargo"))
    found["PATH"] = os.pathsep.join([found.get("PATH", ""), str(home / "bin")])
    if _core.instructions() == "x86-64":
        found.setdefault("RUSTFLAGS", "-C target-cpu=x86-64")
    return found
