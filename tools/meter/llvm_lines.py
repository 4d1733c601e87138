"""Counts the LLVM instructions of the core before optimization, as `cargo llvm-lines` does.

The compiler has to optimize every one of these lines, once for each scalar for which a function is
compiled. Their number therefore predicts the time of a build.
"""

from __future__ import annotations

import os
import re
import subprocess
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from tools.meter import v0_names

#: Row of the functions that do not name a scalar with derivatives, lanes or symbols.
PLAIN = "f64, or no scalar"
_SCALAR = re.compile(r"\b(?:Dual|Jet|TaylorSeries|Lanes|Interval|Symbolic|Complex)\b")
_DEFINED = re.compile(r'@"?([^"( ]+)"?\(')
#: No optimization, and names from which the module can be read.
_FLAGS = (
    "--emit=llvm-ir",
    *("-C", "no-prepopulate-passes"),
    *("-C", "passes=name-anon-globals"),
    *("-C", "symbol-mangling-version=v0"),
)


@dataclass
class Count:
    """Lines and functions, in total, by module and by scalar."""

    lines: int = 0
    functions: int = 0
    by_module: Counter[str] = field(default_factory=Counter)
    by_scalar: Counter[str] = field(default_factory=Counter)


def functions(text: Iterable[str]) -> Iterator[tuple[str, int]]:
    """Name and number of instructions of each function that a module of LLVM defines.

    Instructions are indented by two spaces; longer ones continue with more.
    """
    name, lines = None, 0
    for line in text:
        if name is None:
            if line.startswith("define ") and (found := _DEFINED.search(line)):
                name, lines = found[1], 0
        elif line.startswith("}"):
            yield name, lines
            name = None
        elif line.startswith("  ") and line[2:3] not in (" ", ";"):
            lines += 1


def scalar(name: str) -> str:
    """The longest scalar in the text of a name, such as `Jet<Dual<3>>`."""
    short = re.sub(r"\b(?:\w+::)+(?=[A-Z])", "", name)
    found = (
        _with_arguments(short, match.start(), match.end()) for match in _SCALAR.finditer(short)
    )
    return max(found, key=len, default=PLAIN)


def _with_arguments(text: str, begin: int, end: int) -> str:
    depth = 0
    for k in range(end, len(text) if text[end : end + 1] == "<" else end):
        depth += (text[k] == "<") - (text[k] == ">")
        if depth == 0:
            return text[begin : k + 1]
    return text[begin:end]


def count(text: Iterable[str], crate: str = "kempe") -> Count:
    """The lines of a module of LLVM that was compiled from a crate."""
    counted = Count()
    for mangled, lines in functions(text):
        # the compiled functions of other crates keep the older names
        known = mangled.startswith("_R")
        name, module = v0_names.read(mangled, crate) if known else (mangled, v0_names.OTHER)
        counted.lines += lines
        counted.functions += 1
        counted.by_module[module] += lines
        counted.by_scalar[scalar(name)] += lines
    return counted


def of_core(root: Path) -> Count:
    """The lines of the core. It is compiled first, in a target folder of its own."""
    target = root / "target" / "meter"
    command = ["cargo", "rustc", "--release", "--locked", "-p", "kempe", "--lib", "--", *_FLAGS]
    environment = os.environ | {"CARGO_TARGET_DIR": str(target)}
    subprocess.run(command, cwd=root, env=environment, check=True)
    files = (target / "release" / "deps").glob("kempe-*.ll")
    newest = max(files, key=lambda path: path.stat().st_mtime)
    with newest.open(encoding="utf-8", errors="replace") as text:
        return count(text)
