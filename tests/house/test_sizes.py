"""No file has more than 400 lines and no function more than 60, except generated ones."""

import ast
from collections.abc import Callable
from pathlib import Path

import pytest
from house.places import ROOT, sources
from house.rust_source import Function, functions

FILE_LIMIT = 400
FUNCTION_LIMIT = 60
GENERATED = "@generated"  # in the first line of generated files

TEXTS = {
    path: path.read_text(encoding="utf-8")
    for path in sources(".rs", ".py", ".pyi", ".sh", ".js", ".mjs", ".ts", ".tsx", ".css", ".html")
}
FILES = [path for path, text in TEXTS.items() if GENERATED not in text.partition("\n")[0]]


def name_of(path: Path) -> str:
    return str(path.relative_to(ROOT))


def python_functions(text: str) -> list[Function]:
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    nodes = [node for node in ast.walk(ast.parse(text)) if isinstance(node, kinds)]
    return [Function(node.name, (node.end_lineno or 0) - node.lineno + 1) for node in nodes]


def too_long(found: list[Function]) -> list[Function]:
    return [function for function in found if function.lines > FUNCTION_LIMIT]


def test_files_are_small() -> None:
    lengths = {name_of(path): len(TEXTS[path].splitlines()) for path in FILES}
    assert not {name: length for name, length in lengths.items() if length > FILE_LIMIT}


@pytest.mark.parametrize(("suffix", "of"), [(".py", python_functions), (".rs", functions)])
def test_functions_are_small(suffix: str, of: Callable[[str], list[Function]]) -> None:
    files = [path for path in FILES if path.suffix == suffix]
    assert files
    assert not {name_of(path): found for path in files if (found := too_long(of(TEXTS[path])))}


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
