"""THIRD_PARTY_NOTICES.txt contains the licence of every crate in the compiled cores."""

import importlib.util
import re
import shutil
from pathlib import Path
from types import ModuleType

import pytest
from house.places import ROOT

NOTICES = ROOT / "THIRD_PARTY_NOTICES.txt"
REMEDY = "run .venv/bin/python tools/third_party_notices.py"


@pytest.fixture(scope="module")
def script() -> ModuleType:
    if shutil.which("cargo") is None:
        pytest.skip("no cargo in PATH")
    path = ROOT / "tools" / "third_party_notices.py"
    spec = importlib.util.spec_from_file_location("third_party_notices", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def headings() -> dict[tuple[str, str], str]:
    """The licence of each crate, by name and version."""
    found = re.findall(r"^(\S+) (\S+) \((\S+)\)\n-+\n", NOTICES.read_text("utf-8"), re.M)
    return {(name, version): licence for name, version, licence in found}


def test_every_linked_crate_has_a_notice(script: ModuleType) -> None:
    assert set(headings()) == script.linked(), REMEDY


def test_the_notices_are_those_of_the_crates(script: ModuleType) -> None:
    assert NOTICES.read_text("utf-8") == script.notices(), REMEDY


def test_versions_are_those_of_the_lock_file() -> None:
    places = (ROOT / "Cargo.lock", ROOT / "bindings" / "web" / "Cargo.lock")
    text = "\n".join(path.read_text("utf-8") for path in places)
    locked = set(re.findall(r'^name = "(.+)"\nversion = "(.+)"\nsource', text, re.M))
    assert headings()
    assert set(headings()) <= locked, REMEDY


def test_licences_are_compatible(script: ModuleType) -> None:
    assert set(headings().values()) <= set(script.ACCEPTED)


@pytest.mark.parametrize("offered", ["GPL-3.0-only", "MIT AND GPL-3.0-only", ""])
def test_another_licence_is_refused(script: ModuleType, offered: str, tmp_path: Path) -> None:
    (tmp_path / "LICENSE").write_text(script.MARKS["MIT"])
    with pytest.raises(SystemExit, match="licence"):
        script.Crate("crate", "1.0.0", offered, tmp_path).notice()


def test_the_first_accepted_licence_with_a_text_is_taken(
    script: ModuleType, tmp_path: Path
) -> None:
    (tmp_path / "LICENSE-ZLIB").write_text(f"{script.MARKS['Zlib']}\n")
    crate = script.Crate("crate", "1.0.0", "MIT OR Zlib", tmp_path)
    assert crate.notice() == ("Zlib", [script.MARKS["Zlib"]])
