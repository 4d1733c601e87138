"""The tools of a release: parts of kempe, paths in binaries, sizes, and steps that are left."""

import base64
import datetime
import gzip
import importlib.util
import io
import json
import lzma
import re
import subprocess
import tarfile
import zipfile
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
import yaml
from house.places import ROOT
from house.test_lock import lock, pins
from sizes import only_full


def tool(name: str) -> ModuleType:
    path = ROOT / "tools" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


SBOM, PATHS, STATE = tool("sbom"), tool("binary_paths"), tool("release_state")
SIZES, TWICE = tool("wheel_sizes"), tool("build_twice")
TODAY = datetime.date(2026, 12, 1)


@pytest.fixture(scope="module")
def parts() -> dict[str, dict[str, Any]]:
    return {one["purl"]: one for one in SBOM.all_parts()}


def test_the_list_has_every_package_of_the_lock_files(parts: dict[str, Any]) -> None:
    python = {f"pkg:pypi/{name}@{number}" for name, number in pins(lock("run"))}
    locks = [ROOT / "Cargo.lock", ROOT / "bindings" / "web" / "Cargo.lock"]
    text = "\n".join(path.read_text("utf-8") for path in locks)
    crates = re.findall(r'^name = "(.+)"\nversion = "(.+)"\nsource', text, re.M)
    # a plus sign is a blank in other URLs, and is therefore encoded
    cargo = {f"pkg:cargo/{n}@{v.replace('+', '%2B')}" for n, v in crates}
    npm = json.loads((ROOT / "studio" / "package-lock.json").read_text("utf-8"))["packages"]
    assert python | cargo <= set(parts)
    assert len(parts) - len(python | cargo) == len({(k.split("node_modules/")[-1], v["version"])
                                                    for k, v in npm.items() if k})  # fmt: skip


def test_a_part_has_its_checksum_and_scope(parts: dict[str, Any]) -> None:
    preact = next(one for url, one in parts.items() if url.startswith("pkg:npm/preact@"))
    assert preact["scope"] == "required" and preact["licenses"] == [{"expression": "MIT"}]
    assert re.fullmatch(r"[0-9a-f]{128}", preact["hashes"][0]["content"])
    scopes = {one["name"]: one["scope"] for one in parts.values()}
    assert (scopes["typescript"], scopes["maturin"], scopes["numpy"]) == (
        "excluded",
        "excluded",
        "required",
    )
    scoped = next(one for one in parts.values() if one["name"] == "@codemirror/state")
    assert scoped["purl"].startswith("pkg:npm/%40codemirror/state@")


def test_the_list_is_the_same_each_time() -> None:
    one, other = SBOM.document(), SBOM.document()
    assert one == other
    assert re.fullmatch(r"urn:uuid:[0-9a-f-]{36}", one["serialNumber"])
    refs = {part["bom-ref"] for part in one["components"]}
    assert set(one["dependencies"][0]["dependsOn"]) <= refs
    assert len(refs) == len(one["components"])


@only_full
def test_a_list_that_is_wrong_is_refused() -> None:
    pytest.importorskip("cyclonedx", reason="tools/lock/release.txt is not installed")
    document = SBOM.document()
    assert SBOM.check(json.dumps(document)) is None
    document["components"][0]["scope"] = "needed"
    assert "is not one of" in SBOM.check(json.dumps(document))


def wheel(path: Path, **files: bytes) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as made:
        for name, data in files.items():
            made.writestr(name.replace("__", "/"), data)
    return path


def paths_in(data: bytes) -> list[str]:
    return [text for _, one in PATHS.contents("x", data) for text in PATHS.found_in(one)]


BINARY = b"\x7fELF\0" + b"\0".join([b"/kempe/core/src/lib.rs", b"/rustc/0a/library/core/x.rs"])


@pytest.mark.parametrize(
    "wrong", [b"/builds/me/kempe/core/src/lib.rs", b"/opt/src/thing.c", b"C:\\Users\\me\\x.rs"]
)
def test_a_path_of_the_machine_is_found(wrong: bytes, tmp_path: Path) -> None:
    assert paths_in(BINARY) == []
    assert len(paths_in(BINARY + b"\0" + wrong)) == 1
    inside = wheel(tmp_path / "x.whl", kempe___core=BINARY + b"\0" + wrong).read_bytes()
    assert len(paths_in(inside)) == 1
    made = io.BytesIO()
    with tarfile.open(fileobj=made, mode="w:gz") as archive:
        info = tarfile.TarInfo("kempe/lib.so")
        info.size = len(BINARY) + 1 + len(wrong)
        archive.addfile(info, io.BytesIO(BINARY + b"\0" + wrong))
    assert len(paths_in(made.getvalue())) == 1


