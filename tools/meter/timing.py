"""Measures the times of builds in a copy of the working tree, and of `import kempe`."""

from __future__ import annotations

import json
import os
import re
import resource
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import median

#: Files of the core in which one line is changed: an analysis, an equation and an element.
CHANGED = (
    "core/src/analyses/limits.rs",
    "core/src/equations/energy.rs",
    "core/src/elements/joints/revolute.rs",
)
LINE = "let _changed = std::hint::black_box(17);"
_BODY = re.compile(r"^ *(?:pub(?:\(\w+\))? )?(?:const )?fn [^;{]*\{\n", re.MULTILINE)
_SOURCES = (
    "Cargo.toml",
    "Cargo.lock",
    "README.md",
    "core",
    "drawing",
    "exchange",
    "bindings/python",
)
_PROCESSES = 9
# ru_maxrss contains the memory of the program that started the process, unlike VmHWM
_IMPORT = """
import json, pathlib, re, resource, time
begin = time.perf_counter()
{}
seconds, status = time.perf_counter() - begin, pathlib.Path("/proc/self/status")
if status.exists():
    size = int(re.search(r"VmHWM:\\s*(\\d+)", status.read_text())[1]) << 10
else:
    size = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print(json.dumps([seconds, size]))
"""


@dataclass(frozen=True)
class Seconds:
    """Time of a build by the clock, and of all processors together."""

    wall: float
    cpu: float


def python(root: Path) -> str:
    """The interpreter of the checkout."""
    own = root / ".venv" / "bin" / "python"
    return str(own) if own.exists() else sys.executable


def changed(text: str) -> str:
    """The text with one more line in the body of the first function."""
    found = _BODY.search(text)
    if not found:
        raise ValueError("no function with a body")
    return f"{text[: found.end()]}    {LINE}\n{text[found.end() :]}"


@contextmanager
def _copy(root: Path) -> Iterator[Path]:
    """A copy of the sources of the extension; the configuration of cargo is in a folder above."""
    folder = root / "target" / "meter-tree"
    shutil.rmtree(folder, ignore_errors=True)
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", *_SOURCES]
    names = subprocess.run(listed, cwd=root, capture_output=True, text=True, check=True).stdout
    try:
        for name in filter(None, names.split("\0")):
            if (root / name).is_file():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(root / name, folder / name)
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _build(root: Path, profile: str, tree: Path, target: Path) -> Seconds:
    """Build the extension in a tree, as ./kempe does."""
    command = ["cargo", "build", "--profile", profile, "--locked", "--quiet", "-p", "kempe-python"]
    variables = {"CARGO_TARGET_DIR": str(target), "PYO3_PYTHON": python(root)}
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, cwd=tree, env=os.environ | variables, check=True)
    wall, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    return Seconds(wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def builds(root: Path, profile: str) -> dict[str, Seconds]:
    """Times of a build in an empty target folder, and of one after each change of a line.

    The changes accumulate in a copy of the working tree: each build differs from the one before by
    one line.
    """
    target = root / "target" / "meter-cold"
    shutil.rmtree(target, ignore_errors=True)
    try:
        with _copy(root) as tree:
            times = {"cold": _build(root, profile, tree, target)}
            for name in CHANGED:
                path = tree / name
                path.write_text(changed(path.read_text(encoding="utf-8")), encoding="utf-8")
                times[name] = _build(root, profile, tree, target)
            return times
    finally:
        shutil.rmtree(target, ignore_errors=True)


def imports(root: Path, statement: str) -> tuple[float, float]:
    """Seconds of a statement in a new process, and its memory in MiB: medians of some processes."""
    command = [python(root), "-c", _IMPORT.format(statement)]
    environment = os.environ | {"PYTHONPATH": str(root / "python")}
    found = [
        json.loads(subprocess.run(command, env=environment, capture_output=True, check=True).stdout)
        for _ in range(_PROCESSES)
    ]
    return median(seconds for seconds, _ in found), median(size for _, size in found) / (1 << 20)
