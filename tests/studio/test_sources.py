"""The checksum of the sources of the page, and the build of the page from them."""

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from house.places import ROOT
from kempe.cli import app, exit_codes
from kempe.studio import build, sources
from quiet import within

SCRIPT = "tools/build_studio.sh"
#: The scripts that read files for the page.
SCRIPTS = ("build.mjs", "bundle.mjs", "licences.mjs", "words.mjs")
CRATE = ("Cargo.toml", "src")
#: Parts of the folder studio that are not in the page.
NO_INPUTS = {"README.md", "biome.json", "dist", "node_modules", "player.html", "tests"}


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """One small file for each input of the page."""
    for name in sources.INPUTS:
        one = tmp_path / name
        path = one if one.suffix else one / "inner" / "one.ts"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name)
    return tmp_path


def test_the_checksum_is_that_of_this_checkout() -> None:
    assert [name for name in sources.INPUTS if not (ROOT / name).exists()] == []
    printed = subprocess.run(
        [sys.executable, ROOT / "python/kempe/studio/sources.py"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert printed.stdout == f"{sources.checksum()}\n"


@pytest.mark.parametrize("name", sources.INPUTS)
def test_the_checksum_depends_on_every_input(checkout: Path, name: str) -> None:
    before = sources.checksum(checkout)
    path = checkout / name
    path = path if path.is_file() else path / "inner" / "one.ts"
    path.write_text(path.read_text() + "\n")
    changed = sources.checksum(checkout)
    path.rename(path.with_stem("other"))
    assert len({before, changed, sources.checksum(checkout)}) == 3


def test_other_files_do_not_change_the_checksum(checkout: Path) -> None:
    before = sources.checksum(checkout)
    for name in ("studio/src/.one.ts.swp", "core/src/note.md", "studio/other.ts", "new.toml"):
        (checkout / name).write_text("other")
    assert sources.checksum(checkout) == before


def test_the_border_between_two_files_is_part_of_the_checksum(checkout: Path) -> None:
    first, second = checkout / "studio/src/a.ts", checkout / "studio/src/b.ts"
    name = second.relative_to(checkout).as_posix()
    found = set()
    for texts in ((f"1{name}2", "3"), ("1", f"2{name}3")):
        first.write_text(texts[0])
        second.write_text(texts[1])
        found.add(sources.checksum(checkout))
    assert len(found) == 2


def test_all_that_the_build_reads_is_an_input() -> None:
    scripts = [(ROOT / "studio" / "build" / name).read_text("utf-8") for name in SCRIPTS]
    read = {name for text in scripts for name in re.findall(r'join\(ROOT, "([^"]+)"', text)}
    manifest = (ROOT / "bindings" / "web" / "Cargo.toml").read_text("utf-8")
    crates = re.findall(r'path = "../../(\w+)"', manifest)
    assert {"examples", "target"} < read
    assert read - {"target"} <= set(sources.INPUTS)  # the compiled core
    assert crates == ["core", "drawing", "exchange", "synthesis"]
    assert {f"{one}/{part}" for one in crates for part in CRATE} <= set(sources.INPUTS)
    inside = {name for name in sources.INPUTS if name.startswith("studio/")}
    parts = {f"studio/{path.name}" for path in (ROOT / "studio").glob("[!.]*")}
    assert parts - {f"studio/{name}" for name in NO_INPUTS} == inside


@pytest.mark.alone
def test_the_checksum_is_fast() -> None:
    def seconds() -> float:
        begin = time.perf_counter()
        assert sources.checksum()
        return time.perf_counter() - begin

    assert within(0.3, seconds)


def test_an_installed_kempe_has_no_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert sources.checksum(tmp_path) is None
    monkeypatch.setattr(sources, "checksum", lambda: None)
    assert app.run(["studio", "--build"]) == exit_codes.FILE
    told = capsys.readouterr().err
    assert "an installed kempe has no sources of the page to build" in told
    assert "in a checkout" in told


@pytest.mark.parametrize(
    ("code", "told"), [(1, "the lines above report"), (5, "a tool is missing; the line above")]
)
def test_a_failed_build_is_an_error(
    checkout: Path,
    code: int,
    told: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (checkout / SCRIPT).write_text(f"exit {code}\n")
    monkeypatch.setattr(sources, "ROOT", checkout)
    assert app.run(["studio", "--build"]) == exit_codes.FILE
    assert told in capsys.readouterr().err


def test_a_build_runs_the_script_with_this_python(
    checkout: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (checkout / SCRIPT).write_text('printf %s "$PYTHON" >"$(dirname -- "$0")/python"\n')
    monkeypatch.setattr(sources, "ROOT", checkout)
    build.build()
    assert (checkout / "tools" / "python").read_text() == sys.executable


@pytest.mark.skipif(os.name != "posix", reason="the script needs a POSIX shell")
@pytest.mark.parametrize(
    ("programs", "told"),
    [
        ({}, "no npm found: install Node 20 or later"),
        ({"npm": ""}, "no node found: install Node 20 or later"),
        ({"npm": "", "node": "echo v18.19.0"}, "Node 20 or later is needed, found v18.19.0"),
        ({"npm": "", "node": "echo v22.1.0"}, "no python3 found: install Python 3.10 or later"),
        (
            {"npm": "", "node": "echo v22.1.0", "python3": "echo 1"},
            "and no apt to get one: run 'rustup component add rust-src'",
        ),
    ],
)
def test_a_missing_tool_is_reported_in_one_line(
    tmp_path: Path, programs: dict[str, str], told: str
) -> None:
    root, tools = tmp_path / "root", tmp_path / "bin"
    (root / "tools").mkdir(parents=True)
    tools.mkdir()
    for name in (SCRIPT, "tools/check_wasm.sh"):
        shutil.copy(ROOT / name, root / name)
    for name in ("sh", "dirname"):
        (tools / name).symlink_to(shutil.which(name) or pytest.fail(f"no {name} here"))
    for name, body in programs.items():
        (tools / name).write_text(f"#!/bin/sh\n{body}\n")
        (tools / name).chmod(0o755)
    done = subprocess.run(
        [root / SCRIPT], env={"PATH": str(tools)}, capture_output=True, text=True, check=False
    )
    assert done.returncode == build.MISSING
    assert told in done.stderr
    assert done.stderr.count("\n") == 1
