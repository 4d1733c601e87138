"""Locations of the sources."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
CORE = ROOT / "core" / "src"
DRAWING = ROOT / "drawing" / "src"
PACKAGE = ROOT / "python" / "kempe"

#: Folders with sources, for tests that read all of them.
CODE = [
    ROOT / name
    for name in (
        "core",
        "drawing",
        "exchange",
        "synthesis",
        "bindings",
        "python",
        "tests",
        "tools",
        "benchmarks",
        "examples",
        "studio/build",
        "studio/src",
        "studio/tests",
    )
]


def sources(*suffixes: str) -> list[Path]:
    """All source files of the repository with one of the suffixes, without build products."""
    found = [path for folder in CODE for suffix in suffixes for path in folder.rglob(f"*{suffix}")]
    return sorted(
        path for path in found if not {"target", "built", "__pycache__"} & set(path.parts)
    )
