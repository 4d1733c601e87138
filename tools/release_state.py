"""What is left to do before a release: `.venv/bin/python tools/release_state.py`.

It reads the repository and changes nothing. Each line is a step of docs/internals/release.md that a
person does. Exit code: 0 if nothing is left, 3 otherwise.
"""

import datetime
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.10
    from pip._vendor import tomli as tomllib

ROOT = Path(__file__).resolve().parents[1]
LEFT = 3


def git(*words: str, root: Path = ROOT) -> str:
    """The output of a command of git."""
    done = subprocess.run(["git", *words], cwd=root, check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout.strip()


def of_the_changelog(text: str, version: str, today: datetime.date) -> Iterator[str]:
    """The version needs a heading with a date, and nothing may be listed above it."""
    heading = re.search(rf"^## \[{re.escape(version)}\] - (\d{{4}}-\d\d-\d\d)$", text, re.M)
    if heading is None:
        yield f"CHANGELOG.md: write the heading '## [{version}] - {today}' below [Unreleased]"
        return
    if datetime.date.fromisoformat(heading[1]) > today:
        yield f"CHANGELOG.md: {version} has a date in the future, {heading[1]}"
    above = text[: heading.start()].partition("## [Unreleased]")[2].strip()
    if above:
        yield f"CHANGELOG.md: there are changes above {version}; move them below its heading"


def of_the_addresses(root: Path) -> Iterator[str]:
    """A package index and a citation need the address of the repository."""
    project = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["project"]
    if "Repository" not in project.get("urls", {}):
        yield "pyproject.toml: [project.urls] has no Repository"
    cargo = tomllib.loads((root / "Cargo.toml").read_text("utf-8"))["workspace"]["package"]
    if "repository" not in cargo:
        yield "Cargo.toml: [workspace.package] has no repository"
    citation = (root / "CITATION.cff").read_text("utf-8")
    for key in ("repository-code", "date-released"):
        if not re.search(rf"^{key}: ", citation, re.M):
            yield f"CITATION.cff: there is no {key}"


def of_the_page(carried: str, present: str, commits: int) -> Iterator[str]:
    """The page of the studio is that of the sources."""
    if carried != present:
        yield (
            f"the page of the studio is {commits} commits old, and its sources have changed: "
            "run tools/release_page.sh and commit the page"
        )


def of_the_tree(status: str, tags: str, version: str) -> Iterator[str]:
    """All is committed, and the version is new."""
    if status:
        yield f"{len(status.splitlines())} files are not committed"
    if f"v{version}" in tags.split():
        yield f"the tag v{version} exists: choose the next version"


def left() -> Iterator[str]:
    """All steps that are left."""
    sys.path.insert(0, str(ROOT / "python"))
    from kempe._version import __version__
    from kempe.studio.page import CARRIED, read
    from kempe.studio.sources import checksum

    changelog = (ROOT / "CHANGELOG.md").read_text("utf-8")
    yield from of_the_changelog(changelog, __version__, datetime.date.today())
    yield from of_the_addresses(ROOT)
    last = git("log", "-1", "--format=%H", "--", str(CARRIED.relative_to(ROOT)))
    commits = int(git("rev-list", "--count", f"{last}..HEAD")) if last else 0
    yield from of_the_page(read(CARRIED).sources, checksum(), commits)
    yield from of_the_tree(git("status", "--porcelain"), git("tag"), __version__)


if __name__ == "__main__":
    steps = list(left())
    for step in steps:
        print(f"left: {step}")
    sys.exit(LEFT if steps else 0)
