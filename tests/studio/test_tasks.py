"""The counts of the five tasks in docs/studio.md are those of benchmarks/studio_tasks.py."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def rows(text: str) -> list[str]:
    """The lines of the table of tasks."""
    lines = text.splitlines()
    begin = lines.index("| task | clicks | drags | keys | estimated time |")
    end = next((k for k in range(begin, len(lines)) if not lines[k].startswith("|")), len(lines))
    return lines[begin:end]


@pytest.mark.usefixtures("built")
def test_the_counts_of_the_tasks_are_those_of_the_docs() -> None:
    # a process of its own: the browser of the tests is driven in this one
    program = [sys.executable, str(ROOT / "benchmarks" / "studio_tasks.py")]
    found = subprocess.run(
        program, capture_output=True, text=True, check=False, timeout=300, env=os.environ
    )
    assert found.returncode == 0, found.stderr
    docs = (ROOT / "docs" / "studio.md").read_text(encoding="utf-8")
    assert rows(found.stdout) == rows(docs)
    assert len(rows(docs)) == 7
