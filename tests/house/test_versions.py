"""The version, the Rust version and the public names agree where they occur twice."""

import ast
import re

import kempe
from house.places import PACKAGE, ROOT
from kempe import _core


def cargo(key: str) -> str:
    found = re.search(rf'^{key} = "(.+)"$', (ROOT / "Cargo.toml").read_text(encoding="utf-8"), re.M)
    assert found
    return found[1]


def test_there_is_one_version() -> None:
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert kempe.__version__ == _core.version() == cargo("version")
    assert f"version: {kempe.__version__}\n" in citation


def test_set_up_and_cargo_require_the_same_rust() -> None:
    script = (ROOT / "tools" / "setup.sh").read_text(encoding="utf-8")
    assert f"RUST_MINOR={cargo('rust-version').split('.')[1]} " in script


def test_public_names_are_declared_for_type_checkers() -> None:
    tree = ast.parse((PACKAGE / "__init__.py").read_text(encoding="utf-8"))
    block = next(node for node in tree.body if isinstance(node, ast.If))
    seen = {
        alias.asname
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert seen == set(kempe._HOME)


def test_every_public_name_can_be_imported() -> None:
    assert all(getattr(kempe, name) is not None for name in kempe.__all__)
    assert set(kempe.__all__) <= set(dir(kempe))