def test_the_core_in_a_page_and_the_home_folder_are_searched() -> None:
    core = base64.b64encode(lzma.compress(BINARY + b"\0/opt/src/thing.c"))
    page = b'<script type="application/octet-stream" id="core">' + core + b"</script>"
    assert paths_in(gzip.compress(page)) == ["/opt/src/thing.c"]
    assert paths_in(f"see {ROOT}/docs".encode()) != []
    assert paths_in(b"a text may name /opt/src/thing.c") == []


def test_files_without_a_path_are_counted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert PATHS.main([str(wheel(tmp_path / "a.whl", kempe__x=BINARY))]) == 0
    assert capsys.readouterr().out == "1 files, 0 paths of the machine that built them\n"
    assert PATHS.main([]) == 1


def test_the_sizes_of_a_wheel_are_those_of_its_parts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {"kempe___core.abi3.so": bytes(9000), "kempe__plot__x.py": b"x", "kempe__a.py": b"y"}
    path = wheel(tmp_path / "a.whl", **files)
    assert set(SIZES.sizes(path)) == {"core, every processor", "kempe/plot", "kempe/*.py"}
    assert SIZES.main([str(path)]) == 0
    monkeypatch.setattr(SIZES, "LARGEST", 100)
    assert SIZES.main([str(path)]) == 1
    assert "larger than" in capsys.readouterr().out


def test_members_that_differ_are_named(tmp_path: Path) -> None:
    one = wheel(tmp_path / "a.whl", kempe__a=b"1", kempe__b=b"2", kempe__c=b"3")
    other = wheel(tmp_path / "b.whl", kempe__a=b"1", kempe__b=b"x", kempe__d=b"3")
    assert TWICE.differences(one, one) == []
    assert TWICE.differences(one, other) == ["kempe/b", "kempe/c", "kempe/d"]


@pytest.mark.parametrize(
    ("text", "left"),
    [
        ("## [Unreleased]\n\n## [0.2.0] - 2026-12-01\n\n- a\n", ""),
        ("## [Unreleased]\n\n- a\n", "write the heading '## [0.2.0] - 2026-12-01'"),
        ("## [Unreleased]\n\n- a\n\n## [0.2.0] - 2026-12-01\n", "changes above 0.2.0"),
        ("## [Unreleased]\n\n## [0.2.0] - 2026-12-02\n", "in the future"),
    ],
)
def test_the_changelog_of_a_release(text: str, left: str) -> None:
    found = list(STATE.of_the_changelog(text, "0.2.0", TODAY))
    assert len(found) == bool(left)
    assert all(left in one for one in found)


def test_an_old_page_and_an_old_tag_are_named() -> None:
    assert list(STATE.of_the_page("a", "a", 7)) == []
    assert "7 commits old" in next(STATE.of_the_page("a", "b", 7))
    assert list(STATE.of_the_tree("", "v0.1.0", "0.2.0")) == []
    assert list(STATE.of_the_tree(" M a\n", "v0.2.0", "0.2.0")) == [
        "1 files are not committed",
        "the tag v0.2.0 exists: choose the next version",
    ]


@pytest.mark.parametrize("words", [[], ["--publish"], ["--dry-run", "--fast"]])
def test_only_a_dry_run_is_possible(words: list[str]) -> None:
    script = ROOT / "tools" / "release.sh"
    done = subprocess.run([script, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and "--dry-run --quick" in done.stderr


def test_the_dry_run_publishes_nothing() -> None:
    text = (ROOT / "tools" / "release.sh").read_text("utf-8")
    assert not re.search(r"upload|cargo publish|git (push|tag)|gpg|cosign", text)


FORMS = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_an_issue_form_asks_for_what_an_answer_needs(path: Path) -> None:
    form = yaml.safe_load(path.read_text("utf-8"))
    if path.stem == "config":
        assert form == {"blank_issues_enabled": True}
        return
    fields = {one["id"]: one for one in form["body"] if "id" in one}
    needed = {name for name, one in fields.items() if one.get("validations", {}).get("required")}
    assert {
        "wrong_number": {"case", "command", "came", "should_come", "version"},
        "refusal": {"case", "message", "kind", "version"},
        "wish": {"problem", "now"},
    }[path.stem] == needed


@pytest.mark.parametrize("name", ["SECURITY.md", "CODE_OF_CONDUCT.md", "GOVERNANCE.md"])
def test_a_page_for_the_community_names_no_address_and_has_targets(name: str) -> None:
    text = (ROOT / name).read_text("utf-8")
    assert not re.search(r"\w@\w|https?:", text)
    assert all((ROOT / target).is_file() for target in re.findall(r"\]\(([^)]+)\)", text))
    assert all((ROOT / name).is_file() for name in re.findall(r"`(docs/\S+\.md)`", text))
