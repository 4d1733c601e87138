"""Public names, the file format and the command line change only if the change is announced.

``docs/promise.md`` states what is promised. The files beside this one contain the present state.
``KEMPE_WRITE=1`` writes them anew. A name that is removed or changed must then be in the changelog.
"""

import os
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from house.places import ROOT
from promise import files_and_commands, python_names

STATES: dict[str, Callable[[], list[str]]] = {
    "python_names": python_names.lines,
    "file_format": files_and_commands.file_format,
    "command_line": files_and_commands.command_line,
}
REMEDY = """\
To announce the change:
1. Keep each former name for one minor version, with a DeprecationWarning: kempe/base/deprecation.py
   has `renamed` for arguments and `former` for methods, and kempe/__init__.py has `_FORMER`.
   Fields of files stay for ever.
2. Write each name that is removed or changed, in backticks, below [Unreleased] in CHANGELOG.md.
3. Run KEMPE_WRITE=1 .venv/bin/python -m pytest tests/promise, and commit the files it writes."""


def place(state: str) -> Path:
    return Path(__file__).with_name(f"{state}.txt")


def changes(before: list[str], now: list[str]) -> list[str]:
    """The lines that are gone, with the marks of diff, and those that are new."""
    gone, new = sorted(set(before) - set(now)), sorted(set(now) - set(before))
    return [f"- {line}" for line in gone] + [f"+ {line}" for line in new]


def last_name(line: str) -> str:
    """The name that the changelog must contain: the last part of a line before its details."""
    found = re.match(r"exit code \d+", line)
    if found:
        return found[0]
    command, _, key = line.partition(" --json: ")
    name = key or re.split(r"\(|: | = |,", command)[0]
    return name.split(" ")[-1].rpartition(".")[2]


def unreleased() -> str:
    text = (ROOT / "CHANGELOG.md").read_text("utf-8")
    return re.split(r"^## ", text, flags=re.M)[1]


def missing_in(changelog: str, before: list[str], now: list[str]) -> list[str]:
    """Names that are removed or changed, and that no code in the changelog contains."""
    code = " ".join(re.findall(r"`([^`]+)`", changelog))
    named = set(re.findall(r"exit code \d+|--[\w-]+|\w+", code))
    return sorted({last_name(line) for line in set(before) - set(now)} - named)


@pytest.mark.parametrize("state", STATES)
def test_no_change_is_unannounced(state: str) -> None:
    path, now = place(state), STATES[state]()
    before = path.read_text("utf-8").splitlines() if path.exists() else []
    if os.environ.get("KEMPE_WRITE"):
        missing = missing_in(unreleased(), before, now)
        assert not missing, f"{', '.join(missing)}: not in backticks below [Unreleased]\n{REMEDY}"
        path.write_text("".join(f"{line}\n" for line in now), "utf-8")
        before = now
    told = changes(before, now)
    assert not told, "\n".join([f"{path.name} has changed:", *told[:40], "", REMEDY])


def test_names_are_listed_once_and_in_order() -> None:
    for state in STATES:
        lines = place(state).read_text("utf-8").splitlines()
        assert lines == sorted(set(lines)), state


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("dynamics(model, start, *, t_end)", "dynamics"),
        ("Model.revolute(name, i, j, *, axes=(0.0, 0.0))", "revolute"),
        ("returned.ConstraintView.force(*, on)", "force"),
        ("joints.revolute.i: point, required", "i"),
        ("units.mm = 0.001 m", "mm"),
        ("functions.sin(x)", "sin"),
        ("run --out, -o: path, default None", "--out"),
        ("sweep", "sweep"),
        ("run --json: analyses.swing.settling[].body", "body"),
        ("exit code 3: MECHANICS", "exit code 3"),
    ],
)
def test_the_changed_name_of_a_line(line: str, name: str) -> None:
    assert last_name(line) == name


def test_a_removed_name_must_be_in_the_changelog() -> None:
    before, now = ["f(a)", "g(x)"], ["f(b)", "g(x)", "h()"]
    assert changes(before, now) == ["- f(a)", "+ f(b)", "+ h()"]
    assert missing_in("## x\n- The function f has `b`.", before, now) == ["f"]
    assert missing_in("## x\n- The argument `a` of `kp.f` is `b`.", before, now) == []
    assert missing_in("", before, [*before, "h()"]) == []
