"""No file has more than 400 lines and no function more than 60, except generated ones."""

import ast
from pathlib import Path

import pytest
from house.places import ROOT, sources
from house.rust_source import Function, functions

FILE_LIMIT = 400
FUNCTION_LIMIT = 60
GENERATED = "@generated"  # in the first line of generated files

FILES = [
    path
    for path in sources(".rs", ".py", ".pyi", ".sh", ".js", ".ts", ".css", ".html")
    if GENERATED not in path.read_text(encoding="utf-8").partition("\n")[0]
]


def name_of(path: Path) -> str:
    return str(path.relative_to(ROOT))


def python_functions(text: str) -> list[Function]:
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    nodes = [node for node in ast.walk(ast.parse(text)) if isinstance(node, kinds)]
    return [Function(node.name, (node.end_lineno or 0) - node.lineno + 1) for node in nodes]


def too_long(found: list[Function]) -> list[Function]:
    return [function for function in found if function.lines > FUNCTION_LIMIT]


@pytest.mark.parametrize("path", FILES, ids=name_of)
def test_a_file_is_small(path: Path) -> None:
    assert len(path.read_text(encoding="utf-8").splitlines()) <= FILE_LIMIT


@pytest.mark.parametrize("path", [path for path in FILES if path.suffix == ".py"], ids=name_of)
def test_python_functions_are_small(path: Path) -> None:
    assert not too_long(python_functions(path.read_text(encoding="utf-8")))


@pytest.mark.parametrize("path", [path for path in FILES if path.suffix == ".rs"], ids=name_of)
def test_rust_functions_are_small(path: Path) -> None:
    assert not too_long(functions(path.read_text(encoding="utf-8")))


def test_a_long_python_function_is_found() -> None:
    text = "def short():\n    pass\n\nclass C:\n    def long(self):\n" + "        x = 1\n" * 60
    assert too_long(python_functions(text)) == [Function("long", 61)]


def test_a_long_rust_function_is_found() -> None:
    body = "    let brace = '{'; // }\n" * 58
    text = f"fn short<'a>(x: [f64; 3]) -> &'a str {{ \"}}\" }}\nfn long() {{\n{body}    x();\n}}\n"
    assert functions(text) == [Function("short", 1), Function("long", 61)]
    assert too_long(functions(text)) == [Function("long", 61)]


def test_a_declaration_without_a_body_is_ignored() -> None:
    text = (
        "trait T {\n    fn norm(x: [f64; 3]) -> f64;\n    fn zero() -> f64 {\n        0.0\n    }\n}"
    )
    assert functions(text) == [Function("zero", 3)]
