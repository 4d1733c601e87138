"""The imports among the modules of the Python package, those inside functions included."""

import ast
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import kempe
from house.places import PACKAGE

Graph = dict[str, set[str]]
#: The compiled modules, and the version, which the root defines at once.
EXTENSIONS = {"kempe._core", "kempe._core_exchange", "kempe._core_sweeps", "kempe.__version__"}


def modules() -> dict[str, str]:
    """The text of each module of the package by its name, such as ``kempe.model.values``."""
    return {_name(path): path.read_text(encoding="utf-8") for path in PACKAGE.rglob("*.py")}


def _name(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def graph(texts: Mapping[str, str], *, types: bool = False) -> Graph:
    """For each module, the modules that it imports anywhere, with the packages that load first.

    A public name that is imported from the root counts as an import of its module.

    Args:
        texts: the text of each module by its name.
        types: whether imports that only type checkers read count too.
    """
    return {
        module: {
            loaded
            for name in _imported(ast.parse(text), set(texts), types=types)
            for loaded in _loaded(name, module)
        }
        - {module}
        for module, text in texts.items()
    }


def _imported(tree: ast.AST, known: set[str], *, types: bool) -> Iterator[str]:
    for node in ast.iter_child_nodes(tree):
        if not isinstance(node, ast.stmt | ast.excepthandler | ast.match_case):
            continue
        if isinstance(node, ast.If) and not types and _is_for_types(node.test):
            for other in node.orelse:
                yield from _imported(other, known, types=types)
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in known)
        elif isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                name = f"{node.module}.{alias.name}"
                if node.module == "kempe" and (home := kempe._HOME.get(alias.name)):
                    yield f"kempe.{home}"
                elif name in known:
                    yield name
                elif node.module in known and name not in EXTENSIONS:
                    yield node.module
        yield from _imported(node, known, types=types)


def _is_for_types(test: ast.expr) -> bool:
    return isinstance(test, ast.Name) and test.id == "TYPE_CHECKING"


def _loaded(name: str, by: str) -> Iterator[str]:
    """A module, and the packages around it that are not also around the module that imports it."""
    yield name
    parts = name.split(".")
    for end in range(len(parts) - 1, 1, -1):
        package = ".".join(parts[:end])
        if not f"{by}.".startswith(f"{package}."):
            yield package


def loops(edges: Mapping[str, Iterable[str]]) -> list[set[str]]:
    """The sets of modules that reach each other, by their imports."""
    reached = {start: _reached(start, edges) for start in edges}
    found: list[set[str]] = []
    for start, ends in reached.items():
        loop = {end for end in ends if start in reached[end]}
        if loop and loop not in found:
            found.append(loop)
    return found


def _reached(start: str, edges: Mapping[str, Iterable[str]]) -> set[str]:
    ahead, seen = list(edges[start]), set[str]()
    while ahead:
        one = ahead.pop()
        if one not in seen:
            seen.add(one)
            ahead += edges[one]
    return seen


def folder(module: str) -> str:
    """The folder or file below the package that a module belongs to, such as ``model``."""
    return module.split(".")[1] if "." in module else ""
