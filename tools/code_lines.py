"""Print the lines of code of each module of the core, without comments, blank lines and unit tests.

    python tools/code_lines.py [REVISION]...

Without a revision, the files of the working tree are counted; each revision adds a column.
"""

import io
import re
import subprocess
import sys
import tarfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SOURCES = "core/src"

sys.path.insert(0, str(ROOT / "tests"))
from house.rust_source import closing_brace, code_only  # noqa: E402


def code_lines(text: str) -> int:
    """Lines of Rust that contain code, without `#[cfg(test)]` items in braces."""
    kept = _without_comments(text)
    for begin, end in _test_items(code_only(kept)):
        kept = kept[:begin] + re.sub(r"[^\n]", " ", kept[begin:end]) + kept[end:]
    return sum(1 for line in kept.splitlines() if line.strip())


def _without_comments(text: str) -> str:
    """The text without comments; a `//` in a string is kept."""
    starts = [match.start() for match in re.finditer(r"//", text)]
    code = code_only(text)
    for start in starts:
        end = text.find("\n", start) if "\n" in text[start:] else len(text)
        before = text[text.rfind("\n", 0, start) + 1 : start]
        if not code[start:end].strip() and before.count('"') % 2 == 0:
            text = text[:start] + " " * (end - start) + text[end:]
    return text


def _test_items(code: str) -> list[tuple[int, int]]:
    """The ranges of items behind `#[cfg(test)]`, in code without strings and comments."""
    found = []
    for match in re.finditer(r"#\[cfg\(test\)\]", code):
        brace, semicolon = code.find("{", match.end()), code.find(";", match.end())
        is_short = 0 <= semicolon < brace or brace < 0
        end = semicolon if is_short else closing_brace(code, brace)
        found.append((match.start(), end + 1))
    return found


def counted(files: dict[str, str]) -> Counter[str]:
    """Lines of code by module: a folder of the core, and the folders of its analyses."""
    lines: Counter[str] = Counter()
    for name, text in files.items():
        parts = Path(name).relative_to(SOURCES).parts
        depth = 2 if parts[0] == "analyses" and len(parts) > 2 else 1
        lines["/".join(parts[:depth])] += code_lines(text)
    return lines


def sources(revision: str | None) -> dict[str, str]:
    """Name and text of the sources of the core, now or at a revision."""
    if revision is None:
        paths = sorted((ROOT / SOURCES).rglob("*.rs"))
        return {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8") for path in paths}
    command = ["git", "archive", revision, SOURCES]
    packed = subprocess.run(command, cwd=ROOT, capture_output=True, check=True).stdout
    with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
        return {
            member.name: file.read().decode()
            for member in archive
            if member.name.endswith(".rs") and (file := archive.extractfile(member))
        }


def main(revisions: list[str]) -> None:
    """Print a table with one column for each revision and one for the working tree."""
    heads = [*revisions, "now"]
    columns = [counted(sources(revision)) for revision in [*revisions, None]]
    modules = sorted({module for column in columns for module in column})
    print("| module | " + " | ".join(heads) + " |")
    print("|---|" + "---:|" * len(heads))
    for module in modules:
        print(f"| {module} | " + " | ".join(str(column[module]) for column in columns) + " |")
    print("| **total** | " + " | ".join(str(column.total()) for column in columns) + " |")


if __name__ == "__main__":
    main(sys.argv[1:])
