"""The set-up installs the versions of constraints.txt, and only files with known hashes."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import pytest
from house.places import ROOT

LOCKS = ("run", "test", "packages", "release")
HASH = re.compile(r"--hash=sha256:[0-9a-f]{64}")


def pins(text: str) -> dict[tuple[str, str], str]:
    """The markers of each package and version."""
    found = re.findall(r"^([\w.-]+)==([\w.]+)[ \t]*;?[ \t]*([^\\\n#]*)", text, re.M)
    return {(name, version): marker.strip() for name, version, marker in found}


def lock(name: str) -> str:
    return (ROOT / "tools" / "lock" / f"{name}.txt").read_text("utf-8")


@pytest.mark.parametrize("name", LOCKS)
def test_every_package_has_hashes(name: str) -> None:
    entries = re.split(r"\n(?=\S)", lock(name).strip())
    assert entries
    for entry in entries:
        first, *others = entry.splitlines()
        assert re.match(r"[\w.-]+==[\w.]+", first), first
        assert others and all(HASH.search(line) for line in others), first


def test_the_versions_are_those_of_the_constraints() -> None:
    known = pins((ROOT / "constraints.txt").read_text("utf-8"))
    locked = {pin for name in LOCKS for pin in pins(lock(name))}
    assert locked == set(known), "run tools/lock.sh"


@pytest.mark.parametrize("name", LOCKS)
def test_every_requirement_is_locked(name: str) -> None:
    path = ROOT / "tools" / "requirements.py"
    spec = importlib.util.spec_from_file_location("requirements", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    named = {re.match(r"[\w.-]+", text)[0].lower() for text in module.requirements(name)}  # type: ignore[index]
    assert named <= {package for package, _ in pins(lock(name))}, "run tools/lock.sh"


def test_a_file_with_another_hash_is_refused(tmp_path: Path) -> None:
    (tmp_path / "thing-1.0-py3-none-any.whl").write_bytes(b"other content")
    (tmp_path / "lock.txt").write_text(f"thing==1.0 --hash=sha256:{'0' * 64}\n")
    words = ("-m", "pip", "install", "--dry-run", "--no-index", "--require-hashes")
    done = subprocess.run(
        [sys.executable, *words, "--find-links", ".", "-r", "lock.txt"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode != 0 and "HASH" in done.stderr.upper()


def test_the_set_up_and_the_workflow_require_hashes() -> None:
    for name in ("tools/setup.sh", ".github/workflows/wheels.yml"):
        text = (ROOT / name).read_text("utf-8").replace("\\\n", " ")
        installs = [line for line in text.splitlines() if "pip install" in line]
        assert installs
        assert all("--require-hashes" in line or "--no-deps" in line for line in installs), name


def test_actions_are_pinned_by_hash() -> None:
    for path in (ROOT / ".github" / "workflows").glob("*.yml"):
        used = re.findall(r"uses: (\S+)", path.read_text("utf-8"))
        assert used
        for action in used:
            assert re.fullmatch(r"[\w./-]+@[0-9a-f]{40}", action), action
