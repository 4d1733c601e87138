"""Reads how much machine code an extension contains, in total and by module."""

from __future__ import annotations

import re
import shutil
import struct
import subprocess
from collections import Counter
from pathlib import Path

#: Crates of this repository. The name of the extension's own crate is `_core`.
_MODULE = re.compile(r"\b(kempe(?:_drawing)?|_core)((?:::[a-z]\w*)*)(?=::)")
_OTHER = "std and other crates"


def extension(root: Path) -> Path:
    """The extension of a checkout."""
    found = sorted((root / "python" / "kempe").glob("_core.*.so"))
    if not found:
        raise FileNotFoundError("the extension is not built: run ./kempe --version first")
    return found[0]


def code_bytes(path: Path) -> int:
    """Size of the section `.text`, from the headers of a file in the format ELF for 64 bits."""
    data = path.read_bytes()
    if data[:6] != b"\x7fELF\x02\x01":
        raise ValueError(f"{path.name} is not an ELF file for 64 bits, little-endian")
    (table,) = struct.unpack_from("<Q", data, 0x28)
    size, number, names = struct.unpack_from("<HHH", data, 0x3A)
    headers = [struct.unpack_from("<IIQQQQ", data, table + k * size) for k in range(number)]
    for header in headers:
        begin = headers[names][4] + header[0]
        if data[begin : data.index(b"\0", begin)] == b".text":
            return header[5]
    raise ValueError(f"{path.name} has no section .text")


def module(name: str) -> str:
    """The first module that a demangled name mentions, with its crate if that is not the core."""
    found = _MODULE.search(re.sub(r"(?:::\{.*)?$", "", name, count=1))
    if not found:
        return _OTHER
    parts = found[2].split("::")[1:3]
    return "::".join(parts if found[1] == "kempe" and parts else [found[1], *parts[:1]])


def by_module(path: Path) -> Counter[str] | None:
    """Bytes of code of each module, or None without the program `nm`.

    Functions of equal code at one address count once.
    """
    if not shutil.which("nm"):
        return None
    command = ["nm", "--size-sort", "-C", "-S", "--defined-only", str(path)]
    listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    names = {}
    for line in listed.splitlines():
        address, size, kind, name = line.split(" ", 3)
        if kind in "tT":
            names[address] = (int(size, 16), module(name))
    counted: Counter[str] = Counter()
    for size, owner in names.values():
        counted[owner] += size
    return counted
