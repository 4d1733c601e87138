"""Find paths of the machine that built them in packages, libraries and pages.

    .venv/bin/python tools/binary_paths.py dist/*

Archives are opened: wheels, source distributions, compressed pages, and the core in a page. A path
is wrong if it begins with a folder of this machine, or if it is the absolute path of a source file
outside the folders that the compiler writes instead. Exit code: 1 if a path is found.
"""

import base64
import gzip
import io
import lzma
import os
import re
import sys
import tarfile
import zipfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
#: What tools/build_packages.py and the toolchain of Rust write in place of folders.
WRITTEN_INSTEAD = (b"/kempe/", b"/cargo/", b"/rustc/", b"/rust/deps/")
_SOURCE = re.compile(rb"(?<![\w./<-])(?:/[\w.+@-]+){2,}\.(?:rs|c|cc|cpp|h|zig)\b")
_WINDOWS = re.compile(rb"\b[A-Z]:\\\\?(?:Users|a|rust)\\\\?[\w.\\-]+")
#: The core and the program in the page of the studio: base64 of xz.
_CORE = re.compile(rb'<script type="application/octet-stream" id="core">([\w+/=\s]+)</script>')


def folders() -> list[bytes]:
    """Folders of this machine that must not be in a package."""
    home = Path.home()
    named = [home, ROOT, os.environ.get("CARGO_HOME"), os.environ.get("RUSTUP_HOME")]
    paths = {Path(path).resolve() for path in named if path} | {home}
    return [f"{path}/".encode() for path in paths if path != Path("/")]


def contents(name: str, data: bytes) -> Iterator[tuple[str, bytes]]:
    """The files in a file, also in archives within it."""
    if data[:2] == b"\x1f\x8b":
        inner = gzip.decompress(data)
        if inner[257:262] == b"ustar":
            with tarfile.open(fileobj=io.BytesIO(inner)) as archive:
                for member in archive:
                    file = archive.extractfile(member)
                    if file is not None:
                        yield from contents(f"{name}: {member.name}", file.read())
        else:
            yield from contents(name, inner)
    elif data[:4] == b"PK\x03\x04":
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for inside in archive.namelist():
                yield from contents(f"{name}: {inside}", archive.read(inside))
    else:
        yield name, data
        core = _CORE.search(data)
        if core is not None:
            yield f"{name}: core", lzma.decompress(base64.b64decode(core[1]))


def is_binary(data: bytes) -> bool:
    """Whether a compiler wrote a file, whose sources are then not a part of it."""
    return b"\0" in data


def found_in(data: bytes) -> list[str]:
    """The wrong paths in one file."""
    wrong = [folder for folder in folders() if folder in data]
    if is_binary(data):
        sources = {match[0] for match in _SOURCE.finditer(data)}
        wrong += [path for path in sources if not path.startswith(WRITTEN_INSTEAD)]
        wrong += {match[0] for match in _WINDOWS.finditer(data)}
    return sorted(path.decode("utf-8", "replace") for path in set(wrong))


def main(paths: list[str]) -> int:
    """Print the wrong paths in files; 1 if there are some."""
    count = 0
    wrong = 0
    for path in paths:
        for name, data in contents(path, Path(path).read_bytes()):
            count += 1
            for text in found_in(data):
                wrong += 1
                print(f"{name}: {text}")
    print(f"{count} files, {wrong} paths of the machine that built them")
    return 1 if wrong or not count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
