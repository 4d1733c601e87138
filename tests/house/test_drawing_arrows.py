"""Imports among four folders run one way, and so do those among the files of each."""

import ast
from graphlib import TopologicalSorter
from pathlib import Path

import pytest
from house.places import PACKAGE

#: What each folder may import of the others; a report shows figures.
ALLOWED = {
    "draw": set(),
    "plot": {"draw"},
    "lab_report": {"plot", "draw"},
}


def imported(path: Path) -> set[str]:
    """Modules of kempe that a file imports, anywhere in it, such as ``draw.scene``."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("kempe"):
            module = (node.module or "").removeprefix("kempe").removeprefix(".")
            found |= {f"{module}.{alias.name}".strip(".") for alias in node.names} | {module}
    return found


@pytest.mark.parametrize("folder", ALLOWED)
def test_a_folder_imports_only_those_below_it(folder: str) -> None:
    for path in (PACKAGE / folder).glob("*.py"):
        parts = {module.partition(".")[0] for module in imported(path)}
        assert parts & (set(ALLOWED) - {folder}) <= ALLOWED[folder], path.name


@pytest.mark.parametrize("folder", ALLOWED)
def test_the_files_of_a_folder_import_each_other_in_one_direction(folder: str) -> None:
    files = {path.stem: path for path in (PACKAGE / folder).glob("*.py") if path.stem != "__init__"}
    graph = {
        name: {module.split(".")[1] for module in imported(path) if module.startswith(f"{folder}.")}
        & set(files)
        for name, path in files.items()
    }
    assert any(graph.values())
    assert len(list(TopologicalSorter(graph).static_order())) >= len(graph)
