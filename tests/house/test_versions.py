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


def test_lock_file_and_crates_have_the_version() -> None:
    text = (ROOT / "Cargo.lock").read_text(encoding="utf-8")
    locked = dict(re.findall(r'^name = "(kempe.*)"\nversion = "(.+)"$', text, re.M))
    assert locked == dict.fromkeys(
        [f"kempe{part}" for part in ("", "-drawing", "-exchange", "-fmu", "-python", "-synthesis")],
        kempe.__version__,
    )
    for crate in ("core", "drawing", "exchange", "synthesis", "bindings/fmu", "bindings/python"):
        manifest = (ROOT / crate / "Cargo.toml").read_text(encoding="utf-8")
        assert "\nversion.workspace = true\n" in manifest, crate
    apart = (ROOT / "bindings" / "web" / "Cargo.toml").read_text(encoding="utf-8")
    assert f'\nversion = "{kempe.__version__}"\n' in apart


def test_no_later_version_is_in_the_changelog() -> None:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    first, *released = re.findall(r"^## \[(.+?)\]", text, re.M)
    assert first == "Unreleased"
    assert not released or numbers(released[0]) <= numbers(kempe.__version__)


def numbers(version: str) -> list[int]:
    return [int(part) for part in version.split(".")]


def test_the_page_of_the_installation_names_packages_of_the_version() -> None:
    page = (ROOT / "docs" / "install.md").read_text(encoding="utf-8")
    named = re.findall(r"dist/kempe-(\d+\.\d+\.\d+)", page)
    assert named
    assert set(named) == {kempe.__version__}


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
