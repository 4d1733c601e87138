"""A checksum of the sources of the page, which the page contains.

A page with another checksum was built from other sources. ``tools/build_studio.sh`` runs this file
as a script, which prints the checksum.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path

#: The folder of the checkout, unless kempe is installed.
ROOT = Path(__file__).resolve().parents[3]
#: All files that the page depends on; a folder stands for all files in it.
INPUTS = (
    "Cargo.toml",
    "THIRD_PARTY_NOTICES.txt",
    "bindings/web/Cargo.lock",
    "bindings/web/Cargo.toml",
    "bindings/web/src",
    "core/Cargo.toml",
    "core/src",
    "drawing/Cargo.toml",
    "drawing/src",
    "exchange/Cargo.toml",
    "exchange/src",
    "synthesis/Cargo.toml",
    "synthesis/src",
    "examples",
    "studio/build",
    "studio/index.html",
    "studio/package-lock.json",
    "studio/package.json",
    "studio/src",
    "studio/tsconfig.json",
    "tools/build_studio.sh",
    "tools/check_wasm.sh",
)
#: Other files, such as those of editors and ``__pycache__``, do not enter the page.
SUFFIXES = {".css", ".html", ".json", ".lock", ".mjs", ".rs", ".sh", ".toml", ".ts", ".tsx", ".txt"}


def checksum(root: Path = ROOT) -> str | None:
    """Twelve hexadecimal digits of the SHA-256 of all names and contents.

    Returns:
        None without the sources, as in an installed kempe.
    """
    if not (root / "studio" / "build").is_dir():
        return None
    total = hashlib.sha256()
    for name, path in sorted(_files(root)):
        content = path.read_bytes()
        total.update(f"{name}\n{len(content)}\n".encode())
        total.update(content)
    return total.hexdigest()[:12]


def _files(root: Path) -> Iterator[tuple[str, Path]]:
    for entry in INPUTS:
        place = root / entry
        for path in place.rglob("*") if place.is_dir() else [place]:
            if path.suffix in SUFFIXES and path.is_file():
                yield path.relative_to(root).as_posix(), path


if __name__ == "__main__":
    print(checksum())
