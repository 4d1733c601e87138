"""The parts of the Python package depend on each other in one direction only."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest
from house.places import PACKAGE

#: Parts that use the interface of Solution only; the command line uses the public interface only.
NO_CORE = {
    "plot",
    "draw",
    "report",
    "lab_report",
    "cli",
    "errors",
    "_version",
    "__init__",
    "__main__",
}

#: Parts that only they themselves and the given module may import.
PRIVATE = {"cli": {"cli", "__main__", "_compact"}}


def parts_named(text: str, package: tuple[str, ...]) -> set[str]:
    """Names under kempe that a file imports, anywhere in it.

    Args:
        text: the Python source.
        package: the package that the file is in, such as ("kempe", "plot").
    """
    named = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            named |= {tuple(alias.name.split(".")) for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else ()
            base = (*above, *(node.module.split(".") if node.module else ()))
            named |= {(*base, alias.name) for alias in node.names}
    return {path[1] for path in named if path[0] == "kempe" and len(path) > 1}


def wrong_arrows(part: str, named: set[str]) -> set[str]:
    hidden = {name for name, friends in PRIVATE.items() if part not in friends}
    return named & (hidden | ({"_core"} if part in NO_CORE else set()))


def _wrong_arrows_of(path: Path) -> set[str]:
    package = path.relative_to(PACKAGE.parent).parts[:-1]
    part = path.relative_to(PACKAGE).with_suffix("").parts[0]
    return wrong_arrows(part, parts_named(path.read_text(encoding="utf-8"), package))


def test_the_files_of_the_package_import_only_permitted_modules() -> None:
    files = sorted(PACKAGE.rglob("*.py"))
    assert not {str(path): wrong for path in files if (wrong := _wrong_arrows_of(path))}


@pytest.mark.parametrize(
    ("part", "text", "wrong"),
    [
        ("plot", "from kempe import _core", {"_core"}),
        ("plot", "from .. import _core", {"_core"}),
        ("draw", "import kempe._core as core", {"_core"}),
        ("report", "def f():\n    from kempe._core import version", {"_core"}),
        ("plot", "from kempe.cli.app import run", {"cli"}),
        ("solution", "from ..cli import main", {"cli"}),
        ("solution", "from kempe import _core", set()),
        ("cli", "from kempe.cli.app import run", set()),
        ("plot", "from . import style\nfrom ..errors import KempeError\nimport numpy", set()),
    ],
)
def test_a_wrong_dependency_is_found(part: str, text: str, wrong: set[str]) -> None:
    assert wrong_arrows(part, parts_named(text, ("kempe", part))) == wrong


@pytest.mark.parametrize(
    ("statement", "kept_out"),
    [
        ("import kempe", "matplotlib typer rich pandas numpy kempe._core kempe.errors"),
        ("import kempe; kempe.errors", "matplotlib typer rich pandas numpy kempe._core"),
        ("import kempe.cli", "matplotlib typer rich pandas numpy kempe._core kempe.errors"),
        ("import kempe.cli.app", "matplotlib pandas numpy kempe._core"),
    ],
)
def test_imports_are_lazy(statement: str, kept_out: str) -> None:
    script = f"import sys; {statement}; print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert not set(kept_out.split()) & set(done.stdout.split())
